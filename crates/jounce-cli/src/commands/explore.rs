//! `jounce explore SPEC`

use crate::failure::Failure;
use crate::output::{line, print};
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce_explorer::{
    ExploreError, Explorer, ServerLimits, ServerOptions, Source, open_in_browser, state_folder,
};
use std::net::SocketAddr;

/// Arguments of `explore`.
#[derive(Debug, Args)]
pub struct Explore {
    #[command(flatten)]
    spec: SpecArguments,
    /// Listens on this address; by default on a free port that only this machine can reach. Anyone
    /// who has the printed address can use the page.
    #[arg(long, value_name = "ADDRESS:PORT")]
    listen: Option<SocketAddr>,
    /// Prints the address without opening the browser.
    #[arg(long)]
    no_browser: bool,
    /// Prints the address as one JSON object.
    #[arg(long)]
    pub json: bool,
}

impl Explore {
    /// Serves the page until it is interrupted.
    pub fn run(&self) -> Result<(), Failure> {
        let key_and_value = |text: &String| match text.split_once('=') {
            Some((key, value)) => Ok((key.to_owned(), value.to_owned())),
            None => Err(Failure::usage(format!(
                "--set {text}: write KEY=VALUE, as in --set stop.tip.gap=\"0.5 mm\""
            ))),
        };
        let set = self
            .spec
            .set
            .iter()
            .map(key_and_value)
            .collect::<Result<_, _>>()?;
        let options = ServerOptions {
            spec: Source::File(self.spec.spec.clone()),
            set,
            listen: self.listen,
            proxy: None,
            frames: false,
            state_folder: state_folder(),
            limits: ServerLimits::default(),
        };
        let explorer = Explorer::bind(options)?;
        let page = explorer.page();
        match self.json {
            true => print(&serde_json::json!({ "page": page })),
            false => line(format!(
                "{page}\nKeep the address private: anyone who has it can use the page. Ctrl+C ends it."
            )),
        }
        // The file that leads the browser to the page is deleted with this variable.
        let mut page_file = None;
        if !self.no_browser {
            match open_in_browser(&page) {
                Ok(file) => page_file = Some(file),
                Err(error) => {
                    eprintln!("no browser could be started ({error}); open the address yourself")
                }
            }
        }
        let stopper = explorer.stopper();
        let handler = ctrlc::set_handler(move || stopper.stop());
        handler.map_err(|error| Failure::Input(format!("Ctrl-C cannot be handled: {error}")))?;
        explorer.run()?;
        drop(page_file);
        Ok(())
    }
}

impl From<ExploreError> for Failure {
    fn from(error: ExploreError) -> Self {
        Failure::Input(error.to_string())
    }
}
