//! Tables and text of a design.

use super::DesignResult;
use crate::error::Error;
use jounce_design::{
    FreeValue, FrontPoint, Goal, LimitResult, NearestFold, NoiseLimit, NoisePower, SearchEnd,
    SobolIndex,
};
use jounce_io::table::{Column, Table};
use std::collections::BTreeSet;

impl DesignResult {
    /// Returns the tables with their names: the free keys, the limits, the better and better designs
    /// and, where there are any, the Sobol indices and the front.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn tables(&self) -> Result<Vec<(&'static str, Table)>, Error> {
        let mut tables = vec![
            ("design-keys", self.table()?),
            ("design-limits", self.limits_table()?),
            ("design-trace", self.trace_table()?),
        ];
        if let Some(robust) = &self.outcome.robust {
            tables.push(("design-sobol", sobol_table(&robust.sobol)?));
        }
        if !self.outcome.front.is_empty() {
            tables.push(("design-front", front_table(&self.outcome.front)?));
        }
        Ok(tables)
    }

    /// Returns the table of the free keys: the best value and the one in the spec.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let text = |name: &str, about: &str, value: fn(&FreeValue) -> String| {
            let values: Vec<String> = self.outcome.best.keys.iter().map(value).collect();
            Column::new(name, "", about, values)
        };
        Ok(Table::new(vec![
            text("key", "free key", |one| one.key.clone()),
            text("value", "best value", |one| one.value.clone()),
            text("before", "value in the spec", |one| one.before.clone()),
            text("at_end", "end of the range that the value has", |one| {
                one.at_end.unwrap_or_default().to_owned()
            }),
        ])?)
    }

    fn limits_table(&self) -> Result<Table, Error> {
        let names: Vec<String> = self
            .outcome
            .limits
            .iter()
            .map(|one| one.name.clone())
            .collect();
        let flags = |value: fn(&LimitResult) -> bool| {
            let limits = self.outcome.limits.iter();
            limits.map(value).collect::<Vec<bool>>()
        };
        let (lower, active) = (flags(|one| one.is_lower), flags(|one| one.active));
        let number = |name: &str, about: &str, value: fn(&LimitResult) -> f64| {
            let values: Vec<f64> = self.outcome.limits.iter().map(value).collect();
            Column::new(name, "", about, values)
        };
        Ok(Table::new(vec![
            Column::new("name", "", "limited quantity", names),
            number("value", "value at the best design, SI", |one| one.value),
            number("limit", "limit, SI", |one| one.limit),
            Column::new(
                "is_lower",
                "",
                "the value must be at least the limit, else at most",
                lower,
            ),
            Column::new("active", "", "the limit binds", active),
            number(
                "exceeded_fraction",
                "share of the other realisations of the noise that exceed the limit",
                |one| {
                    let noise = one.noise.as_ref();
                    noise.map_or(f64::NAN, |noise| {
                        noise.exceeded as f64 / noise.realisations as f64
                    })
                },
            ),
            number(
                "price",
                "gain of power per unit of the limit, W per SI unit",
                |one| one.price.unwrap_or(f64::NAN),
            ),
        ])?)
    }

    fn trace_table(&self) -> Result<Table, Error> {
        let evaluation: Vec<u64> = self
            .outcome
            .trace
            .iter()
            .map(|one| one.evaluation as u64)
            .collect();
        let goal: Vec<f64> = self.outcome.trace.iter().map(|one| one.goal).collect();
        let violation: Vec<f64> = self.outcome.trace.iter().map(|one| one.violation).collect();
        Ok(Table::new(vec![
            Column::new("evaluation", "", "number of evaluated designs", evaluation),
            Column::new("goal", "", "first goal, in its unit", goal),
            Column::new("violation", "", "sum of relative violations", violation),
        ])?)
    }

    /// Returns the result as lines of text.
    pub fn text(&self) -> String {
        let best = &self.outcome.best;
        let mut lines = self.goal_lines();
        for key in &best.keys {
            let end = key
                .at_end
                .map_or_else(String::new, |end| format!(", at its {end} end"));
            let before = match key.before.as_str() {
                "" => ", new".to_owned(),
                before if before == key.value => ", as before".to_owned(),
                before => format!(", before {before}"),
            };
            lines.push(format!("{} = {}{before}{end}", key.key, key.value));
        }
        let is_one = self.conditions.is_empty();
        if best.stable {
            lines.push(format!(
                "orbit            period {}, stable, {:.6e} W{}, reached by {:.1} % of the starts ({:.1} % to {:.1} %){}",
                best.period_cycles,
                best.mean_power_w,
                if is_one { "" } else { " in the first condition" },
                100.0 * best.basin_fraction,
                100.0 * best.basin_fraction_low,
                100.0 * best.basin_fraction_high,
                if is_one { "" } else { " in the condition with the fewest" }
            ));
        }
        lines.extend(best.nearest_fold.as_ref().map(fold_text));
        lines.extend(best.noise.as_ref().map(noise_text));
        lines.extend(self.outcome.limits.iter().map(limit_text));
        lines.extend(self.outcome.robust.iter().flat_map(robust_lines));
        if !self.outcome.front.is_empty() {
            lines.push(format!(
                "front            {} designs",
                self.outcome.front.len()
            ));
        }
        lines.push(format!(
            "search           {} evaluations in {:.1} s; {}",
            self.outcome.evaluations,
            self.outcome.wall_time_s,
            end_text(self.outcome.ended_by)
        ));
        lines.join("\n")
    }

    /// Returns a line for each goal: its value, and that of the spec as given.
    fn goal_lines(&self) -> Vec<String> {
        let best = &self.outcome.best;
        let mut lines = Vec::new();
        for (name, value) in &best.goals {
            let unit = unit(name);
            let before = match self.outcome.before.goals.get(name) {
                Some(before) => format!(", before {before:.6e} {unit}"),
                None => String::new(),
            };
            let interval = match name == Goal::ExpectedPower.name() {
                true => format!(
                    " ({:.3e} to {:.3e})",
                    best.expected_power_low_w, best.expected_power_high_w
                ),
                false => String::new(),
            };
            let of_run = match name == Goal::MeanPower.name() {
                true => " (of one run from run.start)",
                false => "",
            };
            lines.push(format!(
                "{name:<16} {value:.6e} {unit}{interval}{before}{of_run}"
            ));
        }
        lines
    }

    /// Returns the warnings: free keys that change neither a goal nor a limit at the best design, and a
    /// power that counts as 0 because no run settled.
    pub fn warnings(&self) -> Vec<String> {
        self.outcome.warnings.clone()
    }

    /// Returns the message for a design beyond its limits.
    pub fn violation_text(&self) -> String {
        let limits = self.outcome.limits.iter();
        let broken = limits.filter(|one| one.violation > 0.0);
        let names: Vec<String> = broken.map(limit_text).collect();
        format!(
            "no design found keeps all limits; the least violation is {:.3e}: {}",
            self.outcome.violation,
            match names.is_empty() {
                true => "some starts have no periodic orbit".to_owned(),
                false => names.join("; "),
            }
        )
    }
}

