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
const KNOWN: [&str; 9] = [
    "console",
    "python",
    "sh",
    "rust",
    "rust,no_run",
    "text",
    "toml spec",
    "toml part",
    "toml study",
];

impl Block {
    /// `document:line`.
    pub fn place(&self) -> String {
        format!("{}:{}", self.document, self.line)
    }

    /// Why the block is none of the kinds that are checked.
    pub fn fault(&self) -> Option<String> {
        let known = KNOWN.contains(&self.info.as_str());
        (!known).then(|| {
            format!(
                "{}: a block is marked `{}`; allowed are {}",
                self.place(),
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
    let mut found = Vec::new();
    let mut open: Option<(String, usize, Block)> = None;
    for (index, line) in markdown.lines().enumerate() {
        let bare = line.trim_start();
        match &mut open {
            None => {
                let fence = fence(bare);
                if !fence.is_empty() {
                    let info = bare[fence.len()..].trim().to_owned();
                    let block = Block {
                        document: document.to_owned(),
                        line: index + 1,
                        info,
                        text: String::new(),
                    };
                    open = Some((fence, line.len() - bare.len(), block));
                }
            }
            Some((fence, indent, block)) => {
                if bare.trim_end().starts_with(fence.as_str())
                    && bare.trim_end().chars().all(|c| fence.starts_with(c))
                {
                    found.extend(open.take().map(|(_, _, block)| block));
                } else {
                    block
                        .text
                        .push_str(&line[(*indent).min(line.len() - bare.len())..]);
                    block.text.push('\n');
                }
            }
        }
    }
    found.extend(open.map(|(_, _, block)| block));
    found
}

/// The fence that a line starts with, empty without one.
fn fence(line: &str) -> String {
    let mark = line.chars().next().unwrap_or(' ');
    let fence: String = line.chars().take_while(|c| *c == mark).collect();
    if matches!(mark, '`' | '~') && fence.len() >= 3 {
        fence
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::blocks;

    #[test]
    fn finds_blocks_with_their_place_indented_and_nested_ones_too() {
        let markdown = "a\n```sh\njounce --help\n```\n\n1. b\n   ````text\n   ```\n     c\n   ````\n~~~toml spec\n[run]\n~~~\n`x`\n";
        let found = blocks("a.md", markdown);
        let seen: Vec<_> = found
            .iter()
            .map(|block| (block.place(), block.info.as_str(), block.text.as_str()))
            .collect();
        assert_eq!(
            seen,
            [
                ("a.md:2".to_owned(), "sh", "jounce --help\n"),
                ("a.md:7".to_owned(), "text", "```\n  c\n"),
                ("a.md:11".to_owned(), "toml spec", "[run]\n")
            ]
        );
    }

    #[test]
    fn a_block_that_says_nothing_or_something_else_is_a_fault() {
        let told = |info: &str| blocks("a.md", &format!("```{info}\nx\n```\n"))[0].fault();
        assert_eq!(told("sh"), None);
        assert!(told("").is_some() && told("toml").is_some() && told("bash").is_some());
    }
}
