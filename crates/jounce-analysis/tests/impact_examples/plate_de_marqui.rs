//! `examples/plate-de-marqui-2009/stop.toml`: a plate that strikes a stop at one corner.

use crate::example::{relative, run, spec};
use crate::rows::folder;
use jounce_analysis::{Basins, Cloud, InitialStates, Model, Parameter, Recognition, settled_orbit};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_orbits::{HarmonicBalance, OrbitMethod, Shooting};
use jounce_spec::SpecFile;

const EXAMPLE: &str = "plate-de-marqui-2009";
const SPEC: &str = "stop.toml";

/// Energy is conserved and the run settles on a periodic motion with contacts.
#[test]
fn a_run_conserves_energy_and_settles() {
    let (_, result) = run(EXAMPLE, SPEC, &[]);
    let residual = result.energies.residual_relative();
    assert!(residual.abs() < 1e-8, "{residual:e}");
    let settled = result.settlement.as_ref().is_some_and(|end| end.settled);
    assert!(result.contacts > 0 && settled, "{:?}", result.settlement);
}

/// Time integration, shooting and harmonic balance give one orbit, and the basins contain it.
#[test]
fn three_methods_give_one_orbit() {
    let (_, result) = run(EXAMPLE, SPEC, &[]);
    let base = Model::new(spec(EXAMPLE, SPEC, &[])).unwrap();
    let file = SpecFile::read(folder(EXAMPLE).join(SPEC)).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let hertz = key.get(&base.spec).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let rest = vec![0.0; base.kernel.plant.len()];
    let exact = settled_orbit(&parameter, hertz, &rest, 1e-11, 1e-10).unwrap();
    let error = relative(exact.mean_power_w, result.mean_power_w);
    assert!(error < 1e-5, "shooting and the run: {error:e}");

    let shooting = Shooting::new(&parameter, &base.kernel, 1, 1e-11);
    let method = HarmonicBalance::new(shooting, &base.kernel, 200, 0.0).unwrap();
    let position = Position {
        unknown: method.unknown_of(exact.start(), hertz).unwrap(),
        parameter: hertz,
    };
    let corrector = Corrector {
        goal: 1e-10,
        most: 20,
    };
    let metric = Metric::at(&position, 1.0);
    let solution = correct_at(&method, &corrector, &metric, position).unwrap();
    let orbit = method.orbit(&solution.local, solution.error).unwrap();
    let error = relative(orbit.mean_power_w, exact.mean_power_w);
    assert!(error < 1e-6, "harmonic balance and shooting: {error:e}");

    let basins = Basins {
        base: &base,
        starts: InitialStates::Cloud(Cloud {
            starts: 12,
            seed: 1,
            spread: 20.0,
        }),
        recognition: Recognition::at(1e-8),
    }
    .run()
    .unwrap();
    let sum: f64 = basins.attractors.iter().map(|a| a.share.fraction).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    let known = |power_w: f64| relative(power_w, exact.mean_power_w) < 1e-6;
    assert!(basins.attractors.iter().any(|a| known(a.mean_power_w)));
}
