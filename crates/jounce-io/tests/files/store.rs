//! Files that appear whole or not at all, and what interrupted programs leave.

use jounce_io::store::{clean, create, open_locked, prepare, write, write_in_folder};
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::sync::atomic::Ordering::SeqCst;
use std::time::{Duration, SystemTime};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn file_is_created_then_replaced_without_leftovers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    write(&path, b"one").unwrap();
    write(&path, b"two").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert_eq!(names(folder.path()), ["a.csv"]);
}

#[test]
fn write_errors_name_path_and_reason() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    for name in ["file/such.csv", "file/below/such.csv"] {
        let path = folder.path().join(name);
        let fault = write(&path, b"x").unwrap_err().to_string();
        assert!(
            fault.contains("such.csv") && fault.contains("folder"),
            "{fault}"
        );
        assert_eq!(create(&path, b"x").unwrap_err().to_string(), fault);
    }
    fs::remove_file(folder.path().join("file")).unwrap();
    let directory = write(folder.path(), b"x").unwrap_err().to_string();
    assert!(directory.contains("it is a folder"), "{directory}");
    assert!(
        write(Path::new(""), b"x")
            .unwrap_err()
            .to_string()
            .contains("names no file")
    );
    assert!(names(folder.path()).is_empty());
}

#[test]
fn read_only_file_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept");
    write(&path, b"old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    assert!(
        write(&path, b"new")
            .unwrap_err()
            .reason
            .contains("read-only")
    );
    assert_eq!(fs::read(&path).unwrap(), b"old");
}

#[test]
fn existing_file_is_not_created() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    create(&path, b"one").unwrap();
    let message = create(&path, b"two").unwrap_err().to_string();
    assert!(
        message.contains("a.toml") && message.contains("it is there already"),
        "{message}"
    );
    assert_eq!(
        (fs::read(&path).unwrap(), names(folder.path())),
        (b"one".to_vec(), vec!["a.toml".to_owned()])
    );
    assert!(
        create(folder.path(), b"x")
            .unwrap_err()
            .reason
            .contains("there already")
    );
    assert!(
        create(Path::new("/"), b"x")
            .unwrap_err()
            .reason
            .contains("names no file")
    );
}

#[cfg(unix)]
#[test]
fn a_device_is_refused_and_a_link_is_followed() {
    assert!(
        write(Path::new("/dev/null"), b"x")
            .unwrap_err()
            .reason
            .contains("regular file")
    );
    let folder = tempfile::tempdir().unwrap();
    let (real, link) = (folder.path().join("real"), folder.path().join("link"));
    write(&real, b"old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    write(&link, b"new").unwrap();
    assert_eq!(fs::read(&real).unwrap(), b"new");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
}

#[test]
fn only_abandoned_files_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let create_aged = |name: &str, age_s: u64| {
        let file = File::create(folder.path().join(name)).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(age_s))
            .unwrap();
        file
    };
    drop((
        create_aged(".jounce-left00.part", 60),
        create_aged(".jounce-young0.part", 0),
        create_aged("part.parquet", 60),
        create_aged(".jounce-notes", 60),
        create_aged(".jounce-my-own.part", 60),
    ));
    let written = create_aged(".jounce-writt0.part", 60);
    written.lock().unwrap();
    clean(folder.path());
    let mut names: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    names.sort();
    let kept = [
        ".jounce-my-own.part",
        ".jounce-notes",
        ".jounce-writt0.part",
        ".jounce-young0.part",
        "part.parquet",
    ];
    assert_eq!(names, kept);
}

#[test]
fn a_missing_folder_is_created_unless_its_content_is_lost_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    write(&at("a/b/one"), b"1").unwrap();
    create(&at("c/two"), b"2").unwrap();
    assert_eq!(
        (
            fs::read(at("a/b/one")).unwrap(),
            fs::read(at("c/two")).unwrap()
        ),
        (b"1".to_vec(), b"2".to_vec())
    );
    let vanished = write_in_folder(&at("d/three"), b"3").unwrap_err();
    assert!(vanished.reason.contains("does not exist"), "{vanished}");
    assert!(!at("d").exists());
    write_in_folder(&at("c/three"), b"3").unwrap();
}

#[test]
fn a_prepared_file_has_its_name_only_when_it_is_persisted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let prepared = || prepare(&path, |file| file.write_all(b"new"));
    write(&path, b"old").unwrap();
    drop(prepared().unwrap());
    assert_eq!(fs::read(&path).unwrap(), b"old");
    prepared().unwrap().persist().unwrap();
    assert_eq!(
        (fs::read(&path).unwrap(), names(folder.path())),
        (b"new".to_vec(), vec!["a".to_owned()])
    );
}

#[test]
fn the_next_file_removes_what_a_killed_process_left() {
    let folder = tempfile::tempdir().unwrap();
    let left = File::create(folder.path().join(".jounce-left00.part")).unwrap();
    left.set_modified(SystemTime::now() - Duration::from_secs(60))
        .unwrap();
    drop(left);
    write(&folder.path().join("a"), b"x").unwrap();
    assert_eq!(names(folder.path()), ["a"]);
}

#[test]
fn a_locked_file_is_refused_until_its_holder_ends() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lock");
    let held = open_locked(&path).unwrap();
    assert!(held.is_some() && open_locked(&path).unwrap().is_none());
    drop(held);
    assert!(open_locked(&path).unwrap().is_some());
}

/// Threads that lock a file and remove it before they release it: never two at a time.
#[test]
fn a_removed_file_is_not_locked_a_second_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lock");
    let holders = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        for _ in 0..3000 {
            if let Some(file) = open_locked(&path).unwrap() {
                assert_eq!(holders.fetch_add(1, SeqCst), 0);
                std::thread::yield_now();
                holders.fetch_sub(1, SeqCst);
                fs::remove_file(&path).unwrap();
                drop(file);
            }
        }
    };
    std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(work))));
}
