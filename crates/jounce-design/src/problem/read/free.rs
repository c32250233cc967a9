//! Free keys and the specs of their choices.

use crate::problem::{FreeKey, FreeValues};
use jounce_analysis::study::FaultCollector;
use jounce_spec::SpecFile;
use toml_edit::Item;

/// Largest number of free keys: a search over more is slower than its user.
const MAX_FREE: usize = 64;

/// Largest number of combinations of choices.
const MAX_VARIANTS: usize = 1000;

/// Reads the free keys.
pub(super) fn free(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
) -> Vec<FreeKey> {
    let table = reader.table("free", item);
    let Some(table) = table.filter(|table| !table.is_empty()) else {
        let message =
            "free names no key; write [free] and \"stop.tip.gap\" = \"0.2mm:3mm\" below it";
        reader.fault("free", item.and_then(Item::span), message);
        return Vec::new();
    };
    let mut all = Vec::new();
    for (path, item) in table {
        let read = match (item.as_str(), item.as_array()) {
            (Some(text), _) => FreeKey::range(file, path, text),
            (None, Some(array)) => {
                let texts: Vec<String> = array
                    .iter()
                    .filter_map(|value| value.as_str().map(str::to_owned))
                    .collect();
                match texts.len() == array.len() && texts.len() > 1 {
                    true => Ok(FreeKey {
                        path: path.to_owned(),
                        values: FreeValues::Choice(texts),
                    }),
                    false => Err(vec![format!(
                        "free.{path} must list at least two texts, as in [\"steel\", \"aluminium\"]"
                    )]),
                }
            }
            _ => Err(vec![format!(
                "free.{path} must be a text, as in \"0.2mm:3mm\", under the whole path as one key, or a list of texts"
            )]),
        };
        match read {
            Ok(free) => all.push(free),
            Err(messages) => messages
                .into_iter()
                .for_each(|message| reader.fault(path, item.span(), message)),
        }
    }
    if table.len() > MAX_FREE {
        let message = format!(
            "free has {} keys; at most {MAX_FREE} are allowed",
            table.len()
        );
        reader.fault("free", item.and_then(Item::span), message);
    }
    all
}

/// Returns the spec of each combination of choices.
pub(super) fn variants(
    reader: &mut FaultCollector,
    free: &[FreeKey],
    file: &SpecFile,
) -> Vec<SpecFile> {
    let mut variants = vec![file.clone()];
    for free in free {
        let FreeValues::Choice(texts) = &free.values else {
            continue;
        };
        if variants.len() * texts.len() > MAX_VARIANTS {
            let message = format!("free: the choices have more than {MAX_VARIANTS} combinations");
            reader.fault(&free.path, None, message);
            return variants;
        }
        let mut combined = Vec::with_capacity(variants.len() * texts.len());
        for text in texts {
            for variant in &variants {
                let mut variant = variant.clone();
                let set = variant.set(&free.path, text);
                let faults = match set {
                    Err(fault) => vec![fault],
                    Ok(()) => variant
                        .spec()
                        .err()
                        .map_or_else(Vec::new, |faults| faults.as_slice().to_vec()),
                };
                for fault in faults {
                    let message = format!("free.{} = \"{text}\": {}", free.path, fault.message);
                    reader.fault(&free.path, None, message);
                }
                combined.push(variant);
            }
        }
        variants = combined;
    }
    variants
}
