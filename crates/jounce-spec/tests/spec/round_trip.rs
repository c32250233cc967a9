//! A printed spec reads back bit for bit.

use jounce_spec::Spec;
use proptest::prelude::*;

use crate::random;

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_spec_survives_printing_and_reading(spec in random::spec()) {
        let text = spec.to_toml();
        let again = Spec::from_toml(&text).map_err(|faults| TestCaseError::fail(format!("{faults}\n{text}")))?;
        prop_assert_eq!(&again, &spec);
        prop_assert_eq!(again.to_toml(), text);
    }
}
