//! `[damping]`, `[reduction]` and `[run]`

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::{Damping, Quantity, Reduction, Run, Start};

impl Keyed for Damping {
    const KEYS: &'static [Key<Self>] = DAMPING;

    fn blank() -> Self {
        Self::default()
    }
}

static DAMPING: &[Key<Damping>] = &[
    Key::with_slot(
        "ratios",
        Kind::Numbers,
        "damping ratios, one per flexible mode, ascending",
        Slot::Numbers {
            get: |d: &Damping| &d.ratios,
            open: |d| &mut d.ratios,
        },
    )
    .within(Range::from(0.0, 10.0))
    .optional(),
    Key::with_slot(
        "beyond",
        Kind::Number,
        "damping ratio of every flexible mode that `ratios` does not list: of all of them without `ratios`",
        Slot::Optional {
            get: |d: &Damping| d.beyond,
            set: |d, x| d.beyond = Some(x),
        },
    )
    .within(Range::from(0.0, 10.0))
    .optional(),
];

impl Keyed for Reduction {
    const KEYS: &'static [Key<Self>] = REDUCTION;

    fn blank() -> Self {
        Self::default()
    }
}

static REDUCTION: &[Key<Reduction>] = &[
    Key::with_slot(
        "modes",
        Kind::Count,
        "number of retained modes",
        Slot::Count {
            get: |r: &Reduction| r.modes,
            set: |r, x| r.modes = x,
        },
    )
    .within(Range::from(1.0, Reduction::MAX_MODES as f64))
    .optional(),
    Key::number(
        "mesh_tolerance",
        "required relative error of every retained frequency; those of plates are refined to 1e-4 at most",
        |r: &Reduction| r.mesh_tolerance,
        |r, x| r.mesh_tolerance = x,
    )
    .within(Range::from(1e-12, 0.1))
    .optional(),
];

impl Keyed for Run {
    const KEYS: &'static [Key<Self>] = RUN;

    fn blank() -> Self {
        Self::default()
    }
}

static RUN: &[Key<Run>] = &[
    Key::text(
        "start",
        Kind::ChoiceOrPath(&["rest", "linear"]),
        "`\"rest\"`, `\"linear\"` (the steady state without the stops), or the path of a state file relative to the spec",
        |r: &Run| match &r.start {
            Start::Rest => "rest".to_owned(),
            Start::Linear => "linear".to_owned(),
            Start::State(path) => path.clone(),
        },
        |r, x| {
            r.start = match x {
                "rest" => Start::Rest,
                "linear" => Start::Linear,
                path => Start::State(path.to_owned()),
            };
        },
    )
    .optional(),
    Key::quantity("duration", Quantity::Time, "duration of the run", |r: &Run| r.duration_s, |r, x| r.duration_s = x)
        .within(Range::POSITIVE)
        .optional(),
    Key::quantity(
        "average_over",
        Quantity::Time,
        "length of the averaging window at the end of the run",
        |r: &Run| r.average_over_s,
        |r, x| r.average_over_s = x,
    )
    .within(Range::POSITIVE)
    .optional(),
    Key::number("tolerance", "required relative error of the response", |r: &Run| r.tolerance, |r, x| r.tolerance = x)
        .within(Range::from(1e-13, 0.1))
        .optional(),
];
