//! Names of options in texts of the library.

use crate::arguments::Arguments;
use clap::CommandFactory;

/// Writes each `name` of an option in a text of the library, where it is quoted as the keyword in
/// Python, as it is on the command line: --name.
pub fn on_command_line(text: &str) -> String {
    if !text.contains('`') {
        return text.to_owned();
    }
    let command = Arguments::command();
    let options = command
        .get_subcommands()
        .flat_map(|command| command.get_arguments());
    let names: Vec<&str> = options.filter_map(clap::Arg::get_long).collect();
    let part = |(index, part): (usize, &str)| {
        let name = part.replace('_', "-");
        match (index % 2, names.contains(&name.as_str())) {
            (0, _) => part.to_owned(),
            (_, true) => format!("--{name}"),
            (_, false) => format!("`{part}`"),
        }
    };
    text.split('`').enumerate().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::on_command_line;

    #[test]
    fn only_names_of_options_change() {
        let text = "name points with `at`, or omit `sensor_mass`; the base `table` is fixed";
        assert_eq!(
            on_command_line(text),
            "name points with --at, or omit --sensor-mass; the base `table` is fixed"
        );
    }
}
