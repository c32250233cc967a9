//! Matching of the segments of a record with the solutions of a model.

use crate::failure::Failure;
use crate::output::line;
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce_core::integrate::Control;
use jounce_core::signal::Samples;
use jounce_core::table::{Column, Table};
use jounce_measure::segmentation::{
    Candidate, RecordSegment, SegmentMatch, SegmentMatches, match_segments,
};
use jounce_measure::solution::{SolutionSearch, as_recorded, solutions};
use std::path::PathBuf;

/// Model that a record is compared with.
#[derive(Debug, Args)]
pub struct ModelArguments {
    /// Spec of the model: each segment is matched with one of its solutions. The drive frequency,
    /// and the resistance where given, are taken from the record.
    #[arg(long, value_name = "SPEC")]
    model: Option<PathBuf>,
    /// Sets a key of the model, as in --set drive.shaker.amplitude="42 N"; can be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "model")]
    set: Vec<String>,
    /// Number of random starts that find the solutions of the model.
    #[arg(long, default_value_t = 40, requires = "model")]
    starts: usize,
    /// Seed of the starts.
    #[arg(long, default_value_t = 1, requires = "model")]
    seed: u64,
    /// Circuit of the model whose voltage was recorded; by default the first.
    #[arg(long, value_name = "CIRCUIT", requires = "model")]
    load: Option<String>,
    /// Largest distance of the waveforms, relative to the waveform of the record, at which a
    /// solution matches.
    #[arg(long, default_value_t = 0.2, requires = "model")]
    within: f64,
}

impl ModelArguments {
    /// Returns the solutions that match each segment; empty without a model.
    pub fn correspondences(
        &self,
        samples: &Samples<'_>,
        drive_hz: f64,
        resistance_ohm: Option<f64>,
        segments: &[RecordSegment],
    ) -> Result<Vec<SegmentMatches>, Failure> {
        let Some(path) = &self.model else {
            return Ok(Vec::new());
        };
        if !(self.within > 0.0 && self.within <= 1.0) || self.starts == 0 {
            return Err(Failure::usage(
                "--within must be above 0 and at most 1, --starts above 0".to_owned(),
            ));
        }
        let mut spec = SpecArguments {
            spec: path.clone(),
            set: self.set.clone(),
        }
        .spec()?;
        as_recorded(&mut spec, drive_hz, resistance_ohm, self.load.as_deref());
        let search = SolutionSearch {
            starts: self.starts,
            seed: self.seed,
            load: self.load.clone(),
            ..SolutionSearch::default()
        };
        let known_solutions = solutions(&spec, &search, &Control::default())?;
        Ok(segments
            .iter()
            .map(|segment| {
                match_segments(samples, drive_hz, segment, &known_solutions, self.within)
            })
            .collect())
    }
}

/// Prints the match of a segment.
pub fn print_match(matches: &SegmentMatches) {
    let Some(best) = matches.candidates.first() else {
        return;
    };
    let verdict = match matches.fits {
        SegmentMatch::One => format!("solution {}", best.id),
        SegmentMatch::Several => "several solutions match equally well".to_owned(),
        SegmentMatch::None => "no solution of the model matches".to_owned(),
    };
    line(format!("{:>29}{verdict}", ""));
    for candidate in &matches.candidates {
        let number = |value: Option<f64>| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"))
        };
        line(format!(
            "{:>31}{:<8} waveform distance {:>6}, spectrum distance {:>6}, power ratio {:>6}, {:.5e} W in the model{}",
            "",
            candidate.id,
            number(candidate.waveform_distance),
            number(candidate.spectrum_distance),
            number(candidate.power_ratio),
            candidate.mean_power_w,
            if candidate.inverted {
                ", polarity inverted"
            } else {
                ""
            }
        ));
    }
}

/// Adds the match of each segment to the table of segments; nothing without a model.
pub fn columns(table: &mut Table, matches: &[SegmentMatches]) -> Result<(), Failure> {
    if matches.is_empty() {
        return Ok(());
    }
    let best = |value: &dyn Fn(&Candidate) -> Option<f64>| {
        matches
            .iter()
            .map(|matches| {
                matches
                    .candidates
                    .first()
                    .and_then(value)
                    .unwrap_or(f64::NAN)
            })
            .collect::<Vec<f64>>()
    };
    let ids = matches.iter().map(|matches| match matches.fits {
        SegmentMatch::One => matches.id().unwrap_or_default().to_owned(),
        SegmentMatch::Several => "several".to_owned(),
        SegmentMatch::None => "none".to_owned(),
    });
    table.push(Column::new(
        "solution",
        "",
        "matching solution of the model",
        ids.collect::<Vec<_>>(),
    ))?;
    table.push(Column::new(
        "waveform_distance",
        "",
        "waveform distance of the nearest solution",
        best(&|c| c.waveform_distance),
    ))?;
    table.push(Column::new(
        "spectrum_distance",
        "",
        "spectrum distance of the nearest solution",
        best(&|c| c.spectrum_distance),
    ))?;
    table.push(Column::new(
        "model_power_w",
        "W",
        "mean power of the nearest solution",
        best(&|c| Some(c.mean_power_w)),
    ))?;
    Ok(())
}
