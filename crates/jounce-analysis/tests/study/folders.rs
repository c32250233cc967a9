//! Folders of a study: shards, damaged parts, stops and locks.

use crate::{GRID, study};
use jounce_analysis::study::{Folder, Shard, Study, StudyError};
use jounce_control::Control;
use jounce_io::table::{Table, Values};
use std::path::Path;

/// Returns the bytes of the merged table after the given number of shards, on the threads of a
/// pool.
fn merged_bytes(study: &Study, folder: &Path, shards: usize) -> Vec<u8> {
    for index in 1..=shards {
        let folder_state = Folder::of(folder, study).unwrap();
        folder_state
            .run(
                study,
                Shard { index, of: shards },
                &Control::default(),
                &|_| (),
            )
            .unwrap();
    }
    std::fs::read(Folder::open(folder).unwrap().merge().unwrap()).unwrap()
}

#[test]
fn any_number_of_shards_gives_the_same_bytes() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let reference = merged_bytes(&study, &folder.path().join("whole"), 1);
    assert_eq!(
        reference,
        merged_bytes(&study, &folder.path().join("three"), 3)
    );
    let (table, manifest) = Table::read(&folder.path().join("whole/study.parquet")).unwrap();
    assert_eq!(
        (table.rows(), manifest.options["study_sha256"].as_str()),
        (8, study.hash_hex())
    );
    let Values::Count(points) = &table.column("point").unwrap().values else {
        panic!("numbers of points are counts")
    };
    assert!(points.iter().copied().eq(0..8));
}

#[test]
fn damaged_parts_are_recomputed() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let reference = merged_bytes(&study, folder.path(), 1);
    let part = |number| {
        folder
            .path()
            .join(format!("parts/part-{number:06}.parquet"))
    };
    let bytes = std::fs::read(part(0)).unwrap();
    std::fs::write(part(0), &bytes[..bytes.len() / 2]).unwrap();
    std::fs::copy(part(1), part(2)).unwrap();
    let folder_state = Folder::open(folder.path()).unwrap();
    assert_eq!(
        (
            folder_state.status().finished,
            folder_state.status().damaged.len(),
            folder_state.missing()
        ),
        (1, 2, vec![0, 2])
    );
    assert!(matches!(
        folder_state.merge(),
        Err(StudyError::Table(_) | StudyError::Damaged { .. })
    ));
    assert_eq!(reference, merged_bytes(&study, folder.path(), 1));
}

#[test]
fn a_stopped_study_keeps_its_finished_parts_and_continues() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let folder_state = Folder::of(folder.path(), &study).unwrap();
    let control = Control::default();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    pool.install(|| {
        folder_state.run(&study, Shard::WHOLE, &control, &|points| {
            if points > 0 {
                control.stop()
            }
        })
    })
    .unwrap();
    assert_eq!(folder_state.status().finished, 1);
    let error = folder_state.merge().unwrap_err();
    assert!(
        error.to_string().starts_with("2 of 3 parts are missing"),
        "{error}"
    );
    let reference = merged_bytes(&study, &folder.path().join("other"), 1);
    assert_eq!(reference, merged_bytes(&study, folder.path(), 2));
}

#[test]
fn a_folder_belongs_to_one_study_and_a_shard_to_one_process() {
    let folder = tempfile::tempdir().unwrap();
    let folder_state = Folder::of(folder.path(), &study(GRID)).unwrap();
    let other = Folder::of(folder.path(), &study(&GRID.replace("0.5mm", "0.6mm"))).unwrap_err();
    assert!(matches!(other, StudyError::OtherStudy { .. }), "{other}");
    let nothing = Folder::open(&folder.path().join("parts")).unwrap_err();
    assert!(nothing.to_string().contains("holds no study"), "{nothing}");
    let lock = std::fs::File::create(folder.path().join(".shard-1-of-2.lock")).unwrap();
    lock.lock().unwrap();
    let study = study(GRID);
    let busy = folder_state
        .run(
            &study,
            Shard { index: 1, of: 2 },
            &Control::default(),
            &|_| (),
        )
        .unwrap_err();
    assert!(
        busy.to_string()
            .contains("another process works on shard 1/2"),
        "{busy}"
    );
    folder_state
        .run(
            &study,
            Shard { index: 2, of: 2 },
            &Control::default(),
            &|_| (),
        )
        .unwrap();
    assert_eq!(folder_state.status().finished, 1);
}

/// Bytes that are not the part are refused, and the finished part remains.
#[test]
fn a_wrong_part_from_elsewhere_is_not_stored() {
    let (study, folder) = (study(GRID), tempfile::tempdir().unwrap());
    let reference = merged_bytes(&study, folder.path(), 1);
    let bytes = |part: u32| {
        let name = format!("parts/part-{part:06}.parquet");
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let folder_state = Folder::open(folder.path()).unwrap();
    for wrong in [bytes(1), b"no table".to_vec()] {
        let error = folder_state.keep(0, &wrong).unwrap_err();
        assert!(matches!(error, StudyError::Damaged { .. }), "{error}");
    }
    folder_state.keep(0, &bytes(0)).unwrap();
    assert_eq!(
        reference,
        std::fs::read(folder_state.merge().unwrap()).unwrap()
    );
}

/// A recording and a start state are inputs by their content, which may change under their names.
#[test]
fn the_digest_depends_on_the_files_that_the_spec_names() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "harvester.toml",
        "[mass.m]\nmass = \"2 kg\"\nstiffness = \"7 kN/m\"\ndamping_ratio = 0.04\n\
         [drive.road]\nkind = \"base-acceleration\"\nsignal = \"recording\"\nfile = \"road.csv\"\n\
         [run]\nduration = \"1 s\"\naverage_over = \"1 s\"\nstart = \"state.json\"\n",
    );
    write("road.csv", "time (s),a (g)\n0,0\n0.5,1\n1,-2\n");
    write("state.json", "{\"displacement\": [0]}");
    let text = "spec = \"harvester.toml\"\n[vary]\n\"mass.m.mass\" = \"1kg,2kg\"\n";
    let digest = || {
        let study = Study::parse(text, folder.path()).unwrap();
        study.hash_hex().to_owned()
    };
    let before = digest();
    assert_eq!(digest(), before);
    write("state.json", "{\"displacement\": [1]}");
    let with_state = digest();
    write("road.csv", "time (s),a (g)\n0,0\n0.5,1\n1,-3\n");
    let with_both = digest();
    assert!(before != with_state && with_state != with_both);
}
