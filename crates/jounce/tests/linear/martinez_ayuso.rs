//! `examples/porous-patch-martinez-ayuso`: the constants of its patch from those of the dense ceramic.

use crate::expected::{check, spec};
use jounce::material::porous::{PZT_5A, Pores, Scheme};

const EXAMPLE: &str = "porous-patch-martinez-ayuso";

#[test]
fn every_expected_row_is_met() {
    let porous = PZT_5A.porous(0.3, Pores::Spheroids(1.0), Scheme::MoriTanaka).unwrap().ceramic();
    let cylinders = PZT_5A.porous(0.3, Pores::Cylinders, Scheme::MoriTanaka).unwrap().ceramic();
    let spec = spec(EXAMPLE, &[]);
    let patch = &spec.patch["porous"];
    check(
        EXAMPLE,
        &[
            ("youngs_modulus_gpa", porous.youngs_modulus_pa() / 1e9),
            ("d31_pc_per_n", porous.d31_m_per_v * 1e12),
            ("relative_permittivity_at_constant_stress", porous.relative_permittivity),
            ("cylinder_d31_over_dense", cylinders.d31_m_per_v / PZT_5A.ceramic().d31_m_per_v),
            ("modulus_in_spec_gpa", patch.youngs_modulus_pa / 1e9),
            ("permittivity_in_spec_nf_m", patch.permittivity_f_m.unwrap() * 1e9),
        ],
    );
    assert!((patch.permittivity_f_m.unwrap() / porous.clamped_permittivity_f_m() - 1.0).abs() < 1e-3);
    assert!((patch.d31_m_per_v.unwrap() / porous.d31_m_per_v - 1.0).abs() < 1e-3);
}
