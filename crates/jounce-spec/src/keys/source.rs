//! `[source]`

use crate::Source;
use crate::key::{Key, Keyed, Kind, Slot};

impl Keyed for Source {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self::default()
    }
}

static KEYS: &[Key<Source>] = &[Key::with_slot(
    "publications",
    Kind::References {
        what: "publications",
    },
    "publications that describe the harvester, by their keys in `jounce cite`",
    Slot::Texts {
        get: |s: &Source| &s.publications,
        open: |s| &mut s.publications,
    },
)
.optional()];
