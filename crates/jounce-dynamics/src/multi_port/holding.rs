//! Forces that hold points on rigid stops at an instant.

use crate::error::IntegrationError;
use crate::integrator::Integrator;
use crate::ports::state::ContactState;
use jounce_linalg::Mat;

/// Remaining mobility of a second sticking port, relative to its own, below which both constrain
/// the same motion.
pub(super) const MIN_RELATIVE_MOBILITY: f64 = 1e-10;

impl Integrator<'_> {
    /// Releases sticking ports whose stop would have to pull, starting with the largest pull.
    ///
    /// # Errors
    /// [`IntegrationError::RestsTwice`] where two stops constrain the same motion.
    pub(super) fn release(&mut self) -> Result<(), IntegrationError> {
        loop {
            let resting = self.sticking_ports();
            let forces = self.holding_forces_n(&resting)?;
            let weakest = (0..resting.len()).min_by(|a, b| forces[*a].total_cmp(&forces[*b]));
            match weakest.filter(|index| self.pulls(resting[*index], forces[*index])) {
                // It leaves from rest, whatever the roundoff of its motion.
                Some(index) => {
                    self.set_motion(resting[index], [0.0, 0.0]);
                    self.ports[resting[index]].contact_state = ContactState::Flight;
                }
                None => return Ok(()),
            }
        }
    }

    fn sticking_ports(&self) -> Vec<usize> {
        self.ports_in(ContactState::Contact)
            .filter(|p| self.is_rigid(*p))
            .collect()
    }

    /// True where a holding force would have to pull.
    fn pulls(&self, p: usize, force_n: f64) -> bool {
        !self.presses(p, force_n * self.ports[p].rows.mobility_per_kg)
    }

    /// Returns the acceleration of a port towards its stop under the forces of all other stops,
    /// m/s^2.
    pub(crate) fn pressing_acceleration_m_s2(&self, p: usize) -> f64 {
        let mut resting = self.sticking_ports();
        resting.retain(|q| *q != p);
        // Where two of them constrain the same motion, the next step is refused.
        let held = self.holding_forces_n(&resting).unwrap_or_default();
        let by_held = |(q, force_n): (&usize, f64)| self.mobility_per_kg(p, *q) * force_n;
        self.acceleration_under_forces_m_s2(p, &self.forces_n())
            - resting.iter().zip(held).map(by_held).sum::<f64>()
    }

    /// Returns the acceleration of a port under given contact forces, m/s^2.
    fn acceleration_under_forces_m_s2(&self, p: usize, forces_n: &[f64]) -> f64 {
        self.acceleration_m_s2(p)
            - forces_n
                .iter()
                .enumerate()
                .map(|(q, force_n)| self.mobility_per_kg(p, q) * force_n)
                .sum::<f64>()
    }

    /// Returns the rate of the acceleration of a port by the forces of the compliant stops in
    /// contact, m/s^3; their damping contributes by the acceleration without forces.
    pub(crate) fn jerk_by_stops_m_s3(&self, p: usize) -> f64 {
        self.ports_in(ContactState::Contact)
            .filter(|q| !self.is_rigid(*q))
            .map(|q| {
                let port = &self.ports[q];
                let slopes = self.law(q).slopes(port.penetration_m, port.rate_m_s);
                let rate_n_s = slopes.stiffness_n_m * port.rate_m_s
                    + slopes.damping_n_s_m * self.acceleration_m_s2(q);
                self.mobility_per_kg(p, q) * rate_n_s
            })
            .sum()
    }

    /// Returns the forces that hold sticking ports at the current time, N.
    ///
    /// # Errors
    /// [`IntegrationError::RestsTwice`] where two stops constrain the same motion.
    fn holding_forces_n(&self, resting: &[usize]) -> Result<Vec<f64>, IntegrationError> {
        if resting.is_empty() {
            return Ok(Vec::new());
        }
        let pressed = self.forces_n();
        let count = resting.len();
        let matrix = Mat::from_fn(count, count, |a, b| {
            self.mobility_per_kg(resting[a], resting[b])
        });
        let (inverse, pivots) = jounce_linalg::inverse_fully_pivoted(&matrix);
        if pivots[count - 1] <= MIN_RELATIVE_MOBILITY * pivots[0] {
            let stops = resting
                .iter()
                .map(|p| self.kernel.plant.system.stops[*p].name.clone())
                .collect();
            return Err(IntegrationError::RestsTwice {
                time_s: self.time_s,
                stops,
            });
        }
        let right: Vec<f64> = resting
            .iter()
            .map(|p| self.acceleration_under_forces_m_s2(*p, &pressed))
            .collect();
        Ok((0..count)
            .map(|a| (0..count).map(|b| inverse[(a, b)] * right[b]).sum())
            .collect())
    }
}
