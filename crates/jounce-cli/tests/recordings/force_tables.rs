//! A measured pulse becomes the force table of a stop: `contact --mass`, and `law = "table"` with a `file`.

use super::{assert_written, csv, jounce};
use std::path::Path;

/// Mass, kg, and speed, m/s, of a steel ball, and the stiffness of its stop, N/m^1.5.
const MASS: f64 = 0.1;
const SPEED: f64 = 0.5;
const STIFFNESS: f64 = 1e8;
const RATE: f64 = 200_000.0;

/// Greatest penetration of an impact with Hertz's law: (5 m v^2 / (4 k))^(2/5) (Goldsmith 1960).
fn deepest_m() -> f64 {
    (1.25 * MASS * SPEED * SPEED / STIFFNESS).powf(0.4)
}

/// Pulse of an impact with Hertz's law, by small steps of the leapfrog method.
fn write_pulse(path: &Path) {
    let force = |d: f64| STIFFNESS * d.max(0.0).powf(1.5);
    let step = 1.0 / (200.0 * RATE);
    let (mut d, mut v, mut pulse) = (0.0_f64, SPEED, vec![0.0; 100]);
    for k in 0..100_000 {
        if k % 200 == 70 {
            pulse.push(force(d));
        }
        v -= 0.5 * step * force(d) / MASS;
        d += step * v;
        v -= 0.5 * step * force(d) / MASS;
    }
    pulse.resize(4000, 0.0);
    let rows = pulse.iter().enumerate();
    csv(
        path,
        "time [s],hammer [N]",
        rows.map(|(k, force)| vec![k as f64 / RATE, *force]),
    );
}

/// A free ball, and a stop 0.1 mm away that it strikes with the speed.
fn spec(law: &str) -> String {
    format!(
        "[mass.ball]\non = \"nothing\"\nmass = \"{MASS} kg\"\nvelocity = \"{SPEED} m/s\"\n\
         [stop.s]\nat = \"ball\"\ngap = \"0.1 mm\"\n{law}\n\
         [run]\nduration = \"4 ms\"\naverage_over = \"4 ms\"\ntolerance = 1e-9\n"
    )
}

/// The ball strikes the table as deep and as hard as Hertz's law in closed form.
#[test]
fn a_measured_pulse_gives_the_table_of_a_stop() {
    let folder = tempfile::tempdir().unwrap();
    write_pulse(&folder.path().join("pulse.csv"));
    let mut arguments = vec!["contact", "pulse.csv", "--mass", "0.1kg", "--out", "out"];
    let (code, _, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    let out = folder.path().join("out");
    assert_written(&out, &["contact", "force-table-1"], &["contact-pulses"]);
    arguments.extend(["--speed", "0.5m/s", "--json"]);
    let (_, json, _) = jounce(folder.path(), &arguments);
    let table = &json["force_tables"][0];
    let [depths, forces] = ["penetration_m", "force_n"].map(|name| table[name].as_array().unwrap());
    assert_eq!(
        (depths.len(), &table["speed_m_s"]),
        (forces.len(), &SPEED.into())
    );
    let peak = STIFFNESS * deepest_m().powf(1.5);
    for (depth, force) in depths.iter().zip(forces) {
        let law = STIFFNESS * depth.as_f64().unwrap().powf(1.5);
        assert!(
            (force.as_f64().unwrap() - law).abs() < 2e-4 * peak,
            "{depth}"
        );
    }

    let laws = [
        (
            "table.toml",
            "law = \"table\"\nfile = \"out/force-table-1.csv\"".to_owned(),
        ),
        (
            "hertz.toml",
            format!("law = \"hertz\"\nstiffness = \"{STIFFNESS} N/m^1.5\""),
        ),
    ];
    for (name, law) in laws {
        std::fs::write(folder.path().join(name), spec(&law)).unwrap();
        let (code, json, stderr) = jounce(folder.path(), &["run", name, "--json"]);
        assert_eq!(code, 0, "{stderr}");
        let depth = json["max_penetration_m"].as_f64().unwrap();
        let force = json["max_contact_force_n"].as_f64().unwrap();
        assert!((depth / deepest_m() - 1.0).abs() < 3e-4, "{name}: {depth}");
        assert!((force / peak - 1.0).abs() < 3e-4, "{name}: {force}");
    }
}

#[test]
fn wrong_speeds_and_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    write_pulse(&folder.path().join("pulse.csv"));
    let cases: [(&[&str], i32, &str); 3] = [
        (
            &["--speed", "0.5m/s"],
            2,
            "--speed is 0.5 m/s; give the mass of the hammer",
        ),
        (
            &["--mass", "0.1kg", "--speed", "0m/s"],
            2,
            "--speed is 0 m/s; it must be",
        ),
        (
            &["--mass", "0.1kg", "--speed", "5 kg"],
            2,
            "expected a speed",
        ),
    ];
    for (options, expected, message) in cases {
        let arguments = [&["contact", "pulse.csv"], options].concat();
        let (code, _, stderr) = jounce(folder.path(), &arguments);
        assert_eq!(code, expected, "{stderr}");
        assert!(stderr.contains(message), "{message}\n{stderr}");
    }
    let arguments = [
        "contact",
        "pulse.csv",
        "--mass",
        "0.1kg",
        "--speed",
        "2m/s",
        "--json",
    ];
    let (code, json, _) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0);
    let reason = json["force_tables"][0]["reason"].as_str().unwrap();
    assert!(
        reason.contains(
            "is not 1 to 2 times the momentum of the hammer, 2.0000e-1 N s; correct its mass"
        ),
        "{reason}"
    );

    let law = "law = \"table\"\nfile = \"absent.csv\"";
    std::fs::write(folder.path().join("spec.toml"), spec(law)).unwrap();
    let (code, _, stderr) = jounce(folder.path(), &["check", "spec.toml"]);
    assert_eq!(code, 4, "{stderr}");
    assert!(
        stderr.contains("line 9, column 8: stop.s.file") && stderr.contains("absent.csv"),
        "{stderr}"
    );
}
