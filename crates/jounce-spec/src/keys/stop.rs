//! `[stop.NAME]`

use crate::key::{Key, Kind, Range};
use crate::{Quantity, Side, Stop, StopLaw};

const LAWS: &[&str] = &[
    "hertz",
    "spring",
    "kelvin-voigt",
    "hunt-crossley",
    "cubic",
    "rigid",
];
const POWER_LAWS: &[&str] = &["hertz", "hunt-crossley"];
const LINEAR_LAWS: &[&str] = &["spring", "kelvin-voigt"];

/// Exponent of Hertz's law for two smooth bodies.
const HERTZ_EXPONENT: f64 = 1.5;

pub(super) fn blank() -> Stop {
    Stop {
        at: String::new(),
        frame: "ground".to_owned(),
        side: Side::default(),
        gap_m: f64::NAN,
        law: StopLaw::Hertz {
            stiffness: f64::NAN,
            exponent: HERTZ_EXPONENT,
        },
    }
}

pub(super) static KEYS: &[Key<Stop>] = &[
    Key::text(
        "at",
        Kind::Reference { what: "a point or mass" },
        "point that strikes the stop",
        |s: &Stop| s.at.clone(),
        |s, x| x.clone_into(&mut s.at),
    ),
    Key::text(
        "frame",
        Kind::Reference { what: "a point or mass, or \"ground\" or another base" },
        "support of the stop, which takes the reaction: `\"ground\"` or another base, a mass or a point",
        |s: &Stop| s.frame.clone(),
        |s, x| x.clone_into(&mut s.frame),
    )
    .optional(),
    Key::text(
        "side",
        Kind::Choice(&["positive", "negative"]),
        "direction in which the point moves to strike",
        |s: &Stop| if s.side == Side::Positive { "positive" } else { "negative" }.to_owned(),
        |s, x| s.side = if x == "positive" { Side::Positive } else { Side::Negative },
    )
    .optional(),
    Key::quantity(
        "gap",
        Quantity::Length,
        "distance to the stop at rest; negative for a preloaded contact; for `cubic` the position at which the spring is relaxed",
        |s: &Stop| s.gap_m,
        |s, x| s.gap_m = x,
    ),
    Key::text("law", Kind::Choice(LAWS), "contact law", |s: &Stop| law_word(&s.law).to_owned(), |s, x| s.law = blank_law(x)),
    Key::number("exponent", "exponent of the penetration", |s: &Stop| exponent(&s.law), |s, x| set_exponent(&mut s.law, x))
        .within(Range::from(1.0, 10.0))
        .when("law", POWER_LAWS)
        .optional(),
    Key::quantity(
        "stiffness",
        Quantity::ContactStiffness { exponent: HERTZ_EXPONENT },
        "contact stiffness: force over penetration to the power of `exponent`",
        |s: &Stop| stiffness(&s.law),
        |s, x| set_stiffness(&mut s.law, x),
    )
    .within(Range::POSITIVE)
    .when("law", POWER_LAWS)
    .measured_by("exponent", |s: &Stop| Some(Quantity::ContactStiffness { exponent: exponent(&s.law) })),
    Key::quantity(
        "stiffness",
        Quantity::Stiffness,
        "contact stiffness: force over penetration",
        |s: &Stop| stiffness(&s.law),
        |s, x| set_stiffness(&mut s.law, x),
    )
    .within(Range::POSITIVE)
    .when("law", LINEAR_LAWS),
    Key::quantity(
        "stiffness",
        Quantity::Stiffness,
        "linear stiffness on both sides; negative for a spring that pushes away from its relaxed position",
        // A blank stop has another law, so this value is the default.
        |s: &Stop| if let StopLaw::Cubic { stiffness_n_m, .. } = s.law { stiffness_n_m } else { 0.0 },
        |s, x| set_stiffness(&mut s.law, x),
    )
    .when("law", &["cubic"])
    .optional(),
    Key::quantity(
        "cubic_stiffness",
        Quantity::ContactStiffness { exponent: 3.0 },
        "cubic stiffness on both sides: force over displacement cubed; negative for a softening spring",
        |s: &Stop| if let StopLaw::Cubic { cubic_stiffness_n_m3, .. } = s.law { cubic_stiffness_n_m3 } else { f64::NAN },
        |s, x| set_cubic_stiffness(&mut s.law, x),
    )
    .when("law", &["cubic"]),
    Key::quantity(
        "damping",
        Quantity::Damping,
        "contact damping: force over penetration rate",
        |s: &Stop| damping(&s.law),
        |s, x| set_damping(&mut s.law, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["kelvin-voigt"]),
    Key::quantity(
        "damping",
        Quantity::InverseSpeed,
        "damping factor c of `1 + c * rate of penetration`",
        |s: &Stop| damping(&s.law),
        |s, x| set_damping(&mut s.law, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["hunt-crossley"]),
    Key::number(
        "restitution",
        "coefficient of restitution: speed after the impact over speed before it",
        |s: &Stop| if let StopLaw::Rigid { restitution } = s.law { restitution } else { f64::NAN },
        |s, x| s.law = StopLaw::Rigid { restitution: x },
    )
    .within(Range::from(0.0, 1.0))
    .when("law", &["rigid"]),
];

fn law_word(law: &StopLaw) -> &'static str {
    match law {
        StopLaw::Hertz { .. } => "hertz",
        StopLaw::Spring { .. } => "spring",
        StopLaw::KelvinVoigt { .. } => "kelvin-voigt",
        StopLaw::HuntCrossley { .. } => "hunt-crossley",
        StopLaw::Cubic { .. } => "cubic",
        StopLaw::Rigid { .. } => "rigid",
    }
}

fn blank_law(word: &str) -> StopLaw {
    let (hole, exponent) = (f64::NAN, HERTZ_EXPONENT);
    match word {
        "spring" => StopLaw::Spring {
            stiffness_n_m: hole,
        },
        "kelvin-voigt" => StopLaw::KelvinVoigt {
            stiffness_n_m: hole,
            damping_n_s_m: hole,
        },
        "hunt-crossley" => StopLaw::HuntCrossley {
            stiffness: hole,
            exponent,
            damping_s_m: hole,
        },
        "cubic" => StopLaw::Cubic {
            stiffness_n_m: 0.0,
            cubic_stiffness_n_m3: hole,
        },
        "rigid" => StopLaw::Rigid { restitution: hole },
        _ => StopLaw::Hertz {
            stiffness: hole,
            exponent,
        },
    }
}

fn exponent(law: &StopLaw) -> f64 {
    match law {
        StopLaw::Hertz { exponent, .. } | StopLaw::HuntCrossley { exponent, .. } => *exponent,
        _ => 1.0,
    }
}

fn set_exponent(law: &mut StopLaw, value: f64) {
    if let StopLaw::Hertz { exponent, .. } | StopLaw::HuntCrossley { exponent, .. } = law {
        *exponent = value;
    }
}

fn stiffness(law: &StopLaw) -> f64 {
    match law {
        StopLaw::Hertz { stiffness: k, .. } | StopLaw::HuntCrossley { stiffness: k, .. } => *k,
        StopLaw::Spring { stiffness_n_m: k }
        | StopLaw::KelvinVoigt {
            stiffness_n_m: k, ..
        }
        | StopLaw::Cubic {
            stiffness_n_m: k, ..
        } => *k,
        StopLaw::Rigid { .. } => f64::NAN,
    }
}

fn set_stiffness(law: &mut StopLaw, value: f64) {
    match law {
        StopLaw::Hertz { stiffness: k, .. } | StopLaw::HuntCrossley { stiffness: k, .. } => {
            *k = value
        }
        StopLaw::Spring { stiffness_n_m: k }
        | StopLaw::KelvinVoigt {
            stiffness_n_m: k, ..
        }
        | StopLaw::Cubic {
            stiffness_n_m: k, ..
        } => *k = value,
        StopLaw::Rigid { .. } => {}
    }
}

fn set_cubic_stiffness(law: &mut StopLaw, value: f64) {
    if let StopLaw::Cubic {
        cubic_stiffness_n_m3: k,
        ..
    } = law
    {
        *k = value;
    }
}

fn damping(law: &StopLaw) -> f64 {
    match law {
        StopLaw::KelvinVoigt {
            damping_n_s_m: c, ..
        }
        | StopLaw::HuntCrossley { damping_s_m: c, .. } => *c,
        _ => f64::NAN,
    }
}

fn set_damping(law: &mut StopLaw, value: f64) {
    if let StopLaw::KelvinVoigt {
        damping_n_s_m: c, ..
    }
    | StopLaw::HuntCrossley { damping_s_m: c, .. } = law
    {
        *c = value;
    }
}
