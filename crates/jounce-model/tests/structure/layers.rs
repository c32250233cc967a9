//! Passive layers: a two-layer cantilever in closed form, a layer as part of its beam, errors.

use crate::paper::{frequency_hz, paper_beam, paper_patch};
use jounce_model::structure::section::{CrossSection, outer_lever_m, patch_moment_n_m_per_v};
use jounce_model::structure::{Modes, modes};
use jounce_spec::{Beam, Damping, Face, Layer, Patch, Reduction, Section, Spec};

const LENGTH_M: f64 = 0.315;

fn layer(face: Face, thickness_m: f64, youngs_modulus_pa: f64, density_kg_m3: f64) -> Layer {
    Layer {
        on: "beam".into(),
        face,
        material: String::new(),
        start_m: 0.0,
        length_m: LENGTH_M,
        width_m: 0.03,
        thickness_m,
        youngs_modulus_pa,
        density_kg_m3,
        section: Section::Laminate,
        on_plate: Default::default(),
    }
}

fn spec(beam: Beam, layers: &[(&str, Layer)], patches: &[(&str, Patch)]) -> Spec {
    let mut spec = Spec {
        beam: [("beam".to_owned(), beam)].into(),
        ..Spec::default()
    };
    spec.layer = layers
        .iter()
        .map(|(name, layer)| ((*name).to_owned(), layer.clone()))
        .collect();
    spec.patch = patches
        .iter()
        .map(|(name, patch)| ((*name).to_owned(), patch.clone()))
        .collect();
    spec.damping = Damping {
        ratios: Vec::new(),
        beyond: Some(0.01),
    };
    spec.reduction = Reduction {
        modes: 4,
        ..Reduction::default()
    };
    spec
}

fn beam_modes(spec: &Spec) -> Modes {
    modes(spec).unwrap()
}

