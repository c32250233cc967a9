//! Fibre composites on plates against closed forms and classical laminate theory; principal strain of
//! a ceramic.

use super::plates::{ceramic, plate, spec};
use jounce_linalg::Mat;
use jounce_model::structure::{Modes, modes};
use jounce_spec::{AcrossFibres, Edge, OnPlate, Patch, PatchFoils, PlatePoint};
use std::f64::consts::PI;

const SIDES_M: [f64; 2] = [0.12, 0.08];
const PLATE_POISSON: f64 = 0.3;
const FOIL_M: f64 = 0.06e-3;
const FOIL_PA: f64 = 2.5e9;
const FOIL_POISSON: f64 = 0.34;
const FOIL_KG_M3: f64 = 1420.0;
const MODULUS_PA: [f64; 2] = [48e9, 16e9];
const POISSON: f64 = 0.31;
const SHEAR_PA: f64 = 5.5e9;
const D33: f64 = 460e-12;
const D32: f64 = -185e-12;
const SPACING_M: f64 = 0.5e-3;
const ACTIVE_M: f64 = 0.18e-3;
const ACTIVE_KG_M3: f64 = 5540.0;

/// Active layer of a fibre composite between foils, with a field along its fibres.
pub fn composite(on: &str, [start_m, length_m]: [f64; 2], width_m: f64) -> Patch {
    Patch {
        thickness_m: ACTIVE_M,
        youngs_modulus_pa: MODULUS_PA[0],
        density_kg_m3: ACTIVE_KG_M3,
        d31_m_per_v: None,
        d33_m_per_v: Some(D33),
        electrode_spacing_m: Some(SPACING_M),
        capacitance_f: Some(7e-9),
        permittivity_f_m: None,
        foils: PatchFoils {
            thickness_m: Some(FOIL_M),
            ..PatchFoils::default()
        },
        on_plate: OnPlate {
            across_start_m: None,
            poisson_ratio: Some(POISSON),
        },
        across: AcrossFibres {
            youngs_modulus_pa: Some(MODULUS_PA[1]),
            shear_modulus_pa: Some(SHEAR_PA),
            d32_m_per_v: Some(D32),
        },
        ..ceramic(on, [start_m, length_m], width_m)
    }
}

/// Inverse of the compliance in the plane, Pa.
fn reduced_pa([along, across]: [f64; 2], poisson: f64, shear: f64) -> Mat<f64> {
    let cross = -poisson / along;
    let compliance = [
        1.0 / along,
        cross,
        0.0,
        cross,
        1.0 / across,
        0.0,
        0.0,
        0.0,
        1.0 / shear,
    ];
    Mat::from_row_slice(3, 3, &compliance)
        .try_inverse()
        .unwrap()
}

fn isotropic_pa(modulus: f64, poisson: f64) -> Mat<f64> {
    reduced_pa([modulus; 2], poisson, modulus / (2.0 * (1.0 + poisson)))
}

/// `D - B A^-1 B` (N m), the moments of the patch per volt (N/V) and the mass per area of a plate
/// that the composite covers on top, with heights from the bottom of the plate.
fn covered_section() -> (Mat<f64>, Mat<f64>, f64) {
    let of_plate = plate(SIDES_M, PLATE_POISSON, [Edge::SimplySupported; 4]);
    let h = of_plate.thickness_m;
    let foil = isotropic_pa(FOIL_PA, FOIL_POISSON);
    let active = reduced_pa(MODULUS_PA, POISSON, SHEAR_PA);
    let plies = [
        (
            isotropic_pa(of_plate.youngs_modulus_pa, PLATE_POISSON),
            [0.0, h],
            of_plate.density_kg_m3,
        ),
        (foil.clone(), [h, h + FOIL_M], FOIL_KG_M3),
        (
            active.clone(),
            [h + FOIL_M, h + FOIL_M + ACTIVE_M],
            ACTIVE_KG_M3,
        ),
        (
            foil,
            [h + FOIL_M + ACTIVE_M, h + 2.0 * FOIL_M + ACTIVE_M],
            FOIL_KG_M3,
        ),
    ];
    let moment = |power: i32| {
        plies
            .iter()
            .fold(Mat::zeros(3, 3), |sum: Mat<f64>, (q, [from, to], _)| {
                sum + q * ((to.powi(power) - from.powi(power)) / f64::from(power))
            })
    };
    let [a, b, d] = [1, 2, 3].map(moment);
    let inverse = a.try_inverse().unwrap();
    let mass = plies
        .iter()
        .map(|(_, [from, to], density)| density * (to - from));
    // Force and moment of the blocked layer, and the force released.
    let field = Mat::from_row_slice(3, 1, &[D33, D32, 0.0]) * (1.0 / SPACING_M);
    let force = active * field * ACTIVE_M;
    let middle_m = h + FOIL_M + ACTIVE_M / 2.0;
    let released = &b * &inverse * &force;
    (
        d - &b * inverse * &b,
        force * middle_m - released,
        mass.sum(),
    )
}

