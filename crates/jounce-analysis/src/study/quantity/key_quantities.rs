//! Quantities over one or two keys: sweeps, diagrams and bifurcation curves.

use crate::{
    AnalysisError, AttractorKind, BifurcationSearch, BranchKind, CurveKind, Diagram, DiagramOrder,
    Model, Parameter, Sweep, SweepOrder,
};
use jounce_orbits::OrbitError;
use jounce_spec::{KeyRange, NumericKey};
use std::path::Path;

/// Cycles stored of a motion without a period: only its kind counts here.
const APERIODIC_CYCLES: u32 = 1;

/// Evaluates the highest and average power of a sweep, and its points that had not settled.
pub(super) fn sweep(
    model: &Model,
    (over, values): (&str, &str),
    (direction, fixed_duration): (SweepOrder, bool),
    folder: &Path,
) -> Result<Vec<f64>, String> {
    let range = KeyRange::parse(key(model, over)?, values).map_err(|fault| fault.to_string())?;
    let study = Sweep {
        spec: &model.spec,
        range: &range,
        direction,
        fixed_duration,
        folder: folder.to_path_buf(),
    };
    let points = study
        .run(None, &model.kernel.control, &|_| ())
        .map_err(|error| error.to_string())?;
    let highest = points
        .iter()
        .max_by(|a, b| a.mean_power_w.total_cmp(&b.mean_power_w))
        .ok_or("the sweep was stopped")?;
    let unsettled = points.iter().filter(|point| !point.settled).count();
    let sum_w: f64 = points.iter().map(|point| point.mean_power_w).sum();
    Ok(vec![
        highest.mean_power_w,
        highest.parameter,
        sum_w / points.len() as f64,
        unsettled as f64,
    ])
}

/// Evaluates the highest power, longest period and non-periodic fraction of the motions over a key.
pub(super) fn diagram(
    model: &Model,
    (over, values): (&str, &[f64]),
    order: DiagramOrder,
    tolerance: f64,
) -> Result<Vec<f64>, String> {
    if model.kernel.plant.period_s().is_none() {
        let frequencies = model.kernel.plant.tones.len();
        return Err(OrbitError::<AnalysisError>::Frequencies { frequencies }.to_string());
    }
    let (key, width) = (key(model, over)?, values[values.len() - 1] - values[0]);
    let parameter = Parameter::new(
        model,
        &key,
        if width > 0.0 {
            width
        } else {
            values[0].abs().max(1e-12)
        },
    );
    let study = Diagram {
        base: model,
        parameter: &parameter,
        values,
        order,
        cycles: APERIODIC_CYCLES,
        tolerance,
    };
    let visits = study
        .run(None, &|_| ())
        .map_err(|error| error.to_string())?;
    let points: Vec<_> = visits
        .iter()
        .filter(|visit| visit.motion != AttractorKind::Lost)
        .collect();
    let highest = points
        .iter()
        .max_by(|a, b| a.mean_power_w.total_cmp(&b.mean_power_w))
        .ok_or("every run failed")?;
    let aperiodic = points
        .iter()
        .filter(|visit| visit.motion != AttractorKind::Orbit)
        .count();
    Ok(vec![
        highest.mean_power_w,
        highest.parameter,
        points
            .iter()
            .map(|visit| visit.period_cycles)
            .max()
            .map_or(0.0, f64::from),
        aperiodic as f64 / points.len() as f64,
        (visits.len() - points.len()) as f64,
    ])
}

/// Evaluates the number of bifurcation curves over two keys, and the range of the folds.
pub(super) fn bifurcations(
    model: &Model,
    keys: &[String; 2],
    ranges: [(f64, f64); 2],
    (seeds, longest_period, tolerance): (usize, u32, f64),
) -> Result<Vec<f64>, String> {
    let [first, second] = [key(model, &keys[0])?, key(model, &keys[1])?];
    let search = BifurcationSearch {
        base: model,
        keys: [&first, &second],
        ranges,
        tolerance,
        seeds,
        longest_period,
        peaks: false,
    };
    let curves = search.run().map_err(|error| error.to_string())?;
    let folds: Vec<_> = curves
        .iter()
        .filter(|curve| curve.kind == CurveKind::Bifurcation(BranchKind::Fold))
        .collect();
    let positions = || {
        folds
            .iter()
            .flat_map(|curve| &curve.points)
            .map(|point| point.parameter)
    };
    // Without a fold both ends are NaN.
    let (low, high) = (
        positions().fold(f64::NAN, f64::min),
        positions().fold(f64::NAN, f64::max),
    );
    Ok(vec![curves.len() as f64, folds.len() as f64, low, high])
}

fn key(model: &Model, path: &str) -> Result<NumericKey, String> {
    NumericKey::find(&model.spec, path).map_err(|fault| fault.to_string())
}
