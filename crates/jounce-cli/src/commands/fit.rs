//! `jounce fit SPEC --to FEATURES`

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce_core::integrate::Control;
use jounce_core::spec::{Spec, SpecFile};
use jounce_core::table::{Column, Table};
use jounce_measure::draw::fitted;
use jounce_measure::fit::{Features, FitResult, FittedCurve, FittedFeature, FittedKey, fit};
use std::path::{Path, PathBuf};

/// Format of a file of features; no line is wider than a terminal.
const FEATURES: &str = r#"FEATURES, a small one:

  hold = ["table"]              # fixed in the test; empty by default
  frequency_deviation = 0.002   # relative, or "residuals" of the fit

  [free]                        # keys, each with its relative deviation
  "beam.beam.youngs_modulus" = 0.03
  "damping.ratios.1" = 0.5      # "damping.ratios": each of the list

  [[mode]]
  number = 1                    # in the model, from 1
  frequency = "9.01 Hz"
  damping_ratio = 0.002
  damping_deviation = 0.1

Deviations are relative standard deviations, those of keys before the test.
Further tables are [[response]], [[power]], [[jump]] and [[history]]. All their
keys, with an example of each, are in the book, "Recordings of a test rig",
section "Model and measurement" (book/src/howto/measured.md)."#;

/// Arguments of `fit`.
#[derive(Debug, Args)]
#[command(after_help = FEATURES)]
pub struct Fit {
    #[command(flatten)]
    spec: SpecArguments,
    /// Measured features, and the keys to fit (TOML, described below); no default.
    #[arg(long, value_name = "FEATURES")]
    to: PathBuf,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Fit {
    /// Fits and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let features = Features::read(&self.to)?;
        let file = self.spec.file()?;
        let spec = self.spec.read(&file)?;
        let control = Control::default();
        let (result, _) =
            progress::with_count("models computed", &|| control.progress().0, || {
                fit(&file, &spec, &features, &self.spec.folder(), &control)
            })?;
        if let Some(folder) = &self.output.out {
            self.write(folder, file, &spec, &result)?;
        }
        if self.output.json {
            print(
                &serde_json::to_value(&result)
                    .map_err(|error| Failure::Input(error.to_string()))?,
            );
        } else {
            print_fit(&result);
        }
        Ok(())
    }

