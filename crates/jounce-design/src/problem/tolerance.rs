//! Tolerances of the workshop.

use super::free_key::messages;
use jounce_spec::{NumericKey, SpecFile};

/// Scatter of a key about its value.
#[derive(Debug, Clone)]
pub struct Tolerance {
    /// The key.
    pub key: NumericKey,
    /// Half the width of a uniform distribution, or the standard deviation of a normal one, SI.
    pub width: f64,
    /// True for a normal distribution.
    pub normal: bool,
}

impl Tolerance {
    /// Reads `"0.05 mm"`, uniform between both sides, or `"0.05 mm normal"`, a standard deviation.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub fn read(file: &SpecFile, path: &str, text: &str) -> Result<Self, Vec<String>> {
        let key = file.numeric_key(path).map_err(|faults| messages(&faults))?;
        let (width, normal) = match text.trim().strip_suffix("normal") {
            Some(width) => (width.trim(), true),
            None => (text.trim(), false),
        };
        let wrong = |reason: &str| vec![format!("{path}: {text:?} is no tolerance; {reason}")];
        let width = key.read(width).map_err(|reason| wrong(&reason))?;
        if !(width > 0.0 && width.is_finite()) {
            return Err(wrong(
                "it must be above 0, as in \"0.05 mm\" or \"0.05 mm normal\"",
            ));
        }
        Ok(Self { key, width, normal })
    }

    /// Returns the standard deviation, SI.
    pub fn standard_deviation(&self) -> f64 {
        match self.normal {
            true => self.width,
            false => self.width / 3.0_f64.sqrt(),
        }
    }

    /// Returns the deviation for a place in (0, 1).
    pub fn deviation(&self, place: f64) -> f64 {
        match self.normal {
            true => self.width * normal_quantile(place),
            false => self.width * (2.0 * place - 1.0),
        }
    }
}

/// Returns the quantile of the standard normal distribution, by bisection of its distribution
/// function.
fn normal_quantile(place: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        // Phi(x) = erfc(-x / sqrt 2) / 2
        if 0.5 * libm::erfc(-middle / std::f64::consts::SQRT_2) < place {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        for (place, quantile) in [(0.5, 0.0), (0.975, 1.959_963_985), (0.001, -3.090_232_306)] {
            assert!((normal_quantile(place) - quantile).abs() < 1e-8);
        }
    }
}
