//! Studies: their points, identical tables for any split, stop or damage of the work, and immediate
//! errors for invalid texts.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod designs;
mod devices;
mod faults;
mod folders;
mod quantities;

use jounce_analysis::study::Study;
use std::path::{Path, PathBuf};

const GRID: &str = r#"
spec = "harvester.toml"
points_per_part = 3
[set]
"run.duration" = "0.5 s"
"run.average_over" = "0.25 s"
[vary]
"stop.tip.gap" = "0.5mm,1mm"
"drive.shaker.frequency" = "11Hz:13Hz:2x"
"circuit.load.resistance" = "100kohm:1Mohm:2log"
"#;

fn example_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/impact-harvester-2019")
}

fn study(text: &str) -> Study {
    Study::parse(text, &example_folder()).unwrap()
}
