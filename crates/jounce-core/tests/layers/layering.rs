//! The layers from left to right, and violations of their order.

use super::paths::uses;

/// File with its path below `src/`.
#[derive(Debug, Clone)]
pub struct Source {
    /// Path with slashes, as in `integrate/flight.rs`.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// Names of the layers, leftmost first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layering(Vec<String>);

/// Start of the layer list of a crate in a document; the name of the crate follows.
const OPENING: &str = "```text layers of ";

impl Layering {
    /// Reads the list of a crate from the block "```text layers of CRATE": one layer per line, its
    /// name first.
    pub fn from_markdown(text: &str, name: &str) -> Option<Self> {
        let opens = |line: &str| line.trim_end().strip_prefix(OPENING) == Some(name);
        let lines = text
            .lines()
            .skip_while(|line| !opens(line))
            .skip(1)
            .take_while(|line| !line.starts_with("```"));
        let names: Vec<String> = lines
            .filter_map(|line| line.split_whitespace().next().map(str::to_owned))
            .collect();
        (!names.is_empty()).then_some(Self(names))
    }

    /// Returns every violation of the order, one sentence each.
    pub fn faults(&self, sources: &[Source]) -> Vec<String> {
        let mut folders: Vec<&str> = sources
            .iter()
            .filter_map(|source| layer_of(&source.path))
            .collect();
        folders.sort_unstable();
        folders.dedup();
        let unlisted = folders
            .iter()
            .filter(|folder| self.position(folder).is_none());
        let absent = self
            .0
            .iter()
            .filter(|layer| !folders.contains(&layer.as_str()));
        let mut faults: Vec<String> = unlisted
            .map(|folder| format!("`{folder}` is not in the layer list of ARCHITECTURE.md"))
            .collect();
        faults.extend(absent.map(|layer| {
            format!("ARCHITECTURE.md lists `{layer}`, but the crate has no such module")
        }));
        faults.extend(sources.iter().flat_map(|source| self.faults_of(source)));
        faults
    }

    fn faults_of(&self, source: &Source) -> Vec<String> {
        // The root of the crate may use all modules.
        let Some(layer) = layer_of(&source.path) else {
            return Vec::new();
        };
        let used = uses(&source.text, depth_of(&source.path));
        let says =
            |used: &super::paths::Use, why: String| format!("{}:{}: {why}", source.path, used.line);
        used.iter()
            .filter_map(
                |used| match (self.position(layer), self.position(&used.name)) {
                    (_, None) => Some(says(
                        used,
                        format!(
                            "`crate::{}` is not a layer; name the layer that holds it",
                            used.name
                        ),
                    )),
                    (Some(position), Some(other)) if other > position => Some(says(
                        used,
                        format!("`{layer}` uses `{}`, which stands to its right", used.name),
                    )),
                    _ => None,
                },
            )
            .collect()
    }

    fn position(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|layer| layer == name)
    }
}

/// Layer of a file; `None` for the root of the crate.
fn layer_of(path: &str) -> Option<&str> {
    match path.split_once('/') {
        Some((folder, _)) => Some(folder),
        None => path.strip_suffix(".rs").filter(|name| *name != "lib"),
    }
}

/// Number of modules from the root down to the file.
fn depth_of(path: &str) -> usize {
    path.split('/').filter(|part| *part != "mod.rs").count()
}

#[cfg(test)]
mod tests {
    use super::{Layering, Source, depth_of};

    const LIST: &str = "# A\n\n```text layers of a\nother   crate\n```\n\n```text layers of jounce\nspec    says\nplant   linear\nintegrate time\n```\n\n```text\nother\n```\n";

    fn faults(files: &[(&str, &str)]) -> Vec<String> {
        let source = |(path, text): &(&str, &str)| Source {
            path: (*path).to_owned(),
            text: (*text).to_owned(),
        };
        let layering = Layering::from_markdown(LIST, "jounce").expect("the list is there");
        layering.faults(&files.iter().map(source).collect::<Vec<_>>())
    }

    const ALL_FILES: [(&str, &str); 4] = [
        (
            "lib.rs",
            "pub mod integrate; use crate::integrate::Integrator;",
        ),
        ("spec/mod.rs", ""),
        ("plant/mod.rs", "use crate::spec::Spec;"),
        (
            "integrate/flight.rs",
            "use crate::{plant::Plant, spec, integrate::Kernel}; use super::super::plant;",
        ),
    ];

    #[test]
    fn arrows_to_the_left_pass() {
        assert_eq!(faults(&ALL_FILES), Vec::<String>::new());
    }

    #[test]
    fn an_arrow_to_the_right_is_caught_however_it_is_written() {
        for text in [
            "\nuse crate::integrate::Integrator;",
            "\nfn f() { crate::integrate::go() }",
            "\nuse crate::{spec, integrate};",
            "\nuse super::super::integrate;",
        ] {
            let violations = faults(&[&ALL_FILES[..], &[("plant/system.rs", text)]].concat());
            assert_eq!(
                violations,
                ["plant/system.rs:2: `plant` uses `integrate`, which stands to its right"],
                "{text}"
            );
        }
    }

    #[test]
    fn tests_and_comments_may_point_anywhere() {
        let text = "//! See [`crate::integrate`].\n#[cfg(test)]\nmod tests { use crate::integrate::Integrator; }";
        assert_eq!(
            faults(&[&ALL_FILES[..], &[("plant/system.rs", text)]].concat()),
            Vec::<String>::new()
        );
    }

    #[test]
    fn a_way_round_through_the_root_is_caught() {
        let violations = faults(
            &[
                &ALL_FILES[..],
                &[("plant/system.rs", "use crate::Integrator;")],
            ]
            .concat(),
        );
        assert_eq!(
            violations,
            ["plant/system.rs:1: `crate::Integrator` is not a layer; name the layer that holds it"]
        );
    }

    #[test]
    fn a_folder_that_is_not_listed_and_a_layer_without_folder_are_caught() {
        let violations =
            faults(&[&ALL_FILES[..3], &[("orbit/mod.rs", ""), ("extra.rs", "")]].concat());
        assert_eq!(violations.len(), 3, "{violations:?}");
        assert!(
            violations[0].contains("`extra`")
                && violations[1].contains("`orbit`")
                && violations[2].contains("`integrate`"),
            "{violations:?}"
        );
    }

    #[test]
    fn a_document_without_the_list_has_none() {
        assert_eq!(
            Layering::from_markdown("```text\nspec\n```", "jounce"),
            None
        );
    }

    #[test]
    fn depth_counts_modules() {
        assert_eq!(
            [
                depth_of("integrate/mod.rs"),
                depth_of("integrate/flight.rs"),
                depth_of("spec/key/mod.rs"),
                depth_of("lib.rs")
            ],
            [1, 2, 2, 1]
        );
    }
}
