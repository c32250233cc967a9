//! Run of a harvester by brute force: contacts, strobed states and energies.

use super::system::Drawn;
use super::with_model;
use crate::brute::{Flow, Passage, Phase, Record, ReferenceModel, STEP_TOLERANCE, Work};
use jounce_model::contact::Law;
use jounce_model::plant::System;

/// Begin of a contact.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    pub time_s: f64,
    pub speed_m_s: f64,
}

/// Fraction of a drive cycle after the start within which a begin is a contact of the start.
pub const AT_START: f64 = 1e-6;

/// A run by brute force.
pub struct Run {
    /// Contacts of each stop that begin after the start.
    pub contacts: Vec<Vec<Contact>>,
    /// Time in contact of each stop that yields on one side, s.
    pub contact_s: Vec<Option<f64>>,
    /// States at the start and after each cycle, energy coordinates.
    pub strobe: Vec<Vec<f64>>,
    /// Largest norm of the motion in energy coordinates.
    pub size: f64,
    pub energies: Energies,
    /// True where the integration was ended.
    pub is_lost: bool,
    /// Begins and ends of all contacts.
    pub passages: Vec<Passage>,
}

/// Energies of a run, J.
#[derive(Debug, Clone, Copy)]
pub struct Energies {
    pub work: Work,
    pub load_j: f64,
    pub stored_j: f64,
}

impl Energies {
    /// Named energies.
    pub fn list(&self) -> [(&'static str, f64); 6] {
        [
            ("input", self.work.input_j),
            ("load", self.load_j),
            ("leakage", self.work.leak_j),
            ("damping", self.work.damping_j),
            ("contact loss", self.work.contact_j),
            ("stored", self.stored_j),
        ]
    }

    /// Input less everything else.
    pub fn residual_j(&self) -> f64 {
        2.0 * self.work.input_j - self.list().iter().map(|(_, energy)| energy).sum::<f64>()
    }
}

/// Start of a run, physical `(q, q', V)`, and a factor on its drive.
pub struct Start<'a> {
    pub physical: &'a [f64],
    pub drive: f64,
}

/// Integrates as [`run`] with another error per step.
pub fn run_at(system: &System, start: &Start, cycles: usize, tolerance: f64) -> Run {
    with_model!(system, run_of, system, start, (cycles, tolerance))
}

/// Integrates a system for some cycles.
pub fn run(system: &System, start: &Start, cycles: usize) -> Run {
    if start.drive == 1.0 {
        return run_at(system, start, cycles, STEP_TOLERANCE);
    }
    let mut system = system.clone();
    system.drives[0].amplitude_n *= start.drive;
    run_at(&system, start, cycles, STEP_TOLERANCE)
}

fn run_of<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    system: &System,
    start: &Start,
    (cycles, tolerance): (usize, f64),
) -> Run {
    let flow = Flow {
        model,
        tolerance,
        has_series: true,
    };
    let mut motion = flow.start(model.state(start.physical));
    let begin_j = model.stored(&motion.state, &motion.phases) + flow.slack_j(&motion);
    let mut record = Record::default();
    record.work.contact_j = flow.slack_j(&motion);
    motion.record = Some(record);
    let mut strobe = vec![model.energy_coordinates(&motion.state)];
    let mut size = motion.size;
    for _ in 0..cycles {
        flow.cycle(&mut motion);
        size = size.max(motion.size);
        strobe.push(model.energy_coordinates(&motion.state));
    }
    let mut record = motion.record.take().unwrap_or_default();
    // The library counts the energy of a stop as stored until the point has left it.
    let slack_j = flow.slack_j(&motion);
    record.work.contact_j -= slack_j;
    let end_s = cycles as f64 * model.cycle_s;
    let of = |p: usize| {
        record
            .passages
            .iter()
            .filter(move |passage| passage.stop == p)
    };
    let contacts = |p: usize| begins(of(p), AT_START * model.cycle_s);
    let contact_s = |p: usize| match system.stops[p].law {
        Law::Cubic(_) | Law::Rigid(_) => None,
        _ => {
            let is_open = motion.phases[p] == Phase::Free;
            let ended_s: f64 = of(p).map(signed_time_s).sum();
            Some(ended_s + if is_open { 0.0 } else { end_s })
        }
    };
    let stops = 0..system.stops.len();
    Run {
        contacts: stops.clone().map(contacts).collect(),
        contact_s: stops.map(contact_s).collect(),
        energies: Energies {
            work: record.work,
            load_j: motion.state[D - 1],
            stored_j: model.stored(&motion.state, &motion.phases) + slack_j - begin_j,
        },
        strobe,
        size,
        is_lost: motion.is_lost,
        passages: record.passages.clone(),
    }
}

