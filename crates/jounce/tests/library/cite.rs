//! Publications of specs: the examples cite their sources, and each publication has its reason.

use jounce::{CiteResult, Harvester};
use jounce_spec::bibliography::publications;
use jounce_spec::material::LIBRARY;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

/// Files of an example that are not a harvester.
const OTHERS: &[&str] = &["design", "expected", "measured", "study"];

/// Returns the specs of all examples.
fn examples() -> Vec<(PathBuf, Harvester)> {
    let folders = std::fs::read_dir(EXAMPLES).unwrap();
    let files = folders.flat_map(|folder| std::fs::read_dir(folder.unwrap().path()).unwrap());
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let is_spec = |path: &PathBuf| {
        let stem = path.file_stem().unwrap().to_str().unwrap();
        path.extension().is_some_and(|one| one == "toml") && !OTHERS.contains(&stem)
    };
    let specs = paths.into_iter().filter(is_spec);
    specs
        .map(|path| (path.clone(), Harvester::read(&path).unwrap()))
        .collect()
}

fn keys(result: &CiteResult) -> Vec<&str> {
    result
        .citations
        .iter()
        .map(|one| one.key.as_str())
        .collect()
}

fn reasons<'a>(result: &'a CiteResult, key: &str) -> &'a [String] {
    let citation = result.citations.iter().find(|one| one.key == key);
    citation.map_or(&[], |one| &one.reasons)
}

