//! Tables and figures of an ensemble.

use super::EnsembleResult;
use crate::error::Error;
use jounce_analysis::Member;
use jounce_io::table::{Column, Table};
use jounce_plot as picture;
use jounce_plot::{DensityLine, Figure};

/// Unit of a density.
const DENSITY_UNIT: &str = "V^2/Hz";

impl EnsembleResult {
    /// Returns the table of the members.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let members = &self.members;
        let number = |name: &str, unit: &str, about: &str, value: fn(&Member) -> f64| {
            let values: Vec<f64> = members.iter().map(value).collect();
            Column::new(name, unit, about, values)
        };
        let integer = |name: &str, about: &str, value: fn(&Member) -> u64| {
            let values: Vec<u64> = members.iter().map(value).collect();
            Column::new(name, "", about, values)
        };
        Ok(Table::new(vec![
            integer("member", "number of the realisation under its seed", |m| {
                m.index as u64
            }),
            number("mean_power_w", "W", "mean power of all loads", |m| {
                m.mean_power_w
            }),
            integer("contacts", "contacts that began", |m| m.contacts),
            number("contact_rate_hz", "Hz", "contacts per second", |m| {
                m.contact_rate_hz
            }),
            number(
                "mean_impact_velocity_m_s",
                "m/s",
                "mean impact velocity",
                |m| m.mean_impact_velocity_m_s,
            ),
            number(
                "max_impact_velocity_m_s",
                "m/s",
                "largest impact velocity",
                |m| m.max_impact_velocity_m_s,
            ),
            number(
                "mean_contact_duration_s",
                "s",
                "mean contact duration",
                |m| m.mean_contact_duration_s,
            ),
            number("max_penetration_m", "m", "largest penetration", |m| {
                m.max_penetration_m
            }),
            number(
                "energy_residual_relative",
                "",
                "energy residual relative to the largest energy",
                |m| m.energy_residual_relative,
            ),
        ])?)
    }

    /// Returns the figure of the members, their running mean and the interval of the mean power.
    pub fn figure(&self) -> Figure {
        let powers_w: Vec<f64> = self.members.iter().map(|own| own.mean_power_w).collect();
        let half_width_w = self.mean_power_half_width_w.unwrap_or(f64::INFINITY);
        let (low_w, high_w) = (
            self.mean_power_w - half_width_w,
            self.mean_power_w + half_width_w,
        );
        picture::ensemble("Mean power of realisations", &powers_w, low_w, high_w)
    }

    /// Returns the table of the spectra of the voltages; `None` without a spectrum.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn spectrum_table(&self) -> Result<Option<Table>, Error> {
        let Some(first) = self.patches.first() else {
            return Ok(None);
        };
        let mut table = Table::new(vec![Column::new(
            "frequency_hz",
            "Hz",
            "middle of the bin",
            first.spectrum.frequency_hz.clone(),
        )])?;
        for patch in &self.patches {
            let name = |what: &str| format!("{}.voltage.{what}", patch.name);
            table.push(Column::new(
                &name("psd"),
                DENSITY_UNIT,
                "power spectral density, one-sided",
                patch.spectrum.density_v2_hz.clone(),
            ))?;
            table.push(Column::new(
                &name("psd_half_width"),
                DENSITY_UNIT,
                "half width of its 95 % interval",
                patch.spectrum.density_half_width_v2_hz.clone(),
            ))?;
        }
        Ok(Some(table))
    }

    /// Returns the figure of the spectra of the voltages; `None` without a spectrum.
    pub fn spectrum_figure(&self) -> Option<Figure> {
        let frequency_hz = &self.patches.first()?.spectrum.frequency_hz;
        let line = |patch: &super::EnsemblePatch| {
            let (density, half_width) = (
                &patch.spectrum.density_v2_hz,
                &patch.spectrum.density_half_width_v2_hz,
            );
            let end = |sign: f64| {
                let pairs = density.iter().zip(half_width);
                pairs.map(|(mean, width)| mean + sign * width).collect()
            };
            DensityLine {
                quantity: format!("{}.voltage", patch.name),
                unit: DENSITY_UNIT.to_owned(),
                interval: [end(-1.0), end(1.0)],
                density: density.clone(),
            }
        };
        let lines: Vec<DensityLine> = self.patches.iter().map(line).collect();
        let title = "Spectra of realisations";
        Some(picture::densities(title, frequency_hz, &lines))
    }
}
