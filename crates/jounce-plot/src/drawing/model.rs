//! Content of a drawing: plain lengths and texts.

/// A harvester.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Title.
    pub title: String,
    /// Bodies; places refer to them by index.
    pub bodies: Vec<DrawnBody>,
    /// Contacts.
    pub contacts: Vec<DrawnContact>,
    /// Drives.
    pub drives: Vec<DrawnDrive>,
    /// Text at the arrow of gravity, which points up if the flag is set.
    pub gravity: Option<(String, bool)>,
    /// Circuits.
    pub circuits: Vec<DrawnCircuit>,
    /// Plates, each in a plan view.
    pub plans: Vec<DrawnPlan>,
}

/// A body.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnBody {
    /// Name and description, line by line.
    pub words: Vec<String>,
    /// Shape.
    pub shape: DrawnShape,
    /// Support.
    pub seat: Seat,
}

/// Shape of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnShape {
    /// A beam, to scale.
    Beam(DrawnBeam),
    /// A rigid mass, a symbol.
    Block,
    /// A free mass, a symbol.
    Ball,
    /// A symbol: a structure given by its modes, or a plate, which has a plan view.
    Given,
}

/// Support of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seat {
    /// Clamped to the ground.
    Ground,
    /// Fixed to another body.
    On(DrawnPlace),
    /// On a spring, on the ground or on another body.
    Spring(Option<DrawnPlace>),
    /// No support.
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
    /// Width, m.
    pub width_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// Passive layers, under the patches.
    pub layers: Vec<DrawnPatch>,
    /// Patches.
    pub patches: Vec<DrawnPatch>,
    /// Named places: name and distance from the root, m.
    pub points: Vec<(String, f64)>,
}

/// A patch or a layer on a face of a beam.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPatch {
    /// Name.
    pub label: String,
    /// Distance of its start from the root, m.
    pub start_m: f64,
    /// Length, m.
    pub length_m: f64,
    /// Width, m.
    pub width_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// True on the upper face, false on the lower one.
    pub top: bool,
}

/// A stop and the two places of its contact.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnContact {
    /// Name.
    pub label: String,
    /// Striking place.
    pub at: DrawnPlace,
    /// Struck place; `None` for the ground.
    pub on: Option<DrawnPlace>,
    /// True if the struck place is above.
    pub above: bool,
    /// Gap, m; negative for a preload at rest.
    pub gap_m: f64,
    /// Law and its numbers.
    pub law: String,
}

/// A drive.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnDrive {
    /// Text at its arrow.
    pub words: String,
    /// Place of a force; `None` for motions of a base.
    pub at: Option<DrawnPlace>,
    /// Moving base; `None` for a force.
    pub base: Option<String>,
    /// Bodies on the moving base.
    pub carried_bodies: Vec<usize>,
    /// Contacts whose stop stands directly on the moving base.
    pub stops: Vec<usize>,
}

/// A circuit: elements between two wires, from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnCircuit {
    /// Name.
    pub label: String,
    /// Elements.
    pub elements: Vec<DrawnElement>,
}

/// An element of a circuit.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnElement {
    /// Patches in series, one above the other; `true` for reversed polarity.
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
    /// A block between both wires, with text in it.
    Block(Vec<String>),
}

/// A plate in a plan view; `x` to the right, `y` up.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPlan {
    /// Name and material.
    pub label: String,
    /// Length along x, m.
    pub length_m: f64,
    /// Width along y, m.
    pub width_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
    /// Supports of the left, right, front and back edge.
    pub edges: [DrawnEdge; 4],
    /// Passive layers.
    pub layers: Vec<DrawnRectangle>,
    /// Patches.
    pub patches: Vec<DrawnRectangle>,
    /// Named points, with what stands or acts there.
    pub points: Vec<DrawnPoint>,
}

/// Support of an edge of a plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnEdge {
    /// Clamped.
    Clamped,
    /// Simply supported.
    SimplySupported,
    /// Free.
    Free,
}

/// A patch or a layer on a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnRectangle {
    /// Name.
    pub label: String,
    /// Start and end along x, m.
    pub x_m: [f64; 2],
    /// Start and end along y, m.
    pub y_m: [f64; 2],
    /// True on the upper face, false on the lower one.
    pub top: bool,
}

/// A point of a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// Name, and the masses, stops and drives there.
    pub label: String,
    /// Distance from the left edge, m.
    pub x_m: f64,
    /// Distance from the front edge, m.
    pub y_m: f64,
}
