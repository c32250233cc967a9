//! Fibre composites and porous ceramics on narrow plates against the beam, and a porous ceramic
//! without pores.

use super::composites::composite;
use super::plates::{ceramic, plate, spec};
use jounce_model::structure::{Modes, modes};
use jounce_spec::{Beam, Edge, Patch, PatchPores, Spec};

const BEAM_M: [f64; 3] = [0.1, 0.02, 0.5e-3];

/// A cantilevered plate and the beam of the same dimensions, each with the patch.
fn plate_and_beam(width_m: f64, poisson_ratio: f64, patch: &Patch) -> [Modes; 2] {
    let [length_m, _, thickness_m] = BEAM_M;
    let edges = [Edge::Clamped, Edge::Free, Edge::Free, Edge::Free];
    let mut wide = plate([length_m, width_m], poisson_ratio, edges);
    wide.thickness_m = thickness_m;
    let beam = Beam {
        material: String::new(),
        length_m,
        width_m,
        thickness_m,
        youngs_modulus_pa: wide.youngs_modulus_pa,
        density_kg_m3: wide.density_kg_m3,
        root: "ground".into(),
        root_stiffness_n_m_rad: None,
        point: Default::default(),
    };
    let on = |name: &str| Patch {
        on: name.into(),
        ..patch.clone()
    };
    let mut of_plate = spec(wide, 1);
    of_plate.patch = [("patch".into(), on("plate"))].into();
    let mut of_beam = Spec {
        beam: [("beam".into(), beam)].into(),
        patch: [("patch".into(), on("beam"))].into(),
        ..Spec::default()
    };
    of_beam.damping.beyond = Some(0.01);
    of_beam.reduction.modes = 1;
    [of_plate, of_beam].map(|spec| modes(&spec).unwrap())
}

/// Relative differences of the first mode of plate and beam: frequency, coupling, largest strain.
fn differences([wide, narrow]: &[Modes; 2]) -> [f64; 3] {
    let strain = |modes: &Modes| {
        let places = modes.patch["patch"].strain.iter();
        places
            .map(|place| place.at(&[1.0]).abs())
            .fold(0.0, f64::max)
    };
    let pairs = [
        [wide, narrow].map(|modes| modes.frequency_rad_s[0]),
        [wide, narrow].map(|modes| modes.patch["patch"].coupling_n_per_v[0].abs()),
        [wide, narrow].map(strain),
    ];
    pairs.map(|[of_plate, of_beam]| of_plate / of_beam - 1.0)
}

/// Without contraction, Poisson's ratio of the foils included, a narrow plate is the beam.
#[test]
fn a_composite_on_a_narrow_plate_without_contraction_is_that_of_the_beam() {
    let mut patch = composite("", [0.005, 0.06], BEAM_M[1]);
    patch.on_plate.poisson_ratio = Some(0.0);
    patch.foils.poisson_ratio = Some(0.0);
    let both = plate_and_beam(BEAM_M[1], 0.0, &patch);
    let [frequency, coupling, strain] = differences(&both);
    eprintln!("{frequency:e} {coupling:e} {strain:e}");
    assert!(frequency.abs() < 1e-8 && coupling.abs() < 1e-8);
    assert!(strain.abs() < 1e-6);
    assert_eq!(both[0].patch["patch"].capacitance_f, 7e-9);
    assert_eq!(both[1].patch["patch"].capacitance_f, 7e-9);
}

/// PZT-5A with 30 % of spherical pores.
fn porous(porosity: f64) -> Patch {
    let mut patch = ceramic("", [0.005, 0.06], BEAM_M[1]);
    let pores = PatchPores {
        porosity: Some(porosity),
        ..PatchPores::default()
    };
    let of_pores = pores.composite_of("PZT-5A").unwrap();
    patch.material = "PZT-5A".into();
    patch.youngs_modulus_pa = of_pores.youngs_modulus_pa;
    patch.density_kg_m3 = of_pores.density_kg_m3;
    patch.d31_m_per_v = Some(of_pores.d31_m_per_v);
    patch.permittivity_f_m = Some(of_pores.permittivity_f_m);
    patch.on_plate.poisson_ratio = None;
    patch.pores = PatchPores {
        composite: Some(of_pores),
        ..pores
    };
    patch
}

#[test]
fn porous_ceramic_without_contraction_is_that_of_the_beam() {
    let mut patch = porous(0.3);
    patch.on_plate.poisson_ratio = Some(0.0);
    let [frequency, coupling, strain] = differences(&plate_and_beam(BEAM_M[1], 0.0, &patch));
    eprintln!("{frequency:e} {coupling:e} {strain:e}");
    assert!(frequency.abs() < 1e-8 && coupling.abs() < 1e-8);
    assert!(strain.abs() < 1e-6);
}

/// A plate with the Poisson's ratio of the porous ceramic contracts freely where it is narrow. The
/// clamp holds it over a length of its width, so the difference from the beam falls with the width.
#[test]
fn porous_ceramic_on_a_narrow_plate_tends_to_that_of_the_beam() {
    let patch = porous(0.3);
    let poisson_ratio = patch.poisson_ratio().unwrap();
    let at = |width_m: f64| {
        let patch = Patch {
            width_m,
            ..patch.clone()
        };
        differences(&plate_and_beam(width_m, poisson_ratio, &patch))
    };
    let [wide, narrow] = [0.002, 0.001].map(at);
    for quantity in [0, 1] {
        let limit = 2.0 * narrow[quantity] - wide[quantity];
        eprintln!("{wide:?} {narrow:?} {limit:e}");
        let ratio = narrow[quantity] / wide[quantity];
        assert!((ratio - 0.5).abs() < 0.02, "{ratio}");
        assert!(limit.abs() < 2e-4, "{limit:e}");
    }
}

/// Without pores the composite is the dense ceramic with its full constants.
#[test]
fn ceramic_of_no_porosity_is_the_dense_one() {
    use jounce_spec::material::porous::PZT_5A;
    let empty = porous(0.0);
    let dense_ceramic = PZT_5A.ceramic();
    let mut dense = ceramic("", [0.005, 0.06], BEAM_M[1]);
    dense.youngs_modulus_pa = dense_ceramic.youngs_modulus_pa();
    dense.density_kg_m3 = empty.density_kg_m3;
    dense.d31_m_per_v = Some(dense_ceramic.d31_m_per_v);
    dense.on_plate.poisson_ratio = Some(PZT_5A.in_plane_poisson_ratio());
    // Plane stress: c33 and e33 act through the free thickness.
    let stress_free = PZT_5A.permittivity_33_f_m + PZT_5A.e33_c_m2.powi(2) / PZT_5A.c33_pa;
    dense.permittivity_f_m = Some(stress_free);
    let [[one, _], [other, _]] = [empty, dense].map(|patch| plate_and_beam(BEAM_M[1], 0.3, &patch));
    let pair = |read: fn(&Modes) -> f64| read(&one) / read(&other) - 1.0;
    for error in [
        pair(|modes| modes.frequency_rad_s[0]),
        pair(|modes| modes.patch["patch"].coupling_n_per_v[0]),
        pair(|modes| modes.patch["patch"].capacitance_f),
    ] {
        assert!(error.abs() < 1e-10, "{error:e}");
    }
}
