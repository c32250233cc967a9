//! Laminates of layers with different Poisson's ratios against `D - B A^-1 B` of the textbook (Reddy,
//! Mechanics of Laminated Composite Plates and Shells, 2004, ch. 3), in x, y and shear.

use super::plates::{plate, spec};
use jounce_linalg::Mat;
use jounce_model::structure::modes;
use jounce_spec::{Edge, Face, Layer, OnPlate, Section, Spec};
use std::f64::consts::PI;

const SIDES_M: [f64; 2] = [0.1, 0.06];
const LAYER_M: f64 = 0.8e-3;
const LAYER_PA: f64 = 40e9;
const LAYER_POISSON: f64 = 0.45;
const LAYER_KG_M3: f64 = 1500.0;
const PLATE_POISSON: f64 = 0.05;

/// A plate that a stiff layer covers completely.
fn covered(edges: [Edge; 4]) -> Spec {
    let mut spec = spec(plate(SIDES_M, PLATE_POISSON, edges), 5);
    let layer = Layer {
        on: "plate".into(),
        face: Face::Top,
        material: String::new(),
        start_m: 0.0,
        length_m: SIDES_M[0],
        width_m: SIDES_M[1],
        thickness_m: LAYER_M,
        youngs_modulus_pa: LAYER_PA,
        density_kg_m3: LAYER_KG_M3,
        section: Section::Laminate,
        on_plate: OnPlate {
            across_start_m: Some(0.0),
            poisson_ratio: Some(LAYER_POISSON),
        },
    };
    spec.layer = [("bond".into(), layer)].into();
    spec
}

/// Reduced stiffness of a layer, Pa.
fn reduced_pa(youngs_modulus_pa: f64, poisson: f64) -> Mat<f64> {
    let q = youngs_modulus_pa / (1.0 - poisson * poisson);
    let shear = youngs_modulus_pa / (2.0 * (1.0 + poisson));
    Mat::from_row_slice(
        3,
        3,
        &[q, poisson * q, 0.0, poisson * q, q, 0.0, 0.0, 0.0, shear],
    )
}

/// `D - B A^-1 B`, N m, and the mass per area.
fn bending() -> (Mat<f64>, f64) {
    let of_plate = &covered([Edge::Free; 4]).plate["plate"];
    let middle_m = of_plate.thickness_m;
    let plies = [
        (
            reduced_pa(of_plate.youngs_modulus_pa, PLATE_POISSON),
            [0.0, middle_m],
        ),
        (
            reduced_pa(LAYER_PA, LAYER_POISSON),
            [middle_m, middle_m + LAYER_M],
        ),
    ];
    let moment = |power: i32| {
        plies
            .iter()
            .fold(Mat::zeros(3, 3), |sum: Mat<f64>, (q, [from, to])| {
                sum + q * ((to.powi(power) - from.powi(power)) / f64::from(power))
            })
    };
    let [a, b, d] = [1, 2, 3].map(moment);
    let inverse = a.try_inverse().unwrap();
    let mass = of_plate.density_kg_m3 * of_plate.thickness_m + LAYER_KG_M3 * LAYER_M;
    (d - &b * inverse * &b, mass)
}

#[test]
fn a_simply_supported_laminate_has_the_frequencies_of_its_stiffness() {
    let (d, mass) = bending();
    // It bends as an isotropic plate: D11 = D12 + 2 D66.
    assert!((d[(0, 0)] / (d[(0, 1)] + 2.0 * d[(2, 2)]) - 1.0).abs() < 1e-12);
    let [a, b] = SIDES_M;
    let mut exact: Vec<f64> = (1..6)
        .flat_map(|m| {
            (1..6).map(move |n| (m as f64 * PI / a).powi(2) + (n as f64 * PI / b).powi(2))
        })
        .map(|square| square * (d[(0, 0)] / mass).sqrt())
        .collect();
    exact.sort_by(f64::total_cmp);
    let found = modes(&covered([Edge::SimplySupported; 4])).unwrap();
    for (found, exact) in found.frequency_rad_s.iter().zip(&exact) {
        assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
    }
}

/// With free edges the effective Poisson's ratio `D12 / D11` counts too: the frequencies are those of
/// one layer with this ratio, the same `D11` and the same mass.
#[test]
fn a_cantilevered_laminate_has_an_effective_poisson_ratio() {
    let (d, mass) = bending();
    let edges = [Edge::Clamped, Edge::Free, Edge::Free, Edge::Free];
    let poisson = d[(0, 1)] / d[(0, 0)];
    assert!(poisson > 0.1 && poisson < 0.35, "{poisson}");
    let mut single = spec(plate(SIDES_M, poisson, edges), 5);
    let of_plate = single.plate.get_mut("plate").unwrap();
    let height_m = of_plate.thickness_m;
    of_plate.youngs_modulus_pa = 12.0 * (1.0 - poisson * poisson) * d[(0, 0)] / height_m.powi(3);
    of_plate.density_kg_m3 = mass / height_m;
    let [laminate, single] = [covered(edges), single].map(|spec| modes(&spec).unwrap());
    for (found, exact) in laminate.frequency_rad_s.iter().zip(&single.frequency_rad_s) {
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    }
}

/// A coefficient so large that nothing is left of the permittivity at constant strain.
#[test]
fn a_capacitance_that_is_not_positive_is_refused() {
    let starter = jounce_spec::starter::Starter::of("plate-with-stop").unwrap();
    let text = starter
        .spec
        .replace("\"PZT-5A\" ", "\"PZT-5A\"\nd31 = \"-400 pm/V\" ");
    let found = modes(&Spec::from_toml(&text).unwrap())
        .unwrap_err()
        .to_string();
    assert!(found.contains("patch.patch.capacitance"), "{found}");
}
