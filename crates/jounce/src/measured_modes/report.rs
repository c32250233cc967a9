//! Warnings, notes and figures of measured modes.

use super::MeasuredModesResult;
use jounce_data::recording::Quantity;
use jounce_experiment::draw::{modal_fit, stabilisation};
use jounce_plot::Figure;

/// Maximum number of peaks that are listed.
const MAX_LISTED_PEAKS: usize = 8;

impl MeasuredModesResult {
    /// Returns the messages about modes that may be noise, and about peaks without a mode.
    pub fn warnings(&self) -> Vec<String> {
        let doubtful: Vec<String> = (1..)
            .zip(&self.modes)
            .filter(|(_, mode)| mode.doubtful)
            .map(|(number, _)| number.to_string())
            .collect();
        let doubtful = (!doubtful.is_empty()).then(|| {
            format!(
                "the damping of mode {} is statistically indistinguishable from zero, so it may be noise; try a smaller `order` or a narrower \
                 band: if the mode disappears, it is noise",
                doubtful.join(", ")
            )
        });
        let listed = self.unexplained.iter().take(MAX_LISTED_PEAKS);
        let peaks: Vec<String> = listed
            .map(|peak| format!("{:.6}", peak.frequency_hz))
            .collect();
        let more = match self.unexplained.len().saturating_sub(MAX_LISTED_PEAKS) {
            0 => String::new(),
            remaining => format!(" and {remaining} more"),
        };
        let unexplained = (!peaks.is_empty()).then(|| {
            format!(
                "the responses have peaks at {}{more} Hz that no mode explains; try a band around them, or a larger `order`",
                peaks.join(", ")
            )
        });
        doubtful.into_iter().chain(unexplained).collect()
    }

    /// Returns lines of text about the noise and the window of a hammer or shaker test.
    pub fn notes(&self) -> Vec<String> {
        if self.frf.is_none() {
            return Vec::new();
        }
        let window = (self.window_decay_per_s > 0.0).then(|| {
            format!(
                "damping of the exponential window, {:.5} 1/s, was subtracted",
                self.window_decay_per_s
            )
        });
        let noise = match self.block_s {
            None => Some("response functions contain no noise estimate; the intervals are computed from the residual of each line".to_owned()),
            Some(_) if self.misfit > 1.0 => Some(format!(
                "the residual of the modes is {:.1} times that expected from the coherence; the intervals are widened by this factor",
                self.misfit.sqrt()
            )),
            Some(_) => None,
        };
        window.into_iter().chain(noise).collect()
    }

    /// Returns the stabilisation diagram.
    pub fn figure(&self) -> Figure {
        stabilisation("Stabilisation diagram", &self.identification)
    }

    /// Returns the figure of the functions, measured and reconstructed from the modes.
    pub fn fit_figure(&self) -> Figure {
        let is_force = |input: &Quantity| *input == Quantity::Force;
        let title = match &self.frf {
            None => "One-sided spectra",
            Some(frf) if frf.data.inputs.iter().all(is_force) => "Displacement per force",
            Some(_) => "Displacement, or voltage, per input",
        };
        let title = format!("{title}: measured and reconstructed from the modes");
        let unit = |k: usize| match &self.frf {
            Some(frf) => fit_unit(frf.data.quantities[k], frf.data.inputs[k]),
            None => String::new(),
        };
        let functions = self.functions.iter().enumerate();
        let functions: Vec<_> = functions.map(|(k, name)| (name, unit(k))).collect();
        modal_fit(&title, &functions, &self.identification)
    }
}

/// Returns the unit of a response in which motion is a displacement, and motion of the base an
/// acceleration; empty if a quantity is not known.
fn fit_unit(output: Quantity, input: Quantity) -> String {
    let output = match output {
        Quantity::Displacement | Quantity::Velocity | Quantity::Acceleration => "m",
        Quantity::Voltage => "V",
        _ => return String::new(),
    };
    match input {
        Quantity::Displacement | Quantity::Velocity | Quantity::Acceleration => {
            format!("{output}/(m/s^2)")
        }
        Quantity::Force | Quantity::Voltage | Quantity::Pressure => {
            format!("{output}/{}", input.si_unit())
        }
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_is_in_displacement_per_force_or_acceleration() {
        use Quantity::{Acceleration, Displacement, Force, Unknown, Velocity, Voltage};
        let cases = [
            (Acceleration, Force, "m/N"),
            (Velocity, Velocity, "m/(m/s^2)"),
            (Displacement, Voltage, "m/V"),
            (Voltage, Acceleration, "V/(m/s^2)"),
            (Unknown, Force, ""),
            (Voltage, Unknown, ""),
        ];
        for (output, input, unit) in cases {
            assert_eq!(fit_unit(output, input), unit);
        }
    }
}
