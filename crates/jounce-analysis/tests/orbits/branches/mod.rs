//! Branches over one key, their labels and widths.

mod branch_update;
mod circle;
mod events;
mod hard_cases;
mod isolated;
mod label_comparison;
mod label_errors;
mod labels;
mod limits_of_stops;
mod paper;
#[path = "../../attractors/random_specs.rs"]
pub mod random_specs;
mod same_labels;
mod sweeps;
mod widths;
