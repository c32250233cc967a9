//! The layouts with faults: an error with its reason, or an issue, never a wrong time.

use super::loggers::lvm;
use super::{rows, sample};
use crate::formats::through_a_file::{kinds, one, read};
use jounce_data::recording::IssueKind;
use std::f64::consts::TAU;

fn refused(text: &str, notes: Option<&str>) -> String {
    read("a.csv", text.as_bytes(), notes)
        .expect_err("it should be refused")
        .to_string()
}

/// Without a usable step, a counter remains a counter.
#[test]
fn a_preamble_without_a_step_gives_no_rate() {
    for step in ["", "0", "-1e-4", "soon"] {
        let text = format!("X,CH1,Start,Increment,\nSequence,Volt,-1e-2,{step}\n")
            + &rows(|k| format!("{k},{:.4},", sample(0, k)));
        let message = refused(&text, None);
        assert!(
            message.contains("\" counts") && message.contains("rate = "),
            "{step}: {message}"
        );
    }
}

/// Column names for time with integer values need a unit; so does any column that only increases.
#[test]
fn a_rising_column_alone_is_not_a_time() {
    for head in ["sample", "Sequence", "index", "n", "#"] {
        assert!(
            refused(&format!("{head},a\n1,5\n2,7\n3,6\n4,5\n"), None).contains("counts"),
            "{head}"
        );
    }
    for head in ["time", "t", "Timestamp"] {
        assert!(
            refused(&format!("{head},a\n0,5\n10,7\n20,6\n30,5\n"), None)
                .contains("in ms 100.000000 Hz"),
            "{head}"
        );
    }
    assert!(refused("x,a\n0.0,5\n0.1,7\n0.2,6\n0.3,5\n", None).contains("\"x\" rises by 0.1"));
    let named = one(
        "a.csv",
        b"x,a\n0.0,5\n0.1,7\n0.2,6\n0.3,5\n",
        Some("[channel.x]\nunit = \"ms\"\n"),
    );
    assert!((named.rate() - 1e4).abs() < 1e-6, "{}", named.rate());
    let scaled = one(
        "a.csv",
        b"ticks,a\n0,5\n1,7\n2,6\n3,5\n",
        Some("time = \"ticks\"\n[channel.ticks]\nscale = 0.0025\n"),
    );
    assert!((scaled.rate() - 400.0).abs() < 1e-9, "{}", scaled.rate());
}

/// The header of a decimated record does not give its time, and this is reported.
#[test]
fn stamps_win_over_a_header_that_disagrees() {
    let text = "Sample Interval,1e-05\nTIME,CH1\n".to_owned()
        + &rows(|k| format!("{:e},{:.4}", 1e-3 * k as f64, sample(0, k)));
    let recording = one("a.csv", text.as_bytes(), None);
    assert!(
        (recording.rate() - 1e3).abs() < 1e-6
            && kinds(&recording).contains(&IssueKind::HeaderDisagrees),
        "{:?}",
        recording.issues
    );
}

/// Time stamps without a unit get it from the rate in the header.
#[test]
fn the_rate_gives_the_unit_of_the_stamps() {
    let text = "Sample Rate,200\ntime,CH1\n".to_owned()
        + &rows(|k| format!("{},{:.4}", 5 * k, sample(0, k)));
    assert!((one("a.csv", text.as_bytes(), None).rate() - 200.0).abs() < 1e-9);
}

/// Channels over separate times form separate sets; units stay with their channels; a channel may
/// end before another.
#[test]
fn channels_of_an_lvm_keep_their_own_times_and_units() {
    let text = lvm("Multi").replace("Volts\t\tVolts", "Volts\t\tPounds");
    let recording = one("a.lvm", text.as_bytes(), None);
    let units: Vec<&str> = recording
        .channels
        .iter()
        .map(|channel| channel.unit.as_str())
        .collect();
    assert_eq!(units, ["V", "N"]);
    let mut other = lvm("Multi")
        .split_once("X_Value")
        .map(|(head, _)| head.to_owned())
        .expect("heads")
        + "X_Value\tCH1\tX_Value\tCH2\tComment\n";
    for k in 0..400 {
        let second = if k < 100 {
            format!("{:.6}\t{:.5}", 0.004 * k as f64, sample(1, k))
        } else {
            "\t".to_owned()
        };
        other += &format!("{:.6}\t{:.5}\t{second}\n", 0.001 * k as f64, sample(0, k));
    }
    let sets = read("a.lvm", other.as_bytes(), None)
        .expect("two sets")
        .recordings;
    let summary: Vec<(f64, usize, &str)> = sets
        .iter()
        .map(|set| {
            (
                set.rate().round(),
                set.channels[0].values.len(),
                set.channels[0].name.as_str(),
            )
        })
        .collect();
    assert_eq!(summary, [(1000.0, 400, "CH1"), (250.0, 100, "CH2")]);
}

