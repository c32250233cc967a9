//! Materials of the library, by the publications that their sources name.

use super::Reasons;
use jounce_spec::Spec;

/// Publications in the sources of the materials.
const OF_MATERIALS: &[(&str, &[&str])] = &[
    ("PZT-5A", &["jaffe-1971", "erturk-inman-2011"]),
    ("PZT-5H", &["jaffe-1971", "erturk-inman-2011"]),
    ("PSI-5A4E", &["erturk-inman-2009"]),
    ("MFC-P1", &["bilgen-2010"]),
    ("MFC-P2", &["bilgen-2010"]),
    ("silicon", &["hopcroft-2010"]),
];

pub(super) fn add(spec: &Spec, reasons: &mut Reasons) {
    for (element, material) in used(spec) {
        let known = OF_MATERIALS.iter().find(|(name, _)| *name == material);
        for key in known.map_or(&[][..], |(_, keys)| keys) {
            reasons.add(key, format!("{element}: constants of {material}"));
        }
    }
}

/// Returns each use of a material, with its element.
fn used(spec: &Spec) -> Vec<(String, &str)> {
    let beams = spec
        .beam
        .iter()
        .map(|(name, one)| (format!("beam {name}"), one.material.as_str()));
    let plates =
        (spec.plate.iter()).map(|(name, one)| (format!("plate {name}"), one.material.as_str()));
    let patches =
        (spec.patch.iter()).map(|(name, one)| (format!("patch {name}"), one.material.as_str()));
    let layers =
        (spec.layer.iter()).map(|(name, one)| (format!("layer {name}"), one.material.as_str()));
    beams.chain(plates).chain(patches).chain(layers).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::bibliography::publication;
    use jounce_spec::material::LIBRARY;

    /// Names of authors in the sources of the library that are in the bibliography.
    const FAMILIES: &[&str] = &["Jaffe", "Erturk", "Bilgen", "Hopcroft"];

    #[test]
    fn the_publications_of_a_material_are_those_of_its_source() {
        for material in LIBRARY {
            let known = OF_MATERIALS.iter().find(|(name, _)| *name == material.name);
            let keys = known.map_or(&[][..], |(_, keys)| keys);
            for key in keys {
                let publication = publication(key).unwrap();
                let family = publication.authors[0].split(',').next().unwrap();
                let named = material.source.contains(family)
                    && material.source.contains(&format!("({})", publication.year));
                assert!(named, "{}: {key} is not in its source", material.name);
            }
            let named = FAMILIES
                .iter()
                .filter(|family| material.source.contains(**family));
            assert_eq!(named.count(), keys.len(), "{}", material.name);
        }
        let is_known = |name: &str| LIBRARY.iter().any(|material| material.name == name);
        assert!(OF_MATERIALS.iter().all(|(name, _)| is_known(name)));
    }
}