fn relative(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

/// `EI = b (E1^2 t1^4 + 4 E1 E2 t1^3 t2 + 6 E1 E2 t1^2 t2^2 + 4 E1 E2 t1 t2^3 + E2^2 t2^4) / (12 (E1 t1 + E2 t2))`
/// (S. Timoshenko, J. Opt. Soc. Am. 11 (1925) 233), on either face; first frequency
/// `1.8751040687^2 / (2 pi L^2) sqrt(EI / m)`.
#[test]
fn a_layer_over_the_full_beam_makes_a_bimetal() {
    let beam = paper_beam("ground");
    for (thickness_m, modulus_pa, density) in [
        (0.2e-3, 70e9, 2200.0),
        (1.5e-3, 3e9, 1200.0),
        (0.98e-3, 200e9, 7800.0),
    ] {
        let (b, e1, t1, e2, t2): (f64, f64, f64, f64, f64) =
            (0.03, 65e9, 0.98e-3, modulus_pa, thickness_m);
        let powers = e1 * e1 * t1.powi(4)
            + e2 * e2 * t2.powi(4)
            + e1 * e2 * t1 * t2 * (4.0 * t1 * t1 + 6.0 * t1 * t2 + 4.0 * t2 * t2);
        let stiffness = b * powers / (12.0 * (e1 * t1 + e2 * t2));
        let mass = b * (2750.0 * t1 + density * t2);
        let exact_hz = 1.875_104_068_7_f64.powi(2) / (std::f64::consts::TAU * LENGTH_M.powi(2))
            * (stiffness / mass).sqrt();
        for face in [Face::Top, Face::Bottom] {
            let coat = layer(face, thickness_m, modulus_pa, density);
            let section = CrossSection::laminated(&beam, [&coat].into_iter(), std::iter::empty());
            assert!(
                relative(section.bending_stiffness_n_m2, stiffness) < 1e-13,
                "{:e}",
                relative(section.bending_stiffness_n_m2, stiffness)
            );
            let modal = beam_modes(&spec(beam.clone(), &[("coat", coat)], &[]));
            assert!(
                relative(frequency_hz(&modal)[0], exact_hz) < 1e-10,
                "{:e}",
                relative(frequency_hz(&modal)[0], exact_hz)
            );
        }
    }
}

/// Layers of the beam's material on both faces are equivalent to a thicker beam, also with a patch
/// on one of them: frequencies, coupling, strain. Measured: identical bits.
#[test]
fn layers_of_the_beams_material_thicken_it() {
    let beam = paper_beam("ground");
    let patch = paper_patch(Section::Laminate);
    let [top, bottom] = [Face::Top, Face::Bottom].map(|face| layer(face, 0.25e-3, 65e9, 2750.0));
    let thick = Beam {
        thickness_m: beam.thickness_m + 0.5e-3,
        ..beam.clone()
    };
    let with_coat = beam_modes(&spec(
        beam,
        &[("a", top), ("b", bottom)],
        &[("mfc", patch.clone())],
    ));
    let plain = beam_modes(&spec(thick, &[], &[("mfc", patch)]));
    let (one, other) = (&with_coat.patch["mfc"], &plain.patch["mfc"]);
    let pairs = (with_coat.frequency_rad_s.iter().zip(&plain.frequency_rad_s))
        .chain(one.coupling_n_per_v.iter().zip(&other.coupling_n_per_v));
    let strains = (0..4).map(|mode| {
        let unit: Vec<f64> = (0..4).map(|k| f64::from(k == mode)).collect();
        [one, other].map(|patch| patch.strain[0].at(&unit))
    });
    let worst = pairs
        .map(|(one, other)| [*one, *other])
        .chain(strains)
        .map(|[one, other]| relative(one.abs(), other.abs()))
        .fold(0.0, f64::max);
    eprintln!("{worst:.1e}");
    assert!(worst < 1e-11, "{worst:e}");
}

/// A bond line between beam and patch: forces and moments of three layers in equilibrium, solved
/// for strain and curvature without a neutral axis. Measured: 1.3e-15.
#[test]
fn a_bond_line_lifts_its_patch() {
    let (beam, patch) = (paper_beam("ground"), paper_patch(Section::Laminate));
    let bond = Layer {
        start_m: 0.0,
        length_m: 0.2,
        ..layer(Face::Top, 0.1e-3, 2.5e9, 1150.0)
    };
    let section = CrossSection::laminated(&beam, [&bond].into_iter(), [&patch].into_iter());
    let plies = [
        (65e9, 0.0, 0.98e-3),
        (2.5e9, 0.98e-3, 1.08e-3),
        (30.336e9, 1.08e-3, 1.38e-3),
    ];
    let integral = |power: i32| {
        plies
            .iter()
            .map(|(e, low, high): &(f64, f64, f64)| {
                e * 0.03 * (high.powi(power) - low.powi(power)) / f64::from(power)
            })
            .sum::<f64>()
    };
    let (a, s, d) = (integral(1), integral(2), integral(3));
    // Free strain e of the patch: a e0 + s k = N, s e0 + d k = M, with N and M those of the blocked
    // patch.
    let free = -170e-12 / 0.3e-3 * 30.336e9 * 0.03;
    let (n, m) = (
        free * 0.3e-3,
        free * (1.38e-3_f64.powi(2) - 1.08e-3_f64.powi(2)) / 2.0,
    );
    let curvature = (a * m - s * n) / (a * d - s * s);
    let moment = patch_moment_n_m_per_v(&beam, &section, &patch);
    eprintln!(
        "{:e}",
        relative(moment / section.bending_stiffness_n_m2, curvature)
    );
    assert!(relative(moment / section.bending_stiffness_n_m2, curvature) < 1e-12);
    assert!(relative(section.bending_stiffness_n_m2, d - s * s / a) < 1e-12);
    assert!(relative(outer_lever_m(&beam, &section, &patch), 1.38e-3 - s / a) < 1e-12);
}

/// A thin skin: stiffness at the surface of the beam, no mass.
#[test]
fn a_thin_skin_stiffens_without_weight() {
    let beam = paper_beam("ground");
    let skin = Layer {
        section: Section::ThinSkin,
        ..layer(Face::Bottom, 0.1e-3, 70e9, 0.0)
    };
    let section = CrossSection::laminated(&beam, [&skin].into_iter(), std::iter::empty());
    let bare = CrossSection::bare(&beam);
    let exact = 1.0 + 3.0 * (70e9 * 0.1e-3) / (65e9 * 0.98e-3);
    assert!(
        relative(
            section.bending_stiffness_n_m2 / bare.bending_stiffness_n_m2,
            exact
        ) < 1e-13
    );
    assert_eq!(section.mass_per_length_kg_m, bare.mass_per_length_kg_m);
}

#[test]
fn layers_that_do_not_fit_are_refused() {
    let (beam, patch) = (paper_beam("ground"), paper_patch(Section::Laminate));
    let coat = layer(Face::Top, 0.1e-3, 70e9, 2200.0);
    let part = Layer {
        length_m: 0.05,
        ..coat.clone()
    };
    let error = |layers: &[(&str, Layer)]| {
        modes(&spec(beam.clone(), layers, &[("mfc", patch.clone())]))
            .unwrap_err()
            .to_string()
    };
    let under = error(&[("bond", part.clone())]);
    assert!(
        under.contains("layer.bond covers 0 m to 0.05 m, under a part of patch.mfc"),
        "{under}"
    );
    let twice = error(&[("a", coat.clone()), ("b", part)]);
    assert!(
        twice.contains("layer.a") && twice.contains("layer.b") && twice.contains("nor must layers"),
        "{twice}"
    );
    let skin = error(&[(
        "a",
        Layer {
            section: Section::ThinSkin,
            ..coat.clone()
        },
    )]);
    assert!(
        skin.contains("layer.a and patch.mfc cover the same part of the beam"),
        "{skin}"
    );
    let long = error(&[(
        "a",
        Layer {
            length_m: 0.4,
            ..coat.clone()
        },
    )]);
    assert!(long.contains("layer.a covers 0 m to 0.4 m"), "{long}");
    let elsewhere = error(&[(
        "a",
        Layer {
            on: "bean".into(),
            ..coat
        },
    )]);
    assert!(elsewhere.contains("layer.a.on is \"bean\""), "{elsewhere}");
}
