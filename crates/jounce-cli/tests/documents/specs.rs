//! Specs of a document, and parts of specs.

use super::block::Block;
use std::path::Path;
use std::process::Command;

/// Why `jounce check` refuses the spec of a block.
pub fn fault(block: &Block, base: &str, folder: &Path) -> Option<String> {
    let text = if block.info == "toml part" {
        merge_part(base, &block.text)
    } else {
        block.text.clone()
    };
    let path = folder.join(format!(
        "{}-{}.toml",
        block.document.replace('/', "-"),
        block.line
    ));
    std::fs::write(&path, text).expect("a file can be written in the target folder");
    let output = Command::new(env!("CARGO_BIN_EXE_jounce"))
        .arg("check")
        .arg(&path)
        .output()
        .expect("jounce starts");
    let message = || {
        format!(
            "{}: this spec is refused\n{}",
            block.location(),
            String::from_utf8_lossy(&output.stderr)
        )
    };
    (!output.status.success()).then(message)
}

/// A spec with the tables of a part in place of its own.
pub fn merge_part(base: &str, part: &str) -> String {
    let replaced_headers: Vec<&str> = part.lines().filter_map(header).collect();
    let mut is_retained = true;
    let mut text = String::new();
    for line in base.lines() {
        if let Some(header) = header(line) {
            is_retained = !replaced_headers.contains(&header);
        }
        if is_retained {
            text.push_str(line);
            text.push('\n');
        }
    }
    text + part
}

/// `[stop.tip]` of a line that opens a table.
fn header(line: &str) -> Option<&str> {
    let end = line.find(']')?;
    line.starts_with('[').then(|| &line[..=end])
}

#[cfg(test)]
mod tests {
    use super::super::block::blocks;
    use super::super::empty_folder;
    use super::{fault, merge_part};

    #[test]
    fn a_part_replaces_its_table() {
        let base =
            "# all\n[run]\nstart = \"rest\" # so\n[stop.tip] # it\ngap = 1\n[stop.top]\ngap = 2\n";
        assert_eq!(
            merge_part(base, "[stop.tip]\ngap = 3\n"),
            "# all\n[run]\nstart = \"rest\" # so\n[stop.top]\ngap = 2\n[stop.tip]\ngap = 3\n"
        );
    }

    #[test]
    fn an_invalid_spec_is_reported() {
        let block = &blocks("a.md", "```toml spec\n[rum]\n```\n")[0];
        let message = fault(block, "", &empty_folder("wrong-spec"));
        assert!(message.is_some_and(|message| message.starts_with("a.md:1: this spec is refused")));
    }
}
