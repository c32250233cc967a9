//! `[stop.NAME]`

use super::contact_bodies as bodies;
use super::stop_law::{
    blank_law, damping, exponent, law_word, set_cubic_stiffness, set_damping, set_exponent,
    set_stiffness, stiffness,
};
use crate::hertz::HERTZ_EXPONENT;
use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::material;
use crate::{ForceTable, Quantity, Side, Stop, StopLaw};

const LAWS: &[&str] = &[
    "hertz",
    "spring",
    "kelvin-voigt",
    "hunt-crossley",
    "cubic",
    "table",
    "rigid",
];
const POWER_LAWS: &[&str] = &["hertz", "hunt-crossley"];
/// Of a power law, the stiffness or the bodies from which it follows.
const STIFFNESS: &[&str] = &["stiffness", "radius"];
/// Penetrations of a table, or the file that has them and the forces.
const PENETRATION: &[&str] = &["penetration_m", "penetration", "file"];
/// Forces of a table, or the file.
const FORCE: &[&str] = &["force_n", "force", "file"];
const LINEAR_LAWS: &[&str] = &["spring", "kelvin-voigt"];

impl Keyed for Stop {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            at: String::new(),
            frame: "ground".to_owned(),
            side: Side::default(),
            gap_m: f64::NAN,
            law: StopLaw::Hertz {
                stiffness: f64::NAN,
                exponent: HERTZ_EXPONENT,
            },
            bodies: None,
            table: ForceTable::default(),
        }
    }
}

