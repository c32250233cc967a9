//! The paper on jounce, `paper/paper.md`: its form, its references, its figures.

use super::{assert_none, empty_folder, root};
use std::collections::BTreeSet;
use std::process::Command;

/// Sections that the Journal of Open Source Software requires.
const SECTIONS: [&str; 8] = [
    "Summary",
    "Statement of need",
    "State of the field",
    "Software design",
    "Research impact statement",
    "AI usage disclosure",
    "Acknowledgements",
    "References",
];

/// Number of words that the journal allows.
const WORDS: std::ops::RangeInclusive<usize> = 750..=1750;

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).expect("the file is there")
}

/// The text below the metadata.
fn body() -> String {
    let paper = read("paper/paper.md");
    let mut parts = paper.splitn(3, "---\n");
    parts.nth(2).expect("the paper has metadata").to_owned()
}

/// Keys of the citations, `@key`.
fn citations() -> BTreeSet<String> {
    let body = body();
    let key = |text: &str| -> String {
        let is_key = |letter: &char| letter.is_ascii_alphanumeric() || *letter == '-';
        text.chars().take_while(is_key).collect()
    };
    body.split('@').skip(1).map(key).collect()
}

/// Entries of a bibliography in BibTeX, with their keys.
fn entries(bibliography: &str) -> Vec<(String, String)> {
    let entry = |text: &str| {
        let (key, _) = text.split_once('{')?.1.split_once(',')?;
        Some((key.to_owned(), format!("@{}", text.trim())))
    };
    bibliography.split('@').skip(1).filter_map(entry).collect()
}

#[test]
fn the_paper_has_the_sections_and_the_length_of_its_journal() {
    let body = body();
    let headings: Vec<&str> = body
        .lines()
        .filter_map(|line| line.strip_prefix("# "))
        .collect();
    assert_eq!(headings, SECTIONS);
    let words = body.split_whitespace().count();
    assert!(WORDS.contains(&words), "{words} words");
    let citation = read("CITATION.cff");
    let paper = read("paper/paper.md");
    let author = citation
        .lines()
        .find_map(|line| line.trim().strip_prefix("- name: "))
        .expect("CITATION.cff names the authors");
    assert!(paper.contains(&format!("- name: {author}\n")), "{author}");
}

/// Every citation has an entry, every entry is cited, and is that of `jounce cite`.
#[test]
fn the_references_of_the_paper_are_those_of_the_program() {
    let stored = entries(&read("paper/paper.bib"));
    let keys: BTreeSet<String> = stored.iter().map(|(key, _)| key.clone()).collect();
    assert_eq!(keys, citations(), "paper.bib and the citations of paper.md");
    let spec = read("examples/impact-harvester-2019/harvester.toml");
    let own = "publications = [\"impact-harvester-2019\"]";
    assert!(spec.contains(own));
    let path = empty_folder("paper").join("harvester.toml");
    let named = format!("publications = {:?}", keys.iter().collect::<Vec<_>>());
    std::fs::write(&path, spec.replace(own, &named)).expect("the folder is ours");
    let output = Command::new(env!("CARGO_BIN_EXE_jounce"))
        .arg("cite")
        .arg(&path)
        .arg("--bibtex")
        .output()
        .expect("the program starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let known = entries(&String::from_utf8_lossy(&output.stdout));
    let differs = |entry: &&(String, String)| !known.contains(entry);
    let fault =
        |(key, _): &(String, String)| format!("paper.bib: {key} is not that of `jounce cite`");
    assert_none(stored.iter().filter(differs).map(fault).collect());
}

/// Every number of a table of the paper is in the row of its method in the benchmarks.
#[test]
fn the_figures_of_the_paper_are_those_of_the_benchmarks() {
    let cells = |line: &str| -> Vec<String> {
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    };
    let results = read("bench/RESULTS.md");
    let orbits = read("bench/ORBITS.md");
    let first_table = results
        .split("### ")
        .find(|part| part.starts_with("50 N at 11 Hz"))
        .expect("the first case is there");
    let first_table = first_table.split("| method | setting").next().unwrap_or("");
    let rows: Vec<Vec<String>> = first_table
        .lines()
        .chain(orbits.lines())
        .filter(|line| line.starts_with('|'))
        .map(cells)
        .collect();
    let body = body();
    let table = body.lines().filter(|line| line.starts_with('|'));
    let mut checked = 0;
    let mut faults = Vec::new();
    for row in table
        .map(cells)
        .filter(|row| row[0] != "method" && !row[0].starts_with("---"))
    {
        let of_method: Vec<&Vec<String>> = rows.iter().filter(|own| own[0] == row[0]).collect();
        for cell in &row[1..] {
            let holds = |own: &String| own == cell || own.starts_with(&format!("{cell} "));
            let found = of_method.iter().any(|own| own[1..].iter().any(holds));
            checked += 1;
            if !found {
                faults.push(format!("{}: {cell} is not in the benchmarks", row[0]));
            }
        }
    }
    assert_none(faults);
    assert_eq!(checked, 6 * 4 + 4 * 3);
}
