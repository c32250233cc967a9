//! The reader never panics, always reports the place of a fault, and finishes in bounded time.
//!
//! `JOUNCE_FUZZ_SECONDS=600 cargo test --release -p jounce-spec --test spec fuzz` runs longer. Inputs
//! that break the reader are written to the corpus folder as `found-*.toml`.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use jounce_spec::{Spec, SpecFile};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRng, TestRunner};

use crate::{MODAL, paper, random};

/// Words of the syntax.
const WORDS: &[&str] = &[
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    ".",
    ",",
    "\"",
    "'",
    "\"\"\"",
    "'''",
    "\n",
    "\r\n",
    "#",
    "nan",
    "inf",
    "-inf",
    "true",
    "1979-05-27",
    "0x10",
    "1e999",
    "-",
    "9999999999999999999999",
    "\u{feff}",
    "\0",
    "\u{b5}",
    "\u{3a9}",
    "\\",
    "\\u0000",
    "[beam.beam]",
    "[stop.tip]",
    "[[stop]]",
    "law = \"rigid\"",
    "law = \"spring\"",
    "\"1 mm\"",
    "\"-1 kN/mm^(3/2)\"",
    "\"1 N/m s\"",
    "exponent = 2",
    "root = \"end\"",
    "a.b.c",
    "((((",
    "^^",
];

fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let base = prop_oneof![
        Just(paper()),
        Just(MODAL.to_owned()),
        random::spec().prop_map(|spec| spec.to_toml())
    ];
    let edit = (
        any::<prop::sample::Index>(),
        any::<prop::sample::Index>(),
        0..5u8,
        prop::sample::select(WORDS),
    );
    (base, prop::collection::vec(edit, 1..12)).prop_map(|(base, edits)| {
        let mut bytes = base.into_bytes();
        for (first, second, kind, word) in edits {
            let (a, b) = (first.index(bytes.len() + 1), second.index(bytes.len() + 1));
            mutate(&mut bytes, a.min(b), a.max(b), kind, word);
        }
        bytes
    })
}

fn mutate(bytes: &mut Vec<u8>, from: usize, to: usize, kind: u8, word: &str) {
    match kind {
        0 => drop(bytes.drain(from..to.min(from + 40))),
        1 => drop(bytes.splice(from..from, word.bytes())),
        2 => drop(bytes.splice(from..to.min(from + 8), word.bytes())),
        3 => {
            let piece = bytes[from..to.min(from + 200)].to_vec();
            let end = bytes.len();
            bytes.splice(end..end, piece);
        }
        // Swapping complete lines preserves much of the grammar.
        _ => {
            let mut lines: Vec<Vec<u8>> = bytes
                .split(|byte| *byte == b'\n')
                .map(<[u8]>::to_vec)
                .collect();
            let count = lines.len();
            lines.swap(from % count, to % count);
            *bytes = lines.join(&b'\n');
        }
    }
}

fn garbage() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..400),
        prop::collection::vec(prop::sample::select(WORDS), 0..60)
            .prop_map(|words| words.concat().into_bytes()),
    ]
}

/// Processor time of this thread, which does not grow when other programs run; time on the clock
/// where the system does not count it.
fn processor_time() -> Duration {
    static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|text| text.split(' ').next()?.parse().ok())
        .map_or_else(|| BEGIN.elapsed(), Duration::from_nanos)
}

