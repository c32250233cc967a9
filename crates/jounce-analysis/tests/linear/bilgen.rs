//! `examples/mfc-bender-bilgen-2010`: patch moments of both kinds of Macro Fiber Composite against
//! static beam theory.

use crate::expected::{check, spec};
use crate::rows;
use jounce_model::structure::modes;
use jounce_model::structure::section::{CrossSection, patch_moment_n_m_per_v};

const EXAMPLE: &str = "mfc-bender-bilgen-2010";

/// Timoshenko (1925): curvature of two layers of one width whose free strains differ by `strain`.
fn bimetal_curvature(h_m: f64, e_pa: f64, patch_m: f64, patch_pa: f64, strain: f64) -> f64 {
    let (m, n) = (h_m / patch_m, e_pa / patch_pa);
    6.0 * strain * (1.0 + m).powi(2)
        / ((h_m + patch_m) * (3.0 * (1.0 + m).powi(2) + (1.0 + m * n) * (m * m + 1.0 / (m * n))))
}

/// One volt bends the segment under the patch like a bimetal and leaves the rest straight. The end
/// moves by `curvature * length * (distance from the middle of the patch to the end)`. The modes
/// must sum to that; the error after 40 of them is 1e-5.
#[test]
fn one_volt_bends_it_as_a_bimetal() {
    for (material, strain_per_v) in [("MFC-P2", -170e-12 / 0.3e-3), ("MFC-P1", 400e-12 / 0.5e-3)] {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        let basis = modes(&spec).unwrap();
        let coupling = &basis.patch["mfc"].coupling_n_per_v;
        let shape = &basis.shape["substrate.end"];
        let modal: f64 = (0..basis.len())
            .map(|mode| shape[mode] * coupling[mode] / basis.frequency_rad_s[mode].powi(2))
            .sum();
        let curvature = bimetal_curvature(0.5e-3, 70e9, 0.3e-3, 30.336e9, strain_per_v);
        let exact = curvature * 0.085 * (0.1 - 0.005 - 0.085 / 2.0);
        assert!(
            (modal / exact - 1.0).abs() < 1e-4,
            "{material}: {modal:e} {exact:e}"
        );
        let section = CrossSection::covered(&spec.beam["substrate"], spec.patch.values());
        assert!(section.neutral_axis_m > 0.25e-3);
    }
}

/// The composite specified by its layers, with some keys changed.
fn composite_from_layers(kind: &[(&str, &str)]) -> jounce_spec::Spec {
    let path = rows::folder(EXAMPLE).join("layers.toml");
    let mut file = jounce_spec::SpecFile::read(path).unwrap();
    kind.iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file.spec().unwrap_or_else(|faults| panic!("{faults}"))
}

/// Curvature per volt of a stack of layers `(modulus, thickness)` from the bottom, where number
/// `active` has the free strain `strain_per_v`. The total force and moment are zero,
/// `[EA, ES; ES, EI] (e0, k) = (N, M)` about the bottom. Classical laminate theory without a
/// neutral axis, 1/(V m).
fn stack_curvature(stack: &[(f64, f64)], active: usize, strain_per_v: f64) -> f64 {
    let (mut bottom_m, mut sums, mut free) = (0.0, [0.0; 3], [0.0; 2]);
    for (k, (modulus_pa, thickness_m)) in stack.iter().enumerate() {
        let top_m: f64 = bottom_m + thickness_m;
        let integral = |power: i32| {
            modulus_pa * (top_m.powi(power + 1) - f64::powi(bottom_m, power + 1))
                / f64::from(power + 1)
        };
        (0..3).for_each(|power| sums[power as usize] += integral(power));
        if k == active {
            free = [strain_per_v * integral(0), strain_per_v * integral(1)];
        }
        bottom_m = top_m;
    }
    (sums[0] * free[1] - sums[1] * free[0]) / (sums[0] * sums[2] - sums[1] * sums[1])
}

