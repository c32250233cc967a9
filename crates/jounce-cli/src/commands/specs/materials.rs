//! `jounce materials`

use crate::failure::Failure;
use crate::output::line;
use clap::Args;

/// Arguments of `materials`.
#[derive(Debug, Args)]
pub struct Materials {
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Materials {
    /// Lists the materials and the chips of regulators with their sources.
    pub fn run(&self) -> Result<(), Failure> {
        if self.json {
            line(serde_json::json!({ "materials": jounce::materials(), "chips": jounce::chips() }));
            return Ok(());
        }
        print_materials();
        print_chips();
        Ok(())
    }
}

fn print_materials() {
    for material in jounce::materials() {
        let in_plane = material.active.and_then(|of| of.in_plane_poisson_ratio);
        let ratio = match (material.poisson_ratio, in_plane) {
            (Some(ratio), _) => format!(", Poisson's ratio {ratio}"),
            (None, Some(ratio)) => {
                format!(", Poisson's ratio in the plane {}", decimals(ratio))
            }
            (None, None) => String::new(),
        };
        line(format!(
            "{}: {} GPa{ratio}, {} kg/m^3",
            material.name,
            decimals(material.youngs_modulus_pa / 1e9),
            material.density_kg_m3
        ));
        if let Some(active) = material.active {
            let marker = if active.electrode_spacing_m.is_some() {
                "d33"
            } else {
                "d31"
            };
            line(format!(
                "    {marker} {} pC/N, permittivity at constant strain {} nF/m",
                decimals(active.charge_coefficient_m_per_v * 1e12),
                decimals(active.permittivity_f_m * 1e9)
            ));
        }
        if let Some([low, high]) = material.yield_strength_pa {
            line(format!(
                "    yield strength {} to {} MPa",
                decimals(low / 1e6),
                decimals(high / 1e6)
            ));
        }
        if let Some(strain) = material.strain_limit {
            line(format!(
                "    recommended strain at most {} ppm",
                decimals(strain * 1e6)
            ));
        }
        if let Some([low, high]) = material.voltage_limits_v {
            line(format!("    voltage from {low} V to {high} V"));
        }
        line(format!("    {}", material.source));
    }
}

fn print_chips() {
    for chip in jounce::chips() {
        let of = &chip.regulator;
        line(format!(
            "{}: regulator, starts at {} V, stops at {} V, output {} V, efficiency {}",
            chip.name, of.start_v, of.stop_v, of.output_v, of.efficiency
        ));
        line(format!(
            "    current off {} nA at the start voltage, quiescent current on {} nA",
            decimals(of.idle_a * 1e9),
            decimals(of.quiescent_a * 1e9)
        ));
        line(format!("    {}", chip.source));
    }
}

/// Rounds to five digits, without trailing zeros.
fn decimals(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
