//! Plates against closed forms, published values, the beam, and conserved sums.

use jounce_model::structure::{Modes, modes};
use jounce_spec::{
    Beam, Damping, Edge, Face, Layer, Mass, OnPlate, Patch, Plate, PlatePoint, Section, Spec,
};
use std::f64::consts::PI;

const E_PA: f64 = 70e9;
const DENSITY_KG_M3: f64 = 2700.0;
const THICKNESS_M: f64 = 1e-3;

pub fn plate([length_m, width_m]: [f64; 2], poisson_ratio: f64, edges: [Edge; 4]) -> Plate {
    let [left, right, front, back] = edges;
    Plate {
        material: String::new(),
        length_m,
        width_m,
        thickness_m: THICKNESS_M,
        youngs_modulus_pa: E_PA,
        poisson_ratio,
        density_kg_m3: DENSITY_KG_M3,
        on: "ground".into(),
        left,
        right,
        front,
        back,
        point: Default::default(),
    }
}

pub fn spec(plate: Plate, count: usize) -> Spec {
    let mut spec = Spec {
        plate: [("plate".into(), plate)].into(),
        damping: Damping {
            ratios: Vec::new(),
            beyond: Some(0.01),
        },
        ..Spec::default()
    };
    spec.reduction.modes = count;
    spec
}

/// `w a^2 sqrt(rho h / D)`, with `a` the length.
fn factors(spec: &Spec) -> Vec<f64> {
    let plate = &spec.plate["plate"];
    let d_n_m = plate.youngs_modulus_pa * plate.thickness_m.powi(3)
        / (12.0 * (1.0 - plate.poisson_ratio.powi(2)));
    let unit = plate.length_m.powi(2) * (plate.density_kg_m3 * plate.thickness_m / d_n_m).sqrt();
    let modes = modes(spec).unwrap();
    modes.frequency_rad_s.iter().map(|w| w * unit).collect()
}

#[test]
fn a_simply_supported_plate_has_the_exact_frequencies() {
    for sides in [[0.1, 0.1], [0.1, 0.06]] {
        let ratio = sides[0] / sides[1];
        let mut exact: Vec<f64> = (1..8)
            .flat_map(|m| (1..8).map(move |n| (m * m) as f64 + (n * n) as f64 * ratio * ratio))
            .map(|square| PI * PI * square)
            .collect();
        exact.sort_by(f64::total_cmp);
        let found = factors(&spec(plate(sides, 0.3, [Edge::SimplySupported; 4]), 8));
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
        }
    }
}

#[test]
fn a_cantilevered_plate_has_the_values_of_ritz() {
    let edges = [Edge::Clamped, Edge::Free, Edge::Free, Edge::Free];
    for (sides, ritz) in [
        (
            [0.1, 0.1],
            &[3.4713, 8.5077, 21.288, 27.199, 30.960, 54.194][..],
        ),
        ([0.1, 0.05], &[3.4399, 14.805, 21.438, 48.187, 60.160]),
    ] {
        let found = factors(&spec(plate(sides, 0.3, edges), ritz.len()));
        for (found, ritz) in found.iter().zip(ritz) {
            assert!((found / ritz - 1.0).abs() < 1e-3, "{found} {ritz}");
            assert!(
                *found < ritz * 1.00002,
                "the values of Ritz are upper bounds"
            );
        }
    }
}

/// The unimorph of Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002.
fn unimorph() -> (Beam, Patch) {
    let beam = Beam {
        material: String::new(),
        length_m: 0.1,
        width_m: 0.02,
        thickness_m: 0.5e-3,
        youngs_modulus_pa: 100e9,
        density_kg_m3: 7165.0,
        root: "ground".into(),
        root_stiffness_n_m_rad: None,
        point: [("tip".into(), 0.1)].into(),
    };
    (beam, ceramic("beam", [0.0, 0.1], 0.02))
}

pub fn ceramic(on: &str, [start_m, length_m]: [f64; 2], width_m: f64) -> Patch {
    Patch {
        on: on.into(),
        face: Face::Top,
        material: String::new(),
        start_m,
        length_m,
        width_m,
        thickness_m: 0.4e-3,
        youngs_modulus_pa: 66e9,
        density_kg_m3: 7800.0,
        d31_m_per_v: Some(-190e-12),
        d33_m_per_v: None,
        electrode_spacing_m: None,
        capacitance_f: None,
        permittivity_f_m: Some(15.93e-9),
        strain_limit: None,
        leakage_ohm: None,
        electrodes: jounce_spec::Electrodes::Open,
        section: Section::Laminate,
        pores: Default::default(),
        foils: Default::default(),
        on_plate: OnPlate {
            across_start_m: None,
            poisson_ratio: Some(0.0),
        },
        across: Default::default(),
    }
}

