//! Half-power bandwidth over the frequency of the first drive.

use super::MainOrbit;
use jounce_analysis::{
    AnalysisError, BandwidthSearch, BranchSearch, KnownOrbit, Model, OrbitMethodKind, Parameter,
    WarmStart, drive_frequency,
};
use jounce_continuation::StepControl;
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.5, 1.5];

/// Values in the range at which integrations search for orbits, and the longest period.
const SEEDS: usize = 4;
const LONGEST_PERIOD: u32 = 2;

const TOLERANCE: f64 = 1e-8;

/// Length to which bifurcations are located, where a twentieth of the range counts as one.
const RESOLUTION: f64 = 1e-5;

/// Returns the sum of the intervals of the frequency, Hz, in which a stable orbit has at least half
/// the largest power. The orbits at the frequency of the drive, where they are known, are followed;
/// otherwise orbits are searched.
pub(super) fn half_power_hz(
    model: &Model,
    known: Option<&[MainOrbit]>,
) -> Result<f64, AnalysisError> {
    let Some((path, frequency_hz)) = drive_frequency(model) else {
        let drive = model.spec.drive.keys().next().cloned().unwrap_or_default();
        let part = format!("drive `{drive}`");
        return Err(AnalysisError::Aperiodic { part });
    };
    let key = NumericKey::find(&model.spec, &path)?;
    let range = (RANGE[0] * frequency_hz, RANGE[1] * frequency_hz);
    let parameter = Parameter::new(model, &key, range.1 - range.0);
    // A design whose branches cannot be followed has no known bandwidth: 0 ranks it below all whose
    // branches are known, and leaves it its other goals, which a failed evaluation would lose.
    let branches = match known {
        Some(orbits) => {
            let known = |orbit: &MainOrbit| KnownOrbit {
                period_cycles: orbit.period_cycles,
                state: orbit.state.clone(),
                parameter: frequency_hz,
            };
            let known: Vec<KnownOrbit> = orbits.iter().map(known).collect();
            let warm_start = WarmStart {
                family: &parameter,
                kernel: &model.kernel,
                range,
                tolerance: TOLERANCE,
                control: StepControl::default(),
                resolution: RESOLUTION,
            };
            warm_start.run(&known).unwrap_or_default()
        }
        None => {
            let search = BranchSearch {
                base: model,
                parameter: &parameter,
                range,
                method: OrbitMethodKind::Shooting,
                tolerance: TOLERANCE,
                seeds: SEEDS,
                longest_period: LONGEST_PERIOD,
            };
            search.run().unwrap_or_default()
        }
    };
    let bandwidths = BandwidthSearch {
        base: model,
        parameter: &parameter,
        range,
        tolerance: TOLERANCE,
    };
    let together = bandwidths.run(&branches).together;
    Ok(together.map_or(0.0, |found| found.width))
}
