//! The hits of a hammer test, or the blocks of a shaker test, as lines of text.

use super::MeasuredFrfResult;
use jounce_signal::spectral::{HitWarning, ImpactHit};
use std::collections::BTreeMap;

/// Number of hits that are listed for each fault; for more hits only the count is printed.
const MAX_LISTED_HITS: usize = 3;

impl MeasuredFrfResult {
    /// Returns lines of text: the hits or blocks that were averaged, the faults of hits, and the
    /// hits that were left out.
    pub fn hit_lines(&self) -> Vec<String> {
        let mut lines = self.averages();
        lines.extend(self.faults());
        let unused: Vec<usize> = (1..)
            .zip(&self.hits)
            .filter(|(_, hit)| !hit.used)
            .map(|(number, _)| number)
            .collect();
        if !unused.is_empty() {
            let list = hit_list(&unused);
            lines.push(format!(
                "left out: {list}, whose blocks would extend beyond the record"
            ));
        }
        lines
    }

    /// Describes the blocks that were averaged.
    fn averages(&self) -> Vec<String> {
        let Some(block_s) = self.block_s else {
            return Vec::new();
        };
        if self.hits.is_empty() {
            let first = self.data.functions.first();
            let blocks = first.map_or(0, |function| function.blocks);
            return vec![format!(
                "continuous input (shaker): {blocks} blocks of {block_s:.6} s averaged, half overlapping, Hann"
            )];
        }
        let used = self.hits.iter().filter(|hit| hit.used).count();
        let all = self.hits.len();
        vec![format!(
            "{used} hits of {all} averaged, blocks of {block_s:.6} s"
        )]
    }

    /// Describes the faults of hits: the first few of each fault, and the number of the others.
    fn faults(&self) -> Vec<String> {
        let mut faults: BTreeMap<&str, Vec<(usize, String)>> = BTreeMap::new();
        for (number, ImpactHit { hit, .. }) in (1..).zip(&self.hits) {
            for warning in &hit.warnings {
                let fault = faults.entry(fault(*warning)).or_default();
                // A hit with many bounces is one double hit.
                if fault.last().is_none_or(|(last, _)| *last != number) {
                    let force_n = hit.peak_force_n;
                    let text = format!("warning: hit {number} of {force_n:.4} N {warning}");
                    fault.push((number, text));
                }
            }
        }
        let mut lines = Vec::new();
        for (fault, messages) in faults {
            let listed = messages.iter().take(MAX_LISTED_HITS);
            lines.extend(listed.map(|(_, message)| message.clone()));
            let others = messages.iter().skip(MAX_LISTED_HITS);
            let others: Vec<usize> = others.map(|(number, _)| *number).collect();
            if !others.is_empty() {
                lines.push(format!("warning: also {fault}: {}", hit_list(&others)));
            }
        }
        lines
    }
}

/// `hit 4, 5, 6 and 20 more`.
fn hit_list(hits: &[usize]) -> String {
    let listed = hits.iter().take(MAX_LISTED_HITS);
    let numbers: Vec<String> = listed.map(ToString::to_string).collect();
    let suffix = match hits.len().saturating_sub(MAX_LISTED_HITS) {
        0 => String::new(),
        remaining => format!(" and {remaining} more"),
    };
    format!("hit {}{suffix}", numbers.join(", "))
}

fn fault(warning: HitWarning) -> &'static str {
    match warning {
        HitWarning::Double { .. } => "double",
        HitWarning::Clipped { .. } => "clipped",
        HitWarning::Coarse { .. } => "coarse",
        HitWarning::Cut => "cut",
        HitWarning::Ringing { .. } => "while a response still moves",
    }
}
