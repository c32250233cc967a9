//! Labels of quantities and elements.

use jounce_spec::{
    Beam, ContactBodies, ContactBody, Drive, DriveKind, DriveSignal, ForceTable, GROUND, Gravity,
    Mass, Modal, NO_SUPPORT, Quantity, Spec, Stop, StopLaw,
};
use std::f64::consts::TAU;

/// Formats a value in its unit with at most five digits; large numbers have an exponent.
pub fn value(quantity: Quantity, value: f64) -> String {
    let text = quantity.write_rounded(value, 5);
    let (number, unit) = text.split_once(' ').unwrap_or((&text, ""));
    let long = number
        .parse::<f64>()
        .ok()
        .filter(|number| number.abs() >= 1e5);
    let number = long.map_or_else(|| number.to_owned(), |number| format!("{number:e}"));
    let unit = unit
        .strip_prefix('u')
        .map_or_else(|| unit.to_owned(), |unit| format!("µ{unit}"));
    format!(
        "{number} {}",
        unit.replace("ohm", "Ω")
            .replace("^2", "²")
            .replace("^3", "³")
    )
}

/// Returns the label of a beam: name and material.
pub fn beam(name: &str, beam: &Beam) -> Vec<String> {
    vec![if beam.material.is_empty() {
        name.to_owned()
    } else {
        format!("{name}, {}", beam.material)
    }]
}

/// Adds the base of a body to its label, if it is not the ground.
pub fn on_base(spec: &Spec, mut words: Vec<String>, support: &str) -> Vec<String> {
    words.extend((support != GROUND && spec.is_base(support)).then(|| format!("on {support}")));
    words
}

/// Returns the label of a structure given by its modes.
pub fn modal(name: &str, modal: &Modal) -> Vec<String> {
    let first = modal
        .frequency_hz
        .first()
        .map(|first| value(Quantity::Frequency, *first));
    let modes = match (modal.frequency_hz.len(), first) {
        (1, Some(first)) => format!("one mode, {first}"),
        (count, Some(first)) => format!("{count} modes from {first}"),
        (_, None) => "no modes".to_owned(),
    };
    vec![name.to_owned(), modes]
}

/// Returns the label of gravity, and true where it points up.
pub fn gravity(gravity: &Gravity) -> Option<(String, bool)> {
    let along = gravity.acceleration_m_s2.filter(|along| *along != 0.0)?;
    Some((
        format!("gravity {}", value(Quantity::Acceleration, along.abs())),
        along > 0.0,
    ))
}

/// Returns the label of a contact law with its numbers; a stiffness that follows from two bodies
/// has their radius and materials after it.
pub fn law(stop: &Stop) -> String {
    let stiffness =
        |stiffness: f64, exponent: f64| value(Quantity::ContactStiffness { exponent }, stiffness);
    let text = match stop.law {
        StopLaw::Hertz {
            stiffness: k,
            exponent,
        } => format!("hertz, {}", stiffness(k, exponent)),
        StopLaw::Spring { stiffness_n_m } => {
            format!("spring, {}", value(Quantity::Stiffness, stiffness_n_m))
        }
        StopLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        } => {
            format!(
                "kelvin-voigt, {}, {}",
                value(Quantity::Stiffness, stiffness_n_m),
                value(Quantity::Damping, damping_n_s_m)
            )
        }
        StopLaw::HuntCrossley {
            stiffness: k,
            exponent,
            damping_s_m,
        } => {
            format!(
                "hunt-crossley, {}, {}",
                stiffness(k, exponent),
                value(Quantity::InverseSpeed, damping_s_m)
            )
        }
        StopLaw::Cubic {
            stiffness_n_m,
            cubic_stiffness_n_m3,
        } => {
            format!(
                "cubic, {}, {}",
                value(Quantity::Stiffness, stiffness_n_m),
                stiffness(cubic_stiffness_n_m3, 3.0)
            )
        }
        StopLaw::Table { damping_s_m } => table(&stop.table, damping_s_m),
        StopLaw::Rigid { restitution } => format!("rigid, restitution {restitution}"),
    };
    stop.bodies.as_ref().map_or_else(
        || text.clone(),
        |bodies| format!("{text}: {}", pair(bodies)),
    )
}

