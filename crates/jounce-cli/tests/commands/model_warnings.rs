//! Warnings of a run outside the assumptions of the model.

use crate::jounce;
use crate::warnings::{SINE, STRIP, write_spec};

/// A square plate of 100 mm: its twentieth mode has a half-wavelength of about 25 mm.
#[test]
fn a_thick_plate_gives_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[plate.lid]\nmaterial = \"aluminium\"\nlength = \"100 mm\"\nwidth = \"100 mm\"\nthickness = \"5 mm\"\nleft = \"clamped\"\n\
        [damping]\nbeyond = 0.01\n[reduction]\nmodes = 20\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"1 g\"\nfrequency = \"50 Hz\"\n\
        [run]\nstart = \"linear\"\nduration = \"0.2 s\"\naverage_over = \"0.1 s\"\n";
    let (code, run, text_out) = jounce(&["run", &write_spec(&folder, text), "--json"]);
    let warning = &run["warnings"][0];
    assert!(
        code == 0
            && warning["warning"] == "thick-plate"
            && text_out.contains("plate lid: its thickness of 5 mm"),
        "{run} {text_out}"
    );
    let half_wavelength_m = warning["half_wavelength_m"].as_f64().unwrap();
    assert!((0.02..0.035).contains(&half_wavelength_m), "{run}");
    let thin = text.replace("5 mm", "0.5 mm");
    let (_, run, _) = jounce(&["run", &write_spec(&folder, &thin), "--json"]);
    assert!(run["warnings"].as_array().unwrap().is_empty(), "{run}");
}

/// Each warning with the change of the spec that causes it.
#[test]
fn a_run_outside_the_model_gives_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_spec(&folder, &format!("{STRIP}{SINE}"));
    for (kind, key, part) in [
        (
            "thick-beam",
            "beam.s.thickness=40 mm",
            "3.0 thicknesses long",
        ),
        (
            "composite-thickness",
            "patch.m.thickness=3 mm",
            "3.0000 mm, but the constants of MFC-P2 are those of a product 0.3000 mm thick",
        ),
        (
            "large-deflection",
            "drive.b.amplitude=200 g",
            "of its length",
        ),
        ("part-of-period", "run.average_over=10 ms", "0.330 periods"),
        ("part-of-period", "run.average_over=0.5 s", "16.500 periods"),
    ] {
        let (code, run, text) = jounce(&["run", &spec, "--json", "--set", key]);
        let warnings = run["warnings"].as_array().unwrap();
        let has = warnings.iter().any(|warning| warning["warning"] == kind);
        assert!(code == 0 && has && text.contains(part), "{key}: {text}");
        // What needs no integration is known to `check`.
        let (code, check, text) = jounce(&["check", &spec, "--json", "--set", key]);
        let is_known = check["warnings"].to_string().contains(kind) && text.contains(part);
        assert!(
            code == 0 && is_known == (kind != "large-deflection"),
            "{key}: {check} {text}"
        );
    }
    let whole = [
        "run.average_over=0.3333333333333333 s",
        "drive.b.amplitude=0.01 g",
    ];
    let (_, run, _) = jounce(&["run", &spec, "--json", "--set", whole[0], "--set", whole[1]]);
    assert_eq!(run["warnings"].as_array().unwrap().len(), 0, "{run}");
    let still = write_spec(&folder, STRIP);
    let (_, _, text) = jounce(&["run", &still]);
    assert!(text.contains("the spec has no drive"), "{text}");
}

/// A list of damping ratios is longer than the modes, and a thin skin thicker than its beam; a laminate
/// may be, as the ceramic of a bimorph on its shim.
#[test]
fn what_the_model_ignores_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_spec(&folder, &format!("{STRIP}{SINE}"));
    let warnings = |set: &[&str]| {
        let set = set.iter().flat_map(|one| ["--set", one]);
        let whole = ["--set", "run.average_over=0.3333333333333333 s"];
        let arguments = ["check", &spec, "--json"].into_iter().chain(whole);
        let arguments: Vec<&str> = arguments.chain(set).collect();
        let (code, check, text) = jounce(&arguments);
        assert_eq!(code, 0, "{text}");
        check["warnings"].clone()
    };
    let ratios = ["damping.ratios=[0.01, 0.02, 0.03]", "reduction.modes=2"];
    let found = warnings(&ratios);
    assert_eq!(found[0]["warning"], "unused-ratios", "{found}");
    assert_eq!(
        (&found[0]["listed"], &found[0]["used"]),
        (&3.into(), &2.into())
    );
    assert_eq!(
        warnings(&[ratios[0], "reduction.modes=3"]),
        serde_json::json!([])
    );
    let skin = ["patch.m.section=thin-skin", "beam.s.thickness=0.2 mm"];
    let found = warnings(&skin);
    assert_eq!(found[0]["warning"], "thick-skin", "{found}");
    assert_eq!(warnings(&skin[1..]), serde_json::json!([]));
}

/// Penetrations of 0.6 um at displacements of 300 um: their roundoff is 7e-12 of the energy.
#[test]
fn a_residual_above_the_tolerance_gives_a_warning() {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/seismic-mass-jacquelin-2011/harvester.toml"
    );
    let short = ["--set", "run.duration=1s", "--set", "run.average_over=0.5s"];
    for tolerance in ["1e-9", "1e-13"] {
        let (code, run, text) = jounce(
            &[
                &["run", spec, "--json", "--tolerance", tolerance],
                &short[..],
            ]
            .concat(),
        );
        assert_eq!(code, 0, "{text}");
        let residual = run["energy_residual_relative"].as_f64().unwrap().abs();
        let exceeds = residual > tolerance.parse().unwrap();
        assert_eq!(exceeds, tolerance == "1e-13", "{residual:e}");
        let message = format!("more than the tolerance of {tolerance}");
        assert_eq!(text.contains(&message), exceeds, "{text}");
        let warnings = run["warnings"].as_array().unwrap();
        let found = warnings.iter().find(|one| one["warning"] == "unbalanced");
        assert_eq!(found.is_some(), exceeds, "{run}");
    }
}
