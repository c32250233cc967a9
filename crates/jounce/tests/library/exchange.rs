//! Models that leave as matrices and circuits, and matrices that come in.

use jounce::{
    BasinsOptions, BranchOptions, Error, ExportOptions, Harvester, ImportOptions, RunOptions,
    import_matrices,
};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);

/// Stop, circuit, drive and run of the harvester of the paper, on the imported structure.
const REST: &str = r#"
[stop.tip]
at = "h.beam-tip"
frame = "ground"
law = "hertz"
gap = "1 mm"
stiffness = "1000 N/m^1.5"

[circuit.load]
patch = "h.mfc"
resistance = "1 Mohm"

[drive.shaker]
at = "h.table"
kind = "force"
amplitude = "200 N"
frequency = "13 Hz"

[run]
start = "rest"
duration = "20 s"
average_over = "10 s"
"#;

fn paper() -> Result<Harvester, Error> {
    Harvester::read(SPEC)
}

fn exported(harvester: &Harvester, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let matrices = Some(folder.to_path_buf());
    Ok(harvester
        .export(&ExportOptions {
            matrices,
            spice: None,
        })?
        .files)
}

/// Mean power of a run, the powers of a branch and the basins are those of the original.
#[test]
fn exported_matrices_are_the_same_harvester() -> Result<(), Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let original = paper()?;
    let files = exported(&original, folder.path())?;
    assert_eq!(files.len(), 9, "{files:?}");
    let options = ImportOptions {
        name: "h".to_owned(),
        modes: 8,
        ..Default::default()
    };
    let imported = import_matrices(folder.path(), &options)?;
    assert!(
        imported.orthogonality < 1e-14 && imported.warnings.is_empty(),
        "{imported:?}"
    );
    let copy = Harvester::from_text(&(imported.spec.clone() + REST), ".")?;
    for frequency in ["11 Hz", "13 Hz"] {
        let power = |harvester: &Harvester| -> Result<f64, Error> {
            let harvester = harvester.changed([("drive.shaker.frequency", frequency)])?;
            Ok(harvester.run(&RunOptions::default())?.mean_power_w)
        };
        let (first, second) = (power(&original)?, power(&copy)?);
        assert!(
            (second / first - 1.0).abs() < 1e-10,
            "{frequency}: {second} for {first}"
        );
    }
    let options = BranchOptions {
        over: "drive.shaker.frequency=12.5Hz:13Hz".to_owned(),
        ..Default::default()
    };
    let (first, second) = (original.branch(&options)?, copy.branch(&options)?);
    let powers = |result: &jounce::BranchResult| -> Result<Vec<f64>, Error> {
        let table = result.table()?;
        Ok(table
            .floats("mean_power_w")
            .map(<[f64]>::to_vec)
            .unwrap_or_default())
    };
    let (first, second) = (powers(&first)?, powers(&second)?);
    assert!(
        !first.is_empty() && first.len() == second.len(),
        "{} {}",
        first.len(),
        second.len()
    );
    for (first, second) in first.iter().zip(&second) {
        assert!((second / first - 1.0).abs() < 1e-10, "{second} for {first}");
    }
    same_basins(&original, &copy)
}

/// The attractors of both harvesters have the same powers, and the same starts end in them.
fn same_basins(original: &Harvester, copy: &Harvester) -> Result<(), Error> {
    let options = BasinsOptions {
        starts: 6,
        ..Default::default()
    };
    let basins = |harvester: &Harvester| -> Result<jounce::BasinsResult, Error> {
        harvester.basins(&options)
    };
    let (first, second) = (basins(original)?, basins(copy)?);
    assert_eq!(first.finished, 6, "{first:?}");
    assert_eq!(first.attractors.len(), second.attractors.len());
    for (first, second) in first.attractors.iter().zip(&second.attractors) {
        assert_eq!(first.period_cycles, second.period_cycles);
        assert_eq!(first.fraction.to_bits(), second.fraction.to_bits());
        let ratio = second.mean_power_w / first.mean_power_w;
        assert!((ratio - 1.0).abs() < 1e-10, "{second:?} for {first:?}");
    }
    let end = |result: &jounce::BasinsResult| -> Vec<Option<usize>> {
        result.points.iter().map(|point| point.attractor).collect()
    };
    assert_eq!(end(&first), end(&second));
    Ok(())
}

/// Stop, circuit, drive and run of the plate with a stop, on its modes.
const REST_OF_PLATE: &str = r#"
[stop.corner]
at = "h.plate-corner"
frame = "ground"
side = "positive"
gap = "0.2 mm"
law = "hertz"
stiffness = "1e6 N/m^1.5"

[circuit.load]
patch = "h.ceramic"
resistance = "20 kohm"

[drive.shaker]
kind = "base-acceleration"
amplitude = "0.3 g"
frequency = "55 Hz"

[run]
duration = "4 s"
average_over = "2 s"
"#;

