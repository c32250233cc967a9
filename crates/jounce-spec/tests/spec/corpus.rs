//! Errors that users see: every invalid file of `crates/jounce-spec/tests/corpus/spec` with all its
//! faults.

use jounce_spec::SpecFile;

#[test]
fn the_faults_of_the_corpus_are_unchanged() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/spec");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    });
    files.sort();
    assert!(files.len() > 40, "the corpus is here");
    for path in files {
        let report = match SpecFile::read(&path) {
            Ok(file) => file
                .spec()
                .map(|_| "no fault".to_owned())
                .unwrap_or_else(|faults| faults.to_string()),
            // The path differs between machines.
            Err(error) => error.to_string().rsplit('/').next().unwrap().to_owned(),
        };
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        insta::assert_snapshot!(name, report);
    }
}
