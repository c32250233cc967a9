//! Harvesters and searches shared by several tests.

use jounce_analysis::{Branch, BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_dynamics::Kernel;
use jounce_model::plant::{Plant, PlantError, System};
use jounce_orbits::{ModelInstance, ParametricModel};
use jounce_spec::SpecFile;

/// Systems given by a function of any parameter, with derivatives by differences.
pub struct Systems<F>(pub F);

impl<F: Fn(f64) -> System + Sync> ParametricModel for Systems<F> {
    type Error = PlantError;

    fn at(&self, parameter: f64) -> Result<ModelInstance, PlantError> {
        Ok(ModelInstance {
            kernel: Kernel::new(Plant::new((self.0)(parameter))?)?,
            change: None,
        })
    }

    fn difference(&self) -> f64 {
        1e-7
    }
}

/// `bench/plant.toml`: the paper's harvester with eight modes.
pub fn bench() -> SpecFile {
    SpecFile::from_text(include_str!("../../../../bench/plant.toml"))
}

/// The bench with some keys changed.
pub fn bench_with_keys(changes: &[(&str, &str)]) -> SpecFile {
    let mut file = bench();
    changes
        .iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file
}

/// Branches of one drive cycle over the frequency of the shaker.
pub fn branches(
    file: &SpecFile,
    range: (f64, f64),
    method: OrbitMethodKind,
    seeds: usize,
) -> Vec<Branch> {
    branches_of(file, range, method, seeds, 1)
}

/// Branches of several drive cycles.
pub fn branches_of(
    file: &SpecFile,
    range: (f64, f64),
    method: OrbitMethodKind,
    seeds: usize,
    longest_period: u32,
) -> Vec<Branch> {
    branches_to(1e-10, file, range, method, (seeds, longest_period))
}

/// Branches to a tolerance of the integrations, from a number of seeds up to a longest period.
pub fn branches_to(
    tolerance: f64,
    file: &SpecFile,
    range: (f64, f64),
    method: OrbitMethodKind,
    (seeds, longest_period): (usize, u32),
) -> Vec<Branch> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds,
        longest_period,
    }
    .run()
    .unwrap()
}
