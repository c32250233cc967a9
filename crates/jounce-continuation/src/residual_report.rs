//! Parts of a residual that does not converge.

use std::fmt;

/// Number of parts in a message.
const REPORTED_PARTS: usize = 3;

/// Sizes of the parts of a residual; empty where a problem does not name them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResidualReport {
    /// Unit of the sizes.
    pub unit: &'static str,
    /// Name and size of each part.
    pub sizes: Vec<(String, f64)>,
}

impl fmt::Display for ResidualReport {
    /// Writes the largest parts, as the end of a sentence.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut largest: Vec<&(String, f64)> =
            self.sizes.iter().filter(|(_, size)| *size > 0.0).collect();
        largest.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        for (k, (name, size)) in largest.into_iter().take(REPORTED_PARTS).enumerate() {
            write!(
                f,
                "{}{name} {size:.1e} {}",
                if k == 0 {
                    "; what is left of the equations is largest in "
                } else {
                    ", "
                },
                self.unit
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_parts_come_first() {
        let sizes = [0.1, 3.0, 0.0, 2.0, 1.0]
            .iter()
            .enumerate()
            .map(|(k, size)| (format!("harmonic {k}"), *size))
            .collect();
        let printed = ResidualReport { unit: "m", sizes }.to_string();
        assert_eq!(
            printed,
            "; what is left of the equations is largest in harmonic 1 3.0e0 m, harmonic 3 2.0e0 m, harmonic 4 1.0e0 m"
        );
        assert_eq!(ResidualReport::default().to_string(), "");
    }
}
