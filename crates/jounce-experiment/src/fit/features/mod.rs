//! Features of a measurement to fit, as read from a file, and their values in the model.
mod faults;
mod file;
pub(super) mod history;
pub(super) mod jump;
pub(super) mod mode;
pub(super) mod power;
pub(super) mod response;
mod table;

pub use file::Features;
pub use history::HistoryFeature;
pub use jump::JumpFeature;
pub use mode::ModeFeature;
pub use power::PowerFeature;
pub use response::{MeasuredLines, ResponseFeature};
