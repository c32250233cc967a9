//! Cross-section of a beam, bare or with layers and patches: bending stiffness, mass per length and
//! neutral axis.
//!
//! With layers `i` of modulus `E_i` (Pa), area `A_i = b_i t_i` (m^2), mid-height `z_i` (m, from the
//! bottom of the beam):
//!
//! ```text
//! zbar    = sum E_i A_i z_i / sum E_i A_i                            neutral axis, m
//! EI      = sum E_i (b_i t_i^3 / 12 + A_i (z_i - zbar)^2)            laminate, N m^2
//! EI      = E b h^3 / 12 + E_p b_p h_p (h/2)^2                       thin skin, N m^2
//! gamma_p = E_p b_p h_p e_V (z_p - zbar)                             moment per volt of the patch, N m/V
//! ```
//!
//! `e_V` is the free strain per volt: `d31 / h_p` for a field through the thickness (so that
//! `gamma_p = E_p d31 b_p (z_p - zbar)`), `d33 / s` for a field along the beam between electrodes
//! `s` apart. A patch on the lower face has `z_p = -h_p / 2`. A passive layer under a patch raises
//! it by the thickness of the layer, as a foil of a Macro Fiber Composite raises its active layer;
//! foils are layers too.
//!
//! The thin skin is the section that reproduces Table 2 of the impact-harvester paper (2019): the
//! stiffness of a skin at the surface of the beam, no shift of the axis, no mass. Its `gamma_p`
//! (eq. 2) uses the shifted axis `zbar`.

use super::ply::{Ply, above_m};
use jounce_spec::{Beam, Face, Layer, Patch, Section};

/// Bending properties of a cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossSection {
    /// `EI`, N m^2.
    pub bending_stiffness_n_m2: f64,
    /// Mass per length, kg/m.
    pub mass_per_length_kg_m: f64,
    /// Height of the neutral axis of the layers above the bottom of the beam, m.
    pub neutral_axis_m: f64,
    /// Thickness of the passive layers on the bottom and on the top, on which patches lie, m.
    pub coated_m: [f64; 2],
}

impl CrossSection {
    /// Returns the section of the bare beam.
    pub fn bare(beam: &Beam) -> Self {
        Self::of_plies(&[Ply::of_beam(beam)])
    }

    /// Returns the section of the beam under these patches, at most one on each face, all with the
    /// same section model.
    pub fn covered<'a>(beam: &Beam, patches: impl Iterator<Item = &'a Patch> + Clone) -> Self {
        Self::laminated(beam, std::iter::empty(), patches)
    }

    /// Returns the section of the beam under these layers with these patches on top, at most one of
    /// each on each face.
    pub fn laminated<'a, 'l>(
        beam: &Beam,
        layers: impl Iterator<Item = &'l Layer> + Clone,
        patches: impl Iterator<Item = &'a Patch> + Clone,
    ) -> Self {
        let coat = |face: Face| {
            layers
                .clone()
                .filter(|layer| layer.face == face)
                .map(|layer| layer.thickness_m)
                .sum::<f64>()
        };
        let coated_m = [coat(Face::Bottom), coat(Face::Top)];
        let plies: Vec<Ply> = std::iter::once(Ply::of_beam(beam))
            .chain(layers.clone().map(|layer| Ply::of_layer(beam, layer)))
            .chain(
                patches
                    .clone()
                    .map(|patch| Ply::of_patch(beam, patch, coat(patch.face))),
            )
            .chain(
                patches
                    .clone()
                    .flat_map(|patch| Ply::of_foils(beam, patch, coat(patch.face))),
            )
            .collect();
        let laminate = Self {
            coated_m,
            ..Self::of_plies(&plies)
        };
        let thin_layers = layers
            .map(|layer| layer.section)
            .chain(patches.map(|patch| patch.section))
            .any(|section| section == Section::ThinSkin);
        if !thin_layers {
            return laminate;
        }
        let bare = Self::bare(beam);
        let lever_m = beam.thickness_m / 2.0;
        let skin_n_m2: f64 = plies[1..]
            .iter()
            .map(|ply| ply.axial_stiffness_n() * lever_m * lever_m)
            .sum();
        Self {
            bending_stiffness_n_m2: bare.bending_stiffness_n_m2 + skin_n_m2,
            mass_per_length_kg_m: bare.mass_per_length_kg_m,
            ..laminate
        }
    }

    /// Returns the phase of a bending wave of 1 rad/s per length of beam, `(m / EI)^(1/4)`,
    /// s^(1/2)/m.
    pub(super) fn wave_number_per_root_frequency(&self) -> f64 {
        (self.mass_per_length_kg_m / self.bending_stiffness_n_m2)
            .sqrt()
            .sqrt()
    }

    /// Returns the thickness of the layer under a patch of a face, m.
    fn coat_m(&self, face: Face) -> f64 {
        self.coated_m[usize::from(face == Face::Top)]
    }

    fn of_plies(plies: &[Ply]) -> Self {
        let axial_n: f64 = plies.iter().map(Ply::axial_stiffness_n).sum();
        let moment_n_m: f64 = plies
            .iter()
            .map(|ply| ply.axial_stiffness_n() * ply.middle_m)
            .sum();
        let neutral_axis_m = moment_n_m / axial_n;
        Self {
            bending_stiffness_n_m2: plies
                .iter()
                .map(|ply| ply.bending_stiffness_n_m2(neutral_axis_m))
                .sum(),
            mass_per_length_kg_m: plies
                .iter()
                .map(|ply| ply.density_kg_m3 * ply.width_m * ply.thickness_m)
                .sum(),
            neutral_axis_m,
            coated_m: [0.0; 2],
        }
    }
}

