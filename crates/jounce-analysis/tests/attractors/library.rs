//! Results of the library for a cloud: the part of its basin analysis that the comparison uses.

use jounce_analysis::{
    Attractor, AttractorKind, BasinFraction, Basins, InitialStates, Model, Recognition, wilson,
};
use jounce_spec::SpecFile;

/// Result of the library for the starts that end on one attractor.
#[derive(Debug, Clone)]
pub struct Account {
    pub id: String,
    pub kind: AccountKind,
    pub mean_power_w: f64,
    /// States at the starts of drive cycles, energy coordinates; empty without an orbit.
    pub strobe: Vec<Vec<f64>>,
    pub share: BasinFraction,
    pub starts: Vec<usize>,
}

/// Kind of attractor to which a start is assigned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AccountKind {
    /// Periodic orbit with this period in drive cycles.
    Periodic(usize),
    Torus,
    Chaos,
    Undecided,
}

/// Returns the results for all starts; a start in no list is undecided.
pub fn accounts(file: &SpecFile, starts: InitialStates) -> Vec<Account> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let basins = Basins {
        base: &base,
        starts,
        recognition: Recognition::at(1e-8),
    }
    .run()
    .unwrap();
    basins.attractors.iter().map(account).collect()
}

fn account(attractor: &Attractor) -> Account {
    let kind = match attractor.kind {
        AttractorKind::Torus => AccountKind::Torus,
        AttractorKind::Chaos => AccountKind::Chaos,
        AttractorKind::Undecided | AttractorKind::Lost => AccountKind::Undecided,
        AttractorKind::Orbit => AccountKind::Periodic(attractor.period_cycles as usize),
    };
    Account {
        id: attractor.id.clone(),
        kind,
        mean_power_w: attractor.mean_power_w,
        // The last state equals the first.
        strobe: attractor.orbit().map_or(Vec::new(), |orbit| {
            orbit.strobe_states[..orbit.period_cycles as usize].to_vec()
        }),
        share: attractor.share,
        starts: attractor.starts.clone(),
    }
}

/// Confidence interval of an attractor that no start has reached.
pub fn empty_interval(of: usize) -> [f64; 2] {
    let share = wilson(0, of);
    [share.low, share.high]
}