/// A plate takes as many steps as any structure with its modes: the integration knows modes only, so its
/// time per step and mode is that of beams.
#[test]
fn plates_march_as_their_modes() -> Result<(), Error> {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/plate-de-marqui-2009/stop.toml"
    );
    let plate = Harvester::read(spec)?.changed([("run.duration", "4 s")])?;
    let folder = tempfile::tempdir().expect("a folder");
    exported(&plate, folder.path())?;
    let options = ImportOptions {
        name: "h".to_owned(),
        modes: 6,
        ..Default::default()
    };
    let modes = import_matrices(folder.path(), &options)?;
    let copy = Harvester::from_text(&(modes.spec + REST_OF_PLATE), ".")?;
    let run = |harvester: &Harvester| harvester.run(&RunOptions::default());
    let (first, second) = (run(&plate)?, run(&copy)?);
    let steps = |result: &jounce::RunResult| {
        let work = result.work;
        work.flight_steps + work.flight_rejections + work.contact_steps + work.contact_rejections
    };
    assert!(first.contacts > 50, "{}", first.contacts);
    assert_eq!(first.contacts, second.contacts);
    let ratio = steps(&first) as f64 / steps(&second) as f64;
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    let power = second.mean_power_w / first.mean_power_w;
    assert!((power - 1.0).abs() < 1e-9, "{power}");
    Ok(())
}

/// All faults of a folder are reported, each with its file.
#[test]
fn faults_name_the_files() -> Result<(), Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let message = |options: &ImportOptions| match import_matrices(folder.path(), options) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    };
    let options = ImportOptions {
        modes: 3,
        ..Default::default()
    };
    let text = message(&options);
    assert!(
        text.contains("mass.mtx does not exist") && text.contains("stiffness.mtx does not exist"),
        "{text}"
    );
    exported(&paper()?, folder.path())?;
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    let names = "kind,index,name\npoint,99,tip\nelectrode,2,mfc\n";
    write("names.csv", names);
    write(
        "base.mtx",
        "%%MatrixMarket matrix array real general\n2 1\n1\n1\n",
    );
    write(
        "capacitance.mtx",
        "%%MatrixMarket matrix array real general\n1 1\n-1\n",
    );
    let text = message(&options);
    let expected = [
        "tip has index 99, but there are",
        "mfc has index 2, but there are 1 columns",
        "column 1 of coupling has no name",
        "base has 2 rows, one per degree of freedom, but must have 8",
        "capacitance: entry (1, 1) is -1; it must be positive",
    ];
    expected
        .iter()
        .for_each(|part| assert!(text.contains(part), "{part} in {text}"));
    Ok(())
}

/// Options out of range, and files that are not the matrices of a structure.
#[test]
fn faults_of_options_and_contents() -> Result<(), Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let message = |options: &ImportOptions| match import_matrices(folder.path(), options) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    };
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    let options = ImportOptions {
        modes: 2,
        ..Default::default()
    };
    let none = ImportOptions {
        modes: 0,
        ..Default::default()
    };
    assert!(message(&none).contains("modes is 0; it must be at least 1"));
    let head = "%%MatrixMarket matrix array real general\n2 2\n1\n0.5\n0.4\n1\n";
    write("stiffness.mtx", head);
    write(
        "mass.mtx",
        "%%MatrixMarket matrix array real general\n2 2\n1\n0\nx\n1\n",
    );
    assert!(
        message(&options).contains("mass.mtx, line 5: x is not a finite number"),
        "{}",
        message(&options)
    );
    write("mass.mtx", &head.replace("0.4", "0.5"));
    let text = message(&options);
    assert!(
        text.contains("stiffness: the matrix is not symmetric: entry (1, 2)"),
        "{text}"
    );
    Ok(())
}

/// ngspice computes the mean power of the harvester of the paper within 0.1 %.
#[test]
fn circuit_has_the_same_power() -> Result<(), Error> {
    if Command::new("ngspice").arg("--version").output().is_err() {
        // Written past the capture of the output of tests.
        let text = "SKIPPED: ngspice is not installed (on Debian and Ubuntu: apt install ngspice)";
        let _ = writeln!(std::io::stderr(), "{text}");
        return Ok(());
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("harvester.cir");
    // Fewer modes and a shorter run than those of the paper, to save time; with all of them the powers
    // agree to 2e-6.
    let values = [
        ("drive.shaker.frequency", "11 Hz"),
        ("reduction.modes", "4"),
        ("run.duration", "10 s"),
        ("run.average_over", "4 s"),
    ];
    let harvester = paper()?.changed(values)?;
    harvester.export(&ExportOptions {
        matrices: None,
        spice: Some(path.clone()),
    })?;
    let output = Command::new("ngspice")
        .arg("-b")
        .arg(&path)
        .output()
        .expect("ngspice runs");
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find(|line| line.starts_with("mean_power_1"));
    let word = line
        .and_then(|line| line.split_whitespace().nth(2))
        .unwrap_or_default();
    let circuit: f64 = word.parse().unwrap_or(f64::NAN);
    let power = harvester.run(&RunOptions::default())?.mean_power_w;
    assert!(
        (circuit / power - 1.0).abs() < 1e-3,
        "{circuit} for {power}: {text}"
    );
    Ok(())
}

/// Elements without an equivalent circuit are listed.
#[test]
fn circuits_refuse_what_they_cannot_hold() -> Result<(), Error> {
    let values = [
        ("stop.tip.law", "rigid"),
        ("stop.tip.restitution", "0.5"),
        ("stop.tip.stiffness", ""),
        ("circuit.load.interface", "bridge"),
        ("circuit.load.storage", "1 uF"),
    ];
    let harvester = paper()?.changed(values)?;
    let spice = Some(PathBuf::from("never.cir"));
    let message = match harvester.export(&ExportOptions {
        matrices: None,
        spice,
    }) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    };
    assert!(
        message.contains("circuit load has diodes") && message.contains("stop tip is rigid"),
        "{message}"
    );
    assert!(harvester.export(&ExportOptions::default()).is_err());
    Ok(())
}
