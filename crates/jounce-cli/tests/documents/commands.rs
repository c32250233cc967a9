//! Commands of a document, run against the built program.

use super::block::Block;
use super::root;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// How a document may call the program.
const PREFIXES: [&str; 2] = ["cargo run --release -- ", "jounce "];

/// What a command line asks for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DocumentCommand {
    /// Arguments of `jounce`, as the shell reads them.
    Jounce(String),
    /// The script of the repository that runs this very test: only looked at.
    Test,
    /// The installation of the Python package from here, which the tests of that package do: only looked at.
    Install,
    /// Anything else.
    Other(String),
}

/// The commands of a block, in order: in `sh` every line but comments, in `console` those behind a prompt.
pub fn parse_commands(block: &Block) -> Vec<DocumentCommand> {
    let mut pieces = block.text.split("\\\n");
    let first_piece = pieces.next().unwrap_or_default().to_owned();
    let text = pieces.fold(first_piece, |text, piece| text + piece.trim_start());
    let command = |line: &str| match block.info.as_str() {
        "console" => line.strip_prefix("$ ").map(str::to_owned),
        _ => Some(line.to_owned()).filter(|line| !line.is_empty() && !line.starts_with('#')),
    };
    text.lines()
        .map(str::trim_end)
        .filter_map(command)
        .map(parse_line)
        .collect()
}

fn parse_line(line: String) -> DocumentCommand {
    match PREFIXES.iter().find_map(|prefix| line.strip_prefix(prefix)) {
        Some(arguments) => DocumentCommand::Jounce(arguments.to_owned()),
        None if line == "./test" => DocumentCommand::Test,
        None if line.starts_with("pip install \".[") => DocumentCommand::Install,
        None => DocumentCommand::Other(line),
    }
}

/// What goes wrong when the commands of a block run in a folder.
pub fn faults(block: &Block, folder: &Path) -> Vec<String> {
    let with_location = |message: String| format!("{}: {message}", block.location());
    let fault = |parse_commands| match parse_commands {
        DocumentCommand::Jounce(arguments) => run(&arguments, folder).err().map(with_location),
        DocumentCommand::Test => (!root().join("test").is_file())
            .then(|| with_location("there is no script `test`".to_owned())),
        DocumentCommand::Install => (!root().join("pyproject.toml").is_file())
            .then(|| with_location("there is no Python package to install".to_owned())),
        DocumentCommand::Other(line) => Some(with_location(format!(
            "`{line}` cannot be run here; mark the block `text`"
        ))),
    };
    parse_commands(block)
        .into_iter()
        .filter_map(fault)
        .collect()
}

/// Starts a server, waits until it says where its page is, and ends it.
fn serve(arguments: &str, folder: &Path) -> Result<(), String> {
    let line = format!("exec \"$JOUNCE\" {arguments} --no-browser");
    let mut command = Command::new("sh");
    command
        .args(["-c", &line])
        .env("JOUNCE", env!("CARGO_BIN_EXE_jounce"))
        .env("XDG_STATE_HOME", folder);
    command.current_dir(folder).stdout(Stdio::piped());
    let mut child = command
        .spawn()
        .map_err(|error| format!("the shell does not start: {error}"))?;
    let mut first_line = String::new();
    let read = child
        .stdout
        .take()
        .map(|out| BufReader::new(out).read_line(&mut first_line));
    let _ = child.kill();
    let _ = child.wait();
    let served = matches!(read, Some(Ok(_))) && first_line.starts_with("http://");
    if served {
        Ok(())
    } else {
        Err(format!(
            "`jounce {arguments}` printed no address, but {first_line:?}"
        ))
    }
}

/// Runs the program through the shell, so that quotes, pipes and redirections mean what the reader expects.
fn run(arguments: &str, folder: &Path) -> Result<(), String> {
    if arguments.starts_with("explore ") {
        return serve(arguments, folder);
    }
    let line = format!("\"$JOUNCE\" {arguments}");
    let output = Command::new("sh")
        .args(["-c", &line])
        .env("JOUNCE", env!("CARGO_BIN_EXE_jounce"))
        // Two documents may compute the same sweep at the same time, which one journal refuses.
        .env("JOUNCE_CACHE", folder.join(".cache"))
        .current_dir(folder)
        .output();
    let output = output.map_err(|error| format!("the shell does not start: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    Err(format!(
        "`jounce {arguments}` ended with {}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    ))
}

/// Copies a folder with all that is in it.
pub fn copy(source: &Path, target: &Path) {
    std::fs::create_dir_all(target).expect("a folder can be made in the target folder");
    for entry in std::fs::read_dir(source).expect("the examples are there") {
        let path = entry.expect("the examples can be listed").path();
        let target_path = target.join(path.file_name().expect("an entry of a folder has a name"));
        if path.is_dir() {
            copy(&path, &target_path);
        } else {
            std::fs::copy(&path, &target_path).expect("an example can be copied");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::block::blocks;
    use super::super::empty_folder;
    use super::{DocumentCommand, faults, parse_commands};

    fn commands(markdown: &str) -> Vec<DocumentCommand> {
        parse_commands(&blocks("a.md", markdown)[0])
    }

    #[test]
    fn reads_commands_and_skips_output_and_comments() {
        let jounce = |arguments: &str| DocumentCommand::Jounce(arguments.to_owned());
        assert_eq!(
            commands(
                "```sh\n# look\ncargo run --release -- run a.toml \\\n    --json\n\n./test\npip install \".[all]\"\nmake it\n```\n"
            ),
            [
                jounce("run a.toml --json"),
                DocumentCommand::Test,
                DocumentCommand::Install,
                DocumentCommand::Other("make it".to_owned())
            ]
        );
        assert_eq!(
            commands("```console\n$ jounce check \\\n  a.toml\nvalid\n$ jounce --version\n```\n"),
            [jounce("check a.toml"), jounce("--version")]
        );
    }

    #[test]
    fn failing_and_unknown_commands_are_reported() {
        let markdown = "```sh\njounce no-such-command\nmake it\n```\n";
        let messages = faults(&blocks("a.md", markdown)[0], &empty_folder("failing"));
        assert_eq!(messages.len(), 2, "{messages:?}");
        assert!(
            messages[0].starts_with("a.md:1: `jounce no-such-command` ended with")
                && messages[1].contains("make it"),
            "{messages:?}"
        );
    }
}
