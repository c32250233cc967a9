//! Conversion of branches of the computation to results.

use super::{
    Bifurcation, Branch, BranchPoint, HalfPowerBandwidth, NotProved, Termination, TerminationReason,
};
use jounce_analysis as analysis;
use jounce_analysis::Bandwidth;
use jounce_analysis::run::ExceededLimit;

impl Branch {
    /// Returns a branch with the exceeded limits of each point; there may be fewer of them.
    pub(crate) fn new(
        branch: &analysis::Branch,
        exceeded: Vec<Vec<ExceededLimit>>,
        bandwidth: Option<&Bandwidth>,
    ) -> Self {
        let exceeded = exceeded.into_iter().chain(std::iter::repeat(Vec::new()));
        let points = branch.points.iter().zip(exceeded);
        Self {
            period_cycles: branch.period_cycles,
            points: points
                .map(|(point, exceeded)| BranchPoint::new(point, exceeded))
                .collect(),
            bifurcations: branch.bifurcations.iter().map(Bifurcation::new).collect(),
            not_proved: branch.not_proved.iter().map(NotProved::new).collect(),
            termination: branch.endings.iter().map(Termination::new).collect(),
            not_followed: branch.not_followed,
            peak: bandwidth.map(|bandwidth| bandwidth.peak),
            half_power_bandwidth: bandwidth.map(HalfPowerBandwidth::new),
        }
    }
}

impl BranchPoint {
    fn new(point: &analysis::BranchPoint, warnings: Vec<ExceededLimit>) -> Self {
        let orbit = &point.orbit;
        Self {
            parameter: point.parameter,
            mean_power_w: orbit.mean_power_w,
            voltage_rms_v: orbit.voltage_rms_v,
            stable: orbit.is_stable(),
            stability_undecided: orbit.is_stability_undecided(),
            floquet_max_abs: orbit.floquet_max_abs(),
            contacts_per_period: orbit.contacts,
            max_penetration_m: orbit.max_penetration_m,
            displacement_peak_m: orbit.displacement_peak_m,
            error_estimate: orbit.error_estimate,
            warnings,
        }
    }
}

impl Bifurcation {
    fn new(bifurcation: &analysis::Bifurcation) -> Self {
        let orbit = &bifurcation.at.orbit;
        Self {
            kind: bifurcation.kind,
            parameter: bifurcation.at.parameter,
            parameter_error: bifurcation.parameter_error,
            mean_power_w: orbit.mean_power_w,
            displacement_peak_m: orbit.displacement_peak_m,
            contacts_per_period: orbit.contacts,
            level: bifurcation.level.clone(),
            stop: bifurcation.stop.clone(),
            neighbours: bifurcation.neighbours,
        }
    }
}

impl NotProved {
    fn new(interval: &analysis::NotProved) -> Self {
        Self {
            event: interval.event,
            from: interval.from,
            to: interval.to,
            message: interval.why.to_string(),
        }
    }
}

impl Termination {
    fn new(ending: &analysis::Termination) -> Self {
        use analysis::Termination as Ending;
        let (reason, place) = match ending {
            Ending::Range => (TerminationReason::Range, None),
            Ending::Closed => (TerminationReason::Closed, None),
            Ending::Merged => (TerminationReason::Merged, None),
            Ending::Points => (TerminationReason::Points, None),
            Ending::Grazing { why, parameter } => {
                (TerminationReason::Grazing, Some((*parameter, why.clone())))
            }
            Ending::Sticking { why, parameter } => {
                (TerminationReason::Sticking, Some((*parameter, why.clone())))
            }
            Ending::Failed { why, parameter } => {
                (TerminationReason::Failed, Some((*parameter, why.clone())))
            }
        };
        let (parameter, message) = place.unzip();
        Self {
            reason,
            parameter,
            message,
        }
    }
}

impl HalfPowerBandwidth {
    pub(super) fn new(bandwidth: &Bandwidth) -> Self {
        Self {
            width: bandwidth.width,
            width_error: bandwidth.width_error,
            intervals: bandwidth.intervals.clone(),
        }
    }
}
