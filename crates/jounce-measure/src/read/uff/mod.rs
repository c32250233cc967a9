//! Universal files: data sets 55 (data at nodes), 58 and 58b (functions at nodal degrees of freedom), 164 (units).
//!
//! Source: Structural Dynamics Research Laboratory, University of Cincinnati, "Universal file formats for modal analysis testing"; the binary
//! form 58b as in the same collection. Other data sets are named in the findings and left out.
mod binary;
mod blocks;
mod function;
mod header;
mod nodes;
mod numbers;

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use super::contents::Found;
use super::error::Damage;
use super::shelf::Shelf;
use crate::recording::{Finding, FindingKind, Place};

pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let file = File::open(path).map_err(|fault| Damage::new(fault.to_string()))?;
    let mut found = Found { sets: Vec::new(), shapes: Vec::new(), findings: Vec::new() };
    blocks::blocks(BufReader::with_capacity(1 << 20, file), shelf, |block| {
        match block.number {
            58 => found.sets.push(function::read(block, shelf)?),
            55 => found.shapes.push(nodes::read(&block)?),
            other => {
                let about = format!("data set {other} holds no samples (geometry, units or headers) and was left out");
                found.findings.push(Finding::new(FindingKind::Skipped, 1, Some(Place::Byte(block.start)), about));
            }
        }
        Ok(())
    })?;
    found.sets = function::grouped(found.sets)?;
    if found.sets.is_empty() && found.shapes.is_empty() {
        let kinds: Vec<&str> = found.findings.iter().map(|finding| finding.about.as_str()).collect();
        return Err(Damage::new(format!("it holds no data set 55 or 58: {}", kinds.join("; "))));
    }
    Ok(found)
}
