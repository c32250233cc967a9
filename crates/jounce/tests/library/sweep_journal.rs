//! Sweeps that are interrupted and continue from their journal.

use jounce::{Control, Harvester, SweepOptions};

const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);

#[test]
fn an_interrupted_sweep_continues_with_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let short = [("run.duration", "5 s"), ("run.average_over", "1 s")];
    let harvester = Harvester::read(SPEC).unwrap().changed(short).unwrap();
    let options = |over: &str| SweepOptions {
        over: format!("drive.shaker.frequency={over}"),
        fixed_duration: true,
        ..Default::default()
    };
    let five = options("10Hz:12Hz:0.5Hz");
    let expected = harvester.sweep(&five).unwrap();
    assert_eq!((expected.points.len(), expected.expected), (5, 5));

    // The third run is long enough for a call of the callback.
    let stops_after_two = Control::with_callback(|control| {
        if control.progress().0 == 2 {
            control.stop();
        }
    });
    let interrupted = harvester.with_control(&stops_after_two);
    let journal = interrupted.sweep_journal(&five, folder.path()).unwrap();
    let partial = interrupted.sweep_with_journal(&five, &journal).unwrap();
    assert_eq!((partial.points.len(), partial.expected), (2, 5));
    assert_eq!(partial.points, expected.points[..2]);
    drop(journal);

    // Another number of threads is the same sweep, other values are another one.
    let journal = |options| harvester.sweep_journal(&options, folder.path()).unwrap();
    assert!(journal(options("10Hz:12Hz:1Hz")).found().is_empty());
    let threads = Some(2);
    let journal = journal(SweepOptions {
        threads,
        ..five.clone()
    });
    assert_eq!(journal.found().len(), 2);
    let busy = harvester.sweep_journal(&five, folder.path()).unwrap_err();
    assert!(busy.to_string().contains("another process"), "{busy}");
    let result = harvester.sweep_with_journal(&five, &journal).unwrap();
    assert_eq!(result, expected);
    assert_eq!(harvester.control().progress(), (10, 10));
    journal.finish().unwrap();
    let again = harvester.sweep_journal(&five, folder.path()).unwrap();
    assert!(again.found().is_empty());
    // A cache that vanishes is no error of a complete sweep.
    std::fs::remove_dir_all(folder.path()).unwrap();
    assert_eq!(
        harvester.sweep_with_journal(&five, &again).unwrap(),
        expected
    );
    again.finish().unwrap();
}
