//! Differences between a run of the library and one by brute force, with their bounds.

use super::independent::{Run, chatter_m_s, contact_shift_s, distance, energy_coordinates};
use super::library::LibraryRun;
use super::system::Drawn;
use super::verdict::Bounds;

/// Residual of the energy balance of brute force, relative to the largest energy.
const OWN_BALANCE: f64 = 1e-9;

/// Differences of one harvester.
#[derive(Default)]
pub struct Differences {
    /// Largest ratio of a difference to its bound.
    pub ratio: f64,
    /// Residual of the energy balance, in tolerances of the largest energy.
    pub residual: f64,
    /// Largest relative difference of the time in contact.
    pub duration: f64,
    /// Number of times in contact among the messages.
    durations: usize,
    /// True where nothing but times in contact differ.
    pub is_duration_only: bool,
    /// Differences above their bounds.
    pub messages: Vec<String>,
}

/// State of a run at its end.
pub fn last(run: &Run) -> &[f64] {
    run.strobe.last().map_or(&[], Vec::as_slice)
}

impl Differences {
    /// Compares contacts, state and energies.
    pub fn of(drawn: &Drawn, own: &Run, library: &LibraryRun, bounds: &Bounds) -> Self {
        let mut differences = Self::default();
        if library.result.energies.scale_j == 0.0 {
            return differences;
        }
        for p in 0..drawn.merged.stops.len() {
            differences.contacts(drawn, (own, library), bounds, p);
        }
        let end = energy_coordinates(&drawn.merged, &library.end);
        let state = distance(last(own), &end) / own.size;
        differences.check("state", state, bounds.state);
        differences.energies(own, library, bounds);
        differences.is_duration_only = differences.durations == differences.messages.len();
        differences
    }

    fn check(&mut self, name: &str, difference: f64, bound: f64) {
        self.ratio = self.ratio.max(difference / bound);
        if difference > bound || difference.is_nan() {
            self.messages
                .push(format!("{name}: {difference:.3e} above {bound:.3e}"));
        }
    }

    fn contacts(
        &mut self,
        drawn: &Drawn,
        (own, library): (&Run, &LibraryRun),
        bounds: &Bounds,
        p: usize,
    ) {
        let stop = &drawn.merged.stops[p];
        let (ours, theirs) = (&own.contacts[p], &library.contacts[p]);
        let counts = format!("{} and {} contacts", ours.len(), theirs.len());
        let shift_s = contact_shift_s(ours, theirs, chatter_m_s(&stop.law, ours));
        self.check(
            &format!("{counts} of {}", stop.name),
            shift_s,
            bounds.shift_s,
        );
        let result = &library.result.stops[p];
        if let Some(own_s) = own.contact_s[p] {
            let cycle_s = drawn.merged.drives[0].frequency_hz.recip();
            let their_s = result.contact_duty * drawn.cycles as f64 * cycle_s;
            let name = format!("time {own_s:e} in {counts} of {}", stop.name);
            let bound_s = (1 + ours.len()) as f64 * bounds.shift_s;
            let difference_s = (own_s - their_s).abs();
            if own_s > 0.0 {
                self.duration = self.duration.max(difference_s / own_s);
            }
            let others = self.messages.len();
            self.check(&name, difference_s, bound_s);
            self.durations += self.messages.len() - others;
        }
        // A contact of the start may be among the reported ones.
        let reported = result.contacts as usize;
        if !(theirs.len()..=theirs.len() + 1).contains(&reported) {
            self.messages
                .push(format!("{reported} of {counts} of {} reported", stop.name));
        }
    }

    fn energies(&mut self, own: &Run, library: &LibraryRun, bounds: &Bounds) {
        let energies = &library.result.energies;
        let scale_j = energies.scale_j;
        let own_residual = own.energies.residual_j().abs() / scale_j;
        let own_bound = OWN_BALANCE.max(bounds.energy);
        self.check("balance of brute force", own_residual, own_bound);
        if !library.result.is_trivial() {
            let residual = energies.residual_relative().abs();
            self.residual = residual / bounds.tolerance;
            self.check("residual", residual, bounds.energy);
        }
        let theirs = [
            energies.input_j,
            energies.loads_j.iter().sum(),
            energies.leaks_j.iter().sum(),
            energies.damping_j,
            energies.contact_loss_j,
            energies.stored_j,
        ];
        for ((name, ours), theirs) in own.energies.list().into_iter().zip(theirs) {
            self.check(name, (ours - theirs).abs() / scale_j, bounds.energy);
        }
    }
}