/// Power of a tone with rounded time stamps, against its true value; samples remain in place.
#[test]
fn rounded_stamps_leave_every_sample_as_it_is() {
    let tone = |k: usize| (TAU * 0.3 * k as f64).sin();
    for (rate_hz, decimals) in [(1536.0, 3), (300.0, 3), (800.0, 2), (51_200.0, 5)] {
        let text = "time [s],a [V]\n".to_owned()
            + &(0..5000)
                .map(|k| format!("{:.decimals$},{:e}\n", 7.25 + k as f64 / rate_hz, tone(k)))
                .collect::<String>();
        let recording = one("a.csv", text.as_bytes(), None).even().expect("even");
        assert_eq!(
            recording.channels[0].values,
            (0..5000).map(tone).collect::<Vec<f64>>(),
            "{rate_hz}"
        );
        let error = (recording.rate() / rate_hz - 1.0).abs();
        eprintln!("{rate_hz} Hz with {decimals} decimals: off by {error:.1e}");
        assert!(
            error < 10f64.powf(-(decimals as f64)) * rate_hz / 5000.0,
            "{rate_hz}: {error}"
        );
        assert_eq!(kinds(&recording), [IssueKind::RoundedStamps]);
    }
    let mut state = 1u32;
    let mut jitter = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1u32 << 24) - 0.5
    };
    let text = "time [s],a [V]\n".to_owned()
        + &(0..5000)
            .map(|k| format!("{:.7},1.5\n", 1e-3 * (k as f64 + 0.3 * jitter())))
            .collect::<String>();
    let recording = one("a.csv", text.as_bytes(), None);
    let message = recording
        .issues
        .iter()
        .find(|issue| issue.kind == IssueKind::Jitter)
        .expect("jitter")
        .to_string();
    assert!(
        message.contains("% of the mean step") && message.contains("e-4 s"),
        "{message}"
    );
}

/// The first bytes do not determine the format of a row: rows that begin beyond them, and lines
/// longer than them.
#[test]
fn the_window_does_not_change_the_rows() {
    let remarks = "a remark that fills the header\n".repeat(20_000);
    let late = remarks
        + "t [s],a [V]\n"
        + &rows(|k| format!("{:.3},{:.4}", 1e-3 * k as f64, sample(0, k)));
    let recording = one("a.csv", late.as_bytes(), None);
    assert_eq!(
        (recording.channels.len(), recording.channels[0].values.len()),
        (1, 400)
    );
    let wide = |k: usize| {
        (0..60_000)
            .map(|c| format!("{:.4}", sample(c, k)))
            .collect::<Vec<String>>()
            .join(",")
            + "\n"
    };
    let text: String = (0..6).map(wide).collect();
    let recording = one("a.csv", text.as_bytes(), Some("rate = \"1 kHz\"\n"));
    assert_eq!(
        (recording.channels.len(), recording.channels[0].values.len()),
        (60_000, 6)
    );
    // A line that ends at the end of the window with fewer fields.
    let text = "t [s],a [V],b [V]\n".to_owned()
        + &(0..20_000)
            .map(|k| {
                format!(
                    "{:.3},{:.4},{:.4}\n",
                    1e-3 * k as f64,
                    sample(0, k),
                    sample(1, k)
                )
            })
            .collect::<String>();
    assert_eq!(kinds(&one("a.csv", text.as_bytes(), None)), []);
}

/// A rate in the notes does not make a recording of a file without rows.
#[test]
fn a_file_without_samples_is_an_error() {
    for text in ["5\n", "a,b\nx,y\n", "1,2\r\n", ",,\n,,\n"] {
        let result = read("a.csv", text.as_bytes(), Some("rate = \"1 kHz\"\n"));
        assert!(
            result.map_or(true, |recording| recording
                .recordings
                .iter()
                .all(|set| set.channels.iter().all(|c| !c.values.is_empty()))),
            "{text:?}"
        );
    }
    assert!(
        read("a.csv", b"5,6\nend\n", Some("rate = \"1 kHz\"\n")).is_ok_and(|recording| recording
            .recordings[0]
            .channels[0]
            .values
            == [5.0])
    );
}
