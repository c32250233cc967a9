//! `jounce explore SPEC`, `jounce explore --link LINK`

use crate::failure::Failure;
use crate::output::{self, line};
use crate::spec_arguments::SpecArguments;
use clap::Args;
use jounce_explorer::{
    ExploreError, Explorer, Link, ServerLimits, ServerOptions, Source, open_in_browser,
    state_folder,
};
use std::net::SocketAddr;
use std::path::PathBuf;

/// Arguments of `explore`.
#[derive(Debug, Args)]
#[command(
    mut_arg("spec", |spec| spec.required(false).required_unless_present("link")),
    mut_arg("set", |set| set.requires("spec"))
)]
pub struct Explore {
    #[command(flatten)]
    spec: Option<SpecArguments>,
    /// Opens the design, the view and the spec of a link, which Copy link of a page copies; with a SPEC
    /// its file is used. By default the page opens with the values of the spec.
    #[arg(long, value_name = "LINK")]
    link: Option<String>,
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
    /// Returns the design of the link; without one, an empty design.
    fn design(&self) -> Result<Link, Failure> {
        let Some(text) = &self.link else {
            return Ok(Link::default());
        };
        Link::parse(text).map_err(|error| Failure::usage(format!("--link: {error}")))
    }

    /// Returns the spec: the file, or the text in the link.
    fn source(&self, link: &Link) -> Result<Source, Failure> {
        match (&self.spec, &link.spec) {
            (Some(arguments), text) => {
                let file = arguments.spec.clone();
                let differs = |text: &String| {
                    std::fs::read_to_string(&file).is_ok_and(|own| own.trim() != text.trim())
                };
                if text.as_ref().is_some_and(differs) {
                    output::note(format!("warning: {} differs from the spec in the link; without SPEC the page opens that one",
                        file.display()));
                }
                Ok(Source::File(file))
            }
            (None, Some(text)) => Ok(Source::Text {
                text: text.clone(),
                folder: PathBuf::new(),
            }),
            (None, None) => Err(Failure::usage(
                "--link: this link holds no spec; give its file too, as in jounce explore SPEC --link LINK, or copy the link with Copy link".to_owned(),
            )),
        }
    }

    /// Serves the page until it is interrupted.
    pub fn run(&self) -> Result<(), Failure> {
        let link = self.design()?;
        let given = self.spec.as_ref().map(SpecArguments::assignments);
        let given = given.transpose()?.unwrap_or_default();
        let owned = |(key, value): (&str, &str)| (key.to_owned(), value.to_owned());
        let given = given.into_iter().map(owned).collect();
        let options = ServerOptions {
            spec: self.source(&link)?,
            set: [link.set, given].concat(),
            view: link.view,
            page: link.page,
            listen: self.listen,
            proxy: None,
            frames: false,
            state_folder: state_folder(),
            limits: ServerLimits::default(),
        };
        let explorer = Explorer::bind(options)?;
        let page = explorer.page();
        match self.json {
            true => line(serde_json::json!({ "page": page })),
            false => line(format!(
                "{page}\nKeep the address private: anyone who has it can use the page. Ctrl+C ends it."
            )),
        }
        // The file that leads the browser to the page is deleted with this variable.
        let mut page_file = None;
        if !self.no_browser {
            match open_in_browser(&page) {
                Ok(file) => page_file = Some(file),
                Err(error) => output::note(format!(
                    "no browser could be started ({error}); open the address yourself"
                )),
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
