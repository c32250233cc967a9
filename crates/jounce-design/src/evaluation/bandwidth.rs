//! Half-power bandwidth over the frequency of the first drive.

use jounce_analysis::{
    AnalysisError, BandwidthSearch, BranchSearch, Model, OrbitMethodKind, Parameter,
};
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.5, 1.5];

/// Values in the range at which integrations search for orbits, and the longest period.
const SEEDS: usize = 4;
const LONGEST_PERIOD: u32 = 2;

const TOLERANCE: f64 = 1e-8;

/// Returns the sum of the intervals of the frequency, Hz, in which a stable orbit has at least half
/// the largest power.
pub(super) fn half_power_hz(model: &Model) -> Result<f64, AnalysisError> {
    let drive = model
        .spec
        .drive
        .iter()
        .find_map(|(name, drive)| Some((name, drive.frequency_hz()?)));
    let Some((name, frequency_hz)) = drive else {
        let drive = model.spec.drive.keys().next().cloned().unwrap_or_default();
        return Err(AnalysisError::Aperiodic { drive });
    };
    let key = NumericKey::find(&model.spec, &format!("drive.{name}.frequency"))?;
    let range = (RANGE[0] * frequency_hz, RANGE[1] * frequency_hz);
    let parameter = Parameter::new(model, &key, range.1 - range.0);
    let search = BranchSearch {
        base: model,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: TOLERANCE,
        seeds: SEEDS,
        longest_period: LONGEST_PERIOD,
    };
    // A design whose branches cannot be followed has no bandwidth.
    let branches = search.run().unwrap_or_default();
    let bandwidths = BandwidthSearch {
        base: model,
        parameter: &parameter,
        range,
        tolerance: TOLERANCE,
    };
    let together = bandwidths.run(&branches).together;
    Ok(together.map_or(0.0, |found| found.width))
}
