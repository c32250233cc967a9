//! `jounce contact FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, or_issues, print_issues};
use crate::output::{self, line};
use clap::Args;
use jounce::parts::{AllowedLaws, HitResult};
use jounce::{ContactOptions, ContactResult};
use std::path::Path;

/// Number of warnings that are printed for a hit.
const MAX_LISTED_WARNINGS: usize = 3;

/// Arguments of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    #[command(flatten)]
    pub file: MeasuredFile,
    #[command(flatten)]
    options: ContactOptions,
}

impl Contact {
    /// Finds the hits, fits each and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let recording = self.file.recording(&self.options)?;
        let result = or_issues(recording.contact(&self.options), &[recording])?;
        print_issues(&result.issues);
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &result)?;
        }
        match self.file.output.json {
            true => line(output::to_json(&result)?),
            false => (0..result.hits.len()).for_each(|hit| print_hit_and_table(&result, hit)),
        }
        Ok(())
    }

    fn write(&self, folder: &Path, result: &ContactResult) -> Result<(), Failure> {
        let manifest = self.file.manifest("contact", &self.options)?;
        output::table(folder, "contact", &result.table()?, &manifest)?;
        for (hit, table) in result.force_tables()? {
            output::table(folder, &format!("force-table-{hit}"), &table, &manifest)?;
        }
        output::figure(folder, "contact-pulses", &result.figure())
    }
}

/// Prints a hit and its table of force over penetration.
fn print_hit_and_table(result: &ContactResult, hit: usize) {
    print_hit(&result.hits[hit]);
    let Some(table) = result.force_tables.get(hit) else {
        return;
    };
    match (
        &table.reason,
        table.penetration_m.last(),
        table.force_n.last(),
    ) {
        (Some(reason), ..) => line(format!("  no force table: {reason}")),
        (None, Some(depth_m), Some(force_n)) => line(format!(
            "  force table: {} points to {depth_m:.4e} m and {force_n:.4} N",
            table.force_n.len()
        )),
        _ => {}
    }
}

fn print_hit(hit: &HitResult) {
    line(format!(
        "hit at {:.6} s: peak {:.4} N, {:.4e} s above a tenth of it ({:.4} N), impulse {:.4e} N s",
        hit.time_s, hit.peak_force_n, hit.contact_time_s, hit.edge_force_n, hit.impulse_n_s
    ));
    hit.warnings
        .iter()
        .take(MAX_LISTED_WARNINGS)
        .for_each(|warning| line(format!("  warning: the hit {warning}")));
    if hit.warnings.len() > MAX_LISTED_WARNINGS {
        line(format!(
            "  warning: and {} more like these",
            hit.warnings.len() - MAX_LISTED_WARNINGS
        ));
    }
    match (&hit.reason, hit.allowed_laws) {
        (Some(reason), _) => line(format!("  no law: {reason}")),
        (None, Some(allowed)) => print_law(hit, allowed),
        (None, None) => {}
    }
}

/// Prints the law of a hit that has one.
fn print_law(hit: &HitResult, allowed: AllowedLaws) {
    let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let exponent = number(hit.exponent);
    line(format!(
        "  law, 95 %: exponent {exponent:.3} +- {:.3}, restitution {:.3} +- {:.3}, contact time {:.4e} s",
        number(hit.exponent_half_width),
        number(hit.restitution),
        number(hit.restitution_half_width),
        number(hit.law_contact_time_s)
    ));
    let interval = |value: f64, unit: &str, low: Option<f64>, high: Option<f64>| {
        let (low, high) = (number(low), number(high));
        format!("stiffness {value:.4e} {unit}, 95 % from {low:.4e} to {high:.4e}")
    };
    if let (Some(stiffness), Some(speed)) = (hit.stiffness, hit.speed_m_s) {
        let unit = format!("N/m^{exponent:.3}");
        let text = interval(stiffness, &unit, hit.stiffness_low, hit.stiffness_high);
        line(format!("  {text}, speed {speed:.4} m/s"));
    }
    for (law, unit, about) in [
        (hit.linear, "N/m", "a linear spring"),
        (hit.hertz, "N/m^1.5", "Hertz's law"),
    ] {
        if let Some(stiffness) = law.stiffness {
            let text = interval(stiffness, unit, law.stiffness_low, law.stiffness_high);
            line(format!("  as {about}: {text}"));
        }
    }
    line(match allowed {
        AllowedLaws::Neither => "  neither a linear spring nor Hertz's law fits",
        AllowedLaws::Linear => "  a linear spring fits, Hertz's law does not",
        AllowedLaws::Hertz => "  Hertz's law fits, a linear spring does not",
        AllowedLaws::Both => "  the data do not distinguish a linear spring from Hertz's law",
    });
}
