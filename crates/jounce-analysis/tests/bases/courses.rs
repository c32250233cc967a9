//! A free ball on a moving table, in two frames. In the frame of the table the ground moves with
//! all of its stops; in space only the table moves. Gravity, noise, pulses and velocity steps. The
//! energies are those of two frames, and each balance closes.

use crate::systems::{LAWS, integrator, kernel, motion};
use jounce_model::drive::Travel;
use jounce_model::plant::System;

const DRIVES: [&str; 4] = [
    "amplitude = \"9 m/s^2\"\nfrequency = \"12 Hz\"\n",
    "signal = \"half-sine\"\namplitude = \"30 m/s^2\"\nstart = \"0.05 s\"\nduration = \"0.04 s\"\n",
    "signal = \"velocity-step\"\nvelocity = \"0.3 m/s\"\nstart = \"0.07 s\"\n",
    "signal = \"noise\"\npsd = \"0.4 (m/s^2)^2/Hz\"\nlow = \"3 Hz\"\nhigh = \"40 Hz\"\n",
];

fn text(law: &str, frame: &str, drive: &str) -> String {
    let stop = format!(
        "[stop.table]\nat = \"ball\"\nframe = \"{frame}\"\nside = \"negative\"\ngap = \"2 mm\"\n{law}\n"
    );
    let gravity = "[gravity]\nacceleration = \"-9.81 m/s^2\"\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    format!(
        "[mass.ball]\non = \"nothing\"\nmass = \"1 kg\"\n{stop}{gravity}[drive.d]\nkind = \"base-acceleration\"\nat = \"{frame}\"\n{drive}"
    )
}

/// Position and velocity of the table: the steady displacement of a sinusoid, otherwise the double
/// integral.
fn table_motion(system: &System, t: f64) -> [f64; 2] {
    let drive = system.drives.first().map_or([0.0; 2], |drive| {
        let w = std::f64::consts::TAU * drive.frequency_hz;
        let (sin, cos) = (w * t + drive.phase_rad).sin_cos();
        [
            -drive.amplitude_n / (w * w) * sin,
            -drive.amplitude_n / w * cos,
        ]
    });
    let displaced = system
        .signals
        .iter()
        .filter(|signal| signal.base.is_some())
        .map(|signal| {
            let index = signal.wave.index_at(t);
            Travel::of(&signal.wave).at(index, &signal.wave.piece(index), t)
        });
    displaced.fold(drive, |[x, v], [dx, dv]| [x + dx, v + dv])
}

#[test]
fn a_ball_falls_on_a_moving_table_in_either_frame() {
    for law in LAWS {
        for drive in DRIVES {
            let (inside, outside) = (
                kernel(&text(law, "ground", drive)),
                kernel(&text(law, "table", drive)),
            );
            let table = |t: f64| table_motion(&outside.plant.system, t);
            let [x, v] = table(0.0);
            let mut one = integrator(&inside, &[0.0], &[0.0], 1e-12);
            let mut other = integrator(&outside, &[x], &[v], 1e-12);
            let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
            for k in 1..=12 {
                let time_s = 0.0237 * f64::from(k);
                one.advance_to(time_s).unwrap();
                other.advance_to(time_s).unwrap();
                let ([a, da], [b, db]) = (
                    motion(&one, &inside, "ball"),
                    motion(&other, &outside, "ball"),
                );
                let [x, v] = table(time_s);
                worst = worst.max((b - x - a).abs()).max((db - v - da).abs() / 50.0);
                largest = largest.max(a.abs());
            }
            let contacts = [one.statistics().contacts, other.statistics().contacts];
            let balance =
                [&one, &other].map(|integrator| integrator.energies().residual_relative().abs());
            let name = format!(
                "{}, {}",
                law.lines().next().unwrap(),
                drive.lines().next().unwrap()
            );
            eprintln!(
                "{name}: {contacts:?} contacts, apart by {:.1e}, balances {:.1e} {:.1e}",
                worst / largest,
                balance[0],
                balance[1]
            );
            // The bounces of chatter are counted until they are negligible; the two frames may
            // differ in this count.
            let agree = contacts[0] == contacts[1] || law.contains("rigid");
            assert!(
                agree && contacts.iter().all(|count| *count > 0),
                "{name}: {contacts:?}"
            );
            assert!(
                worst < 1e-9 * largest && balance[1] < 1e-10,
                "{name}: {:e}, {balance:?}",
                worst / largest
            );
        }
    }
}
