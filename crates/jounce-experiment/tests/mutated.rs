//! Damaged files of every format: a result or one clear error, never a panic, more than 10 s, or
//! more than 200 MB of memory.
//!
//! Every run reads a few thousand; `JOUNCE_MUTATIONS=10000000` sets the number,
//! `JOUNCE_MUTATIONS_FROM=NUMBER` the first one. Input `NUMBER` is reproducible.

#[path = "measured/formats/complete.rs"]
mod complete;
#[path = "measured/samples.rs"]
#[allow(dead_code, reason = "made for other tests too")]
mod samples;
#[path = "measured/formats/writers/mod.rs"]
mod writers;

use complete::complete_files;
use jounce_data::read::{Notes, summary};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Inputs of a run without the variable.
const COUNT: u64 = 4000;
const LONGEST: Duration = Duration::from_secs(10);
/// Bytes above the initial memory of the process.
const MOST_MEMORY: u64 = 200 << 20;

/// SplitMix64: numbers that depend on the seed only.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Changes a few places of the bytes: bits, bytes, words, segments; truncates, duplicates, or
/// inserts a piece of another file.
fn mutated(mut bytes: Vec<u8>, others: &[(&'static str, Vec<u8>)], random: &mut Random) -> Vec<u8> {
    for _ in 0..=random.below(4) {
        if bytes.is_empty() {
            break;
        }
        // Half of the changes are in the header, which has lengths and types.
        let reach = if random.below(2) == 0 {
            bytes.len().min(256)
        } else {
            bytes.len()
        };
        let at = random.below(reach);
        let end = (at + 1 + random.below(64)).min(bytes.len());
        match random.below(11) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.next() as u8,
            2 => bytes[at] = bytes[at].wrapping_add(1),
            3 => bytes[at..(at + 4).min(end)].fill(0xff),
            4 => bytes[at..(at + 8).min(end)].fill([0, 0x7f, 0xff][random.below(3)]),
            5 => {
                let word = [0, 1, 0x7fff_ffff, 0x8000_0000, 1 << 24, 0xffff_fffe][random.below(6)];
                let word_bytes = u32::to_le_bytes(word);
                bytes[at..]
                    .iter_mut()
                    .zip(word_bytes)
                    .for_each(|(to, from)| *to = from);
            }
            6 => drop(bytes.drain(at..end)),
            7 => drop(bytes.splice(at..at, bytes[at..end].to_vec())),
            8 => bytes.truncate(at),
            9 => {
                let other = &others[random.below(others.len())].1;
                let from = random.below(other.len());
                drop(bytes.splice(at..end, other[from..(from + 64).min(other.len())].to_vec()));
            }
            _ => {
                let digits = b"0123456789.-+eE,;\t\n \"NaD";
                bytes[at] = digits[random.below(digits.len())];
            }
        }
    }
    bytes
}

/// A line of the status of this process, bytes.
fn status(key: &str) -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix(key))
        .unwrap_or("0 kB");
    line.trim_matches([':', '\t', ' '])
        .trim_end_matches(" kB")
        .parse::<u64>()
        .unwrap_or(0)
        << 10
}

fn from_environment(key: &str, otherwise: u64) -> u64 {
    std::env::var(key).ok().map_or(otherwise, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{key} is {text}; give a whole number"))
    })
}

/// Number of the current input, and its start, ms.
static NUMBER: AtomicU64 = AtomicU64::new(0);
static SINCE_MS: AtomicU64 = AtomicU64::new(0);

/// Ends the process where an input takes too long, since no other mechanism does.
fn control(begin: Instant) {
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let since = Duration::from_millis(SINCE_MS.load(Ordering::Relaxed));
            if begin.elapsed().saturating_sub(since) > LONGEST {
                eprintln!(
                    "input {} takes more than {LONGEST:?}",
                    NUMBER.load(Ordering::Relaxed)
                );
                std::process::exit(1);
            }
        }
    });
}

#[test]
fn damaged_files_give_a_result_or_an_error() {
    let folder = tempfile::tempdir_in(Path::new("/dev/shm"))
        .or_else(|_| tempfile::tempdir())
        .expect("a folder");
    let complete_files = complete_files(folder.path());
    for (ending, bytes) in &complete_files {
        let path = folder.path().join(format!("whole.{ending}"));
        std::fs::write(&path, bytes).expect("a file");
        std::fs::write(
            Notes::path_of(&path),
            if *ending == "npy" {
                "rate = \"1 kHz\"\n"
            } else {
                ""
            },
        )
        .expect("notes");
        summary(&path).unwrap_or_else(|fault| panic!("the whole file: {fault}"));
    }
    let (from, count) = (
        from_environment("JOUNCE_MUTATIONS_FROM", 0),
        from_environment("JOUNCE_MUTATIONS", COUNT),
    );
    let begin = Instant::now();
    control(begin);
    let (mut slowest, mut read, before) = (Duration::ZERO, 0, status("VmRSS"));
    for number in from..from + count {
        let mut random = Random(number);
        let (ending, bytes) = &complete_files[random.below(complete_files.len())];
        let damaged = mutated(bytes.clone(), &complete_files, &mut random);
        let path = folder.path().join(format!("damaged.{ending}"));
        std::fs::write(&path, &damaged).expect("a file");
        NUMBER.store(number, Ordering::Relaxed);
        SINCE_MS.store(begin.elapsed().as_millis() as u64, Ordering::Relaxed);
        let since = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            summary(&path)
                .map(|_| ())
                .map_err(|fault| fault.to_string())
        }));
        slowest = slowest.max(since.elapsed());
        match outcome {
            Ok(Ok(())) => read += 1,
            Ok(Err(fault)) => assert!(fault.contains("damaged"), "input {number}: {fault}"),
            Err(_) => panic!("input {number}, {ending}: a panic"),
        }
        // The peak covers all inputs so far, so the first one above the limit is named.
        let peak = status("VmHWM").saturating_sub(before);
        assert!(peak < MOST_MEMORY, "input {number}, {ending}: {peak} bytes");
    }
    let peak = status("VmHWM").saturating_sub(before);
    eprintln!(
        "{count} inputs from {from}, {read} read, slowest {slowest:.3?}, peak {:.1} MB, {:.0?}",
        peak as f64 / 1e6,
        begin.elapsed()
    );
}
