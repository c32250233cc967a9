//! `examples/mfc-bender-bilgen-2010`: patch moments of both kinds of Macro Fiber Composite against static beam theory.

use crate::expected::{check, spec};
use jounce::structure::modes;
use jounce::structure::section::CrossSection;

const EXAMPLE: &str = "mfc-bender-bilgen-2010";

/// Timoshenko (1925): curvature of two layers of one width whose free strains differ by `strain`.
fn bimetal_curvature(h_m: f64, e_pa: f64, patch_m: f64, patch_pa: f64, strain: f64) -> f64 {
    let (m, n) = (h_m / patch_m, e_pa / patch_pa);
    6.0 * strain * (1.0 + m).powi(2) / ((h_m + patch_m) * (3.0 * (1.0 + m).powi(2) + (1.0 + m * n) * (m * m + 1.0 / (m * n))))
}

/// One volt bends the stretch under the patch as a bimetal and leaves the rest straight: the end moves by
/// `curvature * length * (distance from the middle of the patch to the end)`. The modes must add up to that; after 40 of them 1e-5 is
/// left.
#[test]
fn one_volt_bends_it_as_a_bimetal() {
    for (material, strain_per_v) in [("MFC-P2", -170e-12 / 0.3e-3), ("MFC-P1", 400e-12 / 0.5e-3)] {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        let found = modes(&spec).unwrap();
        let coupling = &found.patch["mfc"].coupling_n_per_v;
        let shape = &found.shape["substrate.end"];
        let modal: f64 = (0..found.len()).map(|mode| shape[mode] * coupling[mode] / found.frequency_rad_s[mode].powi(2)).sum();
        let curvature = bimetal_curvature(0.5e-3, 70e9, 0.3e-3, 30.336e9, strain_per_v);
        let exact = curvature * 0.085 * (0.1 - 0.005 - 0.085 / 2.0);
        assert!((modal / exact - 1.0).abs() < 1e-4, "{material}: {modal:e} {exact:e}");
        let section = CrossSection::covered(&spec.beam["substrate"], spec.patch.values());
        assert!(section.neutral_axis_m > 0.25e-3);
    }
}

/// Capacitance per area of the manufacturer: 7.8 and 0.30 nF/cm^2 over 8.5 cm by 2.8 cm.
#[test]
fn capacitances_are_those_of_the_manufacturer() {
    for (material, per_area) in [("MFC-P2", 7.8), ("MFC-P1", 0.30)] {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        assert!((spec.patch["mfc"].clamped_capacitance_f() * 1e9 / (per_area * 8.5 * 2.8) - 1.0).abs() < 1e-12);
    }
}

/// The same numbers as rows: the motion of the end as the sum of the modes, the capacitance of the patch.
#[test]
fn every_expected_row_is_met() {
    let of = |material: &str| {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        let found = modes(&spec).unwrap();
        let (shape, coupling) = (&found.shape["substrate.end"], &found.patch["mfc"].coupling_n_per_v);
        let end_m: f64 = (0..found.len()).map(|mode| shape[mode] * coupling[mode] / found.frequency_rad_s[mode].powi(2)).sum();
        [1e6 * end_m, 1e9 * spec.patch["mfc"].clamped_capacitance_f()]
    };
    let [[end_p2, nf_p2], [end_p1, nf_p1]] = ["MFC-P2", "MFC-P1"].map(of);
    check(EXAMPLE, &[("end_um_per_v_p2", end_p2), ("end_um_per_v_p1", end_p1), ("capacitance_nf_p2", nf_p2), ("capacitance_nf_p1", nf_p1)]);
}
