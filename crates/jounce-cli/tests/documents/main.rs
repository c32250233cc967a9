//! README and book say what is true: every command in them runs, every spec in them is valid, every Rust block is a doctest.
//!
//! | block | what is done with it |
//! |---|---|
//! | `sh`, `console` | its commands run in order in a folder with a copy of `examples/`; each must succeed |
//! | `toml spec` | `jounce check` must accept it |
//! | `toml part` | the same, its tables put in place of those of the paper's spec |
//! | `toml study`, `toml design` | it must be a study, or a design, of the paper's spec |
//! | `rust`, `rust,no_run` | the document must be among the doctests of the library |
//! | `python` | `python/tests/test_documents.py` runs it |
//! | `pycon` | `python/tests/test_docstrings.py` runs it: the reference of the package shows the examples of its docstrings |
//! | `text` | nothing |

mod block;
mod commands;
mod links;
mod paper;
mod paths;
mod pictures;
mod specs;

use block::{Block, blocks};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// An empty folder of that name for this test run.
fn empty_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("documents")
        .join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).expect("the folder of an earlier run can be removed");
    }
    std::fs::create_dir_all(&folder).expect("a folder can be made in the target folder");
    folder
}

/// The files of a folder and its subfolders with an extension, by paths from the root.
fn files(folder: &str, extension: &str) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![PathBuf::from(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(root().join(&folder)).expect("the folder is there") {
            let path = folder.join(entry.expect("the folder can be listed").file_name());
            if root().join(&path).is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|found| found == extension) {
                files.push(path.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    files.sort();
    files
}

/// README, ARCHITECTURE and every page of the book, by paths from the root.
fn documents() -> Vec<String> {
    let mut documents = files("book/src", "md");
    documents.extend(["ARCHITECTURE.md".to_owned(), "README.md".to_owned()]);
    documents.sort();
    documents
}

/// The blocks of every document with a property.
fn all_blocks(is_selected: impl Fn(&Block) -> bool) -> Vec<Block> {
    let read = |document: &String| {
        std::fs::read_to_string(root().join(document)).expect("documents are UTF-8")
    };
    documents()
        .iter()
        .flat_map(|document| blocks(document, &read(document)))
        .filter(is_selected)
        .collect()
}

fn assert_none(faults: Vec<String>) {
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_block_names_its_language() {
    assert_none(
        all_blocks(|_| true)
            .iter()
            .filter_map(Block::fault)
            .collect(),
    );
}

#[test]
fn every_command_works() {
    let selected = all_blocks(Block::is_shell);
    assert!(
        selected.iter().any(|block| block.document == "README.md"),
        "README shows no command"
    );
    // Each document has a folder of its own, so the documents run at once.
    let by_document: Vec<&[Block]> = selected.chunk_by(|a, b| a.document == b.document).collect();
    let faults = by_document.into_par_iter().flat_map_iter(|blocks| {
        let folder = empty_folder(&blocks[0].document.replace('/', "-"));
        commands::copy(&root().join("examples"), &folder.join("examples"));
        let mut faults: Vec<String> = blocks
            .iter()
            .flat_map(|block| commands::faults(block, &folder))
            .collect();
        faults.extend(pictures::faults(&blocks[0].document, &folder));
        faults
    });
    assert_none(faults.collect());
}

#[test]
fn every_link_leads_somewhere_and_every_picture_has_alternative_text() {
    let read = |document: &String| {
        std::fs::read_to_string(root().join(document)).expect("documents are UTF-8")
    };
    let faults = documents().into_iter().flat_map(|document| {
        let links = links::links(&read(&document));
        links
            .iter()
            .filter_map(|link| links::fault(&document, link))
            .collect::<Vec<_>>()
    });
    assert_none(faults.collect());
}

/// A comment that names a test, and a page for contributors, name paths from the root.
#[test]
fn every_test_named_in_a_comment_and_every_path_for_contributors_exists() {
    let mut faults = Vec::new();
    for page in paths::PAGES {
        let text = std::fs::read_to_string(root().join(page)).expect("documents are UTF-8");
        let found = paths::faults(&text);
        faults.extend(found.into_iter().map(|fault| format!("{page}: {fault}")));
    }
    for file in files("crates", "rs") {
        let text = std::fs::read_to_string(root().join(&file)).expect("sources are UTF-8");
        let comments = text
            .lines()
            .filter(|line| line.trim_start().starts_with("//"));
        let names = comments.flat_map(|line| line.split('`').skip(1).step_by(2));
        let missing = names.filter(|name| {
            let is_path = name.contains('/') && name.split('/').any(|part| part == "tests");
            is_path && !root().join(name).exists()
        });
        faults.extend(missing.map(|name| format!("{file}: there is no {name}")));
    }
    assert_none(faults);
}

#[test]
fn every_spec_is_valid() {
    let selected = all_blocks(Block::is_spec);
    assert!(!selected.is_empty(), "no document shows a spec");
    let folder = empty_folder("specs");
    let base = root().join("examples/impact-harvester-2019/harvester.toml");
    let base = std::fs::read_to_string(base).expect("the paper's spec is there");
    assert_none(
        selected
            .iter()
            .filter_map(|block| specs::fault(block, &base, &folder))
            .collect(),
    );
}

#[test]
fn every_study_and_every_design_is_valid() {
    let base_folder = root().join("examples/impact-harvester-2019");
    let error_of = |block: &Block| {
        if block.info == "toml study" {
            let study = jounce_analysis::study::Study::parse(&block.text, &base_folder);
            return study.err().map(|error| error.to_string());
        }
        let path = empty_folder("design").join("design.toml");
        let named = block.text.replace(
            "harvester.toml",
            &base_folder.join("harvester.toml").display().to_string(),
        );
        std::fs::write(&path, named).expect("the folder is ours");
        jounce::Design::read(&path)
            .err()
            .map(|error| error.to_string())
    };
    for kind in ["toml study", "toml design"] {
        let selected = all_blocks(|block| block.info == kind);
        assert!(!selected.is_empty(), "no document shows a block `{kind}`");
        let fault = |block: Block| {
            let error = error_of(&block)?;
            Some(format!("{}: it is refused\n{error}", block.location()))
        };
        assert_none(selected.into_iter().filter_map(fault).collect());
    }
}

#[test]
fn every_document_with_rust_is_a_doctest() {
    let library = std::fs::read_to_string(root().join("crates/jounce/src/lib.rs"))
        .expect("the library is there");
    let included =
        |document: &str| library.contains(&format!("include_str!(\"../../../{document}\")"));
    let mut missing: Vec<String> = all_blocks(Block::is_rust)
        .into_iter()
        .map(|block| block.document)
        .collect();
    missing.dedup();
    missing.retain(|document| !included(document));
    assert!(
        missing.is_empty(),
        "documents with Rust that lib.rs does not include: {}",
        missing.join(", ")
    );
}

/// A picture of the harvester that is out of date would show another one than the text.
#[test]
fn the_drawing_in_the_book_is_the_one_that_show_makes() {
    let folder = empty_folder("drawing");
    commands::copy(&root().join("examples"), &folder.join("examples"));
    let arguments = [
        "show",
        "examples/impact-harvester-2019/harvester.toml",
        "--out",
        "harvester.svg",
    ];
    assert_cmd::Command::cargo_bin("jounce")
        .expect("the program is built")
        .args(arguments)
        .current_dir(&folder)
        .assert()
        .success();
    let read = |path: PathBuf| std::fs::read_to_string(path).expect("the picture is there");
    assert!(
        read(folder.join("harvester.svg")) == read(root().join("book/src/pictures/harvester.svg")),
        "draw the picture again"
    );
}
