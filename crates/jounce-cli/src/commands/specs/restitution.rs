//! `jounce restitution`

use crate::failure::Failure;
use crate::output::{line, to_json};
use clap::Args;
use jounce::{RestitutionOptions, restitution};

/// Arguments of `restitution`.
#[derive(Debug, Args)]
pub struct Restitution {
    #[command(flatten)]
    options: RestitutionOptions,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Restitution {
    /// Prints the estimate with its sources.
    pub fn run(&self) -> Result<(), Failure> {
        let result = restitution(&self.options)?;
        if self.json {
            line(to_json(&result)?);
            return Ok(());
        }
        let range = |[low, high]: [f64; 2]| format!("{low:.3} to {high:.3}");
        line(format!("restitution {}", range(result.restitution)));
        line(format!(
            "    pressure at the yield limit {}, fully plastic {}",
            range(result.perfectly_plastic),
            range(result.fully_plastic)
        ));
        let [low, high] = result.yield_strength_pa.map(|of| of / 1e6);
        line(format!(
            "yield strength of the softer body {low} to {high} MPa"
        ));
        let [low, high] = result.yield_speed_m_s;
        line(format!("speed of first yield {low:.2e} to {high:.2e} m/s"));
        for source in &result.sources {
            line(format!("    {source}"));
        }
        Ok(())
    }
}