/// Returns the end of a search in words.
fn end_text(end: SearchEnd) -> &'static str {
    match end {
        SearchEnd::Converged => "ended because no better design is expected",
        SearchEnd::Evaluations => {
            "ended because the next step would exceed the number of evaluations"
        }
        SearchEnd::Seconds => "ended because its wall time was used up",
        SearchEnd::Stopped => "stopped",
    }
}

/// Returns the unit of a goal.
pub(super) fn unit(goal: &str) -> &'static str {
    Goal::named(goal).map_or("", Goal::unit)
}

/// Returns the line of the nearest fold.
fn fold_text(fold: &NearestFold) -> String {
    let in_tolerances = fold.scatter_hz.map_or_else(String::new, |scatter_hz| {
        let count = fold.distance_hz / scatter_hz;
        format!(", {count:.1} standard deviations by the tolerances")
    });
    format!(
        "nearest fold     {} = {:.6} Hz, {:.3e} Hz away{in_tolerances}",
        fold.key, fold.frequency_hz, fold.distance_hz
    )
}

fn noise_text(noise: &NoisePower) -> String {
    format!(
        "noise            {:.6e} W ({:.3e} to {:.3e}) under {} realisations of the noise other than that of the search",
        noise.mean_power_w, noise.mean_power_low_w, noise.mean_power_high_w, noise.realisations
    )
}

