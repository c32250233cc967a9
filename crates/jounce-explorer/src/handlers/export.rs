//! Spec as text, and the commands that give the response on the page.

use crate::link::Link;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::source::Source;
use jounce::live::{Design, KeySpan};

/// Returns the spec as text, the text of its file, the link to the page with its changed keys and the
/// fields that the page reads, and the commands that give the response over a range.
///
/// # Errors
/// [`RequestFault`]: faults of the range.
pub fn export(
    id: u64,
    design: &Design,
    span: &KeySpan,
    set: &[(String, String)],
    page: &[(String, String)],
    source: &Source,
) -> Result<Frame, RequestFault> {
    let (range, over) = (span.text(design)?, &span.over);
    let path = source.name().display().to_string();
    let set_options: String = set
        .iter()
        .map(|(key, value)| format!(" --set {}", shell_quoted(&format!("{key}={value}"))))
        .collect();
    let shell = format!(
        "jounce branch {} --over {}{set_options}",
        shell_quoted(&path),
        shell_quoted(&format!("{over}={range}"))
    );
    let changes: String = set
        .iter()
        .map(|(key, value)| format!("harvester[{key:?}] = {value:?}\n"))
        .collect();
    let python = format!(
        "import jounce\n\nharvester = jounce.read({path:?})\n{changes}print(harvester.branch({over:?}, {range:?}))\n"
    );
    let file = source.read()?.text();
    let link = Link {
        set: set.to_vec(),
        view: Some(span.clone()),
        page: page.to_vec(),
        spec: Some(file.clone()),
    };
    let mut frame = Frame::new(id, "export", "done");
    frame
        .put("spec", design.harvester().text())
        .put("file", file)
        .put("has_file", source.file().is_some())
        .put("link", link.to_string())
        .put("shell", shell)
        .put("python", python);
    Ok(frame)
}

/// Quotes one word of a shell line.
fn shell_quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "=./:_-".contains(letter);
    if word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_shell_line_are_quoted() {
        assert_eq!(shell_quoted("examples/a.toml"), "examples/a.toml");
        assert_eq!(shell_quoted("stop.tip.gap=0.5 mm"), "'stop.tip.gap=0.5 mm'");
        assert_eq!(shell_quoted("a'; rm"), "'a'\\''; rm'");
    }
}
