//! The library's results for the starts of a cloud against brute-force integrations.

use crate::brute::{Ending, Kind};
use crate::endings::{Effort, endings};
use crate::library::{Account, AccountKind, accounts, empty_interval};
use jounce_analysis::{InitialStates, Model, wilson};
use jounce_model::plant::Plant;
use jounce_spec::SpecFile;
use std::fmt::{self, Display};
use std::time::Instant;

/// Largest relative difference of the powers of one attractor.
const POWER: f64 = 1e-4;

/// Distance from the limit at which a motion counts as periodic, relative to its size, with a
/// margin of ten. It limits the accuracy of the power of a voltage that is small in the motion.
const CLOSE: f64 = 1e-7;

/// Largest distance between states of one attractor, relative to the size of the motion.
const STATES: f64 = 1e-4;

/// Number of blocks of starts; the intervals of each are compared with the shares of all other starts.
const BLOCKS: usize = 8;

/// Errors per step, relative to that of the comparison, for repeated integrations of starts with
/// different results.
const AGAIN: [f64; 3] = [3.0, 10.0, 100.0];

/// Verdict on one start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Both end on one attractor.
    Same,
    /// They end on different ones.
    Different,
    /// They do, but brute force with a larger error per step ends where the library does. The start
    /// lies so near a basin boundary, or its transient is so long, that steps of this error do not
    /// decide.
    Sensitive,
    /// The library gives no result.
    Undecided,
    /// Brute force gives no result.
    Unknown,
}

/// Result of a comparison.
pub struct Agreement {
    pub endings: Vec<Ending>,
    pub accounts: Vec<Account>,
    pub verdicts: Vec<Verdict>,
    /// Number of intervals checked, and of those that contain the brute-force share, for the same
    /// starts.
    pub same_starts: [usize; 2],
    /// Same counts, for intervals of each block of starts and shares of the others, where a start may
    /// end on another attractor: 93.6 % must contain them, since the shares scatter too.
    pub other_starts: [usize; 2],
    /// Wall time of the library and of brute force, s.
    pub seconds: [f64; 2],
}

