//! Table and figure of contact laws.

use super::{ContactResult, FixedLawResult, ForceTableResult, HitResult};
use crate::error::Error;
use jounce_experiment::draw::pulses;
use jounce_io::table::{Column, Table};
use jounce_plot::Figure;

/// Largest number of pulses in the figure; more would overlap.
const MAX_DRAWN_PULSES: usize = 6;

impl ContactResult {
    /// Returns the table of the hits; with the mass of the hammer it has speeds and stiffnesses.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let all = &self.hits;
        let hit = |name: &str, unit: &str, about: &str, value: fn(&HitResult) -> f64| {
            let values: Vec<f64> = all.iter().map(value).collect();
            Column::new(name, unit, about, values)
        };
        let warnings: Vec<u64> = all.iter().map(|hit| hit.warnings.len() as u64).collect();
        let mut table = Table::new(vec![
            hit("time_s", "s", "time of the largest force", |hit| hit.time_s),
            hit("peak_force_n", "N", "largest force", |hit| hit.peak_force_n),
            hit(
                "contact_time_s",
                "s",
                "time above a tenth of the largest force",
                |hit| hit.contact_time_s,
            ),
            hit("impulse_n_s", "N s", "integral of the force", |hit| {
                hit.impulse_n_s
            }),
            Column::new("warnings", "", "number of warnings", warnings),
            self.law(
                "law_contact_time_s",
                "s",
                "contact time of the law",
                |hit| hit.law_contact_time_s,
            ),
            self.law("exponent", "", "exponent of the law", |hit| hit.exponent),
            self.law(
                "exponent_deviation",
                "",
                "standard deviation of the exponent",
                |hit| hit.exponent_deviation,
            ),
            self.law(
                "restitution",
                "",
                "ratio of speed after to speed before contact",
                |hit| hit.restitution,
            ),
            self.law(
                "restitution_deviation",
                "",
                "standard deviation of the restitution",
                |hit| hit.restitution_deviation,
            ),
        ])?;
        if self.mass_kg.is_some() {
            self.add_stiffnesses(&mut table)?;
        }
        Ok(table)
    }

    /// Returns a column of the laws, NaN where no law could be fitted.
    fn law(
        &self,
        name: &str,
        unit: &str,
        about: &str,
        value: impl Fn(&HitResult) -> Option<f64>,
    ) -> Column {
        let number = |hit: &HitResult| value(hit).unwrap_or(f64::NAN);
        let values: Vec<f64> = self.hits.iter().map(number).collect();
        Column::new(name, unit, about, values)
    }

    fn add_stiffnesses(&self, table: &mut Table) -> Result<(), Error> {
        table.push(self.law(
            "stiffness",
            "",
            "N/m^exponent, for the mass of the hammer",
            |hit| hit.stiffness,
        ))?;
        table.push(self.law(
            "stiffness_relative_deviation",
            "",
            "standard deviation of the logarithm of the stiffness",
            |hit| hit.stiffness_relative_deviation,
        ))?;
        let low = "lower end of the 95 % interval of the stiffness";
        table.push(self.law("stiffness_low", "", low, |hit| hit.stiffness_low))?;
        let high = "upper end of the 95 % interval of the stiffness";
        table.push(self.law("stiffness_high", "", high, |hit| hit.stiffness_high))?;
        for (name, unit, about, law) in LAWS {
            let about = format!("stiffness of {about}; NaN where the pulse does not allow it");
            let name = format!("{name}_stiffness");
            table.push(self.law(&name, unit, &about, |hit| law(hit).stiffness))?;
            let about = "lower end of the 95 % interval of this stiffness";
            let low = self.law(&format!("{name}_low"), unit, about, |hit| {
                law(hit).stiffness_low
            });
            table.push(low)?;
            let about = "upper end of the 95 % interval of this stiffness";
            let high = self.law(&format!("{name}_high"), unit, about, |hit| {
                law(hit).stiffness_high
            });
            table.push(high)?;
        }
        table.push(self.law("speed_m_s", "m/s", "speed of the hammer", |hit| {
            hit.speed_m_s
        }))?;
        Ok(())
    }

    /// Returns the table of force over penetration of each hit that has one, with the number of the
    /// hit from 1; a stop reads its file as `law = "table"`.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn force_tables(&self) -> Result<Vec<(usize, Table)>, Error> {
        let has_points = |table: &&ForceTableResult| table.reason.is_none();
        let numbered = (1..).zip(&self.force_tables);
        let tables = numbered.filter(|(_, table)| has_points(table));
        tables
            .map(|(number, table)| {
                let about = "penetration during loading";
                let at = Column::new("penetration_m", "m", about, table.penetration_m.clone());
                let about = "force during loading, with that of damping";
                let force = Column::new("force_n", "N", about, table.force_n.clone());
                Ok((number, Table::new(vec![at, force])?))
            })
            .collect()
    }

    /// Returns the figure of the first pulses with the laws fitted to them.
    pub fn figure(&self) -> Figure {
        let count = self.pulses.len().min(MAX_DRAWN_PULSES);
        let title = "Force pulses and the laws fitted to them";
        pulses(title, &self.pulses[..count])
    }
}

/// Name, unit of the stiffness, description, and fit of a law with a given exponent.
type Law = (
    &'static str,
    &'static str,
    &'static str,
    fn(&HitResult) -> FixedLawResult,
);

/// Laws of given exponents.
const LAWS: [Law; 2] = [
    ("linear", "N/m", "a linear spring", |hit| hit.linear),
    ("hertz", "N/m^1.5", "Hertz's law", |hit| hit.hertz),
];
