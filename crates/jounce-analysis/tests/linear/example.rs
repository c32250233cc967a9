//! An example: its spec with some keys changed, its plant.

use crate::rows::folder;
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_spec::{Spec, SpecFile};

/// Acceleration of gravity used in the results of the papers, m/s^2.
pub const G_M_S2: f64 = 9.81;

/// Spec of an example with some keys changed.
pub fn spec(example: &str, settings: &[(&str, &str)]) -> Spec {
    let mut file = SpecFile::read(folder(example).join("harvester.toml")).unwrap();
    for (key, value) in settings {
        file.set(key, value).unwrap();
    }
    file.spec().unwrap_or_else(|faults| panic!("{faults}"))
}

pub fn plant(example: &str, settings: &[(&str, &str)]) -> Plant {
    let spec = spec(example, settings);
    Plant::new(System::assemble(&spec, modes(&spec).unwrap()).unwrap()).unwrap()
}
