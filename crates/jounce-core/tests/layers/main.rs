//! The code follows the layer list of ARCHITECTURE.md: a folder uses only the folders before it.

mod blanking;
mod layering;
mod paths;

use layering::{Layering, Source};
use std::path::{Path, PathBuf};

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Every Rust file below a folder, with its path from there.
fn sources(folder: &Path, inside: &Path) -> Vec<Source> {
    let mut sources_found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("the folder can be listed").path();
        let name = inside.join(path.file_name().expect("an entry of a folder has a name"));
        if path.is_dir() {
            sources_found.extend(sources(&path, &name));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).expect("sources are UTF-8");
            sources_found.push(Source {
                path: name.to_string_lossy().replace('\\', "/"),
                text,
            });
        }
    }
    sources_found.sort_by(|a, b| a.path.cmp(&b.path));
    sources_found
}

#[test]
fn every_arrow_points_to_the_left() {
    let architecture =
        std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md is there");
    let mut faults = Vec::new();
    for name in ["jounce", "jounce-core", "jounce-measure"] {
        let layering = Layering::from_markdown(&architecture, name)
            .expect("ARCHITECTURE.md has a layer list for each library");
        let sources = sources(&root().join("crates").join(name).join("src"), Path::new(""));
        faults.extend(
            layering
                .faults(&sources)
                .into_iter()
                .map(|fault| format!("{name}: {fault}")),
        );
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