/// Contacts that begin after a time.
fn begins<'a>(passages: impl Iterator<Item = &'a Passage>, after_s: f64) -> Vec<Contact> {
    passages
        .filter(|passage| passage.begins && passage.time_s > after_s)
        .map(|passage| Contact {
            time_s: passage.time_s,
            speed_m_s: passage.speed_m_s,
        })
        .collect()
}

/// Time of an end, and minus that of a begin.
fn signed_time_s(passage: &Passage) -> f64 {
    if passage.begins {
        -passage.time_s
    } else {
        passage.time_s
    }
}

/// Physical state in energy coordinates.
pub fn energy_coordinates(system: &System, physical: &[f64]) -> Vec<f64> {
    with_model!(system, coordinates, physical)
}

fn coordinates<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    physical: &[f64],
) -> Vec<f64> {
    model.energy_coordinates(&model.state(physical))
}

/// Largest difference of the begins of contacts, s. Contacts of a rigid stop slower than a limit
/// belong to chatter and need no counterpart. Infinite where a contact has none.
pub fn contact_shift_s(a: &[Contact], b: &[Contact], chatter_m_s: Option<f64>) -> f64 {
    let Some(least) = chatter_m_s else {
        if a.len() != b.len() {
            return f64::INFINITY;
        }
        let pairs = a.iter().zip(b);
        return pairs.fold(0.0, |max, (a, b)| {
            f64::max(max, (a.time_s - b.time_s).abs())
        });
    };
    let nearest = |contact: &Contact, others: &[Contact]| {
        let shifts = others
            .iter()
            .map(|other| (other.time_s - contact.time_s).abs());
        shifts.fold(f64::INFINITY, f64::min)
    };
    let of = |these: &[Contact], others: &[Contact]| {
        let fast = these.iter().filter(|contact| contact.speed_m_s > least);
        fast.fold(0.0, |max: f64, contact| max.max(nearest(contact, others)))
    };
    of(a, b).max(of(b, a))
}

/// Speed below which an impact on a stop belongs to chatter: a part of its largest one. `None` for a
/// stop that yields.
pub fn chatter_m_s(law: &Law, contacts: &[Contact]) -> Option<f64> {
    let largest = contacts
        .iter()
        .fold(0.0_f64, |max, contact| max.max(contact.speed_m_s));
    matches!(law, Law::Rigid(_)).then_some(1e-4 * largest)
}

/// Distance of two states.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

impl Drawn {
    /// Start perturbed by a part of the size of the motion in a fixed irregular direction. From
    /// rest, the drive is perturbed instead, so that touching points keep touching.
    pub fn perturbed(&self, size: f64, part: f64) -> (Vec<f64>, f64) {
        if self.start.iter().all(|x| *x == 0.0) {
            return (self.start.clone(), 1.0 + part);
        }
        let modes = &self.merged.modes;
        let n = modes.len();
        let angular = std::f64::consts::TAU * self.merged.drives[0].frequency_hz;
        let mut start = self.start.clone();
        let unit = |i: usize| (1.0 + 7.3 * i as f64).sin() / (n as f64).sqrt();
        for i in 0..n {
            let frequency = modes.frequency_rad_s[i];
            let w = if frequency > 0.0 { frequency } else { angular };
            start[i] += part * size * unit(i) / w;
            start[n + i] += part * size * unit(n + i);
        }
        (start, 1.0)
    }
}
