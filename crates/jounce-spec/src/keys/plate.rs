//! `[plate.NAME]`

use std::collections::BTreeMap;

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::material;
use crate::{Edge, Plate, PlatePoint, Quantity};

/// Allowed values of Poisson's ratio.
pub(super) const POISSON: Range = Range::from(0.0, 0.5);

const EDGES: &[&str] = &["clamped", "simply-supported", "free"];

impl Keyed for Plate {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            material: String::new(),
            length_m: f64::NAN,
            width_m: f64::NAN,
            thickness_m: f64::NAN,
            youngs_modulus_pa: f64::NAN,
            poisson_ratio: f64::NAN,
            density_kg_m3: f64::NAN,
            on: "ground".to_owned(),
            left: Edge::default(),
            right: Edge::default(),
            front: Edge::default(),
            back: Edge::default(),
            point: BTreeMap::new(),
        }
    }
}

impl Keyed for PlatePoint {
    const KEYS: &'static [Key<Self>] = POINT_KEYS;

    fn blank() -> Self {
        Self {
            x_m: f64::NAN,
            y_m: f64::NAN,
        }
    }
}

fn word(edge: Edge) -> String {
    match edge {
        Edge::Clamped => "clamped",
        Edge::SimplySupported => "simply-supported",
        Edge::Free => "free",
    }
    .to_owned()
}

fn edge(word: &str) -> Edge {
    match word {
        "clamped" => Edge::Clamped,
        "simply-supported" => Edge::SimplySupported,
        _ => Edge::Free,
    }
}

const fn edge_key(
    name: &'static str,
    doc: &'static str,
    get: fn(&Plate) -> String,
    set: fn(&mut Plate, &str),
) -> Key<Plate> {
    Key::text(name, Kind::Choice(EDGES), doc, get, set).optional()
}

static KEYS: &[Key<Plate>] = &[
    Key::text(
        "material",
        Kind::Choice(material::STRUCTURAL),
        "library material (see `jounce materials`): default modulus, Poisson's ratio and density",
        |p: &Plate| p.material.clone(),
        |p, x| {
            x.clone_into(&mut p.material);
            if let Some(known) = material::named(x) {
                (p.youngs_modulus_pa, p.density_kg_m3) =
                    (known.youngs_modulus_pa, known.density_kg_m3);
                p.poisson_ratio = known.poisson_ratio.unwrap_or(f64::NAN);
            }
        },
    )
    .optional(),
    Key::quantity(
        "length",
        Quantity::Length,
        "length along x, from the left to the right edge",
        |p: &Plate| p.length_m,
        |p, x| p.length_m = x,
    )
    .within(Range::POSITIVE),
    Key::quantity(
        "width",
        Quantity::Length,
        "width along y, from the front to the back edge",
        |p: &Plate| p.width_m,
        |p, x| p.width_m = x,
    )
    .within(Range::POSITIVE),
    Key::quantity(
        "thickness",
        Quantity::Length,
        "thickness",
        |p: &Plate| p.thickness_m,
        |p, x| p.thickness_m = x,
    )
    .within(Range::POSITIVE),
    Key::quantity(
        "youngs_modulus",
        Quantity::Pressure,
        "Young's modulus",
        |p: &Plate| p.youngs_modulus_pa,
        |p, x| p.youngs_modulus_pa = x,
    )
    .within(Range::POSITIVE)
    .unless("material"),
    Key::number(
        "poisson_ratio",
        "Poisson's ratio",
        |p: &Plate| p.poisson_ratio,
        |p, x| p.poisson_ratio = x,
    )
    .within(POISSON)
    .unless("material"),
    Key::quantity(
        "density",
        Quantity::Density,
        "density",
        |p: &Plate| p.density_kg_m3,
        |p, x| p.density_kg_m3 = x,
    )
    .within(Range::POSITIVE)
    .unless("material"),
    Key::text(
        "on",
        Kind::Reference {
            what: "\"ground\" or another base",
        },
        "base that the supported edges follow",
        |p: &Plate| p.on.clone(),
        |p, x| x.clone_into(&mut p.on),
    )
    .optional(),
    edge_key(
        "left",
        "edge at x = 0",
        |p| word(p.left),
        |p, x| p.left = edge(x),
    ),
    edge_key(
        "right",
        "edge at x = length",
        |p| word(p.right),
        |p, x| p.right = edge(x),
    ),
    edge_key(
        "front",
        "edge at y = 0",
        |p| word(p.front),
        |p, x| p.front = edge(x),
    ),
    edge_key(
        "back",
        "edge at y = width",
        |p| word(p.back),
        |p, x| p.back = edge(x),
    ),
    Key::with_slot(
        "point",
        Kind::Things,
        "named points, `[plate.NAME.point.POINT]`",
        Slot::Things {
            get: |p: &Plate| &p.point,
            open: |p| &mut p.point,
        },
    )
    .optional(),
];

static POINT_KEYS: &[Key<PlatePoint>] = &[
    Key::quantity(
        "x",
        Quantity::Length,
        "distance from the left edge",
        |p: &PlatePoint| p.x_m,
        |p, x| p.x_m = x,
    )
    .within(Range::NOT_NEGATIVE),
    Key::quantity(
        "y",
        Quantity::Length,
        "distance from the front edge",
        |p: &PlatePoint| p.y_m,
        |p, x| p.y_m = x,
    )
    .within(Range::NOT_NEGATIVE),
];