static KEYS: &[Key<Stop>] = &[
    Key::text(
        "at",
        Kind::Reference { what: "a point or mass" },
        "point that strikes the stop",
        |s: &Stop| s.at.clone(),
        |s, x| x.clone_into(&mut s.at),
    ),
    Key::text(
        "frame",
        Kind::Reference { what: "a point or mass, or \"ground\" or another base" },
        "support of the stop, which takes the reaction: `\"ground\"` or another base, a mass or a point",
        |s: &Stop| s.frame.clone(),
        |s, x| x.clone_into(&mut s.frame),
    )
    .optional(),
    Key::text(
        "side",
        Kind::Choice(&["positive", "negative"]),
        "direction in which the point moves to strike",
        |s: &Stop| if s.side == Side::Positive { "positive" } else { "negative" }.to_owned(),
        |s, x| s.side = if x == "positive" { Side::Positive } else { Side::Negative },
    )
    .optional(),
    Key::quantity(
        "gap",
        Quantity::Length,
        "distance to the stop in the undeformed position; negative for a preloaded contact; for `cubic` the position at which the spring is relaxed",
        |s: &Stop| s.gap_m,
        |s, x| s.gap_m = x,
    ),
    Key::text("law", Kind::Choice(LAWS), "contact law", |s: &Stop| law_word(&s.law).to_owned(), |s, x| s.law = blank_law(x)),
    Key::number("exponent", "exponent of the penetration", |s: &Stop| exponent(&s.law), |s, x| set_exponent(&mut s.law, x))
        .within(Range::from(1.0, 10.0))
        .when("law", POWER_LAWS)
        .optional(),
    Key::with_slot(
        "stiffness",
        Kind::Quantity(Quantity::ContactStiffness { exponent: HERTZ_EXPONENT }),
        "contact stiffness: force over penetration to the power of `exponent`",
        Slot::Optional { get: |s: &Stop| s.bodies.is_none().then(|| stiffness(&s.law)), set: |s, x| set_stiffness(&mut s.law, x) },
    )
    .within(Range::POSITIVE)
    .when("law", POWER_LAWS)
    .one_of(STIFFNESS)
    .measured_by("exponent", |s: &Stop| Some(Quantity::ContactStiffness { exponent: exponent(&s.law) })),
    Key::quantity(
        "stiffness",
        Quantity::Stiffness,
        "contact stiffness: force over penetration",
        |s: &Stop| stiffness(&s.law),
        |s, x| set_stiffness(&mut s.law, x),
    )
    .within(Range::POSITIVE)
    .when("law", LINEAR_LAWS),
    Key::quantity(
        "stiffness",
        Quantity::Stiffness,
        "linear stiffness on both sides; negative for a spring that pushes away from its relaxed position",
        // A blank stop has another law, so this value is the default.
        |s: &Stop| if let StopLaw::Cubic { stiffness_n_m, .. } = s.law { stiffness_n_m } else { 0.0 },
        |s, x| set_stiffness(&mut s.law, x),
    )
    .when("law", &["cubic"])
    .optional(),
    Key::quantity(
        "cubic_stiffness",
        Quantity::ContactStiffness { exponent: 3.0 },
        "cubic stiffness on both sides: force over displacement cubed; negative for a softening spring",
        |s: &Stop| if let StopLaw::Cubic { cubic_stiffness_n_m3, .. } = s.law { cubic_stiffness_n_m3 } else { f64::NAN },
        |s, x| set_cubic_stiffness(&mut s.law, x),
    )
    .when("law", &["cubic"]),
    Key::quantity(
        "damping",
        Quantity::Damping,
        "contact damping: force over penetration rate",
        |s: &Stop| damping(&s.law),
        |s, x| set_damping(&mut s.law, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["kelvin-voigt"]),
    Key::quantity(
        "damping",
        Quantity::InverseSpeed,
        "damping factor c of `1 + c * rate of penetration`",
        |s: &Stop| damping(&s.law),
        |s, x| set_damping(&mut s.law, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["hunt-crossley"]),
    Key::quantity(
        "damping",
        Quantity::InverseSpeed,
        "damping factor c of `1 + c * rate of penetration`",
        // A blank stop has another law, so this value is the default.
        |s: &Stop| if let StopLaw::Table { damping_s_m } = s.law { damping_s_m } else { 0.0 },
        |s, x| set_damping(&mut s.law, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["table"])
    .optional(),
    Key::with_slot(
        "penetration_m",
        Kind::Numbers,
        "penetrations of the measured points in m, ascending; the force is 0 at 0",
        Slot::Numbers { get: |s: &Stop| &s.table.penetration_m, open: |s| &mut s.table.penetration_m },
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["table"])
    .one_of(PENETRATION),
    Key::with_slot(
        "penetration",
        Kind::Quantities(Quantity::Length),
        "penetrations of the measured points with units, in place of `penetration_m`",
        Slot::DerivedNumbers { of: "penetration_m", get: |s: &Stop| &s.table.penetration_m, open: |s| &mut s.table.penetration_m },
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["table"])
    .one_of(PENETRATION),
    Key::with_slot(
        "force_n",
        Kind::Numbers,
        "forces at the measured points in N, one for each penetration; between them a monotone cubic curve, past the last one its slope",
        Slot::Numbers { get: |s: &Stop| &s.table.force_n, open: |s| &mut s.table.force_n },
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["table"])
    .one_of(FORCE),
    Key::with_slot(
        "force",
        Kind::Quantities(Quantity::Force),
        "forces at the measured points with units, in place of `force_n`",
        Slot::DerivedNumbers { of: "force_n", get: |s: &Stop| &s.table.force_n, open: |s| &mut s.table.force_n },
    )
    .within(Range::NOT_NEGATIVE)
    .when("law", &["table"])
    .one_of(FORCE),
    Key::text(
        "file",
        Kind::Path,
        "measured points in a file that `jounce read` accepts, one column in a unit of length and one in a unit of force; path relative to the spec",
        |s: &Stop| s.table.file.clone(),
        |s, x| x.clone_into(&mut s.table.file),
    )
    .when("law", &["table"])
    .one_of(PENETRATION),
    Key::number(
        "restitution",
        "coefficient of restitution: speed after the impact over speed before it",
        |s: &Stop| if let StopLaw::Rigid { restitution } = s.law { restitution } else { f64::NAN },
        |s, x| s.law = StopLaw::Rigid { restitution: x },
    )
    .within(Range::from(0.0, 1.0))
    .when("law", &["rigid"]),
    Key::with_slot(
        "radius",
        Kind::Quantity(Quantity::Length),
        "radius of curvature of the convex body that strikes or is struck: the stiffness follows from both bodies by Hertz's theory",
        Slot::Optional { get: |s: &Stop| bodies::striking(s)?.radius_m, set: |s, x| bodies::set(s, |b| b.striking.radius_m = Some(x)) },
    )
    .within(Range::POSITIVE)
    .when("law", POWER_LAWS)
    .one_of(STIFFNESS),
    Key::text(
        "shape",
        Kind::Choice(bodies::SHAPES),
        "shape of the body of `radius` at the contact: a cylinder is straight across the plane of its radius, an ellipsoid has a second radius there; a sphere if omitted",
        |s: &Stop| bodies::shape_word(bodies::striking(s)),
        |s, x| bodies::set(s, |b| b.striking.shape = bodies::shape_of(x)),
    )
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "cross_radius",
        Kind::Quantity(Quantity::Length),
        "radius of curvature of the body of `radius` in the plane perpendicular to that of `radius`; negative for a concave body",
        Slot::Optional { get: |s: &Stop| bodies::striking(s)?.cross_radius_m, set: |s, x| bodies::set(s, |b| b.striking.cross_radius_m = Some(x)) },
    )
    .when("shape", &["ellipsoid"]),
    Key::text(
        "material",
        Kind::Choice(material::CONTACT),
        "library material of the body of `radius` (see `jounce materials`): default modulus and Poisson's ratio",
        |s: &Stop| bodies::striking(s).map_or_else(String::new, |b| b.material.clone()),
        |s, x| bodies::set(s, |b| bodies::fill(&mut b.striking, x)),
    )
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "youngs_modulus",
        Kind::Quantity(Quantity::Pressure),
        "Young's modulus of the body of `radius`",
        Slot::Optional { get: |s: &Stop| bodies::striking(s)?.youngs_modulus_pa, set: |s, x| bodies::set(s, |b| b.striking.youngs_modulus_pa = Some(x)) },
    )
    .within(Range::POSITIVE)
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "poisson_ratio",
        Kind::Number,
        "Poisson's ratio of the body of `radius`",
        Slot::Optional { get: |s: &Stop| bodies::striking(s)?.poisson_ratio, set: |s, x| bodies::set(s, |b| b.striking.poisson_ratio = Some(x)) },
    )
    .within(Range::above(-1.0, 0.5))
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "stop_radius",
        Kind::Quantity(Quantity::Length),
        "radius of curvature of the other body: negative for a concave seat; if omitted, the body is flat",
        Slot::Optional { get: |s: &Stop| bodies::struck(s)?.radius_m, set: |s, x| bodies::set(s, |b| b.stop.radius_m = Some(x)) },
    )
    .when("law", POWER_LAWS)
    .optional(),
    Key::text(
        "stop_shape",
        Kind::Choice(bodies::SHAPES),
        "shape of the other body at the contact: a cylinder is straight across the plane of its radius, an ellipsoid has a second radius there; a sphere if omitted",
        |s: &Stop| bodies::shape_word(bodies::struck(s)),
        |s, x| bodies::set(s, |b| b.stop.shape = bodies::shape_of(x)),
    )
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "stop_cross_radius",
        Kind::Quantity(Quantity::Length),
        "radius of curvature of the other body in the plane perpendicular to that of `stop_radius`; negative for a concave body",
        Slot::Optional { get: |s: &Stop| bodies::struck(s)?.cross_radius_m, set: |s, x| bodies::set(s, |b| b.stop.cross_radius_m = Some(x)) },
    )
    .when("stop_shape", &["ellipsoid"]),
    Key::text(
        "stop_material",
        Kind::Choice(material::CONTACT),
        "library material of the other body (see `jounce materials`): default modulus and Poisson's ratio",
        |s: &Stop| bodies::struck(s).map_or_else(String::new, |b| b.material.clone()),
        |s, x| bodies::set(s, |b| bodies::fill(&mut b.stop, x)),
    )
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "stop_youngs_modulus",
        Kind::Quantity(Quantity::Pressure),
        "Young's modulus of the other body",
        Slot::Optional { get: |s: &Stop| bodies::struck(s)?.youngs_modulus_pa, set: |s, x| bodies::set(s, |b| b.stop.youngs_modulus_pa = Some(x)) },
    )
    .within(Range::POSITIVE)
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "stop_poisson_ratio",
        Kind::Number,
        "Poisson's ratio of the other body",
        Slot::Optional { get: |s: &Stop| bodies::struck(s)?.poisson_ratio, set: |s, x| bodies::set(s, |b| b.stop.poisson_ratio = Some(x)) },
    )
    .within(Range::above(-1.0, 0.5))
    .when("law", POWER_LAWS)
    .optional(),
    Key::with_slot(
        "crossing_angle",
        Kind::Quantity(Quantity::Angle),
        "angle between the plane of `radius` and that of `stop_radius`; 0 if omitted",
        Slot::Optional { get: |s: &Stop| s.bodies.as_ref()?.crossing_angle_rad, set: |s, x| bodies::set(s, |b| b.crossing_angle_rad = Some(x)) },
    )
    .when("law", POWER_LAWS)
    .optional(),
];