fn narrow_plate() -> Spec {
    let (beam, patch) = unimorph();
    let edges = [Edge::Clamped, Edge::Free, Edge::Free, Edge::Free];
    let mut narrow = plate([beam.length_m, beam.width_m], 0.0, edges);
    narrow.thickness_m = beam.thickness_m;
    narrow.youngs_modulus_pa = beam.youngs_modulus_pa;
    narrow.density_kg_m3 = beam.density_kg_m3;
    let tip = PlatePoint {
        x_m: 0.1,
        y_m: 0.01,
    };
    narrow.point = [("tip".into(), tip)].into();
    let mut spec = spec(narrow, 6);
    let on_plate = Patch {
        on: "plate".into(),
        ..patch
    };
    spec.patch = [("ceramic".into(), on_plate)].into();
    spec
}

/// Modes of a narrow plate without contraction that bend along x only, and those of the beam.
fn bending_modes() -> (Modes, Vec<usize>, Modes) {
    let (beam, patch) = unimorph();
    let mut of_beam = Spec {
        beam: [("beam".into(), beam)].into(),
        patch: [("ceramic".into(), patch)].into(),
        ..Spec::default()
    };
    of_beam.damping.beyond = Some(0.01);
    of_beam.reduction.modes = 3;
    let (wide, narrow) = (modes(&narrow_plate()).unwrap(), modes(&of_beam).unwrap());
    let bending = (0..wide.len())
        .filter(|mode| wide.participation_sqrt_kg[*mode].abs() > 1e-6)
        .take(3)
        .collect();
    (wide, bending, narrow)
}

/// The first frequency is that of Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002.
#[test]
fn a_narrow_plate_without_contraction_is_a_beam() {
    let (wide, bending, narrow) = bending_modes();
    let published = wide.frequency_rad_s[0] / (2.0 * PI * 47.8092) - 1.0;
    assert!(published.abs() < 1e-5, "{published:e}");
    assert_eq!(bending.len(), 3);
    for (mode, of_plate) in bending.into_iter().enumerate() {
        let pairs = [
            (wide.frequency_rad_s[of_plate], narrow.frequency_rad_s[mode]),
            (
                wide.participation_sqrt_kg[of_plate],
                narrow.participation_sqrt_kg[mode],
            ),
            (
                wide.patch["ceramic"].coupling_n_per_v[of_plate],
                narrow.patch["ceramic"].coupling_n_per_v[mode],
            ),
            (
                wide.shape["plate.tip"][of_plate],
                narrow.shape["beam.tip"][mode],
            ),
        ];
        for (found, expected) in pairs {
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "mode {mode}: {found} {expected}"
            );
        }
        let strain = |modes: &Modes, mode: usize| {
            let unit: Vec<f64> = (0..modes.len()).map(|k| f64::from(k == mode)).collect();
            let places = modes.patch["ceramic"].strain.iter();
            places
                .map(|place| place.at(&unit).abs())
                .fold(0.0, f64::max)
        };
        let [found, expected] = [strain(&wide, of_plate), strain(&narrow, mode)];
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
    let [wide, narrow] = [wide, narrow].map(|modes| modes.patch["ceramic"].capacitance_f);
    assert_eq!(wide, narrow);
}

