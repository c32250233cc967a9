//! Plates: keys, round trip, and one clear fault for each bad input.

use jounce_spec::{Edge, Spec};

const PLATE: &str = r#"
[plate.wing]
material = "aluminium"
length = "100 mm"
width = "60 mm"
thickness = "1 mm"
left = "clamped"

[plate.wing.point.corner]
x = "100 mm"
y = "60 mm"

[mass.lump]
on = "wing.corner"
mass = "5 g"

[layer.bond]
on = "wing"
start = "5 mm"
length = "50 mm"
width = "40 mm"
across_start = "0 mm"
thickness = "0.05 mm"
youngs_modulus = "3 GPa"
poisson_ratio = 0.4
density = "1200 kg/m^3"

[patch.cell]
on = "wing"
material = "PZT-5A"
start = "5 mm"
length = "40 mm"
width = "40 mm"
across_start = "0 mm"
thickness = "0.2 mm"
electrodes = "open"

[drive.shaker]
kind = "base-acceleration"
amplitude = "1 g"
frequency = "50 Hz"

[damping]
beyond = 0.01
"#;

fn faults_of(changes: &[(&str, &str)]) -> String {
    let mut text = PLATE.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    Spec::from_toml(&text).map_or_else(|faults| faults.to_string(), |_| String::new())
}

#[test]
fn a_plate_is_read_and_written_again() {
    let spec = Spec::from_toml(PLATE).unwrap();
    let plate = &spec.plate["wing"];
    assert_eq!((plate.left, plate.right), (Edge::Clamped, Edge::Free));
    assert_eq!((plate.poisson_ratio, plate.youngs_modulus_pa), (0.33, 70e9));
    assert_eq!(plate.point["corner"].y_m, 0.06);
    assert_eq!(spec.patch["cell"].poisson_ratio(), Some(5.74 / 16.4));
    assert_eq!(spec.layer["bond"].poisson_ratio(), Some(0.4));
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
    // Jaffe, Cook and Jaffe: eps33T = 1700 eps0, d31 = -171 pm/V, s11E + s12E = (16.4 - 5.74) / TPa.
    let permittivity_f_m =
        1700.0 * 8.854_187_812_8e-12 - 2.0 * 171e-12_f64.powi(2) / (16.4e-12 - 5.74e-12);
    let expected_f = permittivity_f_m * 0.04 * 0.04 / 0.2e-3;
    let found_f = spec.patch["cell"].clamped_in_plane_capacitance_f();
    assert!((found_f / expected_f - 1.0).abs() < 1e-12, "{found_f:e}");
    // A larger d31 of the user softens it further; the free permittivity stays that of the ceramic.
    let mut strong = spec.patch["cell"].clone();
    strong.d31_m_per_v = Some(-200e-12);
    let softer_f =
        2.0 * (200e-12_f64.powi(2) - 171e-12_f64.powi(2)) / (16.4e-12 - 5.74e-12) * 0.04 * 0.04
            / 0.2e-3;
    let found_f = strong.clamped_in_plane_capacitance_f();
    assert!(
        (found_f / (expected_f - softer_f) - 1.0).abs() < 1e-12,
        "{found_f:e}"
    );
    assert_eq!(spec.base_under("wing.corner"), "ground");
}

const CERAMIC: &str = "material = \"PZT-5A\"\nstart = \"5 mm\"\nlength = \"40 mm\"";

/// Replaced parts of the text, and a part of the expected message.
type BadInput = (&'static [(&'static str, &'static str)], &'static str);

