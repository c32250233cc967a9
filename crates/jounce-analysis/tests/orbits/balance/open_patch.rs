//! Orbits of a harvester with an open patch, whose charge is constant: the orbit with zero charge
//! is selected.

use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::{BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_orbits::{ParametricModel, Shooting};
use jounce_spec::SpecFile;

const HARVESTER: &str = r#"
[beam.b]
material = "steel"
length = "100 mm"
width = "10 mm"
thickness = "1 mm"
[patch.p]
on = "b"
face = "top"
material = "PZT-5H"
start = "0 mm"
length = "40 mm"
width = "10 mm"
thickness = "0.2 mm"
electrodes = "open"
[stop.s]
at = "b.end"
gap = "0.2 mm"
law = "hertz"
stiffness = "1e6 N/m^1.5"
[drive.base]
kind = "base-acceleration"
amplitude = "1 g"
frequency = "80 Hz"
[damping]
beyond = 0.02
[reduction]
modes = 3
"#;

/// The charge retains its initial value along the complete branch, and the largest penetration
/// equals that of runs from rest. Measured: charges below 1e-9 of the peak charge of the patch,
/// penetrations 6e-8 and 5e-10 apart.
#[test]
fn a_branch_is_that_of_a_patch_that_was_never_charged() {
    let file = SpecFile::from_text(HARVESTER);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.base.frequency").unwrap();
    let range = (80.0, 84.0);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
    };
    let plant = &base.kernel.plant;
    let (n, node) = (plant.system.modes.len(), &plant.electrical.nodes[0]);
    let shooting = Shooting::new(&parameter, &base.kernel, 1, 1e-9);
    let branches = search.run().unwrap();
    let [branch] = &branches[..] else {
        panic!("{} branches", branches.len())
    };
    let mut points: Vec<_> = branch.points.iter().collect();
    points.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
    for point in &points {
        let state = shooting.physical(point.orbit.start());
        let displaced_c: f64 = node
            .coupling_n_per_v
            .iter()
            .zip(&state)
            .map(|(theta, q)| theta * q)
            .sum();
        let charge_c = node.capacitance_f * state[2 * n] + displaced_c;
        assert!(
            charge_c.abs() < 1e-9 * displaced_c.abs(),
            "{} Hz: {charge_c:e} C of {displaced_c:e}",
            point.parameter
        );
        assert!(point.orbit.is_stable() && point.orbit.mean_power_w.to_bits() == 0);
    }
    for point in [points[0], points[points.len() - 1]] {
        let kernel = parameter.at(point.parameter).unwrap().kernel;
        let plan = RunPlan {
            duration_s: 6.0,
            average_over_s: 0.2,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let run = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        let error = point.orbit.max_penetration_m / run.max_penetration_m - 1.0;
        eprintln!("{} Hz: {error:.1e}", point.parameter);
        assert!(error.abs() < 1e-6);
    }
}