/// Returns `gamma_p`: the pair of end moments of one volt across the patch on a beam of this
/// section, N m/V.
///
/// Validation: -8.6639e-5 N m/V for the harvester of the paper; the curvature `gamma_p / EI` agrees
/// with Timoshenko's bimetal formula to 1e-14.
pub fn patch_moment_n_m_per_v(beam: &Beam, section: &CrossSection, patch: &Patch) -> f64 {
    let ply = Ply::of_patch(beam, patch, section.coat_m(patch.face));
    let lever_m = ply.middle_m - section.neutral_axis_m;
    match (patch.d33_m_per_v, patch.d31_m_per_v) {
        // The thickness cancels.
        (None, Some(d31_m_per_v)) => {
            patch.youngs_modulus_pa * d31_m_per_v * patch.width_m * lever_m
        }
        _ => ply.axial_stiffness_n() * patch.free_strain_per_v() * lever_m,
    }
}

/// Returns the height of the outer face of the active layer above the neutral axis of a section, m;
/// its strain is minus this height times the curvature.
pub fn outer_lever_m(beam: &Beam, section: &CrossSection, patch: &Patch) -> f64 {
    above_m(
        beam,
        patch.face,
        section.coat_m(patch.face) + patch.foils.each_m(),
        patch.thickness_m,
    ) - section.neutral_axis_m
}

#[cfg(test)]
pub(in crate::structure) mod tests {
    use super::*;
    use std::collections::BTreeMap;

    pub fn paper_beam() -> Beam {
        Beam {
            material: String::new(),
            length_m: 0.315,
            width_m: 0.03,
            thickness_m: 0.98e-3,
            youngs_modulus_pa: 65e9,
            density_kg_m3: 2750.0,
            root_stiffness_n_m_rad: None,
            root: "ground".into(),
            point: BTreeMap::new(),
        }
    }

    pub(crate) fn paper_patch(section: Section) -> Patch {
        Patch {
            on: "beam".into(),
            face: Face::Top,
            material: String::new(),
            start_m: 0.009,
            length_m: 0.085,
            width_m: 0.03,
            thickness_m: 0.3e-3,
            youngs_modulus_pa: 30.336e9,
            density_kg_m3: 5440.0,
            d31_m_per_v: Some(-170e-12),
            d33_m_per_v: None,
            electrode_spacing_m: None,
            capacitance_f: Some(177e-9),
            permittivity_f_m: None,
            strain_limit: None,
            leakage_ohm: None,
            electrodes: jounce_spec::Electrodes::Circuit,
            section,
            pores: Default::default(),
            foils: Default::default(),
            on_plate: Default::default(),
            across: Default::default(),
        }
    }

    fn patched(beam: &Beam, patch: &Patch) -> CrossSection {
        CrossSection::covered(beam, std::iter::once(patch))
    }

    fn moment(beam: &Beam, patch: &Patch) -> f64 {
        patch_moment_n_m_per_v(beam, &patched(beam, patch), patch)
    }

    fn stiffness_ratio(section: Section) -> f64 {
        let beam = paper_beam();
        patched(&beam, &paper_patch(section)).bending_stiffness_n_m2
            / CrossSection::bare(&beam).bending_stiffness_n_m2
    }

