//! Modes: natural frequencies, damping ratios, couplings and shapes.

mod options;
mod plates;
mod report;
mod result;

pub use options::ModesOptions;
pub use plates::PlateShapes;
pub(crate) use plates::modes_and_plates;
pub use result::{BeamShapes, ModeResult, ModesResult, PatchCoupling, PointShape};

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_model::linear::couplings;
use jounce_model::structure::{BeamShape, Modes, shapes_along_beams};
use jounce_plot::ShapePatch;
use jounce_spec::Spec;
use std::f64::consts::TAU;

/// Number of places along each beam for its shapes.
const PLACES: usize = 201;

impl Harvester {
    /// Computes the undamped short-circuit modes, with some masses fixed.
    ///
    /// # Errors
    /// [`Error::Analysis`] for a structure without a solution or a mass that does not exist.
    ///
    /// ```
    /// use jounce::{Harvester, ModesOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let clamped = ModesOptions { fixed_table: true, ..Default::default() };
    /// let result = harvester.modes(&clamped)?;
    /// println!("{:.3} Hz", result.modes[0].frequency_hz);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn modes(&self, options: &ModesOptions) -> Result<ModesResult, Error> {
        let spec = self.spec();
        let held = held_masses(spec, &options.hold, options.fixed_table);
        let (modes, plates) = modes_and_plates(spec, &held)?;
        let shapes = shapes_along_beams(spec, &held, PLACES)?;
        let beam = |(name, shape): (String, BeamShape)| BeamShapes {
            patches: patches_on(spec, &name),
            shapes_per_sqrt_kg: (0..modes.len()).filter_map(|k| shape.mode(k)).collect(),
            place_m: shape.place_m,
            name,
        };
        let beams = shapes.into_iter().map(beam).collect();
        Ok(ModesResult {
            plates,
            ..ModesResult::new(modes, beams, held)
        })
    }
}

/// Returns the names of the fixed masses: those of `hold`, and all masses for a fixed table.
pub fn held_masses(spec: &Spec, hold: &[String], fixed_table: bool) -> Vec<String> {
    let masses = spec.mass.keys().filter(|_| fixed_table);
    hold.iter().chain(masses).cloned().collect()
}

fn patches_on(spec: &Spec, beam: &str) -> Vec<ShapePatch> {
    let patches = spec.patch.iter().filter(|(_, patch)| patch.on == beam);
    patches
        .map(|(label, patch)| ShapePatch {
            label: label.clone(),
            start_m: patch.start_m,
            end_m: patch.start_m + patch.length_m,
        })
        .collect()
}

impl ModesResult {
    fn new(modes: Modes, beams: Vec<BeamShapes>, held: Vec<String>) -> Self {
        let mode = |k: usize| ModeResult {
            frequency_hz: modes.frequency_rad_s[k] / TAU,
            damping_ratio: modes.damping_ratio[k],
            discretisation_error: modes.discretisation_error[k],
        };
        Self {
            modes: (0..modes.len()).map(mode).collect(),
            couplings: couplings(&modes),
            held,
            points: modes
                .shape
                .into_iter()
                .map(|(name, shape_per_sqrt_kg)| PointShape {
                    name,
                    shape_per_sqrt_kg,
                })
                .collect(),
            patches: modes
                .patch
                .into_iter()
                .map(|(name, patch)| PatchCoupling {
                    name,
                    capacitance_f: patch.capacitance_f,
                    coupling_n_per_v: patch.coupling_n_per_v,
                })
                .collect(),
            beams,
            plates: Vec::new(),
        }
    }
}
