//! `jounce cite SPEC`

use crate::failure::Failure;
use crate::output::{self, line};
use crate::spec_arguments::SpecArguments;
use clap::Args;

/// Arguments of `cite`.
#[derive(Debug, Args)]
pub struct Cite {
    #[command(flatten)]
    spec: SpecArguments,
    /// Prints a file of BibTeX; by default lines of text with the reasons.
    #[arg(long, conflicts_with = "json")]
    bibtex: bool,
    /// Prints one JSON object on stdout, with the text and the BibTeX of each citation.
    #[arg(long)]
    pub json: bool,
}

impl Cite {
    /// Lists the publications, each with its reasons.
    pub fn run(&self) -> Result<(), Failure> {
        let result = self.spec.harvester()?.cite();
        if self.json {
            line(output::to_json(&result)?);
            return Ok(());
        }
        if self.bibtex {
            output::text(&result.bibtex());
            return Ok(());
        }
        for citation in &result.citations {
            line(format!("[{}] {}", citation.key, citation.text));
            for reason in &citation.reasons {
                line(format!("    {reason}"));
            }
        }
        Ok(())
    }
}