    #[test]
    fn stiffness_ratios_of_the_paper() {
        let skin = 1.0 + 3.0 * (30.336e9 * 0.3e-3) / (65e9 * 0.98e-3);
        assert!((stiffness_ratio(Section::ThinSkin) / skin - 1.0).abs() < 1e-14);
        assert!((stiffness_ratio(Section::ThinSkin) - 1.42861).abs() < 5e-6);
        assert!((stiffness_ratio(Section::Laminate) - 1.6532).abs() < 5e-5);
    }

    #[test]
    fn only_the_laminate_weighs() {
        let beam = paper_beam();
        let bare = CrossSection::bare(&beam).mass_per_length_kg_m;
        assert!((bare - 2750.0 * 0.03 * 0.98e-3).abs() < 1e-16);
        assert_eq!(
            patched(&beam, &paper_patch(Section::ThinSkin)).mass_per_length_kg_m,
            bare
        );
        let laminate = patched(&beam, &paper_patch(Section::Laminate)).mass_per_length_kg_m;
        assert!((laminate - bare - 5440.0 * 0.03 * 0.3e-3).abs() < 1e-16);
    }

    #[test]
    fn neutral_axis_and_moment_of_the_paper() {
        let beam = paper_beam();
        for section in [Section::ThinSkin, Section::Laminate] {
            let patch = paper_patch(section);
            assert!((patched(&beam, &patch).neutral_axis_m - 0.57001e-3).abs() < 5e-9);
            assert!((moment(&beam, &patch) + 8.6639e-5).abs() < 5e-10);
        }
    }

    /// Timoshenko (1925), with `m` and `n` the ratios of thickness and modulus, `strain` the
    /// difference of free strain.
    #[test]
    fn free_strain_bends_a_laminate_as_a_bimetal() {
        for (patch_m, modulus_pa) in [
            (0.3e-3, 30.336e9),
            (0.98e-3, 65e9),
            (2e-3, 5e9),
            (0.05e-3, 200e9),
        ] {
            let beam = paper_beam();
            let patch = Patch {
                thickness_m: patch_m,
                youngs_modulus_pa: modulus_pa,
                ..paper_patch(Section::Laminate)
            };
            let curvature = moment(&beam, &patch) / patched(&beam, &patch).bending_stiffness_n_m2;
            let (m, n) = (
                beam.thickness_m / patch_m,
                beam.youngs_modulus_pa / modulus_pa,
            );
            let strain = patch.free_strain_per_v();
            let stiffness = 3.0 * (1.0 + m).powi(2) + (1.0 + m * n) * (m * m + 1.0 / (m * n));
            let bimetal =
                6.0 * strain * (1.0 + m).powi(2) / ((beam.thickness_m + patch_m) * stiffness);
            assert!(
                (curvature / bimetal - 1.0).abs() < 1e-14,
                "{curvature} {bimetal}"
            );
        }
    }

    /// Layers above and below make a bimorph: `YI = (2b/3) [Y_s h_s^3/8 + Y_p ((h_p + h_s/2)^3 -
    /// h_s^3/8)]`, no shift of the axis, and opposite moments (Erturk and Inman, Smart Mater.
    /// Struct. 18 (2009) 025009).
    #[test]
    fn two_faces_make_a_bimorph() {
        let beam = paper_beam();
        let top = paper_patch(Section::Laminate);
        let bottom = Patch {
            face: Face::Bottom,
            ..top.clone()
        };
        let section = CrossSection::covered(&beam, [&top, &bottom].into_iter());
        let (b, h, p) = (beam.width_m, beam.thickness_m, top.thickness_m);
        let published = 2.0 * b / 3.0
            * (65e9 * h.powi(3) / 8.0 + 30.336e9 * ((p + h / 2.0).powi(3) - h.powi(3) / 8.0));
        assert!((section.bending_stiffness_n_m2 / published - 1.0).abs() < 1e-14);
        assert!((section.neutral_axis_m / (h / 2.0) - 1.0).abs() < 1e-14);
        let moment = patch_moment_n_m_per_v(&beam, &section, &top);
        assert!((moment / (30.336e9 * -170e-12 * b * (h + p) / 2.0) - 1.0).abs() < 1e-14);
        assert!((patch_moment_n_m_per_v(&beam, &section, &bottom) / -moment - 1.0).abs() < 1e-14);
        assert!((outer_lever_m(&beam, &section, &bottom) / (h / 2.0 + p) + 1.0).abs() < 1e-14);
    }
}
