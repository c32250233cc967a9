//! The library's account of a cloud: all that is used of its analysis of basins.

use jounce::analysis::{
    Attractor, AttractorKind, BasinFraction, Basins, InitialStates, Model, Parameter, Recognition,
    wilson,
};
use jounce::spec::SpecFile;

/// What the library says of the starts that end on one attractor.
#[derive(Debug, Clone)]
pub struct Account {
    pub id: String,
    pub kind: AccountKind,
    pub mean_power_w: f64,
    /// States at the starts of drive cycles, energy coordinates; none without an orbit.
    pub strobe: Vec<Vec<f64>>,
    pub share: BasinFraction,
    pub starts: Vec<usize>,
}

/// Kind of what a start is counted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AccountKind {
    /// A periodic orbit of some drive cycles.
    Periodic(usize),
    Torus,
    Chaos,
    Undecided,
}

/// The accounts of all starts; a start that none lists is undecided. `key` is any numeric key of the spec.
pub fn accounts(file: &SpecFile, (key, value): (&str, f64), starts: InitialStates) -> Vec<Account> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(key).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let answer = Basins {
        base: &base,
        parameter: &parameter,
        value,
        starts,
        recognition: Recognition::at(1e-8),
    }
    .run(&|| ())
    .unwrap();
    answer.attractors.iter().map(account).collect()
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
        // The last state is the first again.
        strobe: attractor.orbit.as_ref().map_or(Vec::new(), |orbit| {
            orbit.strobe_states[..orbit.period_cycles as usize].to_vec()
        }),
        share: attractor.share,
        starts: attractor.starts.clone(),
    }
}

/// The interval of an attractor that none of some starts has reached.
pub fn unseen(of: usize) -> [f64; 2] {
    let share = wilson(0, of);
    [share.low, share.high]
}
