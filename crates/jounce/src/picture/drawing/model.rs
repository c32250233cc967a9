//! What is drawn: plain lengths and words.

/// A harvester.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Title above it.
    pub title: String,
    /// Its bodies; places name them by their index.
    pub bodies: Vec<DrawnBody>,
    /// What strikes what.
    pub contacts: Vec<DrawnContact>,
    /// What shakes it.
    pub drives: Vec<DrawnDrive>,
    /// Words at the arrow of gravity, which points up where the flag is set.
    pub gravity: Option<(String, bool)>,
    /// What its patches are connected to.
    pub circuits: Vec<DrawnCircuit>,
}

/// A body.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnBody {
    /// Its name and what is said about it, line by line.
    pub words: Vec<String>,
    /// What it looks like.
    pub shape: DrawnShape,
    /// What it stands on.
    pub seat: Seat,
}

/// The look of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnShape {
    /// A beam, to scale.
    Beam(DrawnBeam),
    /// A rigid mass, a symbol.
    Block,
    /// A free mass, a symbol.
    Ball,
    /// Something without a shape, given by its modes.
    Given,
}

/// What a body stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seat {
    /// Clamped to the ground.
    Ground,
    /// Fixed to another body.
    On(DrawnPlace),
    /// On a spring, on the ground or on another body.
    Spring(Option<DrawnPlace>),
    /// On nothing.
    Nothing,
}

/// A place on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawnPlace {
    /// Index of the body.
    pub body: usize,
    /// Distance from the root of a beam, m; 0 on anything else.
    pub along_m: f64,
}

/// A beam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnBeam {
    /// Length, m.
    pub length_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// Its passive layers, under what patches lie there.
    pub layers: Vec<DrawnPatch>,
    /// Its patches.
    pub patches: Vec<DrawnPatch>,
    /// Named places: name and distance from the root, m.
    pub points: Vec<(String, f64)>,
}

/// A patch or a layer on a face of a beam.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPatch {
    /// Its name.
    pub label: String,
    /// Distance of its start from the root, m.
    pub start_m: f64,
    /// Length, m.
    pub length_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// On the upper face, or on the lower one.
    pub top: bool,
}

/// A stop: what strikes, and what it strikes.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnContact {
    /// Its name.
    pub label: String,
    /// What strikes.
    pub at: DrawnPlace,
    /// What is struck; nothing for the ground.
    pub on: Option<DrawnPlace>,
    /// What is struck stands above.
    pub above: bool,
    /// Gap, m; negative where it is pressed in at rest.
    pub gap_m: f64,
    /// The law and its numbers.
    pub law: String,
}

/// A drive.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnDrive {
    /// Words at its arrow.
    pub words: String,
    /// Where a force acts; nothing for motions of a base.
    pub at: Option<DrawnPlace>,
    /// The base that moves; nothing for a force.
    pub base: Option<String>,
    /// The bodies on the base that moves.
    pub carried: Vec<usize>,
    /// The contacts whose stop stands on that base itself.
    pub stops: Vec<usize>,
}

/// A circuit: elements between two wires, from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnCircuit {
    /// Its name.
    pub label: String,
    /// Its elements.
    pub elements: Vec<DrawnElement>,
}

/// An element of a circuit.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnElement {
    /// Patches one above the other in series; `true` where connected the other way round.
    Patches(Vec<(String, bool)>),
    /// A capacitor.
    Capacitor(Vec<String>),
    /// A battery.
    Battery(Vec<String>),
    /// A resistor.
    Resistor(Vec<String>),
    /// An inductor.
    Inductor(Vec<String>),
    /// An inductor in the upper wire.
    SeriesInductor(Vec<String>),
    /// A block that both wires pass through, with words in it.
    Block(Vec<String>),
}
