//! `jounce contact FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, channel, load_channels, parse_positive};
use crate::output::{self, line, print};
use clap::Args;
use jounce_core::signal::Samples;
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::contact::{AllowedLaws, ContactFit, FixedExponentLaw, fit};
use jounce_measure::draw::{PulseFigure, pulses};
use jounce_measure::recording::Quantity;
use jounce_measure::spectral::{Hit, HitSearch, hits};
use std::path::Path;

/// Maximum number of pulses in the picture; more would overlap.
const MAX_SHOWN_PULSES: usize = 6;

/// Arguments of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Channel of the force; by default the first one in newtons.
    #[arg(long, value_name = "CHANNEL")]
    force: Option<String>,
    /// Mass of the hammer, as in 0.1kg. With it the command reports the speed and the stiffness:
    /// for the fitted exponent, and for the linear spring and Hertz's law where the pulse allows
    /// them. By default no speed and no stiffness.
    #[arg(long, value_name = "MASS")]
    mass: Option<String>,
}

impl Contact {
    /// Finds the hits, fits each and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let mass_kg = self
            .mass
            .as_ref()
            .map(|text| parse_positive("--mass", text, Unit::Mass))
            .transpose()?;
        let mut summary = self.file.summary()?;
        let number = channel(
            &mut summary,
            self.force.as_deref(),
            Quantity::Force,
            "--force",
        )?;
        let record = load_channels(summary, &[number])?;
        let force = &record.channels[0];
        let samples = Samples::new(&force.values, record.rate())?;
        let contact_hits = hits(&samples, HitSearch::default())?;
        let fits: Vec<Result<ContactFit, String>> = contact_hits
            .iter()
            .map(|hit| fit(&samples, hit, mass_kg).map_err(|fault| fault.to_string()))
            .collect();
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &samples, &contact_hits, &fits)?;
        }
        if self.file.output.json {
            let hit_json = |(hit, fitted): (&Hit, &Result<ContactFit, String>)| match fitted {
                Ok(law) => serde_json::json!({ "hit": hit, "law": law }),
                Err(reason) => serde_json::json!({ "hit": hit, "law": null, "why": reason }),
            };
            let hit_list: Vec<_> = contact_hits.iter().zip(&fits).map(hit_json).collect();
            print(
                &serde_json::json!({ "channel": force.name, "hits": hit_list, "findings": record.findings }),
            );
            return Ok(());
        }
        for (hit, fitted) in contact_hits.iter().zip(&fits) {
            print_hit(hit, fitted, record.rate());
        }
        Ok(())
    }

    fn write(
        &self,
        folder: &Path,
        force: &Samples<'_>,
        contact_hits: &[Hit],
        fits: &[Result<ContactFit, String>],
    ) -> Result<(), Failure> {
        let hit =
            |value: &dyn Fn(&Hit) -> f64| contact_hits.iter().map(value).collect::<Vec<f64>>();
        let law = |value: &dyn Fn(&ContactFit) -> f64| {
            fits.iter()
                .map(|law| law.as_ref().map_or(f64::NAN, value))
                .collect::<Vec<f64>>()
        };
        let mut table = Table::new(vec![
            Column::new(
                "time_s",
                "s",
                "time of the largest force",
                hit(&|hit| hit.peak as f64 / force.rate_hz()),
            ),
            Column::new(
                "peak_force_n",
                "N",
                "largest force",
                hit(&|hit| hit.peak_force_n),
            ),
            Column::new(
                "contact_time_s",
                "s",
                "time above a tenth of the largest force",
                hit(&|hit| hit.contact_time_s),
            ),
            Column::new(
                "impulse_n_s",
                "N s",
                "integral of the force",
                hit(&|hit| hit.impulse_n_s),
            ),
            Column::new(
                "warnings",
                "",
                "number of warnings",
                contact_hits
                    .iter()
                    .map(|hit| hit.warnings.len() as u64)
                    .collect::<Vec<_>>(),
            ),
            Column::new(
                "law_contact_time_s",
                "s",
                "contact time of the law",
                law(&|law| law.contact_time_s),
            ),
            Column::new(
                "exponent",
                "",
                "exponent of the law",
                law(&|law| law.exponent),
            ),
            Column::new(
                "exponent_deviation",
                "",
                "standard deviation of the exponent",
                law(&|law| law.exponent_deviation),
            ),
            Column::new(
                "restitution",
                "",
                "ratio of speed after to speed before contact",
                law(&|law| law.restitution),
            ),
            Column::new(
                "restitution_deviation",
                "",
                "standard deviation of the restitution",
                law(&|law| law.restitution_deviation),
            ),
        ])?;
        if self.mass.is_some() {
            let about = "N/m^exponent, for the mass of the hammer";
            table.push(Column::new(
                "stiffness",
                "",
                about,
                law(&|law| law.stiffness.unwrap_or(f64::NAN)),
            ))?;
            let about = "standard deviation of the logarithm of the stiffness";
            let deviation = law(&|law| law.stiffness_relative_deviation.unwrap_or(f64::NAN));
            table.push(Column::new(
                "stiffness_relative_deviation",
                "",
                about,
                deviation,
            ))?;
            let [low, high] = [0, 1].map(|end| law(&|law| end_95(law.stiffness_95, end)));
            table.push(Column::new(
                "stiffness_low",
                "",
                "lower end of the 95 % interval of the stiffness",
                low,
            ))?;
            table.push(Column::new(
                "stiffness_high",
                "",
                "upper end of the 95 % interval of the stiffness",
                high,
            ))?;
            for (name, unit, about, fixed_law) in LAWS {
                let stiffness = law(&|law| {
                    fixed_law(law)
                        .and_then(|fixed_law| fixed_law.stiffness)
                        .unwrap_or(f64::NAN)
                });
                let [low, high] = [0, 1].map(|end| {
                    law(&|law| {
                        end_95(
                            fixed_law(law).and_then(|fixed_law| fixed_law.stiffness_95),
                            end,
                        )
                    })
                });
                let about = format!("stiffness of {about}; NaN where the pulse does not allow it");
                table.push(Column::new(
                    &format!("{name}_stiffness"),
                    unit,
                    &about,
                    stiffness,
                ))?;
                table.push(Column::new(
                    &format!("{name}_stiffness_low"),
                    unit,
                    "lower end of the 95 % interval of this stiffness",
                    low,
                ))?;
                table.push(Column::new(
                    &format!("{name}_stiffness_high"),
                    unit,
                    "upper end of the 95 % interval of this stiffness",
                    high,
                ))?;
            }
            table.push(Column::new(
                "speed_m_s",
                "m/s",
                "speed of the hammer",
                law(&|law| law.speed_m_s.unwrap_or(f64::NAN)),
            ))?;
        }
        output::table(folder, "contact", &table, &self.file.manifest("contact")?)?;
        let figures: Vec<PulseFigure> = contact_hits
            .iter()
            .zip(fits)
            .take(MAX_SHOWN_PULSES)
            .map(|(hit, law)| PulseFigure::of(force, hit, law.as_ref().ok()))
            .collect();
        output::figure(
            folder,
            "contact-pulses",
            &pulses("Force pulses and the laws fitted to them", &figures),
        )
    }
}

