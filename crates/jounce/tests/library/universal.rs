//! Modes of universal files (data set 55) as structures.

use jounce::{Error, Harvester, ImportOptions, ImportResult, import_matrices};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

/// Mass and stiffness of the chain, kg and N/m.
const MASS: f64 = 0.5;
const STIFFNESS: f64 = 100.0;

/// A mode of a file: frequency, modal mass, damping ratio, and z at the nodes 7 and 2.
type Mode = (f64, f64, f64, [f64; 2]);

/// Two equal masses in a row, the first one on the ground: `w^2 = (3 -+ sqrt 5) / 2 k / m` with the
/// shapes `(1, (1 +- sqrt 5) / 2)`, here at scales 0.3 and -2.
fn chain() -> [Mode; 2] {
    [(-1.0, 0.3, 0.004), (1.0, -2.0, 0.01)].map(|(sign, scale, ratio)| {
        let angular = ((3.0 + sign * 5f64.sqrt()) / 2.0 * STIFFNESS / MASS).sqrt();
        let shape = [scale, scale * (1.0 - sign * 5f64.sqrt()) / 2.0];
        let modal_mass = MASS * (shape[0] * shape[0] + shape[1] * shape[1]);
        (angular / TAU, modal_mass, ratio, shape)
    })
}

/// Data sets 55 with three directions at each node; the highest mode comes first.
fn universal(modes: &[Mode]) -> String {
    let mut text = String::new();
    for (number, (frequency, mass, ratio, shape)) in modes.iter().enumerate().rev() {
        let _ = writeln!(text, "    -1\n    55");
        text += &"NONE\n".repeat(5);
        let _ = writeln!(text, "{:10}{:10}{:10}{:10}{:10}{:10}", 1, 2, 2, 8, 2, 3);
        let _ = writeln!(text, "{:10}{:10}{:10}{:10}", 2, 4, 1, number + 1);
        let _ = writeln!(text, " {frequency:.10e} {mass:.10e} {ratio:.10e} 0.0");
        for (node, z) in [7, 2].into_iter().zip(shape) {
            let _ = writeln!(text, "{node:10}\n 0.0 0.0 {z:.10e}");
        }
        let _ = writeln!(text, "    -1");
    }
    text
}

fn import(folder: &Path, options: &ImportOptions) -> Result<ImportResult, Error> {
    import_matrices(folder.join("modes.uff"), options)
}

fn written(modes: &str, names: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("modes.uff"), modes).expect("a file");
    if !names.is_empty() {
        std::fs::write(folder.path().join("names.csv"), names).expect("a file");
    }
    folder
}

/// Frequencies and shapes are those of the closed form, and those of the matrices of the chain.
#[test]
fn modes_of_a_universal_file_are_those_of_the_chain() -> Result<(), Error> {
    let names = "kind,index,name\npoint,7z,middle\npoint,2z,tip\npoint,2-z,below\n";
    let folder = written(&universal(&chain()), names);
    let result = import(folder.path(), &ImportOptions::default())?;
    assert!(result.warnings.is_empty(), "{result:?}");
    assert_eq!(result.points, ["below", "middle", "tip"]);
    let harvester = Harvester::from_text(&result.spec, ".")?;
    let modal = &harvester.spec().modal["structure"];
    for (k, (frequency, mass, ratio, shape)) in chain().into_iter().enumerate() {
        assert!((modal.frequency_hz[k] / frequency - 1.0).abs() < 1e-9);
        assert!((modal.damping_ratio[k] / ratio - 1.0).abs() < 1e-8);
        let [middle, tip, below] = ["middle", "tip", "below"].map(|name| modal.point[name][k]);
        let sign = (middle * shape[0]).signum() / mass.sqrt();
        assert!((middle / (sign * shape[0]) - 1.0).abs() < 1e-8);
        assert!((tip / (sign * shape[1]) - 1.0).abs() < 1e-8);
        assert_eq!(below, -tip);
    }

    let matrices = tempfile::tempdir().expect("a folder");
    let head = "%%MatrixMarket matrix coordinate real symmetric";
    for (name, text) in [
        (
            "mass.mtx",
            format!("{head}\n2 2 2\n1 1 {MASS}\n2 2 {MASS}\n"),
        ),
        (
            "stiffness.mtx",
            format!("{head}\n2 2 3\n1 1 200\n2 1 -100\n2 2 100\n"),
        ),
        ("names.csv", "kind,index,name\npoint,2,tip\n".to_owned()),
    ] {
        std::fs::write(matrices.path().join(name), text).expect("a file");
    }
    let options = ImportOptions {
        modes: 2,
        damping_ratio: vec![0.004, 0.01],
        ..Default::default()
    };
    let other = import_matrices(matrices.path(), &options)?;
    for (mode, other) in result.modes.iter().zip(&other.modes) {
        assert!((mode.frequency_hz / other.frequency_hz - 1.0).abs() < 1e-9);
        assert!((mode.damping_ratio / other.damping_ratio - 1.0).abs() < 1e-8);
    }
    Ok(())
}