/// Specified by substrate, bond, foil, fibres and foil, the patch bends like the stack of these
/// layers, d31 and d33. Measured 2e-16 in the moment over the stiffness, 1e-5 in the sum of 40
/// modes.
#[test]
fn a_composite_given_from_its_layers_bends_as_their_stack() {
    let d33 = [
        ("patch.mfc.d33", "460 pC/N"),
        ("patch.mfc.electrode_spacing", "0.5 mm"),
    ];
    for (kind, strain_per_v) in [(&[][..], -210e-12 / 0.18e-3), (&d33[..], 460e-12 / 0.5e-3)] {
        let spec = composite_from_layers(kind);
        let (beam, patch) = (&spec.beam["substrate"], &spec.patch["mfc"]);
        let section = CrossSection::laminated(beam, spec.layer.values(), spec.patch.values());
        let stack = [
            (70e9, 0.5e-3),
            (3e9, 20e-6),
            (2.5e9, 60e-6),
            (48e9, 0.18e-3),
            (2.5e9, 60e-6),
        ];
        let exact = stack_curvature(&stack, 3, strain_per_v);
        let curvature =
            patch_moment_n_m_per_v(beam, &section, patch) / section.bending_stiffness_n_m2;
        let modes = modes(&spec).unwrap();
        let (shape, coupling) = (
            &modes.shape["substrate.end"],
            &modes.patch["mfc"].coupling_n_per_v,
        );
        let end_m: f64 = (0..modes.len())
            .map(|mode| shape[mode] * coupling[mode] / modes.frequency_rad_s[mode].powi(2))
            .sum();
        let errors = [
            curvature / exact - 1.0,
            end_m / (exact * 0.085 * (0.1 - 0.005 - 0.085 / 2.0)) - 1.0,
        ];
        eprintln!("{strain_per_v:e} per V: curvature {curvature:e} 1/(V m), errors {errors:?}");
        assert!(errors[0].abs() < 1e-13 && errors[1].abs() < 1e-4);
        let mass =
            0.028 * (0.5e-3 * 2700.0 + 20e-6 * 1200.0 + 2.0 * 60e-6 * 1420.0 + 0.18e-3 * 5540.0);
        assert!((section.mass_per_length_kg_m / mass - 1.0).abs() < 1e-13);
    }
}

/// Foils with the modulus of the fibres form one layer of the total thickness, again a bimetal.
/// Measured 4e-16.
#[test]
fn foils_like_the_fibres_make_one_layer() {
    let equal_modulus = [
        ("patch.mfc.foil_youngs_modulus", "48 GPa"),
        ("layer.bond.youngs_modulus", "70 GPa"),
    ];
    let spec = composite_from_layers(&equal_modulus);
    let (beam, patch) = (&spec.beam["substrate"], &spec.patch["mfc"]);
    let section = CrossSection::laminated(beam, spec.layer.values(), spec.patch.values());
    let curvature = patch_moment_n_m_per_v(beam, &section, patch) / section.bending_stiffness_n_m2;
    // The moment of a d31 patch depends on its modulus, coefficient and lever arm only, not on its
    // thickness.
    let exact = bimetal_curvature(0.52e-3, 70e9, 0.3e-3, 48e9, -210e-12 / 0.3e-3);
    eprintln!("{:.1e}", curvature / exact - 1.0);
    assert!((curvature / exact - 1.0).abs() < 1e-13);
}

#[test]
fn foils_that_do_not_fit_are_refused() {
    for (key, value, message) in [
        (
            "patch.mfc.foil_youngs_modulus",
            "3 GPa",
            "patch.mfc.foil_youngs_modulus has no effect without `foil_thickness`",
        ),
        (
            "patch.mfc.foil_thickness",
            "60 um",
            "library constants include the foils; give the constants of the active layer",
        ),
        ("patch.mfc.foil_thickness", "0 um", "must be"),
    ] {
        let mut file =
            jounce_spec::SpecFile::read(rows::folder(EXAMPLE).join("harvester.toml")).unwrap();
        let fault = file.set(key, value).map_or_else(
            |fault| fault.to_string(),
            |()| file.spec().unwrap_err().to_string(),
        );
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{key} = {value}: {fault}"
        );
    }
}

/// Capacitance per area of the manufacturer: 7.8 and 0.30 nF/cm^2 over 8.5 cm by 2.8 cm.
#[test]
fn capacitances_are_those_of_the_manufacturer() {
    for (material, per_area) in [("MFC-P2", 7.8), ("MFC-P1", 0.30)] {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        assert!(
            (spec.patch["mfc"].clamped_capacitance_f() * 1e9 / (per_area * 8.5 * 2.8) - 1.0).abs()
                < 1e-12
        );
    }
}

/// The same numbers as rows: the motion of the end as the sum of the modes, the capacitance of the
/// patch.
#[test]
fn every_expected_row_is_met() {
    let of = |material: &str| {
        let spec = spec(EXAMPLE, &[("patch.mfc.material", material)]);
        let modal = modes(&spec).unwrap();
        let (shape, coupling) = (
            &modal.shape["substrate.end"],
            &modal.patch["mfc"].coupling_n_per_v,
        );
        let end_m: f64 = (0..modal.len())
            .map(|mode| shape[mode] * coupling[mode] / modal.frequency_rad_s[mode].powi(2))
            .sum();
        [1e6 * end_m, 1e9 * spec.patch["mfc"].clamped_capacitance_f()]
    };
    let [[end_p2, nf_p2], [end_p1, nf_p1]] = ["MFC-P2", "MFC-P1"].map(of);
    check(
        EXAMPLE,
        &[
            ("end_um_per_v_p2", end_p2),
            ("end_um_per_v_p1", end_p1),
            ("capacitance_nf_p2", nf_p2),
            ("capacitance_nf_p1", nf_p1),
        ],
    );
}
