//! Publications behind a spec: those of its harvester, its models and the methods that it admits.

mod bibtex;
mod program;
mod reasons;
mod result;
mod text;

pub use result::{Citation, CiteResult};

use crate::harvester::Harvester;

impl Harvester {
    /// Lists what a publication of results of this harvester should cite, each with its reasons:
    /// jounce itself, then the publications of the `[source]`, of the models, of the materials and
    /// of the methods that the spec uses or admits.
    ///
    /// Methods of recordings, studies and designs are not included, because no spec names them.
    ///
    /// ```
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = jounce::Harvester::read("examples/plate-de-marqui-2009/harvester.toml")?;
    /// let result = harvester.cite();
    /// assert!(result.citations.iter().any(|citation| citation.key == "de-marqui-2009"));
    /// assert!(result.bibtex().contains("@article{de-marqui-2009,"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn cite(&self) -> CiteResult {
        let spec = self.spec();
        let mut citations = vec![program::citation(reasons::of_program(spec))];
        for (publication, reasons) in reasons::of_publications(spec) {
            citations.push(Citation::of(publication, reasons));
        }
        CiteResult { citations }
    }
}