/// Returns the label of a measured contact: its points and the last one.
fn table(table: &ForceTable, damping_s_m: f64) -> String {
    let mut text = format!("table, {} points", table.force_n.len());
    if let (Some(at_m), Some(force_n)) = (table.penetration_m.last(), table.force_n.last()) {
        let force = value(Quantity::Force, *force_n);
        text += &format!(", {force} at {}", value(Quantity::Length, *at_m));
    }
    if damping_s_m > 0.0 {
        text += &format!(", {}", value(Quantity::InverseSpeed, damping_s_m));
    }
    text
}

/// Returns the two bodies of a contact: `steel R 5 mm on brass`.
fn pair(bodies: &ContactBodies) -> String {
    let body = |body: &ContactBody| {
        let material = match body.youngs_modulus_pa {
            _ if !body.material.is_empty() => body.material.clone(),
            Some(modulus_pa) => value(Quantity::Pressure, modulus_pa),
            None => String::new(),
        };
        body.radius_m.map_or_else(
            || material.clone(),
            |radius_m| format!("{material} R {}", value(Quantity::Length, radius_m)),
        )
    };
    format!("{} on {}", body(&bodies.striking), body(&bodies.stop))
}

/// Returns the label of a mass and its spring.
pub fn mass(name: &str, mass: &Mass) -> Vec<String> {
    let mass_text = value(Quantity::Mass, mass.mass_kg);
    let support_text = match mass.stiffness_n_m {
        Some(stiffness_n_m) => format!(
            ", {}",
            value(
                Quantity::Frequency,
                (stiffness_n_m / mass.mass_kg).sqrt() / TAU
            )
        ),
        None if mass.on == NO_SUPPORT => ", free".to_owned(),
        None => String::new(),
    };
    vec![name.to_owned(), format!("{mass_text}{support_text}")]
}

/// Returns the label of a drive.
pub fn drive(name: &str, drive: &Drive) -> String {
    let unit = match drive.kind {
        DriveKind::Force => Quantity::Force,
        DriveKind::BaseAcceleration => Quantity::Acceleration,
        DriveKind::BaseDisplacement => Quantity::Length,
    };
    let name = drive
        .base()
        .filter(|base| *base != GROUND)
        .map_or_else(|| name.to_owned(), |base| format!("{name} of {base}"));
    let hertz = |frequency_hz: f64| value(Quantity::Frequency, frequency_hz);
    let time = |time_s: f64| value(Quantity::Time, time_s);
    match drive.signal {
        DriveSignal::Sine {
            amplitude,
            frequency_hz,
            ..
        } => format!(
            "{name}: {} peak, {}",
            value(unit, amplitude),
            hertz(frequency_hz)
        ),
        DriveSignal::Chirp {
            amplitude,
            from_hz,
            to_hz,
            ..
        } => {
            format!(
                "{name}: {} peak, {} to {}",
                value(unit, amplitude),
                hertz(from_hz),
                hertz(to_hz)
            )
        }
        DriveSignal::HalfSine {
            amplitude,
            duration_s,
            ..
        } => format!(
            "{name}: {} peak, {}",
            value(unit, amplitude),
            time(duration_s)
        ),
        DriveSignal::VelocityStep { velocity_m_s, .. } => {
            format!("{name}: step of {}", value(Quantity::Speed, velocity_m_s))
        }
        DriveSignal::Noise {
            low_hz, high_hz, ..
        } => format!("{name}: noise, {} to {}", hertz(low_hz), hertz(high_hz)),
        DriveSignal::Recording { ref file, .. } => format!("{name}: {file}"),
    }
}
