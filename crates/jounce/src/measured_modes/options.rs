//! Options of the identification of modes from measurements.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, frequencies_hz, time_s, times_s};
use serde::{Deserialize, Serialize};

/// Limits of the order of the stabilisation diagram.
const ORDERS: std::ops::RangeInclusive<usize> = 2..=400;

/// Options of [`crate::Recording::measured_modes`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeasuredModesOptions {
    /// The recordings are free decays, one after each release or hit, each from its largest sample
    /// on or over a span; by default they are hammer or shaker tests.
    #[arg(long)]
    pub free_decay: bool,
    /// The recording is the response to unmeasured noise, or one amplitude spectrum over frequency;
    /// by default the recordings contain a force.
    #[arg(long)]
    pub output_only: bool,
    /// Part of each free decay to use, in times after its first sample, as in 0.2s:3s; by default
    /// from its largest sample to its end.
    #[arg(long = "span", value_name = "FROM:TO", value_parser = times_s)]
    pub span_s: Option<(f64, f64)>,
    /// Reference channel of the correlations, by name; can be given several times; by default all
    /// channels.
    #[arg(long, value_name = "CHANNEL")]
    pub reference: Vec<String>,
    /// Longest lag of the correlations, as in 2s; by default a sixty-fourth of the record, at least
    /// 512 samples.
    #[arg(long = "lags", value_name = "TIME", value_parser = time_s)]
    pub lags_s: Option<f64>,
    /// Frequency band of the modes, as in 500Hz:4300Hz; by default all lines above 0.
    #[arg(long = "between", value_name = "FROM:TO", value_parser = frequencies_hz)]
    pub between_hz: Option<(f64, f64)>,
    /// Largest order of the stabilisation diagram, an integer from 2 to 400.
    #[arg(long, default_value_t = 40)]
    pub order: usize,
}

impl Default for MeasuredModesOptions {
    fn default() -> Self {
        defaults()
    }
}

impl MeasuredModesOptions {
    /// True where the recordings contain no input.
    pub fn is_unforced(&self) -> bool {
        self.free_decay || self.output_only
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        let &Self {
            free_decay,
            output_only,
            order,
            ..
        } = self;
        if !ORDERS.contains(&order) {
            let expected = format!("it must be from {} to {}", ORDERS.start(), ORDERS.end());
            return Err(Error::option("order", order, expected));
        }
        if free_decay && output_only {
            let expected = "`free_decay` is also given; give one of them";
            return Err(Error::option("output_only", "given", expected));
        }
        let of_other_test = [
            ("span", self.span_s.is_some() && !free_decay, "free_decay"),
            (
                "reference",
                !self.reference.is_empty() && !output_only,
                "output_only",
            ),
            ("lags", self.lags_s.is_some() && !output_only, "output_only"),
        ];
        if let Some((option, _, test)) = of_other_test.into_iter().find(|one| one.1) {
            let expected = format!("it needs `{test}`: give it too, or omit `{option}`");
            return Err(Error::option(option, "given", expected));
        }
        for (option, ends) in [("span", self.span_s), ("between", self.between_hz)] {
            if let Some((from, to)) = ends.filter(|(from, to)| !(0.0 <= *from && from < to)) {
                let expected = "its ends must be at least 0, with the first below the second";
                return Err(Error::option(option, format!("{from}:{to}"), expected));
            }
        }
        if let Some(lags_s) = self.lags_s {
            check_above_zero("lags", lags_s, "s")?;
        }
        Ok(())
    }
}
