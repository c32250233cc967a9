//! Random contact laws.

use super::system::Scales;
use crate::random_specs::Draw;
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid, Table};
use jounce_spec::ForceCurve;

/// Names of the laws; the first is the rigid one.
pub const LAWS: [&str; 10] = [
    "rigid", "hertz", "hertz", "spring", "voigt", "voigt", "hunt", "hunt", "cubic", "table",
];

/// Draws the parameters of a law.
pub fn law(draw: &mut Draw, scales: &Scales, name: &str) -> Law {
    // Contact raises the frequency of the first mode by this factor.
    let stiffness = scales.stiffness * draw.decades(0.3, 200.0).powi(2);
    let exponents = [1.5, 1.5, 1.5, 1.5, 1.2, 2.0, 2.0, 1.35];
    let exponent = draw.one_of(&exponents);
    // A power law has that stiffness at a tenth of the length.
    let powered = stiffness / (exponent * (0.1 * scales.length).powf(exponent - 1.0));
    let damping_s_m = draw.decades(0.02, 3.0) / (scales.angular * scales.length);
    let elastic = Hertz {
        stiffness: powered,
        exponent,
    };
    match name {
        "hertz" => Law::Hertz(elastic),
        "spring" => Law::Hertz(Hertz {
            stiffness,
            exponent: 1.0,
        }),
        "hunt" => Law::HuntCrossley(HuntCrossley {
            elastic,
            damping_s_m,
        }),
        "voigt" => Law::KelvinVoigt(KelvinVoigt {
            stiffness_n_m: stiffness,
            damping_n_s_m: 2.0 * draw.decades(0.003, 1.0) * (stiffness * scales.mass).sqrt(),
        }),
        "cubic" => Law::Cubic(Cubic {
            stiffness_n_m: scales.stiffness * draw.within(-0.6, 2.0),
            cubic_stiffness_n_m3: scales.stiffness * draw.decades(0.1, 20.0)
                / scales.length.powi(2),
        }),
        "table" => Law::Table(Table::new(curve(draw, scales), {
            if draw.happens(0.5) { damping_s_m } else { 0.0 }
        })),
        _ => Law::Rigid(Rigid {
            restitution: draw.one_of(&[0.0, 0.3, 0.6, 0.8, 0.9]) + draw.within(0.0, 0.08),
        }),
    }
}

/// Draws a curve of two to five points that hardens or softens.
fn curve(draw: &mut Draw, scales: &Scales) -> ForceCurve {
    let (mut at, mut force) = (vec![], vec![]);
    let (mut x, mut f) = (0.0, 0.0);
    for _ in 0..draw.one_of(&[2, 3, 5]) {
        let length = scales.length * draw.decades(0.01, 0.3);
        x += length;
        f += length * scales.stiffness * draw.decades(0.5, 60.0).powi(2);
        at.push(x);
        force.push(f);
    }
    ForceCurve::through(&at, &force).unwrap()
}