/// A file without damping takes that of the option; units of mass and number of modes apply; names
/// may lie elsewhere; rigid-body modes stay at 0 Hz.
#[test]
fn options_apply_to_modes_of_a_universal_file() -> Result<(), Error> {
    let undamped = chain().map(|(frequency, mass, _, shape)| (frequency, 1e-3 * mass, 0.0, shape));
    let folder = written(&universal(&undamped), "");
    let elsewhere = folder.path().join("points.csv");
    std::fs::write(&elsewhere, "kind,index,name\npoint,2z,tip\n").expect("a file");
    let options = ImportOptions {
        name: "chain".to_owned(),
        modes: 1,
        damping_ratio: vec![0.02],
        mass_unit_kg: 1e3,
        names: Some(elsewhere),
        ..Default::default()
    };
    let result = import(folder.path(), &options)?;
    assert_eq!(
        (result.modes.len(), result.modes[0].damping_ratio),
        (1, 0.02)
    );
    let harvester = Harvester::from_text(&result.spec, ".")?;
    let tip = harvester.spec().modal["chain"].point["tip"][0];
    let (_, mass, _, shape) = chain()[0];
    assert!((tip.abs() / (shape[1].abs() / mass.sqrt()) - 1.0).abs() < 1e-8);

    let mut free = chain().to_vec();
    free[0].0 = 0.0;
    let folder = written(&universal(&free), "");
    let result = import(folder.path(), &ImportOptions::default())?;
    assert_eq!(result.modes[0].frequency_hz, 0.0);
    assert_eq!(result.points, Vec::<String>::new());
    Ok(())
}

#[test]
fn faults_of_universal_files_are_listed() -> Result<(), Error> {
    let good = universal(&chain());
    let message = |modes: &str, names: &str| {
        let folder = written(modes, names);
        let result = import(folder.path(), &ImportOptions::default());
        result.expect_err("a fault").to_string()
    };
    let names = "kind,index,name\npoint,3z,a\npoint,2w,b\npoint,2,c\nelectrode,1,d\npoint,7z,tip\n";
    let found = message(&good, names);
    for line in [
        "names.csv, line 2: the shapes have no node 3; their 2 nodes are numbered from 2 to 7",
        "names.csv, line 3: the index \"2w\" is not a node and a direction, as in 2z or 2-z; the directions of this file are x, y, z",
        "names.csv, line 4: the index \"2\" is not a node and a direction",
        "names.csv, line 5: a universal file has no electrodes; remove the line",
    ] {
        assert!(found.contains(line), "{line}\n{found}");
    }
    let mut wrong = chain();
    wrong[0].1 = 0.0;
    wrong[1].0 = -1.0;
    let found = message(&universal(&wrong), "");
    // The highest mode is the first of the file.
    assert!(
        found.contains("mode 1 of the file has the frequency -1 Hz"),
        "{found}"
    );
    assert!(
        found.contains("mode 2 of the file has no modal mass"),
        "{found}"
    );
    let found = message("a,b\n0,1\n1,2\n2,4\n", "");
    assert!(found.contains("has no modes (data set 55"), "{found}");
    let found = message(&good[..good.len() / 3], "");
    assert!(
        found.contains("is the file truncated?") || found.contains("truncated"),
        "{found}"
    );
    let missing = import_matrices("no-such-place", &ImportOptions::default());
    let found = missing.expect_err("a fault").to_string();
    assert!(found.contains("neither a folder of matrices"), "{found}");
    let options = ImportOptions {
        names: Some("no-such-names.csv".into()),
        ..Default::default()
    };
    let found = import(written(&good, "").path(), &options).expect_err("a fault");
    assert!(found.to_string().contains("no-such-names.csv"), "{found}");
    Ok(())
}
