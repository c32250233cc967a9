//! The JSON Schema and the key reference. An independent validator tests the schema in `python/tests/test_schema.py`.

#[test]
fn the_schema_and_the_key_reference_are_unchanged() {
    insta::assert_snapshot!(
        "schema",
        serde_json::to_string_pretty(&jounce_spec::schema()).unwrap()
    );
    insta::assert_snapshot!("key_reference", jounce_spec::reference_markdown());
}
