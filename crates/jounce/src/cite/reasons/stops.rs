//! Contact laws of the stops.

use super::Reasons;
use jounce_spec::hertz::HERTZ_EXPONENT;
use jounce_spec::{Spec, StopLaw};

pub(super) fn add(spec: &Spec, reasons: &mut Reasons) {
    for (name, stop) in &spec.stop {
        match stop.law {
            StopLaw::Hertz { exponent, .. } if exponent == HERTZ_EXPONENT => {
                reasons.add("hertz-1881", format!("stop {name}: Hertz contact"));
            }
            StopLaw::HuntCrossley { .. } => {
                let law = format!("stop {name}: Hunt-Crossley contact");
                reasons.add("hunt-crossley-1975", law);
            }
            StopLaw::Cubic { .. } => {
                reasons.add("kovacic-brennan-2011", format!("stop {name}: cubic spring"));
            }
            StopLaw::Table { .. } => {
                let curve = format!("stop {name}: monotone curve through a table of forces");
                reasons.add("fritsch-butland-1984", curve);
            }
            StopLaw::Hertz { .. }
            | StopLaw::Spring { .. }
            | StopLaw::KelvinVoigt { .. }
            | StopLaw::Rigid { .. } => {}
        }
        if stop.bodies.is_some() {
            let stiffness = format!("stop {name}: Hertz stiffness of its bodies");
            reasons.add("hertz-1881", stiffness.clone());
            reasons.add("johnson-1985", stiffness);
        }
    }
    let is_rigid = |law: StopLaw| matches!(law, StopLaw::Rigid { .. });
    if spec.stop.values().filter(|stop| is_rigid(stop.law)).count() > 1 {
        reasons.add("moreau-1988", "simultaneous impacts on several rigid stops");
    }
}
