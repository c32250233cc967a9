//! The JSON Schema and the key reference.

use serde_json::{Value, json};

use crate::{MODAL, paper, root};

fn to_json(item: &toml_edit::Item) -> Value {
    if let Some(table) = item.as_table_like() {
        return table
            .iter()
            .map(|(key, item)| (key.to_owned(), to_json(item)))
            .collect();
    }
    let value = item.as_value().unwrap();
    if let Some(list) = value.as_array() {
        return list
            .iter()
            .map(|value| to_json(&toml_edit::Item::Value(value.clone())))
            .collect();
    }
    value
        .as_str()
        .map(Value::from)
        .or(value.as_integer().map(Value::from))
        .or(value.as_float().map(Value::from))
        .unwrap_or(json!(true))
}

fn valid(text: &str) -> bool {
    let validator = jsonschema::draft7::new(&jounce_spec::schema()).unwrap();
    validator.is_valid(&to_json(
        text.parse::<toml_edit::DocumentMut>().unwrap().as_item(),
    ))
}

#[test]
fn the_schema_is_draft_07_and_holds_for_the_examples() {
    assert!(jsonschema::draft7::meta::is_valid(&jounce_spec::schema()));
    assert!(valid(&paper()));
    assert!(valid(MODAL));
    assert!(valid(
        &jounce_spec::Spec::from_toml(&paper()).unwrap().to_toml()
    ));
    let plant = std::fs::read_to_string(root().join("bench/plant.toml"));
    assert!(valid(&plant.unwrap()));
}

#[test]
fn the_schema_refuses_what_the_reader_refuses() {
    for (from, to) in [
        ("\"30 mm\"", "30"),
        ("\"30 mm\"", "\"-30 mm\""),
        ("\"30 mm\"", "\"30\""),
        ("\"30 mm\"", "\"mm\""),
        ("law = \"hertz\"", ""),
        ("law = \"hertz\"", "law = \"hertzz\""),
        ("law = \"hertz\"", "law = \"spring\"\nexponent = 1.5"),
        ("law = \"hertz\"", "law = \"rigid\"\nrestitution = 0.5"),
        ("law = \"hertz\"", "law = \"kelvin-voigt\""),
        ("law = \"hertz\"", "law = \"hertz\"\nexponent = 0.5"),
        ("gap = \"1 mm\"", "gapp = \"1 mm\""),
        ("gap = \"1 mm\"", "gap = true"),
        ("damping_ratio = 0.3", "damping_ratio = -0.3"),
        (
            "damping_ratio = 0.3",
            "damping_ratio = 0.3\nstiffness = \"1 N/m\"",
        ),
        ("frequency = \"1 Hz\"", "frequency = 1"),
        ("modes = 8", "modes = 8.5"),
        ("modes = 8", "modes = 201"),
        ("[mass.table]", "[mass.\"my table\"]"),
        ("[run]", "[runs]"),
    ] {
        let invalid = paper().replace(from, to);
        assert_ne!(invalid, paper(), "{from}");
        assert!(!valid(&invalid), "{from} -> {to}");
        assert!(
            jounce_spec::Spec::from_toml(&invalid).is_err(),
            "{from} -> {to}"
        );
    }
    assert!(!valid("[run]\nduration = \"1 s\""));
}

#[test]
fn a_patch_of_the_default_section_needs_its_density() {
    let section = "section = \"thin-skin\"";
    let density = "density = \"5440 kg/m^3\"";
    let laminate = paper().replace(section, "");
    assert!(valid(&laminate));
    assert!(!valid(&laminate.replace(density, "")));
    assert!(valid(&paper().replace(density, "")));
    assert!(jounce_spec::Spec::from_toml(&paper().replace(density, "")).is_ok());
    assert!(jounce_spec::Spec::from_toml(&laminate.replace(density, "")).is_err());
}

#[test]
fn the_schema_and_the_key_reference_are_unchanged() {
    insta::assert_snapshot!(
        "schema",
        serde_json::to_string_pretty(&jounce_spec::schema()).unwrap()
    );
    insta::assert_snapshot!("key_reference", jounce_spec::reference_markdown());
}