    fn write(
        &self,
        folder: &Path,
        mut file: SpecFile,
        spec: &Spec,
        result: &FitResult,
    ) -> Result<(), Failure> {
        let key =
            |value: &dyn Fn(&FittedKey) -> f64| result.keys.iter().map(value).collect::<Vec<f64>>();
        let feature = |value: &dyn Fn(&FittedFeature) -> f64| {
            result.features.iter().map(value).collect::<Vec<f64>>()
        };
        let table = Table::new(vec![
            Column::new(
                "key",
                "",
                "the key",
                result
                    .keys
                    .iter()
                    .map(|key| key.key.clone())
                    .collect::<Vec<_>>(),
            ),
            Column::new(
                "unit",
                "",
                "unit of the next columns",
                result
                    .keys
                    .iter()
                    .map(|key| key.unit.clone())
                    .collect::<Vec<_>>(),
            ),
            Column::new("before", "", "value in the spec", key(&|key| key.before)),
            Column::new("after", "", "fitted value", key(&|key| key.after)),
            Column::new(
                "low",
                "",
                "lower end of the 95 % interval",
                key(&|key| key.low),
            ),
            Column::new(
                "high",
                "",
                "upper end of the 95 % interval",
                key(&|key| key.high),
            ),
        ])?;
        let manifest = self
            .spec
            .manifest(spec, "fit")
            .with("to", self.to.display());
        output::table(folder, "fit-keys", &table, &manifest)?;
        let table = Table::new(vec![
            Column::new(
                "feature",
                "",
                "the feature",
                result
                    .features
                    .iter()
                    .map(|f| f.name.clone())
                    .collect::<Vec<_>>(),
            ),
            Column::new(
                "measured",
                "",
                "measured value",
                feature(&|feature| feature.measured),
            ),
            Column::new(
                "deviation",
                "",
                "relative standard deviation of the measurement",
                feature(&|feature| feature.deviation),
            ),
            Column::new(
                "before",
                "",
                "value of the model before",
                feature(&|feature| feature.before),
            ),
            Column::new(
                "after",
                "",
                "value of the model after",
                feature(&|feature| feature.after),
            ),
            Column::new(
                "predicted_deviation",
                "",
                "relative deviation of the model after",
                feature(&|f| f.predicted_deviation),
            ),
            Column::new(
                "low",
                "",
                "lower end of the 95 % prediction interval",
                feature(&|f| f.low),
            ),
            Column::new(
                "high",
                "",
                "upper end of the 95 % prediction interval",
                feature(&|f| f.high),
            ),
        ])?;
        output::table(folder, "fit-features", &table, &manifest)?;
        for (number, curve) in result.curves.iter().enumerate() {
            let name = format!("fit-curve-{}", number + 1);
            output::table(
                folder,
                &name,
                &curve_table(curve)?,
                &manifest.clone().with("curve", &curve.name),
            )?;
        }
        output::figure(
            folder,
            "fit",
            &fitted(
                "Model against measurement, before and after the fit",
                result,
            ),
        )?;
        for key in &result.keys {
            let value = format!("{:?} {}", key.after, key.unit);
            file.set(&key.key, value.trim())
                .map_err(|fault| Failure::faults(&self.spec.spec, vec![fault]))?;
        }
        Ok(jounce_core::store::write(
            &folder.join("fitted.toml"),
            file.text().as_bytes(),
        )?)
    }
}

fn curve_table(curve: &FittedCurve) -> Result<Table, Failure> {
    let unit = if curve.over == "time_s" { "s" } else { "Hz" };
    let column = |name: &str, about: &str, values: &[f64]| {
        Column::new(name, &curve.unit, about, values.to_vec())
    };
    Ok(Table::new(vec![
        Column::new(&curve.over, unit, "place", curve.at.clone()),
        column("measured", "measured value", &curve.measured),
        column("before", "value of the model before", &curve.before),
        column("after", "value of the model after", &curve.after),
        column(
            "low",
            "lower end of the 95 % prediction interval",
            &curve.low,
        ),
        column(
            "high",
            "upper end of the 95 % prediction interval",
            &curve.high,
        ),
    ])?)
}

fn print_fit(result: &FitResult) {
    for key in &result.keys {
        let (path, unit) = (&key.key, &key.unit);
        line(format!(
            "{path}: {:.6e} {unit} -> {:.6e} {unit}, 95 % from {:.6e} to {:.6e}",
            key.before, key.after, key.low, key.high
        ));
    }
    if !result.features.is_empty() {
        line(
            "feature                    measured        before   error %         after   error %   +- 95 %",
        );
    }
    for feature in &result.features {
        let (before, after) = feature.errors();
        line(format!(
            "{:<22} {:>12.6e} {:>13.6e} {:>9.3} {:>13.6e} {:>9.3} {:>9.3}",
            feature.name,
            feature.measured,
            feature.before,
            100.0 * before,
            feature.after,
            100.0 * after,
            50.0 * (feature.high - feature.low) / feature.measured
        ));
    }
    for curve in &result.curves {
        let (before, after) = curve.errors();
        line(format!(
            "{}, {} points: rms error {:.3} % before and {:.3} % after",
            curve.name,
            curve.at.len(),
            100.0 * before,
            100.0 * after
        ));
    }
    for deviation in &result.deviations {
        if let Some(freedom) = deviation.degrees_of_freedom {
            line(format!(
                "deviation of {} from residuals: {:.3e}, {freedom:.1} degrees of freedom",
                deviation.name, deviation.deviation
            ));
        }
    }
    result
        .warnings
        .iter()
        .for_each(|warning| line(format!("warning: {warning}")));
}
