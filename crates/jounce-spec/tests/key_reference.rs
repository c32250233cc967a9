//! The key reference of the book equals the program's output.
//! `JOUNCE_WRITE=1 cargo test --release --test key_reference` writes it anew.

use std::path::Path;

#[test]
fn the_book_holds_the_key_reference_of_the_program() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/keys.md");
    let reference = jounce_spec::reference_markdown();
    if std::env::var_os("JOUNCE_WRITE").is_some() {
        std::fs::write(&page, &reference).expect("the page can be written");
    }
    let page_text = std::fs::read_to_string(&page).expect("the page is there");
    assert!(
        page_text.trim_end() == reference.trim_end(),
        "book/src/keys.md is out of date; set JOUNCE_WRITE=1 and run this test again"
    );
}
