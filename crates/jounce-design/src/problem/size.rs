//! Size of a harvester: its beams and plates with what is bonded to them and what they carry.

use jounce_analysis::DerivativeKey;
use jounce_spec::Spec;

/// Step of a difference quotient, relative to the scale of the key. A size is at most of the third
/// order in one key, so that the error of a central difference is of the order of the step squared.
const STEP: f64 = 1e-5;

/// Size that a limit can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// Mass of the beams, plates, patches and layers, and of the masses that beams and plates carry,
    /// kg.
    Mass,
    /// Largest distance of the end of a beam from the root of its chain, or longest side of a
    /// plate, m.
    Length,
    /// Volume of the beams, plates, patches and layers, m^3.
    Volume,
}

impl Size {
    /// Returns the value in a spec, SI.
    pub fn of(self, spec: &Spec) -> f64 {
        match self {
            Self::Mass => {
                let bonded: f64 = volumes(spec)
                    .map(|(volume, density)| volume * density)
                    .sum();
                let carried = spec.mass.values();
                let carried = carried.filter(|mass| is_carried(spec, &mass.on));
                bonded + carried.map(|mass| mass.mass_kg).sum::<f64>()
            }
            Self::Length => {
                let ends = spec
                    .beam
                    .values()
                    .map(|beam| distance_m(spec, &beam.root, spec.beam.len()) + beam.length_m);
                let sides = spec.plate.values();
                let sides = sides.map(|plate| plate.length_m.max(plate.width_m));
                ends.chain(sides).fold(0.0, f64::max)
            }
            Self::Volume => volumes(spec).map(|(volume, _)| volume).sum(),
        }
    }

    /// Returns the derivative by a key of a spec, SI.
    pub(crate) fn derivative(self, spec: &Spec, key: &DerivativeKey<'_>) -> Option<f64> {
        let value = key.key.get(spec).ok()?;
        let at = |step: f64| {
            let mut changed = spec.clone();
            let set = key.key.set(&mut changed, value + step);
            // Where the spec allows no value on one side, the difference is one-sided.
            let step = if set.is_ok() { step } else { 0.0 };
            (self.of(&changed), step)
        };
        let ((above, up), (below, down)) = (at(STEP * key.scale), at(-STEP * key.scale));
        Some((above - below) / (up - down)).filter(|slope| slope.is_finite())
    }
}

/// Returns the volume, m^3, and the density, kg/m^3, of each body.
fn volumes(spec: &Spec) -> impl Iterator<Item = (f64, f64)> + '_ {
    let box_m3 = |length: f64, width: f64, thickness: f64| length * width * thickness;
    let beams = spec.beam.values().map(move |beam| {
        let volume = box_m3(beam.length_m, beam.width_m, beam.thickness_m);
        (volume, beam.density_kg_m3)
    });
    let plates = spec.plate.values().map(move |plate| {
        let volume = box_m3(plate.length_m, plate.width_m, plate.thickness_m);
        (volume, plate.density_kg_m3)
    });
    let patches = spec.patch.values().flat_map(move |patch| {
        let of = |thickness| box_m3(patch.length_m, patch.width_m, thickness);
        [
            (of(patch.thickness_m), patch.density_kg_m3),
            (
                of(2.0 * patch.foils.each_m()),
                patch.foils.mass_per_volume_kg_m3(),
            ),
        ]
    });
    let layers = spec.layer.values().map(move |layer| {
        let volume = box_m3(layer.length_m, layer.width_m, layer.thickness_m);
        (volume, layer.density_kg_m3)
    });
    beams.chain(plates).chain(patches).chain(layers)
}

/// True where a support is a point of a beam or a plate, or a mass that a beam carries.
fn is_carried(spec: &Spec, support: &str) -> bool {
    let mut support = support;
    for _ in 0..=spec.mass.len() {
        match spec.mass.get(support) {
            Some(mass) => support = &mass.on,
            None => break,
        }
    }
    beam_of(spec, support).is_some() || spec.plate_point(support).is_some()
}

/// Returns the beam of a point, and the distance of the point from its root, m.
fn beam_of<'s>(spec: &'s Spec, point: &str) -> Option<(&'s jounce_spec::Beam, f64)> {
    let (name, point) = point.split_once('.')?;
    let beam = spec.beam.get(name)?;
    let distance_m = match point {
        "root" => 0.0,
        "end" => beam.length_m,
        point => *beam.point.get(point)?,
    };
    Some((beam, distance_m))
}

/// Returns the distance of a support from the root of its chain of at most some beams, m.
fn distance_m(spec: &Spec, support: &str, most: usize) -> f64 {
    match beam_of(spec, support).filter(|_| most > 0) {
        Some((beam, along_m)) => along_m + distance_m(spec, &beam.root, most - 1),
        None => 0.0,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::NumericKey;

    const SPEC: &str = "[mass.table]\nmass = \"3 kg\"\nstiffness = \"100 N/m\"\ndamping_ratio = 0.05\n\
        [beam.a]\nyoungs_modulus = \"70 GPa\"\ndensity = \"2000 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\nroot = \"table\"\n\
        [beam.a.point]\nmiddle = \"40 mm\"\n\
        [beam.b]\nyoungs_modulus = \"70 GPa\"\ndensity = \"1000 kg/m^3\"\nlength = \"90 mm\"\nwidth = \"10 mm\"\nthickness = \"2 mm\"\nroot = \"a.middle\"\n\
        [mass.block]\nmass = \"7 g\"\non = \"b.end\"\n[mass.cap]\nmass = \"1 g\"\non = \"block\"\n\
        [patch.p]\non = \"a\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"20 mm\"\nthickness = \"0.5 mm\"\n\
        youngs_modulus = \"60 GPa\"\ndensity = \"7000 kg/m^3\"\nd31 = \"-170 pC/N\"\ncapacitance = \"10 nF\"\nelectrodes = \"open\"\n\
        [damping]\nbeyond = 0.01\n[drive.d]\nat = \"table\"\namplitude = \"1 N\"\nfrequency = \"9 Hz\"\n\
        [run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

    #[test]
    fn sizes_of_two_beams_with_a_patch_and_carried_masses() {
        let spec = Spec::from_toml(SPEC).unwrap();
        let near = |size: Size, expected: f64| {
            let value = size.of(&spec);
            assert!((value / expected - 1.0).abs() < 1e-12, "{size:?} {value}");
        };
        // 2 ml of 2 g/ml, 1.8 ml of 1 g/ml, 0.3 ml of 7 g/ml, 8 g carried; the table is not.
        near(Size::Mass, 4e-3 + 1.8e-3 + 2.1e-3 + 8e-3);
        near(Size::Volume, 2e-6 + 1.8e-6 + 0.3e-6);
        near(Size::Length, 0.13);
    }

    #[test]
    fn the_derivative_of_a_mass_is_one_sided_where_the_spec_ends() {
        let spec = Spec::from_toml(SPEC).unwrap();
        for (path, scale, expected) in [
            ("patch.p.width", 0.02, 0.03 * 0.5e-3 * 7000.0),
            ("beam.b.length", 0.09, 0.01 * 2e-3 * 1000.0),
        ] {
            let key = &NumericKey::find(&spec, path).unwrap();
            let slope = Size::Mass.derivative(&spec, &DerivativeKey { key, scale });
            assert!(
                (slope.unwrap() / expected - 1.0).abs() < 1e-8,
                "{path} {slope:?}"
            );
        }
    }
}
