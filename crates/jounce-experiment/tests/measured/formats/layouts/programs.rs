//! Numerical programs, and programs from which tables are copied.

use super::{Layout, rows, sample};

const RATE_HZ: f64 = 500.0;

fn t(k: usize) -> f64 {
    k as f64 / RATE_HZ
}

fn pair(k: usize, delimiter: &str) -> String {
    format!("{:.5}{delimiter}{:.5}", sample(0, k), sample(1, k))
}

pub(super) fn all() -> Vec<Layout> {
    [arrays_and_tables(), simulators_and_spreadsheets()]
        .into_iter()
        .flatten()
        .map(|layout| Layout {
            rate_hz: RATE_HZ,
            start_s: 0.0,
            ..layout
        })
        .collect()
}

fn arrays_and_tables() -> Vec<Layout> {
    vec![
        Layout {
            program: "NumPy",
            series: "`savetxt` with a header",
            text: "# t [s] CH1 [V] CH2 [V]\n".replace(" CH", "  CH")
                + &rows(|k| format!("{:.18e} {}", t(k), pair(k, " "))),
            ..Layout::default()
        },
        Layout {
            program: "MATLAB, NumPy",
            series: "`writematrix`, `savetxt`: no header",
            text: rows(|k| format!("{},{}", t(k), pair(k, ","))),
            recognised: "",
            by_hand: "time with its unit, names, units",
            notes: "time = \"1\"\n[channel.1]\nunit = \"s\"\n[channel.2]\nname = \"CH1\"\nunit = \"V\"\n[channel.3]\nname = \"CH2\"\nunit = \"V\"\n",
            refused: "\"column 1\" rises by 0.002",
            ..Layout::default()
        },
        Layout {
            program: "pandas",
            series: "`to_csv` with its index",
            text: ",time_s,CH1_V,CH2_V\n".to_owned()
                + &rows(|k| format!("{k},{},{}", t(k), pair(k, ","))),
            channels: &[("CH1_V", "V"), ("CH2_V", "V")],
            ..Layout::default()
        },
        Layout {
            program: "pandas",
            series: "`to_csv` of columns without names",
            text: ",0,1\n".to_owned() + &rows(|k| format!("{k},{}", pair(k, ","))),
            recognised: "names are numbers",
            by_hand: "rate, units",
            notes: "rate = \"500 Hz\"\n[channel.2]\nname = \"CH1\"\nunit = \"V\"\n[channel.3]\nname = \"CH2\"\nunit = \"V\"\n",
            refused: "counts",
            ..Layout::default()
        },
    ]
}

fn simulators_and_spreadsheets() -> Vec<Layout> {
    vec![
        Layout {
            program: "LTspice",
            series: "exported text",
            text: "time\tV(in)\tV(out)\n".to_owned()
                + &rows(|k| format!("{:.15e}\t{}", t(k), pair(k, "\t"))),
            recognised: "rate where the steps are even, names",
            by_hand: "units",
            notes: "[channel.\"V(in)\"]\nunit = \"V\"\n[channel.\"V(out)\"]\nunit = \"V\"\n",
            channels: &[("V(in)", "V"), ("V(out)", "V")],
            ..Layout::default()
        },
        Layout {
            program: "Excel",
            series: "CSV with commas or semicolons, from Windows or a Mac",
            text: "\u{feff}t (ms);CH1 (mV);CH2 (mV)\n".to_owned()
                + &rows(|k| {
                    format!(
                        "{:.1};{:.2};{:.2}",
                        1e3 * t(k),
                        1e3 * sample(0, k),
                        1e3 * sample(1, k)
                    )
                    .replace('.', ",")
                }),
            ..Layout::default()
        },
    ]
}