/// Wave numbers `(m pi / a, n pi / b)` with the frequency of the orthotropic plate, ascending.
fn exact_modes(d: &Mat<f64>, mass_kg_m2: f64) -> Vec<([f64; 2], f64)> {
    let [a, b] = SIDES_M;
    let of = |m: usize, n: usize| {
        let [x, y] = [m as f64 * PI / a, n as f64 * PI / b];
        let mixed = 2.0 * (d[(0, 1)] + 2.0 * d[(2, 2)]) * x * x * y * y;
        let stiffness = d[(0, 0)] * x.powi(4) + mixed + d[(1, 1)] * y.powi(4);
        ([x, y], (stiffness / mass_kg_m2).sqrt())
    };
    let mut all: Vec<_> = (1..9).flat_map(|m| (1..9).map(move |n| of(m, n))).collect();
    all.sort_by(|one, other| one.1.total_cmp(&other.1));
    all
}

/// Returns `int sin(k x) dx` over a range.
fn sine(k: f64, [from, to]: [f64; 2]) -> f64 {
    ((k * from).cos() - (k * to).cos()) / k
}

/// Where no low mode has a node; the sign of a coupling is that relative to the shape.
const NEAR_M: [f64; 2] = [0.19 * SIDES_M[0], 0.17 * SIDES_M[1]];

fn supported(patch: Patch) -> Modes {
    let mut of_plate = plate(SIDES_M, PLATE_POISSON, [Edge::SimplySupported; 4]);
    let [x_m, y_m] = NEAR_M;
    of_plate.point = [("near".into(), PlatePoint { x_m, y_m })].into();
    let mut spec = spec(of_plate, 8);
    spec.patch = [("fibres".into(), patch)].into();
    modes(&spec).unwrap()
}

/// Coupling of a mode with the sign that its exact shape has.
fn signed_coupling(modes: &Modes, mode: usize, [x, y]: [f64; 2]) -> f64 {
    let positive = (x * NEAR_M[0]).sin() * (y * NEAR_M[1]).sin();
    modes.patch["fibres"].coupling_n_per_v[mode]
        * (modes.shape["plate.near"][mode] * positive).signum()
}

#[test]
fn a_plate_covered_by_a_composite_has_the_exact_frequencies_and_couplings() {
    let (d, moment, mass_kg_m2) = covered_section();
    let found = supported(composite("plate", [0.0, SIDES_M[0]], SIDES_M[1]));
    let exact = exact_modes(&d, mass_kg_m2);
    let [a, b] = SIDES_M;
    let norm = 2.0 / (mass_kg_m2 * a * b).sqrt();
    for (mode, (wave @ [x, y], frequency)) in exact.iter().take(8).enumerate() {
        let error = found.frequency_rad_s[mode] / frequency - 1.0;
        assert!(error.abs() < 1e-6, "mode {mode}: {error:e}");
        let curvature = moment[(0, 0)] * x * x + moment[(1, 0)] * y * y;
        let coupling = -norm * curvature * sine(*x, [0.0, a]) * sine(*y, [0.0, b]);
        let error = signed_coupling(&found, mode, *wave) - coupling;
        // Modes with an even number of half waves do not couple.
        let scale = (norm * curvature / (x * y)).abs();
        assert!(error.abs() < 1e-6 * scale, "mode {mode}: {error:e}");
    }
    // The two directions differ, so that a wrong axis fails.
    assert!(d[(0, 0)] / d[(1, 1)] > 1.1 && moment[(0, 0)] * moment[(1, 0)] < 0.0);
}

