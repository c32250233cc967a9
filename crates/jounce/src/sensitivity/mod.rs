//! Sensitivities: derivatives of the results of an orbit with respect to keys of the spec.

mod along_branch;
mod grazing;
mod options;
mod report;
mod result;

pub use options::SensitivityOptions;
pub use result::{
    FailedKey, KeyDerivative, KeySensitivity, OrbitGrazing, OrbitResult, SensitivityResult,
};

use crate::basins::cloud;
use crate::error::Error;
use crate::harvester::Harvester;
use crate::leaves::leaves;
use crate::options::on_threads;
use crate::periodic;
use jounce_analysis::{
    Attractor, Basins, Derivative, DerivativeAccuracy, DerivativeKey, InitialStates, Model,
    OrbitDerivatives, Recognition, orbit_derivatives,
};
use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_orbits::{Orbit, OrbitQuantity};
use jounce_spec::NumericKey;

/// Size of the cloud of starts, in gaps or steady amplitudes.
const SPREAD: f64 = 10.0;

/// Tolerance of the search for the orbit.
const TOLERANCE: f64 = 1e-10;

impl Harvester {
    /// Computes the derivatives of the results of a stable periodic orbit with respect to numeric
    /// keys of the spec: mean power, and the peaks of voltages, strains, contact forces and
    /// displacements at the stops. They follow the orbit, which changes with the key.
    ///
    /// # Errors
    /// [`Error::Option`] for an unknown orbit, [`Error::Spec`] for an unknown key, and as
    /// [`Harvester::basins`].
    ///
    /// ```
    /// use jounce::{Harvester, SensitivityOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let key = vec!["circuit.load.resistance".to_owned()];
    /// let result = harvester.sensitivity(&SensitivityOptions { key, starts: 4, ..Default::default() })?;
    /// let power = &result.keys[0].derivatives[0];
    /// println!("1 % more resistance changes the power by {} %", power.relative);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn sensitivity(&self, options: &SensitivityOptions) -> Result<SensitivityResult, Error> {
        periodic::frequency(self, "a sensitivity")?;
        let base = self.model()?;
        periodic::check_drives(&base.kernel.plant, "a sensitivity")?;
        let (keys, mut failed) = self.wanted_keys(options)?;
        let starts = InitialStates::Cloud(cloud(options.starts, options.seed, SPREAD)?);
        let study = Basins {
            base: &base,
            starts,
            recognition: Recognition::at(TOLERANCE),
        };
        let work = || {
            let found = study.run()?;
            let (attractor, orbit) = chosen(&found.attractors, options.at.as_deref())?;
            let mut result = sensitivity(&base, attractor, orbit, &keys, &mut failed)?;
            if options.fold {
                along_branch::add_fold(&mut result, &base, orbit, &keys)?;
            }
            if options.peak {
                along_branch::add_peak(&mut result, &base, orbit, &keys)?;
            }
            Ok(result)
        };
        let result = on_threads(options.threads, work)?;
        match self.control().is_stopped() {
            true => Err(Error::Stopped),
            false => Ok(SensitivityResult { failed, ..result }),
        }
    }

    /// Returns the keys of the options or, by default, all numbers of the spec on which periodic
    /// orbits depend.
    fn wanted_keys(
        &self,
        options: &SensitivityOptions,
    ) -> Result<(Vec<NumericKey>, Vec<FailedKey>), Error> {
        let mut keys = Vec::new();
        for path in &options.key {
            keys.extend(self.file().numeric_keys(path)?);
        }
        if options.key.is_empty() {
            let changes_orbits = |path: &str| {
                !(path.starts_with("run.")
                    || path.starts_with("reduction.")
                    || path.ends_with("_limit"))
            };
            let paths = leaves(&self.text()).into_iter().map(|(path, _)| path);
            for path in paths.filter(|path| changes_orbits(path)) {
                keys.extend(self.file().numeric_keys(&path).unwrap_or_default());
            }
            keys.retain(|key| !key.is_count() && key.get(self.spec()).is_ok_and(|x| x != 0.0));
        }
        let mut failed = Vec::new();
        keys.retain(|key| {
            let reason = match key.get(self.spec()) {
                Ok(0.0) => "its value is 0, so there is no relative change",
                Ok(_) if key.is_count() => "it is a whole number",
                _ => return true,
            };
            failed.push(FailedKey {
                key: key.path().to_owned(),
                reason: reason.to_owned(),
            });
            false
        });
        Ok((keys, failed))
    }
}