fn limit_text(limit: &LimitResult) -> String {
    let price = limit.price.map_or_else(String::new, |price| {
        format!(
            ", one more per cent of it is worth {:.3e} W",
            0.01 * price * limit.limit
        )
    });
    let noise = limit.noise.as_ref();
    format!(
        "{:<16} {}, {}{price}{}",
        limit.name,
        limit.comparison(6),
        limit.state(),
        noise.map_or_else(String::new, noise_limit_text)
    )
}

fn noise_limit_text(noise: &NoiseLimit) -> String {
    format!(
        ", beyond it in {} of {} other realisations of the noise ({:.1} % to {:.1} % of all)",
        noise.exceeded,
        noise.realisations,
        100.0 * noise.exceeded_fraction_low,
        100.0 * noise.exceeded_fraction_high,
    )
}

fn robust_lines(robust: &jounce_design::Robustness) -> Vec<String> {
    let mut lines = Vec::new();
    for one in &robust.quantiles {
        lines.push(format!(
            "quantile {:>4.0} %   {:.6e} W",
            100.0 * one.share,
            one.mean_power_w
        ));
    }
    for index in &robust.sobol {
        lines.push(format!(
            "{}: {:.2} of the variance alone ({:.2} to {:.2}), {:.2} in all ({:.2} to {:.2})",
            index.key,
            index.first,
            index.first_low,
            index.first_high,
            index.total,
            index.total_low,
            index.total_high
        ));
    }
    if robust.lost_fraction > 0.0 {
        lines.push(format!(
            "the orbit is lost in {:.1} % of the drawn designs",
            100.0 * robust.lost_fraction
        ));
    }
    lines
}

fn sobol_table(all: &[SobolIndex]) -> Result<Table, Error> {
    let keys: Vec<String> = all.iter().map(|one| one.key.clone()).collect();
    let number = |name: &str, about: &str, value: fn(&SobolIndex) -> f64| {
        Column::new(name, "", about, all.iter().map(value).collect::<Vec<f64>>())
    };
    Ok(Table::new(vec![
        Column::new("key", "", "key of the tolerance", keys),
        number(
            "first",
            "share of the variance that it causes alone",
            |one| one.first,
        ),
        number("first_low", "lower end of the 95 % interval", |one| {
            one.first_low
        }),
        number("first_high", "upper end of the 95 % interval", |one| {
            one.first_high
        }),
        number("total", "share that it causes with all others", |one| {
            one.total
        }),
        number("total_low", "lower end of the 95 % interval", |one| {
            one.total_low
        }),
        number("total_high", "upper end of the 95 % interval", |one| {
            one.total_high
        }),
    ])?)
}

fn front_table(front: &[FrontPoint]) -> Result<Table, Error> {
    let mut columns = Vec::new();
    let Some(first) = front.first() else {
        return Ok(Table::new(columns)?);
    };
    for name in first.goals.keys() {
        let values: Vec<f64> = front.iter().map(|one| one.goals[name]).collect();
        columns.push(Column::new(name, unit(name), "goal", values));
    }
    // A design has the keys of its choices only.
    let keys: BTreeSet<&String> = front.iter().flat_map(|one| one.set.keys()).collect();
    for key in keys {
        let value = |one: &FrontPoint| one.set.get(key).cloned().unwrap_or_default();
        let values: Vec<String> = front.iter().map(value).collect();
        columns.push(Column::new(key, "", "free key", values));
    }
    Ok(Table::new(columns)?)
}
