//! Branches over one key, their labels and widths.

mod branch_update;
mod events;
mod hard_cases;
mod isolated;
mod labels;
mod paper;
mod same_labels;
mod sweeps;
mod widths;
