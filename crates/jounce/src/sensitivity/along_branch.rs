//! Results along the branch of an orbit over the frequency of the drive: the nearest fold and the
//! nearest peak of the mean power.

use super::{KeyDerivative, KeySensitivity, OrbitResult, SensitivityResult};
use crate::error::Error;
use jounce_analysis::{Derivative, DerivativeKey, Model, NotFollowed, nearest_fold, nearest_peak};
use jounce_orbits::Orbit;
use jounce_spec::NumericKey;

/// Adds the nearest fold.
pub fn add_fold(
    result: &mut SensitivityResult,
    base: &Model,
    orbit: &Orbit,
    keys: &[NumericKey],
) -> Result<(), Error> {
    let fold = nearest_fold(base, orbit.period_cycles, orbit.start());
    let fold = found("fold", fold)?;
    let names = [("nearest_fold", "Hz", fold.frequency_hz)];
    add(result, &fold.key, keys, names, |keys| {
        let derivatives = fold.derivatives(base, keys)?;
        Ok(derivatives.into_iter().map(|one| [one]).collect())
    })
}

/// Adds the nearest peak of the mean power.
pub fn add_peak(
    result: &mut SensitivityResult,
    base: &Model,
    orbit: &Orbit,
    keys: &[NumericKey],
) -> Result<(), Error> {
    let peak = nearest_peak(base, orbit.period_cycles, orbit.start());
    let peak = found("peak", peak)?;
    let names = [
        ("nearest_peak", "Hz", peak.frequency_hz),
        ("peak_power", "W", peak.mean_power_w),
    ];
    add(result, &peak.key, keys, names, |keys| {
        let derivatives = peak.derivatives(base, keys)?;
        let both = derivatives
            .into_iter()
            .map(|one| [one.frequency_hz, one.mean_power_w]);
        Ok(both.collect())
    })
}

/// Returns a place on the branch, or the reason why there is none.
fn found<T>(what: &'static str, place: Result<Option<T>, NotFollowed>) -> Result<T, Error> {
    let reason = match place {
        Ok(Some(place)) => return Ok(place),
        Ok(None) => {
            format!(
                "the branch of this orbit has no {what} within 30 % of the frequency of the drive"
            )
        }
        Err(NotFollowed) => format!(
            "the branch of this orbit over the frequency of the drive could not be followed, so that its {what} is not known; `jounce branch` shows where it ends"
        ),
    };
    Err(Error::option(what, "true", reason))
}

/// Adds results with their derivatives, which do not depend on the frequency along the branch.
fn add<const N: usize>(
    result: &mut SensitivityResult,
    frequency: &str,
    keys: &[NumericKey],
    results: [(&str, &'static str, f64); N],
    derivatives: impl FnOnce(&[DerivativeKey<'_>]) -> Result<Vec<[Derivative; N]>, Error>,
) -> Result<(), Error> {
    let (along, mut moving): (Vec<_>, Vec<_>) =
        (result.keys.iter_mut()).partition(|row| row.key == frequency);
    for row in along {
        row.derivatives.extend([KeyDerivative::default(); N]);
    }
    let wanted = moving.iter().filter_map(|row| {
        let key = keys.iter().find(|key| key.path() == row.key)?;
        let scale = row.value.abs();
        Some(DerivativeKey { key, scale })
    });
    let found = derivatives(&wanted.collect::<Vec<_>>())?;
    let relative = |row: &KeySensitivity, derivative: Derivative, value: f64| KeyDerivative {
        derivative: derivative.value,
        relative: derivative.value * row.value / value,
        relative_error: (derivative.error * row.value / value).abs(),
    };
    for (row, found) in moving.iter_mut().zip(found) {
        for (derivative, (_, _, value)) in found.into_iter().zip(results) {
            let added = relative(row, derivative, value);
            row.derivatives.push(added);
        }
    }
    let added = results.map(|(name, unit, value)| OrbitResult {
        name: name.to_owned(),
        unit,
        value,
    });
    result.quantities.extend(added);
    Ok(())
}
