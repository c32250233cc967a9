//! Against what other programs found: the harvester of `bench/plant.toml` at 13.5 Hz, whose orbit of 18 drive cycles has 6.027567570e-6 W.

use crate::agreement::endings;
use crate::brute::{Ending, Patience};
use jounce::spec::SpecFile;
use jounce::study::{Grid, GridAxis, GridSide, Prepared};

/// The harvester at 40 N, 13.5 Hz, 100 kohm, against a stiffer and damped stop.
pub fn harvester() -> SpecFile {
    let mut file = SpecFile::from_text(include_str!("../../../../../bench/plant.toml"));
    for (key, value) in [
        ("drive.shaker.amplitude", "\"40 N\""),
        ("drive.shaker.frequency", "\"13.5 Hz\""),
        ("circuit.load.resistance", "\"100 kohm\""),
        ("stop.tip.stiffness", "\"10000 N/m^1.5\""),
    ] {
        file.set(key, value).unwrap();
    }
    match std::env::var("ROW").as_deref() {
        Ok("hc") => {
            file.set("stop.tip.law", "\"hunt-crossley\"").unwrap();
            file.set("stop.tip.damping", "\"0.3 s/m\"").unwrap();
        }
        Ok("table") => file.set("modal.harvester.damping_ratio", "[0.3, 0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.0016]").unwrap(),
        _ => {}
    }
    file
}

/// Starts on the grid of 20 by 20 that were tried there, every so many.
fn grid_endings(numbers: impl Iterator<Item = usize>, tolerance: f64) -> Vec<Ending> {
    let side = |axis: GridAxis, to: f64| GridSide { axis, from: -to, to, count: 20 };
    let grid = Grid { sides: vec![side(GridAxis::Displacement, 30e-3), side(GridAxis::Velocity, 1.6)] };
    let plant = Prepared::new(harvester().spec().unwrap()).unwrap().kernel.plant.clone();
    let starts: Vec<Vec<f64>> = numbers.map(|number| grid.start(&plant, number)).collect();
    endings(&plant.system, &starts, Patience { cycles: 6000, period: 64 }, tolerance)
}

#[test]
fn explore() {
    let begin = std::time::Instant::now();
    for (number, ending) in grid_endings((0..16).map(|i| i * 25), 1e-11).iter().enumerate() {
        eprintln!("{} {:?} {:.9e} {} {:?}", number * 25, ending.kind, ending.mean_power_w, ending.cycles, ending.exponent);
    }
    eprintln!("{:.2} s", begin.elapsed().as_secs_f64());
}
