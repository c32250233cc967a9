//! A mass between two springs, one on a shaken base and one on the ground; the latter is a contact
//! that never opens. In space its steady amplitude is `(k1 + i c w) / (k1 + k2 - m w^2 + i c w)`
//! times that of the base. The mean power of the base, `c w^2 |Z - X|^2 / 2`, equals the loss in
//! the dashpot between them.

use crate::systems::{integrator, kernel, motion};
use jounce_linalg::c64;
use std::f64::consts::TAU;

#[test]
fn a_mass_between_two_springs_moves_as_in_its_closed_form() {
    let (m, natural_hz, ratio, k2, x_m) = (1.0, 6.0, 0.05, 900.0, 1e-3);
    let (k1, c) = (
        m * (TAU * natural_hz).powi(2),
        2.0 * ratio * TAU * natural_hz * m,
    );
    for drive_hz in [3.0, 7.7, 15.0] {
        let w = TAU * drive_hz;
        let text = format!(
            "[mass.mass]\non = \"head\"\nmass = \"{m} kg\"\nfrequency = \"{natural_hz} Hz\"\ndamping_ratio = {ratio}\n\
             [stop.wall]\nat = \"mass\"\nframe = \"ground\"\ngap = \"0 mm\"\nlaw = \"cubic\"\nstiffness = \"{k2} N/m\"\ncubic_stiffness = \"0 N/m^3\"\n\
             [drive.head]\nkind = \"base-displacement\"\nat = \"head\"\namplitude = \"{x_m} m\"\nfrequency = \"{drive_hz} Hz\"\n"
        );
        let kernel = kernel(&text);
        let base_stiffness = c64::new(k1, c * w);
        let relative =
            base_stiffness / (base_stiffness + c64::new(k2 - m * w * w, 0.0)) - c64::new(1.0, 0.0);
        // The coupled oscillator decays by c / 2 m: after 60 s, e^-56 of the start remains.
        let (end_s, window_s) = (60.0, 10.0 / drive_hz);
        let mut run = integrator(&kernel, &[0.0], &[0.0], 1e-11);
        run.advance_to(end_s - window_s).unwrap();
        let before_j = run.energies().input_j;
        run.advance_to(end_s).unwrap();
        let input_w = (run.energies().input_j - before_j) / window_s;
        let expected = c64::cis(w * end_s) * c64::new(0.0, -x_m) * relative;
        let error =
            (motion(&run, &kernel, "mass")[0] - expected.re).abs() / (x_m * relative.norm());
        let dissipated_w = 0.5 * c * (w * x_m * relative.norm()).powi(2);
        let input = input_w / dissipated_w - 1.0;
        eprintln!("{drive_hz} Hz: off by {error:.1e}, power {input:.1e}");
        assert!(
            error < 1e-9 && input.abs() < 1e-9,
            "{drive_hz} Hz: {error:e} {input:e}"
        );
    }
}
