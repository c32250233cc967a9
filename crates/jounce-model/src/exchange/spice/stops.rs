//! Stops as behavioural sources.

use super::resonators::{coordinate, sum};
use crate::contact::Law;
use crate::plant::{Stop, System};
use jounce_spec::ForceCurve;

/// Penetration, rate and force of each stop, each as the voltage of a node.
pub(super) fn stops(system: &System) -> Vec<String> {
    let mut lines = Vec::new();
    for (index, stop) in system.stops.iter().enumerate() {
        let number = index + 1;
        lines.push(String::new());
        lines.push(format!(
            "* Stop {}: penetration in m, its rate in m/s, force in N",
            stop.name
        ));
        let displacement = sum(&stop.shape, |mode| coordinate(system, mode));
        lines.push(format!(
            "Bdepth{number} depth{number} 0 v = {displacement} - ({:e})",
            stop.gap_m
        ));
        let rate = sum(&stop.shape, |mode| format!("i(Vmode{})", mode + 1));
        lines.push(format!("Brate{number} rate{number} 0 v = {rate}"));
        lines.push(format!(
            "Bstop{number} stop{number} 0 v = {}",
            force(stop, number)
        ));
    }
    lines
}

/// The force of a law.
fn force(stop: &Stop, number: usize) -> String {
    let (depth, rate) = (format!("v(depth{number})"), format!("v(rate{number})"));
    let hertz = |stiffness: f64, exponent: f64| match exponent == 1.0 {
        true => format!("{stiffness:e}*max({depth},0)"),
        false => format!("{stiffness:e}*pwr(max({depth},0),{exponent})"),
    };
    match &stop.law {
        Law::Hertz(law) => hertz(law.stiffness, law.exponent),
        Law::HuntCrossley(law) => {
            let elastic = hertz(law.elastic.stiffness, law.elastic.exponent);
            format!("{elastic}*max(1 + {:e}*{rate},0)", law.damping_s_m)
        }
        Law::KelvinVoigt(law) => format!(
            "{depth} > 0 ? max({:e}*{depth} + {:e}*{rate},0) : 0",
            law.stiffness_n_m, law.damping_n_s_m
        ),
        Law::Cubic(law) => format!(
            "{depth}*({:e} + ({:e})*{depth}*{depth})",
            law.stiffness_n_m, law.cubic_stiffness_n_m3
        ),
        Law::Table(law) => {
            let elastic = rises(law.curve(), &depth);
            format!("({elastic})*max(1 + {:e}*{rate},0)", law.damping_s_m())
        }
        // Refused before.
        Law::Rigid(_) => "0".to_owned(),
    }
}

/// A force curve as the sum of its rises over the pieces, one piece on a line.
fn rises(curve: &ForceCurve, depth: &str) -> String {
    let pieces: Vec<(f64, [f64; 3])> = curve.pieces().collect();
    let rise = |(index, (start_m, [c1, c2, c3])): (usize, &(f64, [f64; 3]))| {
        let past = format!("max({depth} - {start_m:e},0)");
        let past = match pieces.get(index + 1) {
            Some((end_m, _)) => format!("min({past},{:e})", end_m - start_m),
            None => past,
        };
        format!("{past}*({c1:e} + {past}*(({c2:e}) + {past}*({c3:e})))")
    };
    let terms: Vec<String> = pieces.iter().enumerate().map(rise).collect();
    terms.join("\n+ + ")
}
