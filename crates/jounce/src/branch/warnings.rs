//! Texts about what a continuation of branches did not find or prove.

use super::{BranchResult, OrbitMethod, Termination, TerminationReason};
use jounce_analysis::run::WorstExcess;
use jounce_analysis::{self as analysis, Branch};

/// Error estimates above this have a warning.
const MAX_ERROR_ESTIMATE: f64 = 1e-3;

/// Returns the note on the branches that a search may miss.
pub(crate) fn search_note(seeds: usize, longest_period: u32) -> String {
    let branches = match seeds {
        0 => "branches on which no run at an end of the range settles".to_owned(),
        _ => format!("branches that none of {seeds} seeds converges to"),
    };
    format!(
        "the search misses {branches}, and branches of a period above {longest_period} cycles; more `seeds` and a larger `longest_period` find more"
    )
}

/// Returns the note of the live page on the branches that a search did not follow to their ends, or
/// not at all; `None` where there are none.
pub(crate) fn budget_note(branches: &[Branch], budget: usize) -> Option<String> {
    let is_stopped = |own: &&Branch| own.endings.contains(&analysis::Termination::Points);
    let stopped = branches.iter().filter(is_stopped).count();
    let missing: usize = branches.iter().map(|own| own.not_followed).sum();
    let were = |count| if count == 1 { "was" } else { "were" };
    let words = [
        (stopped > 0).then(|| {
            format!(
                "{stopped} of {} branches {} not followed to the end",
                branches.len(),
                were(stopped)
            )
        }),
        (missing > 0).then(|| {
            let doublings = if missing == 1 {
                "doubling"
            } else {
                "doublings"
            };
            format!("the branches of {missing} period {doublings} were not followed at all")
        }),
    ];
    let parts: Vec<_> = words.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| format!(
        "incomplete: {}. A search may use {budget} drive cycles of orbits. To follow the rest, search a shorter range (magnify it, then Use as range), or run jounce branch with a --budget above {budget}",
        parts.join(", and ")
    ))
}

impl BranchResult {
    /// Returns the warnings: branches that end early or are missing, intervals where the events are
    /// not proved, large error estimates, and exceeded limits of patches.
    pub fn warnings(&self) -> Vec<String> {
        if self.branches.is_empty() {
            return vec![format!(
                "no periodic orbit was found over {}: no integration reached one; try more `seeds`, a larger `longest_period`, more damping or another range",
                self.options.over
            )];
        }
        let mut warnings = self.early_terminations();
        warnings.extend(self.missing_doublings());
        warnings.extend(self.intervals_without_proof());
        warnings.extend(self.large_error());
        warnings.extend(self.exceeded_limits());
        warnings
    }

    fn early_terminations(&self) -> Vec<String> {
        let mut texts = Vec::new();
        for branch in &self.branches {
            let cycles = branch.period_cycles;
            for Termination {
                reason,
                parameter,
                message,
            } in &branch.termination
            {
                let event = match reason {
                    TerminationReason::Failed => "ends",
                    TerminationReason::Grazing => "has a sharp kink at a grazing point and ends",
                    TerminationReason::Sticking => "begins to stick and ends",
                    TerminationReason::Points => {
                        let points = branch.points.len();
                        texts.push(format!("a branch of period {cycles} was stopped after {points} points: give a shorter range or a larger `budget`"));
                        continue;
                    }
                    TerminationReason::Range
                    | TerminationReason::Closed
                    | TerminationReason::Merged => continue,
                };
                if let (Some(parameter), Some(message)) = (parameter, message) {
                    let unit = &self.unit;
                    texts.push(format!(
                        "a branch of period {cycles} {event} at {parameter} {unit}: {message}"
                    ));
                }
            }
        }
        texts
    }

    fn missing_doublings(&self) -> Option<String> {
        let missing: usize = self.branches.iter().map(|branch| branch.not_followed).sum();
        let budget = self.options.budget;
        (missing > 0).then(|| format!("the branches of {missing} period doublings were not continued: the budget of {budget} is used up, or Newton iteration found no first orbit"))
    }

    fn intervals_without_proof(&self) -> Vec<String> {
        let mut texts = Vec::new();
        for branch in &self.branches {
            for interval in &branch.not_proved {
                texts.push(format!(
                    "from {} to {} {}, a branch of period {} may have more or fewer events of the kind {} than listed ({}); try a smaller `tolerance`",
                    interval.from,
                    interval.to,
                    self.unit,
                    branch.period_cycles,
                    interval.event.name(),
                    interval.message
                ));
            }
        }
        texts
    }

    fn large_error(&self) -> Option<String> {
        let points = self.branches.iter().flat_map(|branch| &branch.points);
        let worst = points
            .max_by(|a, b| a.error_estimate.total_cmp(&b.error_estimate))
            .filter(|worst| worst.error_estimate > MAX_ERROR_ESTIMATE)?;
        let (error, parameter) = (worst.error_estimate, worst.parameter);
        let method = match self.options.method {
            OrbitMethod::Shooting => "",
            OrbitMethod::HarmonicBalance => " or shooting as `method`",
        };
        Some(format!(
            "the largest error estimate is {error:.1e}, at {parameter} {}: try a smaller `tolerance`{method}",
            self.unit
        ))
    }

    fn exceeded_limits(&self) -> Vec<String> {
        let points = self.branches.iter().flat_map(|branch| &branch.points);
        let (values, exceeded): (Vec<f64>, Vec<_>) = points
            .map(|point| (point.parameter, point.warnings.as_slice()))
            .unzip();
        let place = |index: usize| format!("{} = {:.6} {}", self.key, values[index], self.unit);
        WorstExcess::messages(&exceeded, "points", place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spent_budget_is_named_with_what_is_missing() {
        let whole = Branch {
            endings: vec![analysis::Termination::Range; 2],
            ..Branch::default()
        };
        let stopped = Branch {
            endings: vec![analysis::Termination::Range, analysis::Termination::Points],
            ..Branch::default()
        };
        let parent = Branch {
            not_followed: 3,
            ..whole.clone()
        };
        assert_eq!(budget_note(std::slice::from_ref(&whole), 10), None);
        let note = |branches: &[Branch]| budget_note(branches, 10).unwrap_or_default();
        let both = note(&[whole, stopped.clone(), parent]);
        assert!(
            both.starts_with("incomplete: 1 of 3 branches was not followed to the end, and the branches of 3 period doublings were not followed at all. "),
            "{both}"
        );
        assert!(both.contains("may use 10 drive cycles of orbits"), "{both}");
        assert!(both.contains("search a shorter range"), "{both}");
        assert!(both.contains("--budget above 10"), "{both}");
        let one = note(&[stopped.clone(), stopped]);
        assert!(
            one.starts_with("incomplete: 2 of 2 branches were not followed to the end. "),
            "{one}"
        );
    }
}
