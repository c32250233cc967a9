//! The page of names in the book is the one of the definitions.

use jounce::{OptionDefinition, Question, questions};

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../book/src/names.md");

/// Run with `JOUNCE_WRITE=1` to write the page.
#[test]
fn page_of_names_is_the_one_of_the_definitions() {
    let page = page(&questions());
    if std::env::var_os("JOUNCE_WRITE").is_some() {
        std::fs::write(PAGE, &page).expect("the page is written");
    }
    let written = std::fs::read_to_string(PAGE).expect("the page exists");
    assert!(
        written == page,
        "book/src/names.md differs from the definitions: run with JOUNCE_WRITE=1"
    );
}

fn page(questions: &[Question]) -> String {
    let mut page = String::from(
        "# Names\n\nEach question has one name in the library, the program and the Python package. The code writes this page.\n\n\
         | question | Rust | program | Python | study |\n|---|---|---|---|---|\n",
    );
    for question in questions {
        page += &format!(
            "| {} | `{}` | `jounce {}` | `{}` | {} |\n",
            question.about,
            question.method,
            question.command,
            question.python,
            question
                .quantity
                .map_or_else(String::new, |name| format!("`command = \"{name}\"`"))
        );
    }
    page += "\nAn option is a field in Rust and an argument of the program. In Python it is a keyword argument with the name of the \
             argument, `_` for `-`.\n";
    for question in questions {
        page += &format!(
            "\n## {}\n\n| field | argument | default | meaning |\n|---|---|---|---|\n",
            question.method
        );
        question
            .options
            .iter()
            .for_each(|option| page += &row(option));
    }
    page
}

fn row(option: &OptionDefinition) -> String {
    let default = match option.default.as_str() {
        "" => String::new(),
        default => format!("`{default}`"),
    };
    let choices = match &option.choices[..] {
        [] => String::new(),
        choices => format!(" One of `{}`.", choices.join("`, `")),
    };
    let help = option.help.replace('\n', " ").replace('|', "\\|");
    format!(
        "| `{}` | `--{}` | {default} | {}.{choices} |\n",
        option.name,
        option.argument,
        help.trim_end_matches('.')
    )
}
