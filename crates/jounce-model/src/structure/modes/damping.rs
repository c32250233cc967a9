//! Damping ratios of the modes of assembled structures.
//!
//! The ratio of a mass belongs to the mode in which the mass has the greatest share of the kinetic
//! energy, `m shape(mass)^2` of a mass-normalised mode, among all modes of its structure, retained
//! or not. The other modes take `damping.ratios` in ascending order, then `damping.beyond`. A
//! rigid-body mode has ratio 0 and uses no entry.

use crate::structure::error::StructureError;
use jounce_spec::Damping;

/// The mode (index among the retained modes) that belongs to a mass, and the damping ratio of the
/// mass.
pub(in crate::structure) type MassMode = (usize, f64);

/// Returns the damping ratio of each mode, and the number of the last entries of `damping.ratios` that
/// no mode takes.
///
/// # Errors
/// `MissingDamping` if the list is too short and `beyond` is not set.
pub(in crate::structure) fn damping_ratios(
    frequency_rad_s: &[f64],
    of_masses: &[MassMode],
    damping: &Damping,
) -> Result<(Vec<f64>, usize), StructureError> {
    let mass_ratio = |mode: usize| {
        of_masses
            .iter()
            .find(|(index, _)| *index == mode)
            .map(|(_, ratio)| *ratio)
    };
    let is_flexible = |mode: usize| frequency_rad_s[mode] > 0.0 && mass_ratio(mode).is_none();
    let flexible = (0..frequency_rad_s.len())
        .filter(|mode| is_flexible(*mode))
        .count();
    let mut remaining = damping
        .ratios
        .iter()
        .copied()
        .chain(std::iter::repeat_n(damping.beyond, flexible).flatten());
    let mut ratio = |mode: usize| match (frequency_rad_s[mode] > 0.0, mass_ratio(mode)) {
        (false, _) => Some(0.0),
        (true, Some(ratio)) => Some(ratio),
        (true, None) => remaining.next(),
    };
    let ratios: Option<Vec<f64>> = (0..frequency_rad_s.len()).map(&mut ratio).collect();
    let given = damping.ratios.len();
    let ratios = ratios.ok_or(StructureError::MissingDamping { flexible, given })?;
    Ok((ratios, given.saturating_sub(flexible)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn masses_and_rigid_bodies_leave_the_list_to_the_others() {
        let damping = Damping {
            ratios: vec![0.01, 0.02],
            beyond: Some(0.03),
        };
        let frequencies = [0.0, 1.0, 2.0, 3.0, 4.0];
        let (ratios, unused) = damping_ratios(&frequencies, &[(2, 0.5)], &damping).unwrap();
        assert_eq!(
            (&ratios[..], unused),
            (&[0.0, 0.01, 0.5, 0.02, 0.03][..], 0)
        );
        let (ratios, unused) = damping_ratios(&frequencies[..3], &[(2, 0.5)], &damping).unwrap();
        assert_eq!((&ratios[..], unused), (&[0.0, 0.01, 0.5][..], 1));
    }

    #[test]
    fn missing_ratios_are_counted() {
        let damping = Damping {
            ratios: vec![0.01],
            beyond: None,
        };
        let error = damping_ratios(&[1.0, 2.0, 3.0, 4.0], &[(0, 0.3)], &damping).unwrap_err();
        assert_eq!(
            error,
            StructureError::MissingDamping {
                flexible: 3,
                given: 1
            }
        );
        assert!(
            error.to_string().contains("add 2 or set damping.beyond"),
            "{error}"
        );
    }
}
