//! A switch at an extremum that roundoff places on either side of zero.

use crate::plants::{from_rest, kernel};
use jounce_model::plant::System;
use jounce_spec::Spec;

/// A film on a cantilever that rests against a stiff stop. The time of an extremum of its charge has
/// roundoff, so that the current may lie on either side of zero there.
const PRESSED_FILM: &str = r#"
[beam.a]
material = "steel"
length = "164.5 mm"
width = "30.96 mm"
thickness = "0.1897 mm"
[patch.film]
on = "a"
material = "PVDF"
start = "81.42 mm"
length = "61.56 mm"
width = "25.94 mm"
thickness = "0.06273 mm"
[circuit.c]
patch = "film"
interface = "parallel-sshi"
battery = "0.5383 V"
quality_factor = 20
[stop.end]
at = "a.end"
law = "spring"
gap = "0 mm"
stiffness = "3.165e8 N/m"
[drive.base]
kind = "base-displacement"
amplitude = "0.007486 mm"
frequency = "2.446 Hz"
[damping]
beyond = 0.005
[reduction]
modes = 2
"#;

/// Each switch once left the current past the next extremum, by roundoff, and closed without end at
/// 0.83 s.
#[test]
fn a_switch_closes_once_where_roundoff_places_the_current_past_the_next_extremum() {
    let spec = Spec::from_toml(PRESSED_FILM).unwrap();
    let modes = jounce_model::structure::modes(&spec).unwrap();
    let kernel = kernel(System::assemble(&spec, modes).unwrap());
    for tolerance in [1e-6, 1e-7] {
        let energies = from_rest(&kernel, 1.0, tolerance).energies;
        let (switch_j, residual) = (energies.rectified[0].switch_j, energies.residual_relative());
        eprintln!("{switch_j:e} J in the switch, residual {residual:.1e}");
        assert!(switch_j > 0.0 && residual.abs() < tolerance);
    }
}