/// True where the states of two motions are equal up to a shift by some cycles.
fn same_states(a: &[Vec<f64>], b: &[Vec<f64>], size: f64) -> bool {
    let distance = |x: &[f64], y: &[f64]| {
        x.iter()
            .zip(y)
            .map(|(x, y)| (x - y).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let n = a.len();
    n == b.len()
        && (0..n).any(|shift| (0..n).all(|i| distance(&a[i], &b[(i + shift) % n]) <= STATES * size))
}

/// True where a power equals that of an ending: relative to it, and within the error of the states,
/// `2 sqrt(P P_close) + P_close`.
fn same_power(ending: &Ending, power_w: f64) -> bool {
    let (larger, close) = (
        ending.mean_power_w.max(power_w),
        CLOSE * CLOSE * ending.power_scale_w,
    );
    (ending.mean_power_w - power_w).abs() <= POWER * larger + 2.0 * (larger * close).sqrt() + close
}

/// Compares an ending with an account of the library.
fn verdict(ending: &Ending, account: Option<&Account>) -> Verdict {
    let Some(account) = account else {
        return Verdict::Undecided;
    };
    match (ending.kind, account.kind) {
        (Kind::Lost | Kind::Unsettled, _) => Verdict::Unknown,
        (_, AccountKind::Undecided) => Verdict::Undecided,
        (Kind::Periodic(period), AccountKind::Periodic(library_period)) => {
            let powers = same_power(ending, account.mean_power_w);
            if period == library_period
                && powers
                && same_states(&ending.strobe, &account.strobe, ending.size)
            {
                Verdict::Same
            } else {
                Verdict::Different
            }
        }
        (Kind::Torus, AccountKind::Torus) | (Kind::Chaos, AccountKind::Chaos) => Verdict::Same,
        // Brute force does not search for such a long period.
        (Kind::Torus, AccountKind::Periodic(theirs)) if theirs > ending.cycles / 4 => {
            Verdict::Unknown
        }
        _ => Verdict::Different,
    }
}

/// Groups endings into attractors by their numbers; those without a period by their kind.
pub fn groups(endings: &[Ending]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, ending) in endings.iter().enumerate() {
        let is_one = |group: &&mut Vec<usize>| {
            let known = &endings[group[0]];
            known.kind == ending.kind
                && (!matches!(ending.kind, Kind::Periodic(_))
                    || same_power(known, ending.mean_power_w)
                        && same_states(&known.strobe, &ending.strobe, ending.size))
        };
        match groups.iter_mut().find(is_one) {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    groups
}

/// Returns the physical states `(q, q', V)` of all starts.
pub fn physical(plant: &Plant, starts: &InitialStates) -> Vec<Vec<f64>> {
    (0..starts.len())
        .map(|index| starts.start(plant, index))
        .collect()
}

/// Compares both on one spec.
pub fn compare(file: &SpecFile, starts: InitialStates, effort: &Effort) -> Agreement {
    let prepared = Model::new(file.spec().unwrap()).unwrap();
    let plant = &prepared.kernel.plant;
    let begin = Instant::now();
    let physical = physical(plant, &starts);
    let endings = endings(&plant.system, &physical, effort);
    let brute_s = begin.elapsed().as_secs_f64();
    let begin = Instant::now();
    let results = accounts(file, starts);
    let library_s = begin.elapsed().as_secs_f64();
    let of = |index: usize| {
        results
            .iter()
            .find(|account| account.starts.contains(&index))
    };
    let recompute = |index: usize, factor: f64| {
        let start = std::slice::from_ref(&physical[index]);
        verdict(
            &self::endings(&plant.system, start, &effort.with_larger_error(factor))[0],
            of(index),
        )
    };
    let decide = |(index, ending): (usize, &Ending)| match verdict(ending, of(index)) {
        Verdict::Different
            if AGAIN
                .iter()
                .any(|factor| recompute(index, *factor) == Verdict::Same) =>
        {
            Verdict::Sensitive
        }
        decided => decided,
    };
    let verdicts = endings.iter().enumerate().map(decide).collect();
    Agreement {
        same_starts: coverage(&endings, &results),
        other_starts: coverage_of_other_starts(&endings, &results),
        endings,
        accounts: results,
        verdicts,
        seconds: [library_s, brute_s],
    }
}

/// Coverage of brute-force shares by the library's intervals for blocks of the starts.
fn coverage_of_other_starts(endings: &[Ending], accounts: &[Account]) -> [usize; 2] {
    let (all, block) = (endings.len(), endings.len() / BLOCKS);
    let groups = groups(endings);
    let (mut checked, mut inside) = (0, 0);
    for group in groups.iter().filter(|group| group.len() < all) {
        let ending = &endings[group[0]];
        let reached = accounts
            .iter()
            .find(|account| verdict(ending, Some(account)) == Verdict::Same);
        let found = reached.map_or(&[][..], |account| &account.starts);
        checked += BLOCKS;
        inside += blocks_inside((found, group), (BLOCKS, block), all);
    }
    [checked, inside]
}

/// Number of blocks of starts in which the interval of the share of `found` contains the share of
/// `reference` among all other starts. The starts of a cloud are drawn one by one, so each block is a
/// cloud too.
pub fn blocks_inside(
    (found, reference): (&[usize], &[usize]),
    (blocks, block): (usize, usize),
    all: usize,
) -> usize {
    let is_inside = |first: &usize| {
        let is_here = |start: &&usize| (*first..first + block).contains(*start);
        let hits = found.iter().filter(is_here).count();
        let others = reference.iter().filter(|start| !is_here(start)).count();
        let share = others as f64 / (all - block) as f64;
        let interval = wilson(hits, block);
        (interval.low..=interval.high).contains(&share)
    };
    (0..blocks).map(|k| k * block).filter(is_inside).count()
}

/// Number of attractors by brute force, and of those whose share lies in the library's interval.
fn coverage(endings: &[Ending], accounts: &[Account]) -> [usize; 2] {
    let groups = groups(endings);
    let holds = |group: &&Vec<usize>| {
        let ending = &endings[group[0]];
        let reached = accounts
            .iter()
            .find(|account| verdict(ending, Some(account)) == Verdict::Same);
        let [low, high] = reached.map_or_else(
            || empty_interval(endings.len()),
            |account| [account.share.low, account.share.high],
        );
        (low..=high).contains(&(group.len() as f64 / endings.len() as f64))
    };
    [groups.len(), groups.iter().filter(holds).count()]
}

impl Agreement {
    /// Number of attractors by brute force and by the library.
    pub fn attractors(&self) -> [usize; 2] {
        let decided = self
            .accounts
            .iter()
            .filter(|account| account.kind != AccountKind::Undecided);
        [groups(&self.endings).len(), decided.count()]
    }

    /// Number of starts with a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.verdicts
            .iter()
            .filter(|other| **other == verdict)
            .count()
    }
}

impl Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [library_s, brute_s] = self.seconds;
        let counts = [
            Verdict::Same,
            Verdict::Different,
            Verdict::Sensitive,
            Verdict::Undecided,
            Verdict::Unknown,
        ]
        .map(|verdict| self.count(verdict));
        let [same, different, sensitive, undecided, unknown] = counts;
        let [brute_force, library] = self.attractors();
        writeln!(
            f,
            "same {same} different {different} sensitive {sensitive} undecided {undecided} unknown {unknown}"
        )?;
        writeln!(
            f,
            "  attractors by brute force {brute_force}, by the library {library}"
        )?;
        let [all, inside] = self.same_starts;
        let [others, other_inside] = self.other_starts;
        writeln!(
            f,
            "  shares in their intervals: {inside} of {all}; of other starts {other_inside} of {others}"
        )?;
        let cycles: usize = self.endings.iter().map(|ending| ending.cycles).sum();
        writeln!(
            f,
            "  library {library_s:.2} s, brute force {brute_s:.2} s over {cycles} cycles"
        )?;
        for group in groups(&self.endings) {
            let Ending {
                kind,
                mean_power_w,
                exponent,
                ..
            } = &self.endings[group[0]];
            let exponent = exponent.map_or(String::new(), |[value, error]| {
                format!(", exponent {value:.5} +- {error:.5} a cycle")
            });
            writeln!(
                f,
                "  brute force {kind:?} {mean_power_w:.9e} W: {}{exponent}",
                group.len()
            )?;
        }
        for account in &self.accounts {
            writeln!(
                f,
                "  library     {} {:.9e} W: {}",
                account.id,
                account.mean_power_w,
                account.starts.len()
            )?;
        }
        Ok(())
    }
}
