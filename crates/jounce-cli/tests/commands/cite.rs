//! `jounce cite`: text, BibTeX and JSON.

use crate::{SPEC, jounce, outcome, program};

fn text(arguments: &[&str]) -> String {
    let (code, text, stderr) = outcome(program().args(arguments));
    assert_eq!(code, 0, "{stderr}");
    text
}

#[test]
fn the_three_forms_hold_the_same_citations() {
    let (code, json, _) = jounce(&["cite", SPEC, "--json"]);
    assert_eq!(code, 0);
    let citations = json["citations"].as_array().unwrap();
    let (lines, bibtex) = (text(&["cite", SPEC]), text(&["cite", SPEC, "--bibtex"]));
    assert!(citations.len() > 5 && citations[0]["key"] == "jounce");
    for citation in citations {
        let line = citation["text"].as_str().unwrap();
        assert!(lines.contains(line), "{line}");
        assert!(
            bibtex.contains(citation["bibtex"].as_str().unwrap()),
            "{line}"
        );
        for reason in citation["reasons"].as_array().unwrap() {
            assert!(lines.contains(&format!("    {}\n", reason.as_str().unwrap())));
        }
    }
    assert_eq!(bibtex.matches("\n@").count() + 1, citations.len());
}

#[test]
fn overrides_change_what_is_cited() {
    let law = [
        "cite",
        SPEC,
        "--set",
        "stop.tip.law=hunt-crossley",
        "--set",
        "stop.tip.damping=0.2 s/m",
    ];
    let (code, json, _) = jounce(&[&law[..], &["--json"]].concat());
    assert_eq!(code, 0);
    let text = json.to_string();
    assert!(text.contains("stop tip: Hunt-Crossley contact") && !text.contains("hertz-1881"));
}

#[test]
fn wrong_input_is_refused() {
    let (code, _, text) = jounce(&[
        "cite",
        SPEC,
        "--set",
        "source.publications=[\"erturk-inman-208\"]",
    ]);
    assert_eq!(code, 4);
    assert!(text.contains("did you mean `erturk-inman-2008`?"), "{text}");
    let (code, _, text) = jounce(&["cite", SPEC, "--bibtex", "--json"]);
    assert_eq!(code, 2, "{text}");
    let (code, _, text) = jounce(&["cite", "missing.toml"]);
    assert_eq!(code, 4);
    assert!(text.contains("missing.toml"), "{text}");
}
