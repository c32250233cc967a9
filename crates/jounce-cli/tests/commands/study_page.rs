//! `jounce study page`: one file with the table and its charts; its table is that of the study, and is made again.

use crate::{SPEC, jounce};
use jounce::Table;
use std::path::{Path, PathBuf};

/// Writes a study of 12 points in 4 parts.
fn study(folder: &Path) -> String {
    let text = format!(
        "spec = {SPEC:?}\npoints_per_part = 3\n[set]\n\"run.duration\" = \"1 s\"\n\"run.average_over\" = \"0.5 s\"\n\
         [vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm:4x\"\n\"drive.shaker.frequency\" = \"10Hz:14Hz:3x\"\n"
    );
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn run(arguments: &[&str]) -> serde_json::Value {
    let (code, json, text) = jounce(&[arguments, &["--json"]].concat());
    assert_eq!(code, 0, "{arguments:?}: {text}");
    json
}

/// Runs the study into a folder and writes its page; returns both paths as text.
fn page(folder: &Path, name: &str) -> (String, String) {
    let file = study(folder);
    let text = |path: PathBuf| path.to_str().unwrap().to_owned();
    let (out, page) = (
        text(folder.join(name)),
        text(folder.join("pages/page.html")),
    );
    run(&["study", "run", &file, "--out", &out]);
    assert_eq!(
        run(&["study", "page", &out, "--out", &page])["page"],
        page.as_str()
    );
    (out, page)
}

#[test]
fn the_page_holds_the_numbers_of_the_study_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (out, page) = page(folder.path(), "power");
    let (stored, manifest) = Table::read(&Path::new(&out).join("study.parquet")).unwrap();
    let (shown, shown_manifest) = Table::read(Path::new(&page)).unwrap();
    assert_eq!(shown_manifest, manifest);
    assert_eq!(shown.rows(), 12);
    assert_eq!(shown.columns().len(), stored.columns().len());
    for (a, b) in stored.columns().iter().zip(shown.columns()) {
        assert_eq!((&a.name, &a.unit, &a.about), (&b.name, &b.unit, &b.about));
        for row in 0..12 {
            assert_eq!(a.values.text(row), b.values.text(row), "{} {row}", a.name);
        }
    }
    let bits = |table: &Table| -> Vec<u64> {
        let power_w = table.floats("mean_power_w").unwrap();
        power_w.iter().map(|x| x.to_bits()).collect()
    };
    assert_eq!(bits(&stored), bits(&shown));
}

/// Nothing but the name of the SVG format looks like an address, nothing is loaded, and the page may
/// load nothing.
#[test]
fn the_page_needs_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    let (_, page) = page(folder.path(), "a&<b>");
    let html = std::fs::read_to_string(page).unwrap();
    for part in ["src=", "<link", "@import", "fetch(", "XMLHttp", "import("] {
        assert!(!html.contains(part), "{part}");
    }
    // A clip path of a saved picture lies in this picture.
    let [all, own] = ["url(", "url(#"].map(|part| html.matches(part).count());
    assert_eq!(all, own);
    let (head, data) = html
        .split_once("<script type=\"application/json\"")
        .unwrap();
    let (_, script) = data.split_once("</script>").unwrap();
    for text in [head, script] {
        let addresses = text.matches("://").count();
        let names = text.matches("http://www.w3.org/").count();
        assert_eq!(addresses, names);
    }
    assert!(html.contains(
        "Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'"
    ));
    assert!(html.contains("<title>a&amp;&lt;b></title>"));
    assert_eq!(
        html.matches("<!--").count(),
        0,
        "every mark of the page is replaced"
    );
}

#[test]
fn the_table_of_a_study_and_its_page_are_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let (out, page) = page(folder.path(), "power");
    let table = format!("{out}/study.parquet");
    for file in [&table, &page] {
        let json = run(&["rerun", file]);
        assert_eq!(json["equal"], true, "{json}");
        assert_eq!(json["rows"], 12);
        let arguments = json["arguments"].as_array().unwrap();
        assert_eq!(
            (&arguments[0], &arguments[1]),
            (&"study".into(), &"run".into())
        );
    }
    let html = std::fs::read_to_string(&page).unwrap();
    let (before, values) = html.split_once("\"values\":[[").unwrap();
    let changed = values.replacen("0.0005,", "0.00050000000000000001e0,", 1);
    assert_ne!(changed, values);
    // The same number in other digits is no change; another number is.
    std::fs::write(&page, format!("{before}\"values\":[[{changed}")).unwrap();
    assert_eq!(run(&["rerun", &page])["equal"], true);
    let changed = values.replacen("0.0005,", "0.0005000000000000001,", 1);
    std::fs::write(&page, format!("{before}\"values\":[[{changed}")).unwrap();
    let (code, _, text) = jounce(&["rerun", &page]);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains(
            "column stop.tip.gap, row 1: the file has 0.0005000000000000001, computed 0.0005"
        ),
        "{text}"
    );
}

/// The record is that of the first command: whoever joins the table, it has the same bytes.
#[test]
fn the_record_does_not_depend_on_the_shards() {
    let folder = tempfile::tempdir().unwrap();
    let file = study(folder.path());
    let out = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    run(&["study", "run", &file, "--out", &out("one")]);
    for shard in ["2/2", "1/2"] {
        run(&[
            "study",
            "run",
            &file,
            "--out",
            &out("two"),
            "--shard",
            shard,
        ]);
    }
    let read = |name: &str| std::fs::read(folder.path().join(name).join("study.parquet")).unwrap();
    assert!(read("one") == read("two"));
    assert_eq!(
        run(&["rerun", &format!("{}/study.parquet", out("two"))])["equal"],
        true
    );
}

#[test]
fn a_study_that_is_unfinished_or_none_has_no_page() {
    let folder = tempfile::tempdir().unwrap();
    let file = study(folder.path());
    let half = folder.path().join("half").to_str().unwrap().to_owned();
    run(&["study", "run", &file, "--out", &half, "--shard", "1/2"]);
    let page = folder.path().join("a.html").to_str().unwrap().to_owned();
    let (code, _, text) = jounce(&["study", "page", &half, "--out", &page]);
    assert_eq!(code, 4);
    assert!(text.contains("2 of 4 parts are missing"), "{text}");
    let none = folder.path().to_str().unwrap();
    let (code, _, text) = jounce(&["study", "page", none, "--out", &page]);
    assert!(code == 4 && text.contains("holds no study"), "{text}");
    let (code, _, text) = jounce(&["study", "page", &half, "--out", "power.pdf"]);
    assert_eq!(code, 2);
    assert!(
        text.contains("--out power.pdf: give a file whose name ends in .html"),
        "{text}"
    );
    assert!(!Path::new(&page).exists());
    std::fs::write(&page, "<html></html>").unwrap();
    let (code, _, text) = jounce(&["rerun", &page]);
    assert!(
        code == 4 && text.contains("it is no page of jounce with a table"),
        "{text}"
    );
}