/// Returns a text in ASCII with single spaces, as the READMEs are written.
fn plain(text: &str) -> String {
    let folded = text.replace('í', "i").replace('ê', "e");
    folded.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_example_cites_the_source_that_its_readme_names() {
    let all = examples();
    assert!(all.len() >= 28, "{} examples", all.len());
    for (path, harvester) in &all {
        let readme = std::fs::read_to_string(path.with_file_name("README.md")).unwrap();
        let readme = plain(&readme);
        let sources = &harvester.spec().source.publications;
        let is_own = readme.contains("of our own") || readme.contains("are ours");
        assert!(
            is_own || !sources.is_empty(),
            "{} names no source",
            path.display()
        );
        let result = harvester.cite();
        for key in sources {
            assert_eq!(reasons(&result, key)[0], "source of this harvester");
            let publication = publications().find(|one| one.key == key).unwrap();
            let year = format!("({}", publication.year);
            let is_year_named =
                readme.contains(&year) || readme.contains(&format!(", {})", publication.year));
            assert!(is_year_named, "{}: {key}: {year}", path.display());
            let family = publication
                .authors
                .first()
                .map_or("", |one| one.split(',').next().unwrap());
            let family = plain(family).replace(" Junior", "");
            assert!(
                readme.contains(&family),
                "{}: {key}: {family}",
                path.display()
            );
            let first_page = publication.pages.split('\u{2013}').next().unwrap();
            assert!(
                readme.contains(first_page),
                "{}: {key}: {first_page}",
                path.display()
            );
        }
    }
}

/// Titles in the READMEs are those of the bibliography, without regard to capitals.
#[test]
fn titles_in_the_readmes_are_those_of_the_bibliography() {
    let titled = [
        "impact-harvester-2019",
        "erturk-inman-2008",
        "erturk-inman-2009",
        "de-marqui-2009",
        "adhikari-2009",
        "umeda-1996",
        "cavallier-2005",
        "renaud-2009",
        "jacquelin-2011",
        "gu-livermore-2011",
        "gu-2011",
        "vijayan-2015",
        "bilgen-2010",
        "martinez-ayuso-2017",
        "shu-lien-2006",
    ];
    for key in titled {
        let title = publications()
            .find(|one| one.key == key)
            .unwrap()
            .title
            .to_lowercase();
        let mut with_source = examples().into_iter();
        let names = |harvester: &Harvester| {
            harvester
                .spec()
                .source
                .publications
                .iter()
                .any(|one| one == key)
        };
        let (path, _) = with_source.find(|(_, harvester)| names(harvester)).unwrap();
        let readme = plain(&std::fs::read_to_string(path.with_file_name("README.md")).unwrap());
        assert!(
            readme.to_lowercase().contains(&title),
            "{}: {title}",
            path.display()
        );
    }
}

#[test]
fn no_key_is_cited_twice_and_jounce_is_the_first() {
    for (path, harvester) in examples() {
        let result = harvester.cite();
        let keys = keys(&result);
        let distinct: BTreeSet<&str> = keys.iter().copied().collect();
        assert_eq!(distinct.len(), keys.len(), "{}: {keys:?}", path.display());
        assert_eq!(keys[0], "jounce");
        for citation in &result.citations {
            assert!(
                !citation.reasons.is_empty() && citation.bibtex.is_ascii(),
                "{}",
                citation.key
            );
        }
    }
}

fn example(name: &str) -> Harvester {
    Harvester::read(Path::new(EXAMPLES).join(name)).unwrap()
}

/// Returns specs that use what no example uses.
fn further_specs() -> Vec<Harvester> {
    let paper = example("impact-harvester-2019/harvester.toml");
    let rectifier = example("rectified-shu-lien-2006/harvester.toml");
    let table = "[0.0001, 0.0002]";
    let changes: [(&Harvester, &[(&str, &str)]); 5] = [
        (
            &paper,
            &[
                ("stop.tip.law", "table"),
                ("stop.tip.penetration_m", table),
                ("stop.tip.force_n", "[0.5, 2.0]"),
                ("stop.tip.stiffness", ""),
            ],
        ),
        (
            &paper,
            &[
                ("stop.tip.law", "hunt-crossley"),
                ("stop.tip.damping", "0.2 s/m"),
            ],
        ),
        (
            &paper,
            &[
                ("stop.tip.law", "rigid"),
                ("stop.tip.restitution", "0.7"),
                ("stop.tip.stiffness", ""),
                (
                    "stop.below",
                    "{at = \"beam.tip\", law = \"rigid\", gap = \"2 mm\", restitution = 0.7, side = \"negative\"}",
                ),
            ],
        ),
        (
            &rectifier,
            &[
                ("circuit.rectifier.interface", "parallel-sshi"),
                ("circuit.rectifier.quality_factor", "5"),
            ],
        ),
        (
            &rectifier,
            &[
                ("circuit.rectifier.interface", "sece"),
                ("circuit.rectifier.diode_resistance", ""),
            ],
        ),
    ];
    let changed = |(harvester, keys): &(&Harvester, &[(&str, &str)])| {
        harvester.changed(keys.iter().copied()).unwrap()
    };
    changes.iter().map(changed).collect()
}

#[test]
fn every_publication_is_cited_by_a_spec() {
    let examples = examples().into_iter().map(|(_, harvester)| harvester);
    let specs: Vec<Harvester> = examples.chain(further_specs()).collect();
    let results: Vec<CiteResult> = specs.iter().map(Harvester::cite).collect();
    let cited: BTreeSet<&str> = results.iter().flat_map(keys).collect();
    let unused: Vec<&str> = publications()
        .map(|one| one.key)
        .filter(|key| !cited.contains(key))
        .collect();
    assert!(unused.is_empty(), "{unused:?}");
}

#[test]
fn a_model_is_cited_only_where_it_is_used() {
    let plate = example("plate-de-marqui-2009/stop.toml").cite();
    let beam = example("impact-harvester-2019/harvester.toml").cite();
    for key in ["bogner-1966", "de-marqui-2009", "reddy-2004"] {
        assert!(
            keys(&plate).contains(&key) && !keys(&beam).contains(&key),
            "{key}"
        );
    }
    assert_eq!(reasons(&beam, "hertz-1881"), ["stop tip: Hertz contact"]);
    assert!(
        reasons(&beam, "szabo-babuska-1991").len() == 1
            && reasons(&plate, "szabo-babuska-1991").is_empty()
    );
    let linear = example("unimorph-erturk-2008/harvester.toml").cite();
    let of_orbits = [
        "doedel-1991",
        "nordmark-1991",
        "davis-rabinowitz-1984",
        "hertz-1881",
        "shu-lien-2006",
    ];
    assert!(
        of_orbits.iter().all(|key| !keys(&linear).contains(key)),
        "{:?}",
        keys(&linear)
    );
    let noise = example("random-base/harvester.toml").cite();
    assert!(keys(&noise).contains(&"shinozuka-jan-1972") && !keys(&noise).contains(&"doedel-1991"));
    assert!(!keys(&beam).contains(&"shinozuka-jan-1972"));
    let rectified = example("rectified-shu-lien-2006/harvester.toml").cite();
    assert_eq!(
        reasons(&rectified, "shu-lien-2006")[1],
        "circuit rectifier: full bridge"
    );
    assert!(
        !keys(&rectified).contains(&"guyomar-2005") && !keys(&rectified).contains(&"nordmark-1991")
    );
    assert_eq!(reasons(&beam, "jounce").len(), 2);
    assert_eq!(reasons(&rectified, "jounce"), ["all results"]);
}

#[test]
fn a_material_is_cited_where_an_element_uses_it() {
    let bimorph = example("bimorph-erturk-2009/harvester.toml");
    let names: Vec<&str> = bimorph
        .spec()
        .patch
        .values()
        .map(|one| one.material.as_str())
        .collect();
    assert!(
        names
            .iter()
            .all(|name| LIBRARY.iter().any(|one| one.name == *name)),
        "{names:?}"
    );
    let silicon = example("shock-cavallier-2005/harvester.toml").cite();
    assert!(
        keys(&silicon).contains(&"hopcroft-2010"),
        "{:?}",
        keys(&silicon)
    );
}

/// The source changes neither the results nor their origin.
#[test]
fn the_source_is_no_part_of_the_hash() {
    let with = example("bimorph-erturk-2009/harvester.toml");
    let without = with.changed([("source.publications", "")]).unwrap();
    assert!(without.spec().source.publications.is_empty());
    assert_eq!(with.hash_hex(), without.hash_hex());
}

#[test]
fn a_line_and_an_entry_hold_the_publication() {
    let result = example("two-beams-vijayan-2015/harvester.toml").cite();
    let citation = result
        .citations
        .iter()
        .find(|one| one.key == "vijayan-2015")
        .unwrap();
    assert_eq!(
        citation.text,
        "K. Vijayan, M. I. Friswell, H. Haddad Khodaparast and S. Adhikari, Non-linear energy harvesting from coupled impacting beams, \
         International Journal of Mechanical Sciences 96–97, 101–109 (2015)"
    );
    assert_eq!(
        citation.bibtex,
        "@article{vijayan-2015,\n  author = {Vijayan, K. and Friswell, M. I. and Haddad Khodaparast, H. and Adhikari, S.},\n  \
         title = {{Non-linear energy harvesting from coupled impacting beams}},\n  journal = {International Journal of Mechanical Sciences},\n  \
         volume = {96--97},\n  pages = {101--109},\n  year = {2015},\n}\n"
    );
}

#[test]
fn the_book_lists_every_publication() {
    let page = include_str!("../../../../book/src/howto/cite.md");
    for one in publications() {
        let row = format!("| `{}` | {} ({}) |", one.key, one.title, one.year);
        assert!(page.contains(&row), "book/src/howto/cite.md lacks {row}");
    }
    let rows = page
        .lines()
        .filter(|line| line.starts_with("| `") && line.ends_with(") |"));
    assert_eq!(rows.count(), publications().count());
}

/// A regulator has no periodic orbits, so nothing on continuation is cited.
#[test]
fn a_regulator_admits_no_continuation() {
    let sine = "{kind = \"base-acceleration\", amplitude = \"0.1 g\", frequency = \"46 Hz\"}";
    let sensor = example("wireless-sensor/harvester.toml");
    let sensor = sensor.changed([("drive.base", sine)]).unwrap();
    assert!(!keys(&sensor.cite()).contains(&"doedel-1991"));
}
