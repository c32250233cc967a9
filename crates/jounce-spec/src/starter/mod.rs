//! Commented starter specs: one per kind of harvester, valid as written, with unit and effect of
//! each key.

use crate::nearest;
use jounce_io::store::{self, StoreError};
use std::path::Path;

/// Starter spec.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Starter {
    /// Name of the kind.
    pub kind: &'static str,
    /// Description in one line.
    pub summary: &'static str,
    /// The spec in TOML, with its comments.
    pub spec: &'static str,
}

/// All starters, the simplest first.
pub const STARTERS: &[Starter] = &[
    Starter {
        kind: "cantilever-with-stop",
        summary: "a piezoelectric cantilever that strikes a stop, shaken at its root",
        spec: include_str!("cantilever-with-stop.toml"),
    },
    Starter {
        kind: "plate-with-stop",
        summary: "a cantilevered plate with a piezoelectric patch that strikes a stop at a corner",
        spec: include_str!("plate-with-stop.toml"),
    },
    Starter {
        kind: "two-beams",
        summary: "two piezoelectric cantilevers that strike each other",
        spec: include_str!("two-beams.toml"),
    },
    Starter {
        kind: "ball",
        summary: "a ball that bounces on a bimorph under gravity",
        spec: include_str!("ball.toml"),
    },
    Starter {
        kind: "bimorph-with-rectifier",
        summary: "a bimorph with a tip mass that charges a capacitor through a bridge of diodes",
        spec: include_str!("bimorph-with-rectifier.toml"),
    },
    Starter {
        kind: "random-base",
        summary: "a cantilever between two stops on a randomly excited base",
        spec: include_str!("random-base.toml"),
    },
];

/// Unknown kind of starter.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, serde::Serialize)]
#[error("there is no starter of the kind \"{kind}\"{}; the kinds are {}", suggestion(.nearest), kinds())]
pub struct UnknownKind {
    /// The requested kind.
    pub kind: String,
    /// The nearest known kind.
    pub nearest: Option<&'static str>,
}

impl Starter {
    /// Returns the starter of a kind.
    ///
    /// # Errors
    /// The kind is unknown; the error names the nearest one.
    pub fn of(kind: &str) -> Result<&'static Self, UnknownKind> {
        // A part of a name, such as "bimorph", matches that name.
        let suggestion = || {
            let kinds: Vec<&str> = STARTERS.iter().map(|starter| starter.kind).collect();
            let mut known = kinds.iter().copied();
            nearest(kind, &kinds)
                .or_else(|| known.find(|known| kind.len() > 2 && known.contains(kind)))
        };
        STARTERS
            .iter()
            .find(|starter| starter.kind == kind)
            .ok_or_else(|| UnknownKind {
                kind: kind.to_owned(),
                nearest: suggestion(),
            })
    }

    /// Writes the spec atomically; replaces an existing file only if `replace` is true.
    ///
    /// # Errors
    /// The file exists already, or the path is not writable.
    pub fn write(&self, path: &Path, replace: bool) -> Result<(), StoreError> {
        let content = self.spec.as_bytes();
        if replace {
            store::write(path, content)
        } else {
            store::create(path, content)
        }
    }
}

fn suggestion(nearest: &Option<&str>) -> String {
    nearest
        .map(|kind| format!(" (did you mean \"{kind}\"?)"))
        .unwrap_or_default()
}

fn kinds() -> String {
    STARTERS
        .iter()
        .map(|starter| starter.kind)
        .collect::<Vec<_>>()
        .join(", ")
}
