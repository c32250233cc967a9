//! Files that comments and the pages for contributors name, in backticks.

use super::root;
use std::path::Path;

/// Pages whose paths are complete, from the root of the repository.
pub const PAGES: [&str; 2] = ["ARCHITECTURE.md", "book/src/contributing.md"];

/// Extensions by which a name without a folder is the name of a file.
const EXTENSIONS: [&str; 8] = ["rs", "ts", "py", "md", "js", "css", "html", "toml"];

/// Faults of a page: a path that leads nowhere, and a name that is not there in "`NAME` in `PATH`".
pub fn faults(page: &str) -> Vec<String> {
    let pieces: Vec<&str> = page.split('`').collect();
    let mut faults = Vec::new();
    for (index, path) in pieces.iter().enumerate().skip(1).step_by(2) {
        if !is_path(path) {
            continue;
        }
        if !root().join(path).exists() {
            faults.push(format!("there is no {path}"));
        } else if let Ok(text) = std::fs::read_to_string(root().join(path)) {
            let is_missing = |name: &&str| !text.contains(name.rsplit("::").next().unwrap_or(name));
            let missing = names_in(&pieces, index).into_iter().filter(is_missing);
            faults.extend(missing.map(|name| format!("there is no {name} in {path}")));
        }
    }
    faults
}

fn is_path(name: &str) -> bool {
    let extension = Path::new(name).extension();
    let is_file = extension.is_some_and(|found| EXTENSIONS.iter().any(|known| found == *known));
    !name.contains(char::is_whitespace) && (name.contains('/') || is_file)
}

/// The names before a path, in "`A`, `B` and `C` in `PATH`".
fn names_in<'p>(pieces: &[&'p str], path: usize) -> Vec<&'p str> {
    let (mut names, mut before) = (Vec::new(), path);
    let mut joints: &[&str] = &["in", ", in"];
    while before > 1 && joints.contains(&pieces[before - 1].trim()) {
        before -= 2;
        names.push(pieces[before]);
        joints = &[",", "and", ", and"];
    }
    names.retain(|name| !is_path(name));
    names
}

#[cfg(test)]
mod tests {
    use super::faults;

    #[test]
    fn a_missing_path_and_a_missing_name_are_faults() {
        let there = "`faults`, `PAGES` and\n`is_path` in `crates/jounce-cli/tests/documents/paths.rs` \
            or `m/s` of `crates/` and `workspace` in\n`Cargo.toml`";
        assert_eq!(faults(there), ["there is no m/s"]);
        let wrong = "`crates/no-such/` and `mod.rs`; `package`, `no::Name`, in `Cargo.toml`, `Name` in `test`";
        let expected = [
            "there is no crates/no-such/",
            "there is no mod.rs",
            "there is no no::Name in Cargo.toml",
        ];
        assert_eq!(faults(wrong), expected);
    }
}