/// Name, unit of the stiffness, description, and fit of a contact law.
type Law = (
    &'static str,
    &'static str,
    &'static str,
    fn(&ContactFit) -> Option<FixedExponentLaw>,
);

/// Contact laws of given exponents.
const LAWS: [Law; 2] = [
    ("linear", "N/m", "a linear spring", |law| law.linear),
    ("hertz", "N/m^1.5", "Hertz's law", |law| law.hertz),
];

/// Returns an end of an interval, or NaN where there is no interval.
fn end_95(interval: Option<(f64, f64)>, end: usize) -> f64 {
    interval.map_or(f64::NAN, |(low, high)| [low, high][end])
}

/// Number of warnings that are printed for a hit.
const MAX_LISTED_WARNINGS: usize = 3;

fn print_hit(hit: &Hit, fitted: &Result<ContactFit, String>, rate_hz: f64) {
    let time_s = hit.peak as f64 / rate_hz;
    line(format!(
        "hit at {time_s:.6} s: peak {:.4} N, {:.4e} s above a tenth of it ({:.4} N), impulse {:.4e} N s",
        hit.peak_force_n,
        hit.contact_time_s,
        HitSearch::default().edge_ratio * hit.peak_force_n,
        hit.impulse_n_s
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
    match fitted {
        Err(reason) => line(format!("  no law: {reason}")),
        Ok(law) => {
            line(format!(
                "  law, 95 %: exponent {:.3} +- {:.3}, restitution {:.3} +- {:.3}, contact time {:.4e} s",
                law.exponent,
                law.exponent_half_width(),
                law.restitution,
                law.restitution_half_width(),
                law.contact_time_s
            ));
            if let (Some(stiffness), Some((low, high)), Some(speed)) =
                (law.stiffness, law.stiffness_95, law.speed_m_s)
            {
                let unit = format!("N/m^{:.3}", law.exponent);
                line(format!(
                    "  stiffness {stiffness:.4e} {unit}, 95 % from {low:.4e} to {high:.4e}, speed {speed:.4} m/s"
                ));
            }
            for (_, unit, about, fixed_law) in LAWS {
                let fixed_law = fixed_law(law)
                    .and_then(|fixed_law| fixed_law.stiffness.zip(fixed_law.stiffness_95));
                if let Some((stiffness, (low, high))) = fixed_law {
                    line(format!(
                        "  as {about}: stiffness {stiffness:.4e} {unit}, 95 % from {low:.4e} to {high:.4e}"
                    ));
                }
            }
            line(match law.allowed_laws {
                AllowedLaws::Neither => "  neither a linear spring nor Hertz's law fits",
                AllowedLaws::Linear => "  a linear spring fits, Hertz's law does not",
                AllowedLaws::Hertz => "  Hertz's law fits, a linear spring does not",
                AllowedLaws::Both => {
                    "  the data do not distinguish a linear spring from Hertz's law"
                }
            });
        }
    }
}
