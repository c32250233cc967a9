//! `[plate.NAME]`

use std::collections::BTreeMap;

/// A uniform rectangular thin plate whose supported edges follow a base.
///
/// `x` runs from the left edge along the length, `y` from the front edge along the width.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    /// `material`: library material with default modulus, Poisson's ratio and density; empty if
    /// omitted.
    pub material: String,
    /// `length`, along x.
    pub length_m: f64,
    /// `width`, along y.
    pub width_m: f64,
    /// `thickness`
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `poisson_ratio`
    pub poisson_ratio: f64,
    /// `density`
    pub density_kg_m3: f64,
    /// `on`: base that carries the supported edges; default `"ground"`.
    pub on: String,
    /// `left`: edge at x = 0; default free, as every edge.
    pub left: Edge,
    /// `right`: edge at x = length.
    pub right: Edge,
    /// `front`: edge at y = 0.
    pub front: Edge,
    /// `back`: edge at y = width.
    pub back: Edge,
    /// `[plate.NAME.point.POINT]`
    pub point: BTreeMap<String, PlatePoint>,
}

/// Support of an edge of a plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edge {
    /// `"clamped"`: neither displacement nor rotation.
    Clamped,
    /// `"simply-supported"`: no displacement, free rotation.
    SimplySupported,
    /// `"free"`
    #[default]
    Free,
}

/// Named point of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlatePoint {
    /// `x`: distance from the left edge, m.
    pub x_m: f64,
    /// `y`: distance from the front edge, m.
    pub y_m: f64,
}

/// Position across a plate, and Poisson's ratio, of a patch or a layer; not used on a beam.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OnPlate {
    /// `across_start`: distance from the front edge, m; `None`: centred on the width.
    pub across_start_m: Option<f64>,
    /// `poisson_ratio`, in the plane of the plate; `None`: that of the material.
    pub poisson_ratio: Option<f64>,
}

/// Rectangle of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateArea {
    /// Start and end along x, m.
    pub x_m: [f64; 2],
    /// Start and end along y, m.
    pub y_m: [f64; 2],
}

impl Plate {
    /// Returns the edges in the order left, right, front, back.
    pub fn edges(&self) -> [Edge; 4] {
        [self.left, self.right, self.front, self.back]
    }

    /// True if the supports leave no rigid-body motion: a clamped edge, or two simply supported
    /// ones.
    pub fn is_supported(&self) -> bool {
        let count = |kind| self.edges().iter().filter(|edge| **edge == kind).count();
        count(Edge::Clamped) > 0 || count(Edge::SimplySupported) > 1
    }

    /// Returns the area of a patch or a layer of this length and width, m.
    pub fn area(&self, start_m: f64, length_m: f64, width_m: f64, on: &OnPlate) -> PlateArea {
        let front_m = on.across_start_m.unwrap_or((self.width_m - width_m) / 2.0);
        PlateArea {
            x_m: [start_m, start_m + length_m],
            y_m: [front_m, front_m + width_m],
        }
    }
}

impl PlateArea {
    /// True if two areas share more than a strip of width `slack_m`.
    pub fn meets(&self, other: &Self, slack_m: f64) -> bool {
        let meets =
            |one: [f64; 2], two: [f64; 2]| one[0] < two[1] - slack_m && two[0] < one[1] - slack_m;
        meets(self.x_m, other.x_m) && meets(self.y_m, other.y_m)
    }

    /// True if another area lies within this one, except for a strip of width `slack_m`.
    pub fn contains(&self, other: &Self, slack_m: f64) -> bool {
        let contains = |outer: [f64; 2], inner: [f64; 2]| {
            inner[0] >= outer[0] - slack_m && inner[1] <= outer[1] + slack_m
        };
        contains(self.x_m, other.x_m) && contains(self.y_m, other.y_m)
    }
}
