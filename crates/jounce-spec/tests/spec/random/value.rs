//! Random numbers and names.

use proptest::prelude::*;

pub fn positive() -> impl Strategy<Value = f64> {
    (-9.0..9.0f64).prop_map(|exponent| 10f64.powf(exponent))
}

pub fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![positive(), positive().prop_map(|x| -x), Just(0.0)]
}

pub fn name() -> impl Strategy<Value = String> {
    "[A-Za-z0-9_-]{1,8}".prop_filter("taken", |name| {
        !["ground", "nothing", "root", "end"].contains(&name.as_str())
    })
}
