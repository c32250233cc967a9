//! `[source]`

use crate::Source;
use crate::key::{Key, Kind, Slot};

pub(super) static KEYS: &[Key<Source>] = &[Key::with_slot(
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
