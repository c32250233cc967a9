//! Designs whose best values have a closed form.

use super::outcome_of;

/// A patch whose stiffness and mass do not matter, from the root of a uniform cantilever at its first
/// resonance: the power into the optimal load is `slope(L)^2 / L`, with the slope of the mode at the
/// end of the patch, and largest where the strain there is half the mean strain covered.
///
/// Source: statement of L. Zhao, S. Fan, J. Cheng (2017).
#[test]
fn the_best_patch_covers_the_root_up_to_half_the_mean_strain() {
    let spec = "[beam.b]\nyoungs_modulus = \"200 GPa\"\ndensity = \"8000 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
        [patch.p]\non = \"b\"\nstart = \"0 mm\"\nlength = \"30 mm\"\nwidth = \"20 mm\"\nthickness = \"0.01 mm\"\n\
        youngs_modulus = \"3 GPa\"\nd31 = \"-170 pC/N\"\npermittivity = \"1.5e-8 F/m\"\nsection = \"thin-skin\"\n\
        [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
        [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"80.77 Hz\"\n[damping]\nbeyond = 0.05\n\
        [reduction]\nmodes = 1\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let found = outcome_of(
        spec,
        "[free]\n\"patch.p.length\" = \"10mm:90mm\"\n\"circuit.load.resistance\" = \"100ohm:100kohm:log\"\n\
         [goal]\nmaximise = \"expected-power\"\nstarts = 2\n",
    );
    let length_m: f64 = found.best.set["patch.p.length"]
        .trim_end_matches(" m")
        .parse()
        .unwrap();
    let expected_m = 0.1 * half_of_mean_strain();
    assert!(
        (length_m / expected_m - 1.0).abs() < 1e-4,
        "{length_m} {expected_m}"
    );
}

/// Returns the length at which the strain of the first mode of a cantilever is half of its mean from
/// the root, relative to the length of the beam.
fn half_of_mean_strain() -> f64 {
    let k = 1.875_104_068_711_961_f64;
    let ratio = (k.cosh() + k.cos()) / (k.sinh() + k.sin());
    // w = cosh - cos - ratio (sinh - sin), over k x
    let slope =
        |x: f64| k * ((k * x).sinh() + (k * x).sin() - ratio * ((k * x).cosh() - (k * x).cos()));
    let curvature = |x: f64| {
        k * k * ((k * x).cosh() + (k * x).cos() - ratio * ((k * x).sinh() + (k * x).sin()))
    };
    let (mut low, mut high) = (0.1, 0.9);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if curvature(middle) > 0.5 * slope(middle) / middle {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn the_closed_form_is_that_of_the_literature() {
    assert!((half_of_mean_strain() - 0.5105).abs() < 5e-5);
}