/// Returns the attractor of an id, or the one that most starts reach.
fn chosen<'a>(
    attractors: &'a [Attractor],
    at: Option<&str>,
) -> Result<(&'a Attractor, &'a Orbit), Error> {
    let mut with_orbit = attractors.iter().filter_map(|one| {
        Some((
            one,
            one.orbit().filter(|orbit| !orbit.multipliers.is_empty())?,
        ))
    });
    let found = match at {
        Some(id) => with_orbit.find(|(one, _)| one.id == id),
        None => with_orbit.max_by(|(a, _), (b, _)| a.share.fraction.total_cmp(&b.share.fraction)),
    };
    found.ok_or_else(|| {
        let ids: Vec<&str> = attractors.iter().map(|one| one.id.as_str()).collect();
        let expected = format!(
            "it must be a periodic orbit with a derivative; the starts reach {}",
            ids.join(", ")
        );
        Error::option("at", at.unwrap_or("not given"), expected)
    })
}

/// Computes the derivatives; keys that have none are added to `failed`.
fn sensitivity(
    base: &Model,
    attractor: &Attractor,
    orbit: &Orbit,
    keys: &[NumericKey],
    failed: &mut Vec<FailedKey>,
) -> Result<SensitivityResult, Error> {
    let named = quantities(&base.kernel.plant);
    let quantities: Vec<OrbitQuantity> = named.iter().map(|(_, _, quantity)| *quantity).collect();
    let value = |key: &NumericKey| key.get(&base.spec).unwrap_or(f64::NAN);
    let wanted: Vec<DerivativeKey<'_>> = keys
        .iter()
        .map(|key| DerivativeKey {
            key,
            scale: value(key).abs(),
        })
        .collect();
    let accuracy = DerivativeAccuracy::Estimated;
    let OrbitDerivatives { values, by_key } =
        orbit_derivatives(base, orbit, &wanted, &quantities, accuracy)?;
    let (grazing, changes) = grazing::nearest(base, orbit, &wanted)?;
    let mut rows = Vec::new();
    for ((key, row), grazing_change) in keys.iter().zip(by_key).zip(changes) {
        let path = key.path().to_owned();
        let relative = |(derivative, result): (&Derivative, &f64)| KeyDerivative {
            derivative: derivative.value,
            relative: derivative.value * value(key) / result,
            relative_error: (derivative.error * value(key) / result).abs(),
        };
        match row {
            Ok(row) => rows.push(KeySensitivity {
                key: path,
                unit: key.unit(),
                value: value(key),
                derivatives: row.iter().zip(&values).map(relative).collect(),
                grazing_change,
            }),
            Err(error) => failed.push(FailedKey {
                key: path,
                reason: error.to_string(),
            }),
        }
    }
    let size = |row: &KeySensitivity| row.derivatives[0].relative.abs();
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let results = named.into_iter().zip(values);
    Ok(SensitivityResult {
        at: attractor.id.clone(),
        period_cycles: attractor.period_cycles,
        mean_power_w: attractor.mean_power_w,
        quantities: results
            .map(|((name, unit, _), value)| OrbitResult { name, unit, value })
            .collect(),
        keys: rows,
        grazing,
        failed: Vec::new(),
    })
}

/// Returns the results of an orbit with their names and units.
fn quantities(plant: &Plant) -> Vec<(String, &'static str, OrbitQuantity)> {
    let mut all = vec![("mean_power".to_owned(), "W", OrbitQuantity::MeanPower)];
    for (index, (name, patch)) in plant.system.modes.patch.iter().enumerate() {
        all.push((
            format!("voltage.{name}"),
            "V",
            OrbitQuantity::Voltage(index),
        ));
        if !patch.strain.is_empty() {
            all.push((format!("strain.{name}"), "", OrbitQuantity::Strain(index)));
        }
    }
    for (index, stop) in plant.system.stops.iter().enumerate() {
        if !matches!(stop.law, Law::Rigid(_)) {
            let name = format!("contact_force.{}", stop.name);
            all.push((name, "N", OrbitQuantity::ContactForce(index)));
        }
        let name = format!("displacement.{}", stop.name);
        all.push((name, "m", OrbitQuantity::Displacement(index)));
    }
    all
}