/// Requirements for any bytes; the error names the one that fails.
fn check(bytes: &[u8]) -> Result<(), String> {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return Ok(());
    };
    let start = processor_time();
    let mut file = SpecFile::from_text(text);
    match file.spec() {
        Ok(spec) => {
            let again = Spec::from_toml(&spec.to_toml())
                .map_err(|faults| format!("printed spec has faults: {faults}"))?;
            if again != spec {
                return Err("printed spec differs".to_owned());
            }
        }
        Err(faults) => {
            let lines: Vec<&str> = text.split('\n').collect();
            if faults.as_slice().is_empty() || faults.to_string().is_empty() {
                return Err("refused without a fault".to_owned());
            }
            let is_placed =
                |fault: &&jounce_spec::Fault| !fault.message.starts_with("there are more faults");
            for fault in faults.as_slice().iter().filter(is_placed) {
                let line_end = fault
                    .line
                    .checked_sub(1)
                    .and_then(|line| lines.get(line))
                    .map(|line| line.chars().count() + 1);
                if line_end.is_none_or(|most| fault.column == 0 || fault.column > most) {
                    return Err(format!("no such place: {fault}"));
                }
            }
        }
    }
    if file.set("stop.tip.gap", text).is_ok() {
        let _ = (file.spec(), file.text());
    }
    let duration = processor_time() - start;
    // Measured: 0.2 to 7 s per megabyte on an idle core, for any content; a time that grows with the
    // square of the length is minutes.
    if duration > Duration::from_secs_f64(2.0 + 30e-6 * text.len() as f64) {
        Err(format!("took {duration:?}"))
    } else {
        Ok(())
    }
}

#[test]
fn fuzz_the_reader() {
    let seconds = std::env::var("JOUNCE_FUZZ_SECONDS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(2u64);
    let config = Config {
        failure_persistence: None,
        ..Config::default()
    };
    // The short run is reproducible; the long one is not.
    let mut runner = if seconds > 2 {
        TestRunner::new(config)
    } else {
        TestRunner::new_with_rng(config, TestRng::deterministic_rng(Default::default()))
    };
    let strategy = prop_oneof![3 => mutated(), 1 => garbage()];
    let start = Instant::now();
    let mut cases = 0u64;
    while start.elapsed().as_secs() < seconds && (seconds > 2 || cases < 500) {
        let bytes = strategy.new_tree(&mut runner).unwrap().current();
        let outcome = catch_unwind(AssertUnwindSafe(|| check(&bytes)))
            .unwrap_or_else(|_| Err("panicked".to_owned()));
        if let Err(reason) = outcome {
            let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/spec");
            let path = folder.join(format!(
                "found-{:08x}.toml",
                cases ^ u64::from(std::process::id()) << 16
            ));
            std::fs::write(&path, &bytes).unwrap();
            panic!("{reason}; after {cases} cases; kept as {}", path.display());
        }
        cases += 1;
    }
    eprintln!("{cases} cases");
}

#[test]
fn large_files_are_read_in_bounded_time() {
    let many =
        |count: usize, line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    for text in [
        many(20_000, &|i| format!("[beam.b{i}]\nroot = \"b{i}\"\n")),
        many(20_000, &|i| {
            format!(
                "[mass.m{i}]\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.1\n[stop.s{i}]\nat = \"n{i}\"\n"
            )
        }),
        many(100_000, &|i| format!("key{i} = {i}\n")),
        format!("x = [{}]", "1,".repeat(300_000)),
        format!("x = {}", "[".repeat(100_000)),
        format!("{} = 1", "a.".repeat(50_000) + "a"),
        format!("[{}]", "a.".repeat(50_000) + "a"),
        format!("{} = {{{}", "a.".repeat(50) + "a", "a = {".repeat(50_000)),
        format!("[run]\nstart = \"{}\"", "x".repeat(2_000_000)),
        format!("[run]\nduration = \"{} s\"", "1".repeat(2_000_000)),
        format!("[run]\nduration = \"1 {}\"", "(".repeat(190)),
        many(50_000, &|_| "[\n".to_owned()),
        many(50_000, &|_| "[run]\n".to_owned()),
        many(50_000, &|i| format!("a{i} = = 1\n")),
    ] {
        let start = processor_time();
        check(text.as_bytes()).unwrap_or_else(|reason| panic!("{}: {reason}", &text[..40]));
        eprintln!(
            "{:?} for {} bytes of {:?}",
            processor_time() - start,
            text.len(),
            &text[..30.min(text.len())]
        );
    }
}
