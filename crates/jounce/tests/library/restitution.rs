//! Restitution estimated from materials.

use jounce::{Error, RestitutionOptions, restitution};

fn steel_on_brass() -> RestitutionOptions {
    RestitutionOptions {
        material: "steel".to_owned(),
        stop_material: "brass".to_owned(),
        radius_m: Some(5e-3),
        mass_kg: Some(4e-3),
        speed_m_s: Some(5.0),
        ..Default::default()
    }
}

/// By hand, with `1/E* = (1 - 0.29^2)/200 + (1 - 0.35^2)/110` per GPa, so 79.64 GPa, and Johnson's
/// `3.8 (Y/E*)^(1/2) (m v^2 / (2 Y R^3))^(-1/8)` for 75 and 435 MPa: 0.2243 and 0.6730; the strength is
/// that of brass, the softer body, and the ratio is `5.8^(5/8)`.
#[test]
fn steel_on_brass_is_the_estimate_by_hand() -> Result<(), Error> {
    let result = restitution(&steel_on_brass())?;
    assert_eq!(result.yield_strength_pa, [75e6, 435e6]);
    let modulus_gpa = 1.0 / ((1.0 - 0.29_f64.powi(2)) / 200.0 + (1.0 - 0.35_f64.powi(2)) / 110.0);
    assert!((result.effective_modulus_pa / 1e9 / modulus_gpa - 1.0).abs() < 1e-14);
    let by_hand = |strength_mpa: f64| {
        let energy = 0.5 * 4e-3 * 25.0 / (strength_mpa * 1e6 * 1.25e-7);
        3.8 * (strength_mpa / (1e3 * modulus_gpa)).sqrt() / energy.powf(0.125)
    };
    for (found, strength_mpa) in result.fully_plastic.into_iter().zip([75.0, 435.0]) {
        assert!(
            (found / by_hand(strength_mpa) - 1.0).abs() < 1e-12,
            "{found}"
        );
    }
    let ratio = result.fully_plastic[1] / result.fully_plastic[0];
    assert!((ratio / 5.8_f64.powf(0.625) - 1.0).abs() < 1e-12, "{ratio}");
    assert_eq!(
        result.restitution,
        [result.perfectly_plastic[0], result.fully_plastic[1]]
    );
    assert_eq!(result.sources.len(), 4);
    Ok(())
}

/// Two equal balls have half the radius and half the mass of one on a wall; a known strength leaves the
/// difference of the theories.
#[test]
fn both_bodies_and_a_known_strength() -> Result<(), Error> {
    let pair = RestitutionOptions {
        stop_radius_m: Some(5e-3),
        stop_mass_kg: Some(4e-3),
        yield_strength_pa: Some(2e9),
        ..steel_on_brass()
    };
    let result = restitution(&pair)?;
    assert_eq!(result.effective_radius_m, 2.5e-3);
    assert_eq!(result.effective_mass_kg, 2e-3);
    assert_eq!(result.perfectly_plastic[0], result.perfectly_plastic[1]);
    assert_eq!(result.sources.len(), 2);
    let slow = RestitutionOptions {
        speed_m_s: Some(0.5 * result.yield_speed_m_s[0]),
        ..pair
    };
    assert_eq!(restitution(&slow)?.restitution, [1.0; 2]);
    Ok(())
}

#[test]
fn all_faults_are_reported_at_once() {
    let options = RestitutionOptions {
        material: "stel".to_owned(),
        mass_kg: Some(-1.0),
        speed_m_s: None,
        ..steel_on_brass()
    };
    let message = restitution(&options).unwrap_err().to_string();
    let starts = ["material is", "mass is -1 kg", "speed is missing"];
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines.len(), starts.len(), "{message}");
    for (line, start) in lines.iter().zip(starts) {
        assert!(line.starts_with(start), "{message}");
    }
}

#[test]
fn faults_name_the_option() {
    let good = steel_on_brass;
    for (options, expected) in [
        (
            RestitutionOptions::default(),
            "radius is missing; give it, as in 5mm",
        ),
        (
            RestitutionOptions {
                mass_kg: None,
                ..good()
            },
            "mass is missing; give it, as in 4g",
        ),
        (
            RestitutionOptions {
                speed_m_s: Some(0.0),
                ..good()
            },
            "speed is 0 m/s; it must be above 0",
        ),
        (
            RestitutionOptions {
                material: "silicon".to_owned(),
                ..good()
            },
            "material is \"silicon\"; it must be one of aluminium, steel, brass, bronze",
        ),
        (
            RestitutionOptions {
                stop_material: "stel".to_owned(),
                ..good()
            },
            "stop_material is \"stel\"; it must be one of",
        ),
        (
            RestitutionOptions {
                stop_radius_m: Some(-4e-3),
                ..good()
            },
            "stop_radius is -0.004 m; a concave seat must be wider than the ball, 0.005 m",
        ),
        (
            RestitutionOptions {
                yield_strength_pa: Some(-1.0),
                ..good()
            },
            "yield_strength is -1 Pa; it must be above 0",
        ),
    ] {
        let message = match restitution(&options) {
            Ok(result) => format!("{result:?}"),
            Err(error) => error.to_string(),
        };
        assert!(message.contains(expected), "{expected} in {message}");
    }
}
