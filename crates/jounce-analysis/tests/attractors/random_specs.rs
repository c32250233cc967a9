//! Random harvesters as spec text, reproducible from seed and number.
//!
//! One to three modes near a frequency `f`, a length `L` for gaps and motions, and one or two
//! stops. Contact raises the frequency of the first mode by a factor of 2 to 60: three and a half
//! decades of stiffness, all accessible to an explicit method.

use std::f64::consts::TAU;
use std::fmt::Write;

/// Generator splitmix64: Steele, Lea and Flood, OOPSLA 2014.
pub struct Draw(u64);

impl Draw {
    /// Stream number `index` of a seed.
    pub fn new(seed: u64, index: u64) -> Self {
        let mut draw = Self(
            seed.wrapping_mul(0xd134_2543_de82_ef95) ^ index.wrapping_mul(0xaf25_1af3_b0f0_25b5),
        );
        draw.next();
        draw
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number uniform in the logarithm.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }

    pub fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[(self.next() % list.len() as u64) as usize]
    }

    pub fn happens(&mut self, probability: f64) -> bool {
        self.within(0.0, 1.0) < probability
    }
}

/// Scales for the random parts of a harvester.
struct Scales {
    /// Frequencies of the modes, Hz.
    frequencies: Vec<f64>,
    /// Shape at the tip, kg^-1/2.
    tip: Vec<f64>,
    /// Length of gaps and motions, m.
    length: f64,
    /// Stiffness of the first mode at the tip, N/m.
    stiffness: f64,
}

impl Scales {
    fn angular(&self) -> f64 {
        TAU * self.frequencies[0]
    }
}

/// Returns the text of harvester number `index` of a seed.
pub fn random_spec(seed: u64, index: u64) -> String {
    let draw = &mut Draw::new(seed, index);
    let modes = draw.one_of(&[1, 1, 2, 2, 3]);
    let mut frequencies = vec![draw.decades(1.0, 20.0)];
    (1..modes).for_each(|i| frequencies.push(frequencies[i - 1] * draw.within(1.8, 6.5)));
    let tip: Vec<f64> = (0..modes).map(|i| if i == 0 { 1.0 } else { draw.one_of(&[-1.0, 1.0]) } * draw.within(0.5, 1.5)).collect();
    let stiffness = (TAU * frequencies[0] / tip[0]).powi(2);
    let scales = Scales {
        frequencies,
        tip,
        length: draw.decades(1e-4, 1e-2),
        stiffness,
    };
    let mut text = modal(draw, &scales);
    stops(draw, &scales, &mut text);
    let ratio = draw.decades(0.3, 2.5);
    let frequency = ratio * scales.frequencies[0];
    // The first mode without stops would move by some lengths: the static displacement of the tip
    // over the distance from resonance.
    let magnified = ((1.0 - ratio * ratio).powi(2) + (0.1 * ratio).powi(2)).sqrt();
    let amplitude = draw.decades(0.7, 8.0) * scales.length * scales.stiffness * magnified;
    let phase = draw.one_of(&[0.0, 0.1, 2.0]);
    _ = writeln!(
        text,
        "[drive.d]\nat = \"h.tip\"\namplitude = \"{amplitude:.6} N\"\nfrequency = \"{frequency:.6} Hz\"\nphase = \"{phase} rad\""
    );
    if draw.happens(0.4) {
        // Gravity bends the first mode by up to a length at the tip.
        let sag = scales.length * draw.within(-1.0, 1.0) * scales.angular().powi(2)
            / (scales.tip[0] * 0.8);
        _ = writeln!(text, "[gravity]\nacceleration = \"{sag:.6} m/s^2\"");
    }
    text + "[run]\nduration = \"100 s\"\naverage_over = \"50 s\"\n"
}