/// `chi_mn = gamma int (phi_xx + phi_yy) dA` over the patch, with the shape `2 / sqrt(m a b) sin sin`
/// of a plate whose patch has neither stiffness nor mass.
#[test]
fn a_patch_on_a_simply_supported_plate_couples_as_its_closed_form() {
    let [a, b] = [0.12, 0.08];
    let mut plate = plate([a, b], 0.3, [Edge::SimplySupported; 4]);
    // Where no mode has a node; the sign of a coupling is that relative to the shape.
    let [x_m, y_m] = [0.19 * a, 0.17 * b];
    plate.point = [("near".into(), PlatePoint { x_m, y_m })].into();
    let mut spec = spec(plate, 8);
    let thin = 1e-9;
    let (x, y) = ([0.02, 0.055], [0.01, 0.05]);
    let patch = Patch {
        on: "plate".into(),
        thickness_m: thin,
        density_kg_m3: 1e-3,
        on_plate: OnPlate {
            across_start_m: Some(y[0]),
            poisson_ratio: Some(0.35),
        },
        ..ceramic("plate", [x[0], x[1] - x[0]], y[1] - y[0])
    };
    let gamma = 66e9 / (1.0 - 0.35) * -190e-12 * (THICKNESS_M / 2.0);
    spec.patch = [("thin".into(), patch)].into();
    let modes = modes(&spec).unwrap();
    let mut orders: Vec<(f64, f64)> = (1..8)
        .flat_map(|m| (1..8).map(move |n| (m as f64 * PI / a, n as f64 * PI / b)))
        .collect();
    orders.sort_by(|one, other| one.0.hypot(one.1).total_cmp(&other.0.hypot(other.1)));
    let norm = 2.0 / (DENSITY_KG_M3 * THICKNESS_M * a * b).sqrt();
    let sine = |k: f64, [from, to]: [f64; 2]| ((k * from).cos() - (k * to).cos()) / k;
    for (mode, (kx, ky)) in orders.iter().take(8).enumerate() {
        let exact = -gamma * norm * (kx * kx + ky * ky) * sine(*kx, x) * sine(*ky, y);
        let positive = (kx * x_m).sin() * (ky * y_m).sin();
        let found = modes.patch["thin"].coupling_n_per_v[mode]
            * (modes.shape["plate.near"][mode] * positive).signum();
        assert!(
            (found / exact - 1.0).abs() < 1e-3,
            "mode {mode}: {found} {exact}"
        );
    }
}

/// `sum_i p_i^2` tends to the moving mass from below: four times as many modes leave less than half
/// of the difference. A mass on a point adds to it.
#[test]
fn participations_sum_to_the_moving_mass() {
    let edges = [Edge::Clamped, Edge::Free, Edge::Free, Edge::Free];
    let mut spec = spec(plate([0.1, 0.06], 0.3, edges), 24);
    let corner = PlatePoint {
        x_m: 0.1,
        y_m: 0.06,
    };
    spec.plate.get_mut("plate").unwrap().point = [("corner".into(), corner)].into();
    let bond = Layer {
        on: "plate".into(),
        face: Face::Top,
        material: String::new(),
        start_m: 0.01,
        length_m: 0.05,
        width_m: 0.04,
        thickness_m: 0.5e-3,
        youngs_modulus_pa: 3e9,
        density_kg_m3: 1500.0,
        section: Section::Laminate,
        on_plate: OnPlate {
            across_start_m: Some(0.0),
            poisson_ratio: Some(0.4),
        },
    };
    let layer_kg = 0.05 * 0.04 * 0.5e-3 * 1500.0;
    spec.layer = [("bond".into(), bond)].into();
    let mut plate_kg = 0.1 * 0.06 * THICKNESS_M * DENSITY_KG_M3 + layer_kg;
    for with_mass in [false, true] {
        if with_mass {
            let mass = Mass {
                on: "plate.corner".into(),
                mass_kg: 5e-3,
                rotary_inertia_kg_m2: 0.0,
                stiffness_n_m: None,
                damping_ratio: None,
                velocity_m_s: None,
                friction_n_s_m: None,
            };
            spec.mass = [("lump".into(), mass)].into();
            plate_kg += 5e-3;
        }
        let modes = modes(&spec).unwrap();
        let missing = |count: usize| {
            let first = modes.participation_sqrt_kg.iter().take(count);
            1.0 - first.map(|p| p * p).sum::<f64>() / plate_kg
        };
        let [few, many] = [missing(6), missing(24)];
        assert!(
            many > 0.0 && many < 0.07 && many < 0.5 * few,
            "{few} {many}"
        );
        if with_mass {
            assert_eq!(modes.shape["lump"], modes.shape["plate.corner"]);
        }
    }
}

/// A plate and a beam in one spec: modes in ascending frequency, one damping list, both retained.
#[test]
fn plates_and_beams_share_one_list_of_modes() {
    let (beam, _) = unimorph();
    let mut spec = narrow_plate();
    let alone = modes(&spec).unwrap();
    spec.beam = [("beam".into(), beam)].into();
    spec.damping.ratios = vec![0.01, 0.02, 0.03, 0.04, 0.05, 0.06];
    let both = modes(&spec).unwrap();
    assert_eq!(both.len(), 6);
    assert!(
        both.frequency_rad_s
            .windows(2)
            .all(|pair| pair[0] <= pair[1])
    );
    assert_eq!(both.damping_ratio, spec.damping.ratios);
    let first = both
        .frequency_rad_s
        .iter()
        .position(|w| *w == alone.frequency_rad_s[0])
        .unwrap();
    assert_eq!(both.shape["beam.tip"][first], 0.0);
    assert_eq!(both.shape["plate.tip"][first], alone.shape["plate.tip"][0]);
}
