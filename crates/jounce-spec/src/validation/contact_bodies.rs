//! The bodies of a contact are complete, touch at a point, and go with Hertz's exponent.

use super::ValidationFaults;
use super::geometry::metres;
use crate::hertz::HERTZ_EXPONENT;
use crate::{BodyShape, ContactBodies, ContactBody, Spec, Stop, StopLaw};

/// Largest ratio of the two relative curvatures: beyond it the bodies touch along a line.
const MAX_CURVATURE_RATIO: f64 = 1e8;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, stop) in &spec.stop {
        let Some(bodies) = &stop.bodies else { continue };
        let mut fault = |key: &str, text: String| {
            faults.push(|| format!("stop.{name}.{key}"), || text);
        };
        if bodies.striking.radius_m.is_none() {
            without_radius(bodies, &mut fault);
            continue;
        }
        check_exponent(stop, &mut fault);
        if has_zero_radius(bodies, &mut fault) {
            continue;
        }
        for (prefix, body) in [("", &bodies.striking), ("stop_", &bodies.stop)] {
            check_material(prefix, body, &mut fault);
        }
        if bodies.stop.radius_m.is_none() {
            without_stop_radius(bodies, &mut fault);
        } else {
            check_curvatures(bodies, &mut fault);
        }
    }
}

/// Reports keys of the bodies next to `stiffness`.
fn without_radius(bodies: &ContactBodies, fault: &mut impl FnMut(&str, String)) {
    let keys = [("", &bodies.striking), ("stop_", &bodies.stop)].map(|(prefix, body)| {
        let given = [
            ("radius", body.radius_m.is_some()),
            ("shape", body.shape != BodyShape::default()),
            ("material", !body.material.is_empty()),
            (
                "youngs_modulus",
                body.youngs_modulus_pa.is_some() && body.material.is_empty(),
            ),
            (
                "poisson_ratio",
                body.poisson_ratio.is_some() && body.material.is_empty(),
            ),
        ];
        let given = given.into_iter().filter(|(_, is_given)| *is_given);
        given
            .map(|(key, _)| format!("{prefix}{key}"))
            .collect::<Vec<_>>()
    });
    let angle = bodies
        .crossing_angle_rad
        .map(|_| "crossing_angle".to_owned());
    for key in keys.into_iter().flatten().chain(angle) {
        fault(
            &key,
            "is given without `radius`, which takes the place of `stiffness`; give `radius` or omit this key".to_owned(),
        );
    }
}

/// Reports radii of zero: a curvature without bound.
fn has_zero_radius(bodies: &ContactBodies, fault: &mut impl FnMut(&str, String)) -> bool {
    let radii = [
        ("cross_radius", bodies.striking.cross_radius_m),
        ("stop_radius", bodies.stop.radius_m),
        ("stop_cross_radius", bodies.stop.cross_radius_m),
    ];
    let zero = radii.iter().filter(|(_, radius_m)| *radius_m == Some(0.0));
    zero.map(|(key, _)| {
        fault(
            key,
            "is 0; give a radius other than 0, or omit it for a flat body".to_owned(),
        )
    })
    .count()
        > 0
}

fn check_exponent(stop: &Stop, fault: &mut impl FnMut(&str, String)) {
    if let StopLaw::Hertz { exponent, .. } | StopLaw::HuntCrossley { exponent, .. } = stop.law
        && exponent != HERTZ_EXPONENT
        && !exponent.is_nan()
    {
        fault(
            "exponent",
            format!(
                "is {exponent}, but two smooth bodies have {HERTZ_EXPONENT}; omit it, or give `stiffness` instead of `radius`"
            ),
        );
    }
}

fn check_material(prefix: &str, body: &ContactBody, fault: &mut impl FnMut(&str, String)) {
    let missing = match (body.youngs_modulus_pa, body.poisson_ratio) {
        (Some(_), Some(_)) => return,
        (None, None) => "material",
        (None, Some(_)) => "youngs_modulus",
        (Some(_), None) => "poisson_ratio",
    };
    fault(
        &format!("{prefix}{missing}"),
        format!(
            "is missing; with `radius` both bodies need a material: give `{prefix}material`, or `{prefix}youngs_modulus` and `{prefix}poisson_ratio`"
        ),
    );
}

/// Reports keys of the shape of a flat body.
fn without_stop_radius(bodies: &ContactBodies, fault: &mut impl FnMut(&str, String)) {
    let flat = "has no effect on a flat body; give `stop_radius` or omit this key";
    if bodies.stop.shape != BodyShape::default() {
        fault("stop_shape", flat.to_owned());
    }
    if bodies.crossing_angle_rad.is_some() {
        fault("crossing_angle", flat.to_owned());
    }
    check_curvatures(bodies, fault);
}

/// Refuses bodies that touch along a line, or at more than one point.
fn check_curvatures(bodies: &ContactBodies, fault: &mut impl FnMut(&str, String)) {
    let [least, most] = bodies.curvatures_per_m();
    let is_open = most <= 0.0 || least < -most / MAX_CURVATURE_RATIO;
    let is_line = most > MAX_CURVATURE_RATIO * least;
    let (radius_m, stop_m) = (bodies.striking.radius_m, bodies.stop.radius_m);
    let spheres = [&bodies.striking, &bodies.stop].map(|body| body.shape == BodyShape::Sphere);
    match stop_m {
        Some(stop_m) if is_open && spheres == [true; 2] => {
            let radius = radius_m.map_or_else(String::new, metres);
            fault(
                "stop_radius",
                format!("is {}: a concave seat must have a larger radius than the body in it, of {radius}; the bodies would touch at a rim", metres(stop_m)),
            );
        }
        _ if is_open => fault(
            "radius",
            "is too large for the other radii: the gap closes away from the contact; a concave body must be flatter than the body in it".to_owned(),
        ),
        _ if is_line => fault(
            if stop_m.is_some() { "stop_shape" } else { "shape" },
            "is that of a contact along a line, which has no power law; cross the cylinders (`crossing_angle`), crown one of them (`ellipsoid`), or give `stiffness` and `exponent` instead of `radius`".to_owned(),
        ),
        _ => {}
    }
}
