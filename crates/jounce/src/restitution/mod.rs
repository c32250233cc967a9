//! Estimate of the coefficient of restitution from the materials of two bodies.

mod options;
mod result;

pub use options::RestitutionOptions;
pub use result::RestitutionResult;

use crate::error::Error;
use jounce_model::contact::PlasticCollision;
use jounce_spec::hertz;
use jounce_spec::material::{CONTACT, Material, named};

/// Estimates the coefficient of restitution of a ball on a stop, with its scatter.
///
/// The yield strength of the softer body is known within the range of its tempers, and two theories
/// bound the pressure in the contact: Thornton's takes it to remain at the yield limit, Johnson's takes
/// it as fully plastic. The range from the lower theory with the lowest strength to the higher theory
/// with the highest strength is the estimate.
///
/// # Errors
/// [`Error::Option`].
///
/// # Limits
/// Hardening, the rate of strain, roughness, waves and bending of the bodies are not included.
///
/// ```
/// use jounce::RestitutionOptions;
/// let options = RestitutionOptions {
///     material: "steel".into(),
///     stop_material: "brass".into(),
///     radius_m: Some(5e-3),
///     mass_kg: Some(4e-3),
///     speed_m_s: Some(5.0),
///     ..Default::default()
/// };
/// let [low, high] = jounce::restitution(&options)?.restitution;
/// assert!(0.0 < low && low < high && high < 1.0);
/// # Ok::<(), jounce::Error>(())
/// ```
pub fn restitution(options: &RestitutionOptions) -> Result<RestitutionResult, Error> {
    let bodies = [
        contact_material("material", &options.material),
        contact_material("stop_material", &options.stop_material),
    ];
    let (bodies, checked) = match (bodies, options.checked()) {
        ([Ok(ball), Ok(stop)], Ok(checked)) => ([ball, stop], checked),
        (bodies, checked) => {
            let errors = bodies.into_iter().filter_map(Result::err);
            return Err(Error::of_options(
                errors.chain(checked.err().unwrap_or_default()).collect(),
            ));
        }
    };
    let strengths = match options.yield_strength_pa {
        Some(strength_pa) => [strength_pa; 2],
        None => softer_pa(bodies),
    };
    let elasticity = |material: &Material| {
        let ratio = material.poisson_ratio.unwrap_or(f64::NAN);
        (material.youngs_modulus_pa, ratio)
    };
    let modulus_pa = hertz::effective_modulus_pa(bodies.map(elasticity));
    let collision = |yield_strength_pa| PlasticCollision {
        mass_kg: checked.mass_kg,
        radius_m: checked.radius_m,
        modulus_pa,
        yield_strength_pa,
    };
    let collisions = strengths.map(collision);
    let ranges = collisions.map(|of| of.restitution_range(checked.speed_m_s));
    let [soft, hard] = ranges;
    Ok(RestitutionResult {
        restitution: [soft[0], hard[1]],
        perfectly_plastic: ranges.map(|of| of[0]),
        fully_plastic: ranges.map(|of| of[1]),
        yield_speed_m_s: collisions.map(|of| of.yield_speed_m_s()),
        yield_strength_pa: strengths,
        effective_modulus_pa: modulus_pa,
        effective_radius_m: checked.radius_m,
        effective_mass_kg: checked.mass_kg,
        speed_m_s: checked.speed_m_s,
        sources: sources(bodies, options.yield_strength_pa.is_none()),
    })
}

/// Sources of the theories, and of the strengths where these are those of the library.
fn sources(bodies: [&Material; 2], with_materials: bool) -> Vec<String> {
    let mut sources = vec![
        "K. L. Johnson, Contact Mechanics (1985), equations (11.43) and (11.47)".to_owned(),
        "C. Thornton, J. Appl. Mech. 64 (1997) 383, equation (23)".to_owned(),
    ];
    let mut names: Vec<&Material> = Vec::new();
    for material in bodies {
        if with_materials && !names.contains(&material) {
            names.push(material);
            sources.push(format!("{}: {}", material.name, material.source));
        }
    }
    sources
}

/// Returns the range of the yield strength of the body that yields first, Pa.
fn softer_pa(bodies: [&Material; 2]) -> [f64; 2] {
    let end = |index: usize| {
        let strengths = bodies.iter().filter_map(|of| of.yield_strength_pa);
        strengths
            .map(|range| range[index])
            .fold(f64::INFINITY, f64::min)
    };
    [end(0), end(1)]
}

fn contact_material(option: &'static str, name: &str) -> Result<&'static Material, Error> {
    let found = named(name).filter(|_| CONTACT.contains(&name));
    found.ok_or_else(|| {
        let expected = format!("it must be one of {}", CONTACT.join(", "));
        Error::option(option, format!("{name:?}"), expected)
    })
}
