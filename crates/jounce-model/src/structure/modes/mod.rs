//! A structure as its modes: the only description of beams that the rest of jounce uses.
//!
//! Per mode `i`, with mass-normalised shapes (SI units):
//!
//! ```text
//! q_i'' + 2 zeta_i w_i q_i' + w_i^2 q_i = sum_patches coupling_i V + sum_points shape_i(point) F(point)
//! x(point) = sum_i shape_i(point) q_i
//! C V' + (current into the circuit) + sum_i coupling_i q_i' = 0
//! ```
//!
//! Under an acceleration `a` of the base the right side gains `-participation_i a`, with
//! `participation_i = integral of shape_i dm`. Displacements are then relative to the base (Erturk
//! and Inman, J. Vib. Acoust. 130 (2008) 041002).
//!
//! Source: impact-harvester paper (2019), eqs. (5) and (6), projected onto undamped short-circuit
//! modes.

pub(super) mod along;
pub(super) mod assembled;
pub(super) mod damping;
pub(super) mod merge;
mod strain;
pub(super) mod user;

pub use strain::PlaceStrain;

use jounce_spec::GROUND;
use std::collections::BTreeMap;

/// Undamped short-circuit modes of all structures of a harvester, in ascending frequency.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Modes {
    /// Undamped short-circuit angular frequencies, rad/s, ascending; 0 for a rigid-body mode.
    pub frequency_rad_s: Vec<f64>,
    /// Damping ratio of each mode (1 = critical); meaningless for a rigid-body mode, where it is 0.
    pub damping_ratio: Vec<f64>,
    /// Mass-normalised shape at each named point (`"beam.tip"`, `"table"`, `"harvester.tip"`),
    /// kg^-1/2, one value per mode.
    pub shape: BTreeMap<String, Vec<f64>>,
    /// Each patch by its name (`"mfc"`, `"harvester.mfc"`).
    pub patch: BTreeMap<String, PatchModes>,
    /// Participation of each mode in a uniform acceleration of the base, kg^1/2: mass times shape,
    /// summed over all parts that move relative to the base. With `a` the acceleration of the base
    /// (m/s^2), the modal force is `-participation a` and `q` is relative to the base. The sum of
    /// squares over all modes is the moving mass. Zero if the modes were given without it.
    pub participation_sqrt_kg: Vec<f64>,
    /// Part of the participation due to the elements on each base other than the ground, by the
    /// name of the base.
    pub base_sqrt_kg: BTreeMap<String, Vec<f64>>,
    /// Estimated relative discretisation error of each frequency (0 for modes defined in the spec).
    pub discretisation_error: Vec<f64>,
    /// Number of the last entries of `damping.ratios` that no retained mode takes.
    pub unused_damping_ratios: usize,
}

/// Coupling of a piezoelectric patch to the modes and to the circuit.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchModes {
    /// Modal coupling, N/V per unit modal coordinate (`gamma_p` times the modal slope difference of
    /// the patch ends), one per mode.
    pub coupling_n_per_v: Vec<f64>,
    /// Clamped capacitance, F.
    pub capacitance_f: f64,
    /// Leakage resistance across the capacitance, ohm; `None` without leakage.
    pub leakage_ohm: Option<f64>,
    /// Strain of the outer face at several places of the patch. Empty for modes defined in the spec.
    pub strain: Vec<PlaceStrain>,
}

impl Modes {
    /// Number of modes.
    pub fn len(&self) -> usize {
        self.frequency_rad_s.len()
    }

    /// Returns the participation of each mode in an acceleration of one base, kg^1/2; elements on
    /// no other base follow the ground.
    pub fn participation_in_sqrt_kg(&self, base: &str) -> Vec<f64> {
        if base != GROUND {
            return self
                .base_sqrt_kg
                .get(base)
                .cloned()
                .unwrap_or_else(|| vec![0.0; self.len()]);
        }
        let others = |mode: usize| {
            self.base_sqrt_kg
                .values()
                .map(|participation| participation[mode])
                .sum::<f64>()
        };
        self.participation_sqrt_kg
            .iter()
            .enumerate()
            .map(|(mode, all)| all - others(mode))
            .collect()
    }

    /// Returns the first `count` modes.
    pub(super) fn first(mut self, count: usize) -> Self {
        let patch_lists = self.patch.values_mut().flat_map(|patch| {
            let strain = patch.strain.iter_mut().flat_map(PlaceStrain::rows_mut);
            std::iter::once(&mut patch.coupling_n_per_v).chain(strain)
        });
        let named = self
            .shape
            .values_mut()
            .chain(self.base_sqrt_kg.values_mut());
        let lists = [
            &mut self.frequency_rad_s,
            &mut self.damping_ratio,
            &mut self.participation_sqrt_kg,
            &mut self.discretisation_error,
        ];
        for list in patch_lists.chain(named).chain(lists) {
            list.truncate(count);
        }
        self
    }

    /// True if there are no modes.
    pub fn is_empty(&self) -> bool {
        self.frequency_rad_s.is_empty()
    }
}
