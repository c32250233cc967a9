//! `jounce bifurcations SPEC --over KEY=FROM:TO --against KEY2=FROM:TO`

use crate::failure::Failure;
use crate::interruption;
use crate::option_names::on_command_line;
use crate::output::{self, counted, key_value, line, power};
use crate::progress;
use crate::spec_arguments::{OutputArguments, SpecArguments};
use clap::Args;
use jounce::parts::BifurcationCurve;
use jounce::{BifurcationsOptions, BifurcationsResult, Control, Harvester};
use std::path::Path;

/// Arguments of `bifurcations`.
#[derive(Debug, Args)]
pub struct Bifurcations {
    #[command(flatten)]
    spec: SpecArguments,
    #[command(flatten)]
    options: BifurcationsOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl Bifurcations {
    /// Continues the bifurcation curves and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let control = Control::default();
        let harvester = self.spec.harvester()?.with_control(&control);
        interruption::install(&control);
        let result = progress::with_progress(&control, || harvester.bifurcations(&self.options));
        let result = result.map_err(|error| self.spec.failure(error))?;
        output::warn(&result.warnings());
        if let Some(folder) = &self.output.out {
            self.write(folder, &harvester, &result)?;
        }
        match self.output.json {
            true => line(output::to_json(&result)?),
            false => self.print_lines(&result),
        }
        let curves = &result.curves;
        interruption::end(&control, || format!("the {} finished curves", curves.len()))?;
        if curves.is_empty() || curves.iter().any(BifurcationCurve::is_complete) {
            return Ok(());
        }
        Err(Failure::Incomplete(
            "no curve is complete: continuation stopped early on each".to_owned(),
        ))
    }

    fn write(
        &self,
        folder: &Path,
        harvester: &Harvester,
        result: &BifurcationsResult,
    ) -> Result<(), Failure> {
        let manifest = self
            .spec
            .manifest(harvester, "bifurcations", &self.options)?;
        output::table(folder, "bifurcations", &result.table()?, &manifest)?;
        output::figure(folder, "bifurcations", &result.figure())
    }

    /// Prints the result as lines of text: the ends of each curve.
    fn print_lines(&self, result: &BifurcationsResult) {
        if result.curves.is_empty() {
            line(format!(
                "no fold, doubling, torus, grazing, level or peak over {} for {}",
                self.options.over, self.options.against
            ));
        }
        let (unit, unit_2) = (&result.unit, &result.unit_2);
        for curve in &result.curves {
            line(format!(
                "{} of period {}: {}",
                curve.name(),
                curve.period_cycles,
                counted(curve.points.len(), "point")
            ));
            let last = curve.points.len().saturating_sub(1);
            for (k, point) in curve.points.iter().enumerate() {
                let word = match k {
                    _ if last == 0 => "at",
                    0 => "from",
                    _ if k == last => "to",
                    _ => continue,
                };
                let stable = match point.stable {
                    None => "",
                    Some(true) => "  stable",
                    Some(false) => "  unstable",
                };
                line(format!(
                    "  {word:<4} {} {} {unit}, {} {} {unit_2}, mean power {} W{stable}",
                    result.key,
                    key_value(point.parameter),
                    result.key_2,
                    key_value(point.parameter_2),
                    power(point.mean_power_w)
                ));
            }
        }
        line(on_command_line(&result.note));
    }
}