const BAD_INPUT: &[BadInput] = &[
    (
        &[("left = \"clamped\"", "left = \"free\"")],
        "plate.wing: the plate could move as a rigid body",
    ),
    (
        &[("left = \"clamped\"", "left = \"simply-supported\"")],
        "two to \"simply-supported\"",
    ),
    (
        &[("left = \"clamped\"", "left = \"welded\"")],
        "plate.wing.left",
    ),
    (
        &[("x = \"100 mm\"", "x = \"101 mm\"")],
        "plate.wing.point.corner.x is 101 mm from the left edge; it must not exceed the plate length 100 mm",
    ),
    (
        &[("y = \"60 mm\"", "y = \"-1 mm\"")],
        "plate.wing.point.corner.y",
    ),
    (
        &[("left = \"clamped\"", "left = \"clamped\"\non = \"lump\"")],
        "a plate stands on a base only",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nstart = \"61 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell.length: the patch or layer covers x = 61 mm to 101 mm; it must lie within the plate length 100 mm",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nstart = \"20 mm\"\nlength = \"40 mm\"",
        )],
        "layer.bond covers x = 5 mm to 55 mm, y = 0 m to 40 mm of the same face, under a part of this patch only",
    ),
    (
        &[(
            CERAMIC,
            "material = \"MFC-P2\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell: `d32` is missing; a fibre composite on a plate has other constants across x than along x",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nd33 = \"374 pC/N\"\nelectrode_spacing = \"1 mm\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell: `poisson_ratio`, `transverse_youngs_modulus`, `shear_modulus`, `d32` are missing; a fibre composite",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\ntransverse_youngs_modulus = \"40 GPa\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell: `shear_modulus` is missing; a patch with `transverse_youngs_modulus`",
    ),
    (
        &[(
            CERAMIC,
            "material = \"MFC-P2\"\nd32 = \"-100 pC/N\"\npoisson_ratio = 0.4\ntransverse_youngs_modulus = \"200 GPa\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell.poisson_ratio is 0.4; it must be below 0.3895, the square root of youngs_modulus / transverse_youngs_modulus",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nshear_modulus = \"0 Pa\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell.shear_modulus",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nd32 = \"1 mm\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell.d32",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PZT-5A\"\nfoil_poisson_ratio = 0.3\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell.foil_poisson_ratio has no effect without `foil_thickness`",
    ),
    (
        &[(
            CERAMIC,
            "material = \"PVDF\"\nstart = \"5 mm\"\nlength = \"40 mm\"",
        )],
        "patch.cell: `poisson_ratio` is missing",
    ),
    (
        &[("poisson_ratio = 0.4", "poisson_ratio = 0.7")],
        "layer.bond.poisson_ratio",
    ),
    (
        &[(
            "material = \"PZT-5A\"",
            "material = \"PZT-5A\"\nsection = \"thin-skin\"",
        )],
        "is a section of beams",
    ),
    (
        &[(
            "material = \"PZT-5A\"",
            "material = \"PZT-5A\"\nporosity = 0.2\npoisson_ratio = 0.3",
        )],
        "patch.cell.poisson_ratio does not apply with `porosity`, which sets all constants",
    ),
    (
        &[(
            "material = \"PZT-5A\"",
            "material = \"PZT-5A\"\nporosity = 0.2\nd32 = \"-100 pC/N\"",
        )],
        "patch.cell.d32 does not apply with `porosity`",
    ),
    (
        &[("material = \"aluminium\"", "material = \"silicon\"")],
        "plate.wing: `poisson_ratio` is missing",
    ),
    (
        &[("on = \"wing.corner\"", "on = \"wing.middle\"")],
        "there is no mass or point \"wing.middle\"",
    ),
    (
        &[(
            "mass = \"5 g\"",
            "mass = \"5 g\"\nfrequency = \"9 Hz\"\ndamping_ratio = 0.1",
        )],
        "mass.lump.on is a point of a plate, which carries only fixed masses",
    ),
    (
        &[(
            "[damping]",
            "[mass.second]\non = \"lump\"\nmass = \"1 g\"\n[damping]",
        )],
        "mass.second.on is mass \"lump\" on a plate, which carries nothing",
    ),
    (
        &[(
            "[damping]",
            "[beam.arm]\nmaterial = \"steel\"\nlength = \"9 mm\"\nwidth = \"2 mm\"\nthickness = \"1 mm\"\nroot = \"wing.corner\"\n[damping]",
        )],
        "beam.arm.root is a point of a plate, which carries only fixed masses",
    ),
    (
        &[(
            "[damping]",
            "[modal.wing]\nfrequency_hz = [1]\ndamping_ratio = [0.1]\nparticipation_sqrt_kg = [0.1]\n[damping]",
        )],
        "plate.wing: another structure has this name too",
    ),
    (
        &[(
            "mass = \"5 g\"",
            "mass = \"5 g\"\nrotary_inertia = \"1e-7 kg m^2\"",
        )],
        "mass.lump.rotary_inertia does not apply on a plate",
    ),
    (&[("beyond = 0.01", "ratios = [0.01]")], "damping.ratios"),
];

#[test]
fn bad_input_names_the_place_and_the_remedy() {
    for (changes, expected) in BAD_INPUT {
        let faults = faults_of(changes);
        assert!(faults.contains(expected), "{changes:?}: {faults:?}");
    }
}

fn cell_of(changes: &[(&str, &str)]) -> jounce_spec::Patch {
    let mut text = PLATE.to_owned();
    for (from, to) in changes {
        text = text.replacen(from, to, 1);
    }
    let spec = Spec::from_toml(&text).unwrap();
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
    spec.patch["cell"].clone()
}

/// Smart Material Corp.: E1 30.336 GPa, E2 15.857 GPa, G12 5.515 GPa, nu12 0.31, and nu21 0.16.
#[test]
fn a_library_composite_needs_only_its_transverse_coefficient() {
    for (material, d32) in [("MFC-P2", -100e-12), ("MFC-P1", -170e-12)] {
        let of = format!("material = \"{material}\"\nd32 = \"{} pC/N\"", d32 * 1e12);
        let cell = cell_of(&[("material = \"PZT-5A\"", &of)]);
        let lamina = cell.lamina();
        assert_eq!(lamina.youngs_modulus_pa, [30.336e9, 15.857e9]);
        assert_eq!(
            (lamina.poisson_ratio, lamina.shear_modulus_pa),
            (0.31, 5.515e9)
        );
        let published = lamina.contraction_product() / 0.31;
        assert!((published - 0.16).abs() < 0.005, "{published}");
        assert_eq!(cell.transverse_coefficient_m_per_v(), Some(d32));
        // The data sheet states a capacitance per area.
        let capacitance_f = cell.clamped_capacitance_f();
        assert_eq!(cell.clamped_in_plane_capacitance_f(), capacitance_f);
    }
}

/// Plane stress leaves out the strain along the poling axis: `Q11 = c11 - c13^2 / c33`, `Q12 = c12 -
/// c13^2 / c33`, `e31 - c13 e33 / c33`, `kappa33 + e33^2 / c33`, with no inverse of the stiffness.
#[test]
fn a_porous_ceramic_has_the_constants_of_plane_stress() {
    use jounce_spec::material::porous::{PZT_5A, PoreGeometry, PorosityScheme};
    // Foils leave the ceramic between them isotropic.
    for (porosity, foils) in [(0.0, ""), (0.3, ""), (0.3, "foil_thickness = \"60 um\"")] {
        let of = format!("material = \"PZT-5A\"\nporosity = {porosity}\n{foils}");
        let cell = cell_of(&[("material = \"PZT-5A\"", &of)]);
        let spheres = PoreGeometry::Spheroids(1.0);
        let all = PZT_5A.porous(porosity, spheres, PorosityScheme::MoriTanaka);
        let c = all.unwrap();
        let lost_pa = c.c13_pa * c.c13_pa / c.c33_pa;
        let charge = c.e31_c_m2 - c.c13_pa * c.e33_c_m2 / c.c33_pa;
        let permittivity = c.permittivity_33_f_m + c.e33_c_m2 * c.e33_c_m2 / c.c33_pa;
        let [q11, q12, q22] = cell.lamina().normal_stiffness_pa();
        let [along, across] = cell.blocked_force_n_m_v();
        let area_per_m = cell.width_m * cell.length_m / cell.thickness_m;
        for (found, expected) in [
            (q11, c.c11_pa - lost_pa),
            (q12, c.c12_pa - lost_pa),
            (q22, c.c11_pa - lost_pa),
            (cell.lamina().shear_modulus_pa, (c.c11_pa - c.c12_pa) / 2.0),
            (along, charge),
            (across, charge),
            (
                cell.clamped_in_plane_capacitance_f(),
                permittivity * area_per_m,
            ),
        ] {
            let error = found / expected - 1.0;
            assert!(error.abs() < 1e-10, "{porosity}: {found:e} {expected:e}");
        }
    }
}

/// A position across the width means nothing on a beam.
#[test]
fn a_position_across_a_beam_is_refused() {
    let text = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n[damping]\nbeyond = 0.01\n\
         [patch.p]\non = \"b\"\nmaterial = \"PZT-5A\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"10 mm\"\nthickness = \"0.2 mm\"\n\
         electrodes = \"open\"\nacross_start = \"1 mm\"\n";
    let faults = Spec::from_toml(text).unwrap_err().to_string();
    assert!(
        faults.contains("patch.p.across_start has no effect on a beam"),
        "{faults}"
    );
}
