//! Porous patches: constants that follow from the pores, and invalid combinations.

use jounce_spec::material::porous::{PZT_5A, PoreGeometry, PorosityScheme};
use jounce_spec::{NumericKey, Spec};

fn text(keys: &str) -> String {
    format!(
        "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n[damping]\nbeyond = 0.01\n\
         [patch.p]\non = \"b\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"10 mm\"\nthickness = \"0.2 mm\"\nelectrodes = \"open\"\n{keys}\n"
    )
}

#[test]
fn a_porous_patch_has_the_constants_of_its_scheme() {
    let (mori_tanaka, self_consistent) =
        (PorosityScheme::MoriTanaka, PorosityScheme::SelfConsistent);
    for (keys, pores, scheme) in [
        ("", PoreGeometry::Spheroids(1.0), mori_tanaka),
        (
            "pore_shape = \"cylinders\"",
            PoreGeometry::Cylinders,
            mori_tanaka,
        ),
        (
            "pore_shape = \"spheroids\"\npore_aspect_ratio = 4",
            PoreGeometry::Spheroids(4.0),
            mori_tanaka,
        ),
        (
            "porosity_scheme = \"self-consistent\"",
            PoreGeometry::Spheroids(1.0),
            self_consistent,
        ),
    ] {
        let spec = Spec::from_toml(&text(&format!(
            "material = \"PZT-5A\"\nporosity = 0.2\n{keys}"
        )))
        .unwrap();
        let (patch, exact) = (
            &spec.patch["p"],
            PZT_5A.porous(0.2, pores, scheme).unwrap().ceramic(),
        );
        assert_eq!(
            (patch.youngs_modulus_pa, patch.d31_m_per_v),
            (exact.youngs_modulus_pa(), Some(exact.d31_m_per_v))
        );
        assert_eq!(
            (patch.permittivity_f_m, patch.density_kg_m3),
            (Some(exact.clamped_permittivity_f_m()), 0.8 * 7750.0)
        );
        if scheme == mori_tanaka {
            assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
        }
    }
}

#[test]
fn porosity_is_swept_with_all_that_follows_from_it() {
    let mut spec = Spec::from_toml(&text("material = \"PZT-5A\"\nporosity = 0.2")).unwrap();
    NumericKey::find(&spec, "patch.p.porosity")
        .unwrap()
        .set(&mut spec, 0.4)
        .unwrap();
    assert_eq!(
        spec,
        Spec::from_toml(&text("material = \"PZT-5A\"\nporosity = 0.4")).unwrap()
    );
}

/// Dense: the two sources of the library agree along the beam within 1.1 % (modulus, coefficient
/// and permittivity).
#[test]
fn no_pores_leave_nearly_the_material_of_the_library() {
    let [dense, none] = ["", "porosity = 0"]
        .map(|keys| Spec::from_toml(&text(&format!("material = \"PZT-5A\"\n{keys}"))).unwrap());
    let constants = |spec: &Spec| {
        let patch = &spec.patch["p"];
        [
            patch.youngs_modulus_pa,
            patch.d31_m_per_v.unwrap(),
            patch.permittivity_f_m.unwrap(),
            patch.density_kg_m3,
        ]
    };
    for (dense, none) in constants(&dense).into_iter().zip(constants(&none)) {
        assert!((none / dense - 1.0).abs() < 0.011, "{dense:e} {none:e}");
    }
}

#[test]
fn keys_that_do_not_go_with_pores_are_refused() {
    for (keys, message) in [
        (
            "material = \"PZT-5H\"\nporosity = 0.2",
            "patch.p.porosity is given, but it requires all constants of the dense material; the library has them for \"PZT-5A\"",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 0.2\nd31 = \"-100 pC/N\"",
            "patch.p.d31 does not apply with `porosity`",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 0.2\ncapacitance = \"1 nF\"",
            "patch.p.capacitance does not apply with `porosity`",
        ),
        (
            "material = \"PZT-5A\"\npore_shape = \"cylinders\"",
            "patch.p.porosity is missing",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 0.2\npore_shape = \"spheroids\"",
            "`pore_aspect_ratio` is missing",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 0.2\npore_aspect_ratio = 2",
            "does not apply with pore_shape = \"spheres\"",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 1.5",
            "patch.p.porosity is 1.5",
        ),
        (
            "material = \"PZT-5A\"\nporosity = 0.8\nporosity_scheme = \"self-consistent\"",
            "predicts no stiffness",
        ),
    ] {
        let fault = Spec::from_toml(&text(keys)).unwrap_err().to_string();
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{keys}\n-> {fault}"
        );
    }
}
