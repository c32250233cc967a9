//! The publications of a source are those of the bibliography.

use super::ValidationFaults;
use crate::Spec;
use crate::bibliography::{publication, publications};
use crate::nearest::{clip, did_you_mean};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    let keys = &spec.source.publications;
    for (index, key) in keys.iter().enumerate() {
        if publication(key).is_none() {
            let text = || {
                let known: Vec<&str> = publications().map(|known| known.key).collect();
                format!(
                    "\"{}\" is not a publication that jounce knows{}; the page \"Cite and make again\" of the book lists them; name one, or omit the key",
                    clip(key),
                    did_you_mean(key, &known)
                )
            };
            faults.push(|| "source.publications".to_owned(), text);
        } else if keys[..index].contains(key) {
            let text = || format!("names \"{}\" twice; name it once", clip(key));
            faults.push(|| "source.publications".to_owned(), text);
        }
    }
}
