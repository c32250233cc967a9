//! Gathers the specs under `examples/` into a table, and declares to the linker that Python's symbols come later.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn main() {
    pyo3_build_config::add_extension_module_link_args();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    println!("cargo::rerun-if-changed={}", root.display());
    let mut table = String::from("&[\n");
    for system in listed(&root) {
        for spec in listed(&system).iter().filter(|path| is_spec(path)) {
            let name = |path: &Path| {
                path.file_stem()
                    .map(|name| name.to_string_lossy().into_owned())
                    .unwrap_or_default()
            };
            let path = spec.canonicalize().expect("a listed file exists");
            writeln!(
                table,
                "    ({:?}, {:?}, include_str!({path:?})),",
                name(&system),
                name(spec)
            )
            .expect("a string takes everything");
        }
    }
    table.push(']');
    let out =
        PathBuf::from(std::env::var("OUT_DIR").expect("cargo sets OUT_DIR")).join("examples.rs");
    std::fs::write(out, table).expect("the folder of the build can be written");
}

/// `expected.toml` holds the numbers that a system is published with, `measured.toml` what was measured on it,
/// `study.toml` what is varied of it, `design.toml` what is searched. A spec that reads a recording
/// needs its file beside it, which the module does not carry.
fn is_spec(path: &Path) -> bool {
    let reads_none = || {
        std::fs::read_to_string(path)
            .is_ok_and(|text| !text.lines().any(|line| line.starts_with("file = ")))
    };
    path.extension()
        .is_some_and(|extension| extension == "toml")
        && path.file_name().is_some_and(|name| {
            ![
                "expected.toml",
                "measured.toml",
                "study.toml",
                "design.toml",
            ]
            .iter()
            .any(|other| name == *other)
        })
        && reads_none()
}

/// What a folder holds, by name.
fn listed(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut found: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    found.sort();
    found
}