/// `chi_mn = int gamma_x w_xx + gamma_y w_yy dA` of a patch with neither stiffness nor mass.
#[test]
fn a_thin_composite_couples_as_its_closed_form() {
    let (thin, plate_m) = (1e-9, 1e-3);
    let (along, across) = ([0.02, 0.055], [0.01, 0.05]);
    let width_m = across[1] - across[0];
    let mut patch = composite("plate", [along[0], along[1] - along[0]], width_m);
    patch.thickness_m = thin;
    patch.density_kg_m3 = 1e-3;
    patch.foils = PatchFoils::default();
    patch.on_plate.across_start_m = Some(across[0]);
    let found = supported(patch);
    let [e1, e2] = MODULUS_PA;
    let share = 1.0 - POISSON * POISSON * e2 / e1;
    let force = [
        e1 * (D33 + POISSON * e2 / e1 * D32) / share,
        e2 * (D32 + POISSON * D33) / share,
    ];
    let gamma = force.map(|force| force * thin / SPACING_M * plate_m / 2.0);
    let bare = isotropic_pa(70e9, PLATE_POISSON) * (plate_m.powi(3) / 12.0);
    let mass_kg_m2 = 2700.0 * plate_m;
    let norm = 2.0 / (mass_kg_m2 * SIDES_M[0] * SIDES_M[1]).sqrt();
    for (mode, (wave @ [x, y], _)) in exact_modes(&bare, mass_kg_m2).iter().take(8).enumerate() {
        let curvature = gamma[0] * x * x + gamma[1] * y * y;
        let exact = -norm * curvature * sine(*x, along) * sine(*y, across);
        let found = signed_coupling(&found, mode, *wave);
        let error = found / exact - 1.0;
        assert!(error.abs() < 1e-3, "mode {mode}: {found:e} {exact:e}");
    }
}

/// Near the corner of a simply supported plate the curvatures are small against the twist. On a
/// ceramic there the principal strain is largest at its inner corner; along the fibres of a composite
/// the strain is small.
#[test]
fn the_twist_of_a_corner_strains_a_ceramic() {
    let corner_m = [0.004, 0.003];
    let [x, y] = [PI / SIDES_M[0], PI / SIDES_M[1]];
    let norm = 2.0 / (2.7 * SIDES_M[0] * SIDES_M[1]).sqrt();
    let largest = |patch: Patch| {
        let thin = Patch {
            thickness_m: 1e-9,
            density_kg_m3: 1e-3,
            on_plate: OnPlate {
                across_start_m: Some(0.0),
                poisson_ratio: Some(0.35),
            },
            foils: PatchFoils::default(),
            ..patch
        };
        let found = supported(thin);
        let places = found.patch["fibres"].strain.iter();
        places
            .map(|place| place.at(&[1.0]).abs())
            .fold(0.0, f64::max)
    };
    let found = largest(ceramic("plate", [0.0, corner_m[0]], corner_m[1]));
    let [at_x, at_y] = [x * corner_m[0], y * corner_m[1]];
    let sines = at_x.sin() * at_y.sin();
    let shear = 2.0 * x * y * at_x.cos() * at_y.cos();
    let [of_x, of_y] = [x * x * sines, y * y * sines];
    let principal = (of_x + of_y) / 2.0 + (of_x - of_y).hypot(shear) / 2.0;
    let exact = 0.5e-3 * norm * principal;
    assert!((found / exact - 1.0).abs() < 1e-5, "{found:e} {exact:e}");
    assert!(principal > 5.0 * of_x.max(of_y));
    let found = largest(composite("plate", [0.0, corner_m[0]], corner_m[1]));
    let exact = 0.5e-3 * norm * of_x;
    assert!((found / exact - 1.0).abs() < 1e-3, "{found:e} {exact:e}");
}

/// From the text of a spec. Where the two strains per field of a thickness field are scaled together
/// the coupling is scaled, and a composite without `d32` is refused.
#[test]
fn a_spec_of_a_composite_on_a_plate_has_modes() {
    let text = "[plate.lid]\nmaterial = \"aluminium\"\nlength = \"60 mm\"\nwidth = \"30 mm\"\nthickness = \"1 mm\"\nleft = \"clamped\"\n\
        [patch.fibres]\non = \"lid\"\nmaterial = \"MFC-P2\"\nd32 = \"-100 pC/N\"\nstart = \"1 mm\"\nlength = \"25 mm\"\nwidth = \"14 mm\"\n\
        thickness = \"0.3 mm\"\nelectrodes = \"open\"\n[damping]\nbeyond = 0.01\n\
        [drive.shaker]\nkind = \"base-acceleration\"\namplitude = \"1 g\"\nfrequency = \"50 Hz\"\n";
    let coupling = |from: &str, to: &str| {
        let spec = jounce_spec::Spec::from_toml(&text.replace(from, to)).unwrap();
        modes(&spec).unwrap().patch["fibres"]
            .coupling_n_per_v
            .clone()
    };
    let plain = coupling("", "");
    let twice = coupling("-100 pC/N\"", "-200 pC/N\"\nd31 = \"-340 pC/N\"");
    for (one, two) in plain.iter().zip(&twice) {
        assert!((two - 2.0 * one).abs() < 1e-9 * plain[0].abs());
    }
    let porous = coupling("MFC-P2\"\nd32 = \"-100 pC/N", "PZT-5A\"\nporosity = 0.3\n#");
    assert!(porous[0].abs() > plain[0].abs());
    let without = text.replace("d32 = \"-100 pC/N\"\n", "");
    assert!(jounce_spec::Spec::from_toml(&without).is_err());
}
