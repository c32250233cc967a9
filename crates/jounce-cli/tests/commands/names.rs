//! The commands have the options of the questions.

use assert_cmd::Command;

/// Every option of a question is an argument of its command, with its default.
#[test]
fn commands_have_the_options_of_the_questions() {
    for question in jounce::questions() {
        let mut command = Command::cargo_bin("jounce").unwrap();
        command
            .args(question.command.split(' '))
            .arg("--help")
            .env("COLUMNS", "200");
        let help = String::from_utf8(command.output().unwrap().stdout).unwrap();
        for option in &question.options {
            let argument = format!("--{}", option.argument);
            let is_there = help.split_whitespace().any(|word| word == argument);
            assert!(
                is_there,
                "jounce {}: {argument} is missing",
                question.command
            );
        }
    }
}
