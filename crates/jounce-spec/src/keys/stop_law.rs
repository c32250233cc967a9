//! `[stop.NAME]`: getters and setters of the contact law.

use crate::StopLaw;
use crate::hertz::HERTZ_EXPONENT;

pub(super) fn law_word(law: &StopLaw) -> &'static str {
    match law {
        StopLaw::Hertz { .. } => "hertz",
        StopLaw::Spring { .. } => "spring",
        StopLaw::KelvinVoigt { .. } => "kelvin-voigt",
        StopLaw::HuntCrossley { .. } => "hunt-crossley",
        StopLaw::Cubic { .. } => "cubic",
        StopLaw::Table { .. } => "table",
        StopLaw::Rigid { .. } => "rigid",
    }
}

pub(super) fn blank_law(word: &str) -> StopLaw {
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
        "table" => StopLaw::Table { damping_s_m: 0.0 },
        "rigid" => StopLaw::Rigid { restitution: hole },
        _ => StopLaw::Hertz {
            stiffness: hole,
            exponent,
        },
    }
}

pub(super) fn exponent(law: &StopLaw) -> f64 {
    match law {
        StopLaw::Hertz { exponent, .. } | StopLaw::HuntCrossley { exponent, .. } => *exponent,
        _ => 1.0,
    }
}

pub(super) fn set_exponent(law: &mut StopLaw, value: f64) {
    if let StopLaw::Hertz { exponent, .. } | StopLaw::HuntCrossley { exponent, .. } = law {
        *exponent = value;
    }
}

pub(super) fn stiffness(law: &StopLaw) -> f64 {
    match law {
        StopLaw::Hertz { stiffness: k, .. } | StopLaw::HuntCrossley { stiffness: k, .. } => *k,
        StopLaw::Spring { stiffness_n_m: k }
        | StopLaw::KelvinVoigt {
            stiffness_n_m: k, ..
        }
        | StopLaw::Cubic {
            stiffness_n_m: k, ..
        } => *k,
        StopLaw::Table { .. } | StopLaw::Rigid { .. } => f64::NAN,
    }
}

pub(super) fn set_stiffness(law: &mut StopLaw, value: f64) {
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
        StopLaw::Table { .. } | StopLaw::Rigid { .. } => {}
    }
}

pub(super) fn set_cubic_stiffness(law: &mut StopLaw, value: f64) {
    if let StopLaw::Cubic {
        cubic_stiffness_n_m3: k,
        ..
    } = law
    {
        *k = value;
    }
}

pub(super) fn damping(law: &StopLaw) -> f64 {
    match law {
        StopLaw::KelvinVoigt {
            damping_n_s_m: c, ..
        }
        | StopLaw::HuntCrossley { damping_s_m: c, .. }
        | StopLaw::Table { damping_s_m: c } => *c,
        _ => f64::NAN,
    }
}

pub(super) fn set_damping(law: &mut StopLaw, value: f64) {
    if let StopLaw::KelvinVoigt {
        damping_n_s_m: c, ..
    }
    | StopLaw::HuntCrossley { damping_s_m: c, .. }
    | StopLaw::Table { damping_s_m: c } = law
    {
        *c = value;
    }
}
