//! Universal files: data sets 55 (data at nodes), 58 and 58b (functions at nodal degrees of
//! freedom), 164 (units).
//!
//! Source: Structural Dynamics Research Laboratory, University of Cincinnati, "Universal file
//! formats for modal analysis testing", including the binary form 58b. Other data sets are skipped
//! and listed in the issues.
mod binary;
mod blocks;
mod function;
mod header;
mod nodes;
mod numbers;

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::recording::{Issue, IssueKind, IssuePlace};

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let file = File::open(path).map_err(|fault| Damage::new(fault.to_string()))?;
    let mut result = FormatContents {
        sets: Vec::new(),
        shapes: Vec::new(),
        issues: Vec::new(),
    };
    let mut skipped_counts: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
    blocks::blocks(BufReader::with_capacity(1 << 20, file), store, |block| {
        match block.number {
            58 => result.sets.push(function::read(block, store)?),
            55 => result.shapes.push(nodes::read(&block)?),
            other => skipped_counts.entry(other).or_insert((0, block.start)).0 += 1,
        }
        Ok(())
    })?;
    result.sets = function::grouped(result.sets)?;
    if result.sets.is_empty() && result.shapes.is_empty() {
        let times = |(number, (count, _)): (&u32, &(usize, usize))| {
            if *count == 1 {
                number.to_string()
            } else {
                format!("{number} ({count} times)")
            }
        };
        let skipped: Vec<String> = skipped_counts.iter().map(times).collect();
        let skipped = if skipped.is_empty() {
            "nothing".to_owned()
        } else {
            skipped.join(", ")
        };
        return Err(Damage::new(format!(
            "it contains no data set 55 or 58 (mode shapes or recordings), only {skipped}: \
            geometry, units, headers or computed results"
        )));
    }
    for (number, (count, start)) in skipped_counts {
        let message = format!(
            "data set {number} is neither a recording nor a mode shape and was \
            left out"
        );
        result.issues.push(Issue::new(
            IssueKind::Skipped,
            count,
            Some(IssuePlace::Byte(start)),
            message,
        ));
    }
    Ok(result)
}
