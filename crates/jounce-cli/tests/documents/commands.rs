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
pub enum Asked {
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
pub fn asked(block: &Block) -> Vec<Asked> {
    let mut pieces = block.text.split("\\\n");
    let first = pieces.next().unwrap_or_default().to_owned();
    let text = pieces.fold(first, |text, piece| text + piece.trim_start());
    let command = |line: &str| match block.info.as_str() {
        "console" => line.strip_prefix("$ ").map(str::to_owned),
        _ => Some(line.to_owned()).filter(|line| !line.is_empty() && !line.starts_with('#')),
    };
    text.lines()
        .map(str::trim_end)
        .filter_map(command)
        .map(kind)
        .collect()
}

fn kind(line: String) -> Asked {
    match PREFIXES.iter().find_map(|prefix| line.strip_prefix(prefix)) {
        Some(arguments) => Asked::Jounce(arguments.to_owned()),
        None if line == "./test" => Asked::Test,
        None if line.starts_with("pip install \".[") => Asked::Install,
        None => Asked::Other(line),
    }
}

/// What goes wrong when the commands of a block run in a folder.
pub fn faults(block: &Block, folder: &Path) -> Vec<String> {
    let told = |why: String| format!("{}: {why}", block.place());
    let fault = |asked| match asked {
        Asked::Jounce(arguments) => run(&arguments, folder).err().map(told),
        Asked::Test => {
            (!root().join("test").is_file()).then(|| told("there is no script `test`".to_owned()))
        }
        Asked::Install => (!root().join("pyproject.toml").is_file())
            .then(|| told("there is no Python package to install".to_owned())),
        Asked::Other(line) => Some(told(format!(
            "`{line}` cannot be run here; mark the block `text`"
        ))),
    };
    asked(block).into_iter().filter_map(fault).collect()
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
    let mut told = String::new();
    let read = child
        .stdout
        .take()
        .map(|out| BufReader::new(out).read_line(&mut told));
    let _ = child.kill();
    let _ = child.wait();
    let served = matches!(read, Some(Ok(_))) && told.starts_with("http://");
    if served {
        Ok(())
    } else {
        Err(format!(
            "`jounce {arguments}` told no address, but {told:?}"
        ))
    }
}

/// Runs the program through the shell, so that quotes, pipes and redirections mean what the reader expects.
fn run(arguments: &str, folder: &Path) -> Result<(), String> {
    if arguments.starts_with("explore ") {
        return serve(arguments, folder);
    }
    let line = format!("\"$JOUNCE\" {arguments}");
    let done = Command::new("sh")
        .args(["-c", &line])
        .env("JOUNCE", env!("CARGO_BIN_EXE_jounce"))
        .current_dir(folder)
        .output();
    let done = done.map_err(|error| format!("the shell does not start: {error}"))?;
    if done.status.success() {
        return Ok(());
    }
    Err(format!(
        "`jounce {arguments}` ended with {}\n{}",
        done.status,
        String::from_utf8_lossy(&done.stderr)
    ))
}

/// Copies a folder with all that is in it.
pub fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder can be made in the target folder");
    for entry in std::fs::read_dir(from).expect("the examples are there") {
        let path = entry.expect("the examples can be listed").path();
        let target = to.join(path.file_name().expect("an entry of a folder has a name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(&path, &target).expect("an example can be copied");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::block::blocks;
    use super::super::empty_folder;
    use super::{Asked, asked, faults};

    fn commands(markdown: &str) -> Vec<Asked> {
        asked(&blocks("a.md", markdown)[0])
    }

    #[test]
    fn reads_commands_and_leaves_output_and_comments() {
        let jounce = |arguments: &str| Asked::Jounce(arguments.to_owned());
        assert_eq!(
            commands(
                "```sh\n# look\ncargo run --release -- run a.toml \\\n    --json\n\n./test\npip install \".[all]\"\nmake it\n```\n"
            ),
            [
                jounce("run a.toml --json"),
                Asked::Test,
                Asked::Install,
                Asked::Other("make it".to_owned())
            ]
        );
        assert_eq!(
            commands("```console\n$ jounce check \\\n  a.toml\nvalid\n$ jounce --version\n```\n"),
            [jounce("check a.toml"), jounce("--version")]
        );
    }

    #[test]
    fn a_command_that_fails_and_one_that_cannot_run_are_told() {
        let markdown = "```sh\njounce no-such-command\nmake it\n```\n";
        let found = faults(&blocks("a.md", markdown)[0], &empty_folder("failing"));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(
            found[0].starts_with("a.md:1: `jounce no-such-command` ended with")
                && found[1].contains("make it"),
            "{found:?}"
        );
    }
}
