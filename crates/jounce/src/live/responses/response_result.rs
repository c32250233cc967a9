//! Result of a response over a key.

use super::LinearCurve;
use super::draft::Draft;
use jounce_analysis::{Bifurcation, Branch, BranchPoint, Termination};
use jounce_model::plant::System;
use jounce_spec::NumericKey;
use serde::Serialize;

/// Branches of periodic orbits over a key, and the harvester without contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseResult {
    /// The key.
    pub over: String,
    /// Its SI unit.
    pub unit: String,
    /// True where the voltage of the points is that of the storage of a rectified circuit.
    pub is_storage_voltage: bool,
    /// Number of patches, whose strain [`LiveAnalysis::strain`](crate::live::LiveAnalysis::strain)
    /// computes.
    pub patches: usize,
    /// Mean power without contact.
    pub linear: LinearCurve,
    /// The branches.
    pub branches: Vec<ResponseBranch>,
    /// Bifurcations of all branches.
    pub bifurcations: Vec<ResponseBifurcation>,
    /// Branches that the search may miss; `None` for a coarse response.
    pub note: Option<String>,
    /// Branches that the search did not follow to their end, or not at all, for lack of budget;
    /// `None` where there are none.
    pub budget_note: Option<String>,
    /// How a draft was found; `None` for a searched response.
    pub draft: Option<Draft>,
}

/// A branch: one value of each list per point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseBranch {
    /// Period, in drive cycles.
    pub period_cycles: u32,
    /// Reason why the branch ends at each of its ends.
    pub endings: Vec<Termination>,
    /// Value of the key, SI.
    pub parameter: Vec<f64>,
    /// Mean power of all loads, W.
    pub mean_power_w: Vec<f64>,
    /// Rms voltage of the first load, V.
    pub voltage_rms_v: Vec<f64>,
    /// Largest penetration, m.
    pub max_penetration_m: Vec<f64>,
    /// Largest contact force, N.
    pub max_contact_force_n: Vec<f64>,
    /// Largest impact speed, m/s.
    pub max_impact_velocity_m_s: Vec<f64>,
    /// Half the peak-to-peak displacement at the first stop, m.
    pub displacement_peak_m: Vec<f64>,
    /// Largest modulus of a Floquet multiplier; the orbit is stable below 1.
    pub floquet_max_abs: Vec<f64>,
    /// Contacts per period.
    pub contacts: Vec<u64>,
    /// Of a draft: estimated largest distance from the curve of each line between two neighbouring
    /// points, see [`Draft::error`]; infinite where it is not known. Empty for a searched response.
    pub line_error: Vec<f64>,
}

/// A bifurcation or grazing point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseBifurcation {
    /// Number of its branch, from 0.
    pub branch: usize,
    /// Kind.
    pub kind: &'static str,
    /// Value of the key, SI.
    pub parameter: f64,
    /// Estimated error of this value; `None` where it is not known.
    pub parameter_error: Option<f64>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, V.
    pub voltage_rms_v: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest contact force, N.
    pub max_contact_force_n: f64,
    /// Largest impact speed, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Half the peak-to-peak displacement at the first stop, m.
    pub displacement_peak_m: f64,
    /// Largest modulus of a Floquet multiplier.
    pub floquet_max_abs: f64,
    /// Contacts per period.
    pub contacts: u64,
}

impl ResponseResult {
    pub(super) fn new(
        key: &NumericKey,
        system: &System,
        linear: LinearCurve,
        branches: &[Branch],
    ) -> Self {
        let bifurcations = |(number, branch): (usize, &Branch)| {
            let entry = move |own: &Bifurcation| ResponseBifurcation::new(number, own);
            branch.bifurcations.iter().map(entry).collect::<Vec<_>>()
        };
        Self {
            over: key.path().to_owned(),
            unit: key.unit(),
            is_storage_voltage: system.loads.is_empty() && !system.bridges.is_empty(),
            patches: system.modes.patch.len(),
            linear,
            branches: branches.iter().map(ResponseBranch::new).collect(),
            bifurcations: branches.iter().enumerate().flat_map(bifurcations).collect(),
            note: None,
            budget_note: None,
            draft: None,
        }
    }
}

impl ResponseBranch {
    fn new(branch: &Branch) -> Self {
        let list = |value: fn(&BranchPoint) -> f64| branch.points.iter().map(value).collect();
        let contacts = |point: &BranchPoint| point.orbit.contacts;
        Self {
            period_cycles: branch.period_cycles,
            endings: branch.endings.clone(),
            parameter: list(|point| point.parameter),
            mean_power_w: list(|point| point.orbit.mean_power_w),
            voltage_rms_v: list(|point| point.orbit.voltage_rms_v),
            max_penetration_m: list(|point| point.orbit.max_penetration_m),
            max_contact_force_n: list(|point| point.orbit.max_contact_force_n),
            max_impact_velocity_m_s: list(|point| point.orbit.max_impact_velocity_m_s),
            displacement_peak_m: list(|point| point.orbit.displacement_peak_m),
            floquet_max_abs: list(|point| point.orbit.floquet_max_abs()),
            contacts: branch.points.iter().map(contacts).collect(),
            line_error: Vec::new(),
        }
    }
}

impl ResponseBifurcation {
    fn new(branch: usize, bifurcation: &Bifurcation) -> Self {
        let orbit = &bifurcation.at.orbit;
        Self {
            branch,
            kind: bifurcation.kind.name(),
            parameter: bifurcation.at.parameter,
            parameter_error: bifurcation.parameter_error,
            mean_power_w: orbit.mean_power_w,
            voltage_rms_v: orbit.voltage_rms_v,
            max_penetration_m: orbit.max_penetration_m,
            max_contact_force_n: orbit.max_contact_force_n,
            max_impact_velocity_m_s: orbit.max_impact_velocity_m_s,
            displacement_peak_m: orbit.displacement_peak_m,
            floquet_max_abs: orbit.floquet_max_abs(),
            contacts: orbit.contacts,
        }
    }
}