fn list(values: impl Iterator<Item = f64>) -> String {
    values
        .map(|value| format!("{value:.6}"))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Writes the table of modes and, in most cases, a patch with its resistor.
fn modal(draw: &mut Draw, scales: &Scales) -> String {
    let modes = scales.frequencies.len();
    let (frequency, tip) = (
        list(scales.frequencies.iter().copied()),
        list(scales.tip.iter().copied()),
    );
    let ratios = list((0..modes).map(|_| draw.decades(0.005, 0.1)));
    let side = list((0..modes).map(|i| scales.tip[i] * draw.within(-0.9, 0.9)));
    let participation = list((0..modes).map(|i| 0.8 / (1.0 + i as f64).powi(2)));
    let mut text = format!(
        "[modal.h]\nfrequency_hz = [{frequency}]\ndamping_ratio = [{ratios}]\nparticipation_sqrt_kg = [{participation}]\n\
         [modal.h.point]\ntip = [{tip}]\nside = [{side}]\n"
    );
    if draw.happens(0.85) {
        // The coupling coefficient theta^2 / (C w^2) of the first mode is 0.1 to 10 %.
        let capacitance: f64 = 1e-6;
        let first = (draw.decades(1e-3, 0.1) * capacitance).sqrt() * scales.angular();
        let coupling = (0..modes).map(|i| {
            if i == 0 {
                first
            } else {
                first * draw.within(-2.0, 2.0)
            }
        });
        let coupling = coupling
            .map(|value| format!("{value:.9}"))
            .collect::<Vec<_>>()
            .join(", ");
        let resistance = draw.decades(0.1, 10.0) / (capacitance * scales.angular());
        _ = writeln!(
            text,
            "[modal.h.patch.p]\ncoupling_n_per_v = [{coupling}]\ncapacitance = \"1 uF\"\n\
             [circuit.c]\npatch = \"h.p\"\nresistance = \"{resistance:.3} ohm\""
        );
    }
    text
}

/// Writes one or two stops: two on both sides of the tip, or the second at another point.
fn stops(draw: &mut Draw, scales: &Scales, text: &mut String) {
    let count = draw.one_of(&[1, 2]);
    let mut rigid = false;
    for number in 0..count {
        let at = if number == 1 && draw.happens(0.3) && !rigid {
            "side"
        } else {
            "tip"
        };
        let side = if number == 0 { "positive" } else { "negative" };
        let words: &[&str] = &[
            "hertz",
            "spring",
            "kelvin-voigt",
            "hunt-crossley",
            "rigid",
            "cubic",
        ];
        // A rigid stop at another point than the first is not combined with a second rigid one.
        let word = draw.one_of(if at == "side" || number == 1 && !rigid {
            &words[..4]
        } else {
            words
        });
        rigid |= word == "rigid";
        let gap = scales.length
            * match word {
                "rigid" if count == 2 => draw.within(0.2, 1.5),
                "rigid" => draw.one_of(&[0.0, 0.3, 1.0]),
                _ => draw.one_of(&[0.0, 0.2, 1.0, 1.0, -0.2, -1.0]) * draw.within(0.5, 1.0),
            };
        _ = writeln!(
            text,
            "[stop.s{number}]\nat = \"h.{at}\"\nside = \"{side}\"\ngap = \"{gap:.9} m\"\nlaw = \"{word}\""
        );
        law(draw, scales, word, text);
    }
}

fn law(draw: &mut Draw, scales: &Scales, word: &str, text: &mut String) {
    let stiffness = scales.stiffness * draw.decades(2.0, 60.0).powi(2);
    // A power law has that stiffness at a tenth of the length.
    let exponent = draw.one_of(&[1.5, 1.5, 1.5, 1.2, 2.0]);
    let powered = stiffness / (exponent * (0.1 * scales.length).powf(exponent - 1.0));
    let mass = scales.tip[0].powi(-2);
    _ = match word {
        "hertz" => writeln!(
            text,
            "stiffness = \"{powered:.3} N/m^{exponent}\"\nexponent = {exponent}"
        ),
        "hunt-crossley" => {
            let damping = draw.decades(0.02, 1.0) / (scales.angular() * scales.length);
            writeln!(
                text,
                "stiffness = \"{powered:.3} N/m^{exponent}\"\nexponent = {exponent}\ndamping = \"{damping:.6} s/m\""
            )
        }
        "spring" => writeln!(text, "stiffness = \"{stiffness:.3} N/m\""),
        "kelvin-voigt" => {
            let damping = 2.0 * draw.decades(0.01, 0.4) * (stiffness * mass).sqrt();
            writeln!(
                text,
                "stiffness = \"{stiffness:.3} N/m\"\ndamping = \"{damping:.6} N s/m\""
            )
        }
        "cubic" => {
            let (linear, cubic) = (
                scales.stiffness * draw.within(-0.6, 2.0),
                scales.stiffness * draw.decades(0.1, 20.0),
            );
            let cubic = cubic / scales.length.powi(2);
            writeln!(
                text,
                "stiffness = \"{linear:.3} N/m\"\ncubic_stiffness = \"{cubic:.3} N/m^3\""
            )
        }
        _ => writeln!(text, "restitution = {:.2}", draw.within(0.2, 0.95)),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_spec::Spec;

    #[test]
    fn every_random_text_is_a_legal_spec_and_all_kinds_occur() {
        let texts: Vec<String> = (0..300).map(|index| random_spec(1, index)).collect();
        for (index, text) in texts.iter().enumerate() {
            assert!(
                Spec::from_toml(text).is_ok(),
                "number {index}:\n{text}\n{:?}",
                Spec::from_toml(text).err()
            );
            assert_eq!(*text, random_spec(1, index as u64));
        }
        let kinds = [
            "hertz",
            "spring",
            "kelvin-voigt",
            "hunt-crossley",
            "rigid",
            "cubic",
            "[gravity]",
            "gap = \"-",
            "gap = \"0.000000000",
            "s1",
            "h.side",
            "[circuit",
        ];
        for kind in kinds {
            let count = texts.iter().filter(|text| text.contains(kind)).count();
            assert!((10..300).contains(&count), "{kind}: {count} of 300");
        }
    }
}
