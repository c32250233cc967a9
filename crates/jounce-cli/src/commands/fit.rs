//! `jounce fit SPEC --to FEATURES`

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::spec::{Spec, SpecFile};
use jounce::table::{Column, Table};
use jounce_measure::draw::fitted;
use jounce_measure::fit::{Features, FitAnswer, FittedFeature, FittedKey, fit};
use std::path::{Path, PathBuf};

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct Fit {
    #[command(flatten)]
    spec: SpecArguments,
    /// The measured modes and the free keys (TOML).
    #[arg(long, value_name = "FEATURES")]
    to: PathBuf,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Fit {
    /// Fits and tells.
    pub fn run(&self) -> Result<(), Failure> {
        let features = Features::read(&self.to)?;
        let file = self.spec.file()?;
        let spec = self.spec.checked(file.spec())?;
        let (answer, _) = fit(&file, &spec, &features)?;
        if let Some(folder) = &self.output.out {
            self.write(folder, file, &spec, &answer)?;
        }
        if self.output.json {
            print(&serde_json::to_value(&answer).map_err(|error| Failure::Input(error.to_string()))?);
        } else {
            tell(&answer);
        }
        Ok(())
    }

    fn write(&self, folder: &Path, mut file: SpecFile, spec: &Spec, answer: &FitAnswer) -> Result<(), Failure> {
        let key = |of: &dyn Fn(&FittedKey) -> f64| answer.keys.iter().map(of).collect::<Vec<f64>>();
        let feature = |of: &dyn Fn(&FittedFeature) -> f64| answer.features.iter().map(of).collect::<Vec<f64>>();
        let table = Table::new(vec![
            Column::new("key", "", "the key", answer.keys.iter().map(|key| key.key.clone()).collect::<Vec<_>>()),
            Column::new("unit", "", "unit of the next columns", answer.keys.iter().map(|key| key.unit.clone()).collect::<Vec<_>>()),
            Column::new("before", "", "value in the spec", key(&|key| key.before)),
            Column::new("after", "", "fitted value", key(&|key| key.after)),
            Column::new("low", "", "lower end of its interval of 95 %", key(&|key| key.low)),
            Column::new("high", "", "upper end of its interval of 95 %", key(&|key| key.high)),
        ])?;
        let manifest = self.spec.manifest(spec, "fit").with("to", self.to.display());
        output::table(folder, "fit-keys", &table, &manifest)?;
        let table = Table::new(vec![
            Column::new("feature", "", "the feature", answer.features.iter().map(|f| f.name.clone()).collect::<Vec<_>>()),
            Column::new("measured", "", "as measured", feature(&|feature| feature.measured)),
            Column::new("deviation", "", "relative standard deviation of the measurement", feature(&|feature| feature.deviation)),
            Column::new("before", "", "of the model before", feature(&|feature| feature.before)),
            Column::new("after", "", "of the model after", feature(&|feature| feature.after)),
            Column::new("predicted_deviation", "", "relative deviation of the model after", feature(&|f| f.predicted_deviation)),
        ])?;
        output::table(folder, "fit-features", &table, &manifest)?;
        output::figure(folder, "fit", &fitted("Model against measurement, before and after the fit", answer))?;
        for key in &answer.keys {
            let value = format!("{:?} {}", key.after, key.unit);
            file.set(&key.key, value.trim()).map_err(|fault| Failure::faults(&self.spec.spec, vec![fault]))?;
        }
        Ok(jounce::store::write(&folder.join("fitted.toml"), file.text().as_bytes())?)
    }
}

fn tell(answer: &FitAnswer) {
    for key in &answer.keys {
        let (path, unit) = (&key.key, &key.unit);
        line(format!("{path}: {:.6e} {unit} -> {:.6e} {unit}, 95 % from {:.6e} to {:.6e}", key.before, key.after, key.low, key.high));
    }
    line("feature                    measured        before   error %         after   error %   +- 95 %");
    for feature in &answer.features {
        let (before, after) = feature.errors();
        line(format!(
            "{:<22} {:>12.6} {:>13.6} {:>9.3} {:>13.6} {:>9.3} {:>9.3}",
            feature.name,
            feature.measured,
            feature.before,
            100.0 * before,
            feature.after,
            100.0 * after,
            196.0 * feature.predicted_deviation
        ));
    }
    answer.warnings.iter().for_each(|warning| line(format!("warning: {warning}")));
}
