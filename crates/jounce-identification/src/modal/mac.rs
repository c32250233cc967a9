//! Modal assurance criterion.

use jounce_linalg::c64;

use super::Mode;

/// Computes `|a^H b|^2 / (a^H a  b^H b)`: 1 for equal shapes at any scale and phase, 0 for
/// orthogonal ones; NaN where a shape is zero.
pub fn mac(a: &[c64], b: &[c64]) -> f64 {
    let product: c64 = a.iter().zip(b).map(|(a, b)| a.conj() * b).sum();
    let squared_norm = |shape: &[c64]| shape.iter().map(|x| x.norm_sqr()).sum::<f64>();
    product.norm_sqr() / (squared_norm(a) * squared_norm(b))
}

/// Computes the MAC between all shapes, from their residues. For several references all residues
/// are used: the product of the criterion over the responses and that over the references.
pub fn mac_matrix(modes: &[Mode]) -> Vec<Vec<f64>> {
    let row = |a: &Mode| {
        modes
            .iter()
            .map(|b| mac(&a.residue, &b.residue) * mac(&a.participation, &b.participation))
            .collect()
    };
    modes.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_compared_at_any_scale_and_phase() {
        let a = [c64::new(1.0, 0.0), c64::new(2.0, 1.0)];
        let rotated: Vec<c64> = a.iter().map(|x| x * c64::new(0.3, -4.0)).collect();
        assert!((mac(&a, &rotated) - 1.0).abs() < 1e-15);
        assert!(
            mac(
                &[c64::new(1.0, 0.0), c64::new(0.0, 0.0)],
                &[c64::new(0.0, 0.0), c64::new(0.0, 2.0)]
            ) < 1e-30
        );
    }
}
