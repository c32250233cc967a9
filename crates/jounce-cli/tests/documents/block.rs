//! Fenced blocks of a Markdown document.

/// A fenced block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Path of the document from the root of the repository.
    pub document: String,
    /// Line of its opening fence, from 1.
    pub line: usize,
    /// What stands behind the opening fence.
    pub info: String,
    /// Its lines, the indentation of the fence taken away.
    pub text: String,
}

/// What a block may say that it is.
const KNOWN: [&str; 11] = [
    "console",
    "python",
    "pycon",
    "sh",
    "rust",
    "rust,no_run",
    "text",
    "toml spec",
    "toml part",
    "toml study",
    "toml design",
];

impl Block {
    /// `document:line`.
    pub fn location(&self) -> String {
        format!("{}:{}", self.document, self.line)
    }

    /// Why the block is none of the kinds that are checked.
    pub fn fault(&self) -> Option<String> {
        let is_known = KNOWN.contains(&self.info.as_str());
        (!is_known).then(|| {
            format!(
                "{}: a block is marked `{}`; allowed are {}",
                self.location(),
                self.info,
                KNOWN.join(", ")
            )
        })
    }

    /// True for commands.
    pub fn is_shell(&self) -> bool {
        matches!(self.info.as_str(), "sh" | "console")
    }

    /// True for a spec or a part of one.
    pub fn is_spec(&self) -> bool {
        matches!(self.info.as_str(), "toml spec" | "toml part")
    }

    /// True for Rust.
    pub fn is_rust(&self) -> bool {
        self.info.starts_with("rust")
    }
}

/// The blocks of a document, in order.
pub fn blocks(document: &str, markdown: &str) -> Vec<Block> {
    let mut blocks_read = Vec::new();
    let mut open: Option<(String, usize, Block)> = None;
    for (index, line) in markdown.lines().enumerate() {
        let trimmed = line.trim_start();
        match &mut open {
            None => {
                let fence = fence(trimmed);
                if !fence.is_empty() {
                    let info = trimmed[fence.len()..].trim().to_owned();
                    let block = Block {
                        document: document.to_owned(),
                        line: index + 1,
                        info,
                        text: String::new(),
                    };
                    open = Some((fence, line.len() - trimmed.len(), block));
                }
            }
            Some((fence, indent, block)) => {
                if trimmed.trim_end().starts_with(fence.as_str())
                    && trimmed.trim_end().chars().all(|c| fence.starts_with(c))
                {
                    blocks_read.extend(open.take().map(|(_, _, block)| block));
                } else {
                    block
                        .text
                        .push_str(&line[(*indent).min(line.len() - trimmed.len())..]);
                    block.text.push('\n');
                }
            }
        }
    }
    blocks_read.extend(open.map(|(_, _, block)| block));
    blocks_read
}

/// The fence that a line starts with, empty without one.
fn fence(line: &str) -> String {
    let marker = line.chars().next().unwrap_or(' ');
    let fence: String = line.chars().take_while(|c| *c == marker).collect();
    if matches!(marker, '`' | '~') && fence.len() >= 3 {
        fence
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::blocks;

    #[test]
    fn finds_indented_and_nested_blocks_with_their_location() {
        let markdown = "a\n```sh\njounce --help\n```\n\n1. b\n   ````text\n   ```\n     c\n   ````\n~~~toml spec\n[run]\n~~~\n`x`\n";
        let blocks_read = blocks("a.md", markdown);
        let summaries: Vec<_> = blocks_read
            .iter()
            .map(|block| (block.location(), block.info.as_str(), block.text.as_str()))
            .collect();
        assert_eq!(
            summaries,
            [
                ("a.md:2".to_owned(), "sh", "jounce --help\n"),
                ("a.md:7".to_owned(), "text", "```\n  c\n"),
                ("a.md:11".to_owned(), "toml spec", "[run]\n")
            ]
        );
    }

    #[test]
    fn a_block_without_a_known_language_is_a_fault() {
        let fault_of = |info: &str| blocks("a.md", &format!("```{info}\nx\n```\n"))[0].fault();
        assert_eq!(fault_of("sh"), None);
        assert!(fault_of("").is_some() && fault_of("toml").is_some() && fault_of("bash").is_some());
    }
}
