//! `[gravity]`

use crate::key::{Key, Keyed, Kind, Slot};
use crate::{Gravity, Quantity};

impl Keyed for Gravity {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self::default()
    }
}

static KEYS: &[Key<Gravity>] = &[Key::with_slot(
    "acceleration",
    Kind::Quantity(Quantity::Acceleration),
    "acceleration of gravity along the positive direction of motion; negative if it acts in the opposite direction",
    Slot::Optional {
        get: |g: &Gravity| g.acceleration_m_s2,
        set: |g, x| g.acceleration_m_s2 = Some(x),
    },
)];
