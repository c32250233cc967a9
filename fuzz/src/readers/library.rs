//! Studies, designs, features, saved states, journals and structures of other programs.

use super::specs::{BASES, check_places};
use super::text_of;
use crate::scratch;
use jounce::{ImportOptions, StartState, import_matrices};
use jounce_analysis::study::{Shard, Study, StudyError};
use jounce_analysis::{Journal, SweepPoint};
use jounce_design::{DesignError, Problem};
use jounce_experiment::fit::Features;
use jounce_model::exchange::Names;

/// The points of all parts are those of the study.
pub fn study(data: &[u8]) {
    let text = text_of(data);
    match Study::with_spec(BASES[0].clone(), scratch::folder(), &text) {
        Ok(study) => {
            let (parts, points) = (study.parts(), study.design.len());
            assert!(parts > 0 && study.points(parts - 1).end == points);
            assert_eq!(
                study.design.point(points - 1).len(),
                study.design.varied.len()
            );
        }
        Err(StudyError::Faults(faults)) => check_places(&text, &faults),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

pub fn design(data: &[u8]) {
    let text = text_of(data);
    match Problem::with_spec(
        BASES[0].clone(),
        scratch::folder(),
        &text,
        scratch::folder(),
    ) {
        Ok(problem) => assert_eq!(problem.hash_hex().len(), 64),
        Err(DesignError::Faults(faults)) => check_places(&text, &faults),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Measured values and free keys of a fit.
pub fn features(data: &[u8]) {
    match Features::read(&scratch::file("measured.toml", text_of(data).as_bytes())) {
        Ok(features) => assert!(!features.free.is_empty()),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A shard prints as a text that reads back to the same shard.
pub fn shard(data: &[u8]) {
    if let Ok(shard) = text_of(data).parse::<Shard>() {
        assert_eq!(shard.to_string().parse(), Ok(shard));
        assert!(shard.takes(shard.index - 1));
    }
}

/// A state that was read is written as a file that reads back to the same state.
pub fn start_state(data: &[u8]) {
    if let Ok(state) = StartState::read(&scratch::file("state.json", data)) {
        let path = scratch::folder().join("written.json");
        state.write(&path).expect("it was read");
        assert_eq!(StartState::read(&path).ok(), Some(state));
    }
}

/// A journal of a damaged file continues: a further point is found when it is opened again.
pub fn journal(data: &[u8]) {
    scratch::file("journal.jsonl", data);
    let open = || Journal::<SweepPoint>::open(scratch::folder(), "journal").expect("a journal");
    let journal = open();
    let Some(point) = journal.found().first().cloned() else {
        return;
    };
    let before = journal.found().len();
    journal.keep(&point).expect("a point");
    drop(journal);
    assert_eq!(open().found().len(), before + 1);
}

/// Names that were read print as a table that reads back to the same names.
pub fn names(data: &[u8]) {
    match Names::read(&text_of(data), "names.csv") {
        Ok(names) => assert_eq!(Names::read(&names.text(), "names.csv").ok(), Some(names)),
        Err(faults) => assert!(!faults.0.is_empty()),
    }
}

/// A universal file with modes, or mass, stiffness, points and names, separated by lines `====`. The structure that was read is a spec.
pub fn import(data: &[u8]) {
    let options = ImportOptions::default();
    let result = if data.trim_ascii_start().starts_with(b"-1") {
        scratch::file("names.csv", b"point,2z,tip\n");
        import_matrices(scratch::file("modes.uff", data), &options)
    } else {
        let [mass, stiffness, points, names] = scratch::parts(data);
        let files = [
            ("mass.mtx", mass),
            ("stiffness.mtx", stiffness),
            ("points.mtx", points),
            ("names.csv", names),
        ];
        for (name, bytes) in files {
            match bytes.is_empty() {
                true => drop(std::fs::remove_file(scratch::folder().join(name))),
                false => drop(scratch::file(name, bytes)),
            }
        }
        import_matrices(scratch::folder(), &options)
    };
    match result {
        Ok(result) => drop(
            jounce::Spec::from_toml(&result.spec)
                .unwrap_or_else(|faults| panic!("{faults}\n{}", result.spec)),
        ),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
