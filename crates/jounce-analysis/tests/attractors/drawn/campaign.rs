//! Comparison of many harvesters in portions, with a file of results from which an interrupted one
//! continues.

use super::tally::Tally;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

/// Harvesters of a portion.
const PORTION: u64 = 1_000;

/// Compares harvesters `first` to `first + count`, without the portions in a file, and appends the
/// counts of each portion to it. Returns the numbers of the harvesters that disagree.
pub fn campaign(first: u64, count: u64, results: Option<&Path>) -> Vec<u64> {
    let known = results.map_or(Vec::new(), |path| {
        finished(&std::fs::read_to_string(path).unwrap_or_default())
    });
    let mut disagree = Vec::new();
    let (mut begin, end) = (first, first + count);
    while begin < end {
        let portion = [begin, PORTION.min(end - begin)];
        if !known.contains(&portion) {
            let tally = Tally::of(begin, portion[1]);
            eprintln!("{tally}");
            disagree.extend(tally.disagree.iter().map(|(index, _)| *index));
            if let Some(path) = results {
                let file = OpenOptions::new().create(true).append(true).open(path);
                // One write, which is complete or missing after an interruption.
                let text = format!("{tally} end\n");
                file.unwrap().write_all(text.as_bytes()).unwrap();
            }
        }
        begin += portion[1];
    }
    disagree
}

/// First number and count of each complete portion of a file.
fn finished(text: &str) -> Vec<[u64; 2]> {
    let complete = text
        .split_inclusive(" end\n")
        .filter(|part| part.ends_with(" end\n"));
    let portion = |part: &str| {
        let line = part.lines().find(|line| line.starts_with("first "))?;
        let words: Vec<&str> = line.split_whitespace().collect();
        Some([words[1].parse().ok()?, words[3].parse().ok()?])
    };
    complete.filter_map(portion).collect()
}

#[test]
fn complete_portions_of_a_file_are_found() {
    let text = "first 0 count 10 agree 9\n  disagree 3: state end\nfirst 10 count 10 agree 10 end\nfirst 20 count 10 agr";
    assert_eq!(finished(text), [[0, 10], [10, 10]]);
    assert!(finished(&text[..30]).is_empty());
}
