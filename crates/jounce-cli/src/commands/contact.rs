//! `jounce contact FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, channel, positive, tell_findings};
use crate::output::{line, print};
use clap::Args;
use jounce::signal::Samples;
use jounce::spec::Quantity as Unit;
use jounce_measure::contact::{ContactFit, Told, fit};
use jounce_measure::recording::Quantity;
use jounce_measure::spectral::{Hit, HitSearch, hits};

/// Arguments of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Channel of the force; by default the first one in newtons.
    #[arg(long, value_name = "CHANNEL")]
    force: Option<String>,
    /// Mass of the hammer, as in 0.1kg: with it stiffness and speed are told.
    #[arg(long)]
    mass: Option<String>,
}

impl Contact {
    /// Finds the hits, fits each and tells.
    pub fn run(&self) -> Result<(), Failure> {
        let mass_kg = self.mass.as_ref().map(|text| positive("--mass", text, Unit::Mass)).transpose()?;
        let record = self.file.record()?;
        tell_findings(&record);
        let force = channel(&record, self.force.as_deref(), Quantity::Force, "--force")?;
        let samples = Samples::new(&force.values, record.rate())?;
        let found = hits(&samples, HitSearch::default())?;
        let fits: Vec<Result<ContactFit, String>> =
            found.iter().map(|hit| fit(&samples, hit, mass_kg).map_err(|fault| fault.to_string())).collect();
        if self.file.json {
            let one = |(hit, fitted): (&Hit, &Result<ContactFit, String>)| match fitted {
                Ok(law) => serde_json::json!({ "hit": hit, "law": law }),
                Err(why) => serde_json::json!({ "hit": hit, "law": null, "why": why }),
            };
            let listed: Vec<_> = found.iter().zip(&fits).map(one).collect();
            print(&serde_json::json!({ "channel": force.name, "hits": listed, "findings": record.findings }));
            return Ok(());
        }
        for (hit, fitted) in found.iter().zip(&fits) {
            tell(hit, fitted, record.rate());
        }
        Ok(())
    }
}

fn tell(hit: &Hit, fitted: &Result<ContactFit, String>, rate_hz: f64) {
    let at = hit.peak as f64 / rate_hz;
    line(format!(
        "hit at {at:.6} s: peak {:.4} N, contact {:.4e} s, impulse {:.4e} N s",
        hit.peak_force_n, hit.contact_time_s, hit.impulse_n_s
    ));
    hit.warnings.iter().for_each(|warning| line(format!("  warning: {warning:?}")));
    match fitted {
        Err(why) => line(format!("  no law: {why}")),
        Ok(law) => {
            line(format!(
                "  exponent {:.3} +- {:.3}, restitution {:.3} +- {:.3}",
                law.exponent, law.exponent_deviation, law.restitution, law.restitution_deviation
            ));
            if let (Some(stiffness), Some(speed)) = (law.stiffness, law.speed_m_s) {
                line(format!("  stiffness {stiffness:.4e} N/m^{:.3}, speed {speed:.4} m/s", law.exponent));
            }
            line(match law.told {
                Told::Neither => "  neither a linear spring nor Hertz's law fits",
                Told::Linear => "  a linear spring fits, Hertz's law does not",
                Told::Hertz => "  Hertz's law fits, a linear spring does not",
                Told::Both => "  the data cannot tell a linear spring from Hertz's law",
            });
        }
    }
}
