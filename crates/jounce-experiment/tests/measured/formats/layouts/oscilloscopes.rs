//! Oscilloscopes of Rigol, Tektronix and Keysight.

use super::{Layout, rows, sample, scope_time};

const RIGOL: &str = "Rigol";
const TEKTRONIX: &str = "Tektronix";
const KEYSIGHT: &str = "Keysight";

pub(super) fn v(channel: usize, k: usize) -> String {
    format!("{:.4e}", sample(channel, k))
}

pub(super) fn t(k: usize) -> String {
    format!("{:.6e}", scope_time(k))
}

/// `t,a,b` in each row, with an end.
pub(super) fn table(end: &str) -> String {
    rows(|k| format!("{},{},{}{end}", t(k), v(0, k), v(1, k)))
}

/// Settings next to the first rows, as in older Tektronix files, three or five fields wide.
fn with_settings(settings: &[&str], blank: &str, row: impl Fn(usize) -> String) -> String {
    rows(|k| format!("{},{}", settings.get(k).unwrap_or(&blank), row(k)))
}

pub(super) fn all() -> Vec<Layout> {
    [rigol(), tektronix(), keysight()]
        .into_iter()
        .flatten()
        .collect()
}

fn rigol() -> Vec<Layout> {
    let counted = rows(|k| format!("{k},{},{},", v(0, k), v(1, k)));
    let lines = rows(|k| format!("{k},{},{},0x{:02x},0x00,", v(0, k), v(1, k), k % 256));
    vec![
        Layout {
            program: RIGOL,
            series: "DS1000D, DS1000E",
            text: "X,CH1,CH2,\nSecond,Volt,Volt,\n".to_owned() + &table(","),
            ..Layout::default()
        },
        Layout {
            program: RIGOL,
            series: "DS1000E with screen data",
            text: "Time,X(CH1),X(CH2),\nSecond,Volt,Volt,\n".to_owned() + &table(","),
            channels: &[("X(CH1)", "V"), ("X(CH2)", "V")],
            ..Layout::default()
        },
        Layout {
            program: RIGOL,
            series: "DS1000Z, DS2000A, DS4000, MSO5000 with `Start` and `Increment`",
            text: "X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-2.000000e-02,1.000000e-04,\n".to_owned() + &counted,
            ..Layout::default()
        },
        Layout {
            program: RIGOL,
            series: "MSO1000Z with digital lines",
            recognised: "rate, start, names, units; each eight lines are a number",
            text: "X,CH1,CH2,D7-D0,D15-D8,Start,Increment,\nSequence,Volt,Volt,,,-2.000000e-02,1.000000e-04\n".to_owned() + &lines,
            by_hand: "lines left out: `use = false`",
            notes: "[channel.\"D7-D0\"]\nuse = false\n[channel.\"D15-D8\"]\nuse = false\n",
            ..Layout::default()
        },
        Layout {
            program: RIGOL,
            series: "MSO5000, MSO8000, DHO800 to DHO4000",
            text: "Time(s),CH1V,CH2V,t0 =-2.000000e-02, tInc = 1.000000e-04,\n".to_owned() + &table(",,"),
            ..Layout::default()
        },
        Layout {
            program: RIGOL,
            series: "the same without times",
            text: "CH1V,CH2V,t0 =-2.000000e-02, tInc = 1.000000e-04,\n".to_owned() + &rows(|k| format!("{},{},,", v(0, k), v(1, k))),
            ..Layout::default()
        },
    ]
}

/// Settings of older files.
const TEKTRONIX_SETTINGS: [&str; 18] = [
    "Record Length,4.000000e+02,",
    "Sample Interval,1.000000e-04,",
    "Trigger Point,2.000000000000e+02,",
    ",,",
    ",,",
    ",,",
    "Source,CH1,",
    "Vertical Units,V,",
    "Vertical Scale,5.000000e-01,",
    "Vertical Offset,0.000000e+00,",
    "Horizontal Units,s,",
    "Horizontal Scale,5.000000e-03,",
    "Pt Fmt,Y,",
    "Yzero,0.000000e+00,",
    "Probe Atten,1.000000e+01,",
    "Model Number,TDS2014B,",
    "Serial Number,C000001,",
    "Firmware Version,FV:v22.01,",
];

/// Settings in quotes.
const QUOTED_SETTINGS: [&str; 6] = [
    "\"Record Length\",400,\"Points\"",
    "\"Sample Interval\",1e-04,s",
    "\"Trigger Point\",200,\"Samples\"",
    "\"Trigger Time\",0.34,s",
    "\"\",,",
    "\"Horizontal Offset\",-0.02,s",
];

fn tektronix() -> Vec<Layout> {
    let model = "Model,MDO3014\nFirmware Version,1.22\n\nWaveform Type,ANALOG,\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.004,\nHorizontal Delay,0,\nSample Interval,0.0001,\nRecord Length,400,\nGating,0.0% to 100.0%,\nProbe Attenuation,10,10\nVertical Units,V,V\nVertical Offset,0,0\nVertical Scale,0.5,0.5\nVertical Position,0,0\n,,\n,,\n,,\nLabel,,\nTIME,CH1,CH2\n";
    let newer = "Model,MSO58\nFirmware Version,1.28.1\n\nWaveform Type,ANALOG\nPoint Format,Y\nHorizontal Units,s\nHorizontal Scale,0.004\nHorizontal Delay,0\nSample Interval,1e-04\nRecord Length,400\nGating,0.0% to 100.0%\nProbe Attenuation,1,1\nVertical Units,V,V\nVertical Offset,0,0\nVertical Scale,1,1\nVertical Position,0,0\n\n\nLabel,,\nTIME,CH1,CH2\n";
    let one = |k: usize| format!("{:.12},{},", scope_time(k), v(0, k));
    vec![
        Layout {
            program: TEKTRONIX,
            series: "TDS1000, TDS2000, TBS1000, DPO2000: settings beside the first rows",
            text: with_settings(&TEKTRONIX_SETTINGS, ",,", one),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: TEKTRONIX,
            series: "DPO7000, MSO70000: settings in quotes beside the first rows",
            recognised: "rate, start",
            by_hand: "names, units",
            notes: "[channel.5]\nname = \"CH1\"\nunit = \"V\"\n",
            text: with_settings(&QUOTED_SETTINGS, ",,", |k| format!("{},{}", t(k), v(0, k))),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: TEKTRONIX,
            series: "DPO3000, DPO4000, MDO3000, MDO4000",
            text: model.to_owned() + &table(""),
            ..Layout::default()
        },
        Layout {
            program: TEKTRONIX,
            series: "4, 5 and 6 Series MSO",
            text: newer.to_owned() + &table(""),
            ..Layout::default()
        },
        Layout {
            program: TEKTRONIX,
            series: "TDS3000, and any series without its header",
            recognised: "",
            by_hand: "time with its unit, names, units",
            notes: "time = \"1\"\n[channel.1]\nunit = \"s\"\n[channel.2]\nname = \"CH1\"\nunit = \"V\"\n[channel.3]\nname = \"CH2\"\nunit = \"V\"\n",
            refused: "\"column 1\" rises by",
            text: table(""),
            ..Layout::default()
        },
    ]
}

fn keysight() -> Vec<Layout> {
    let infiniium = "Revision:,0\nType:,raw\nStart:,0\nPoints:,400\nCount:,1\nXDispRange:,4.0E-02\nXDispOrg:,-2.0E-02\nXInc:,1.0E-04\nXOrg:,-2.0E-02\nYInc:,1.0E-03\nYOrg:,0\nYUnits:,Volt\nXUnits:,Second\nFrame:,DSO90404A:MY00000000\nDate:,05 MAR 2024\nTime:,14:07:01:25\n";
    vec![
        Layout {
            program: KEYSIGHT,
            series: "InfiniiVision 2000 X to 6000 X",
            recognised: "rate, start, units; names are numbers",
            text: "x-axis,1,2\nsecond,Volt,Volt\n".to_owned()
                + &rows(|k| {
                    format!(
                        "{:+.8E},{:+.5E},{:+.5E}",
                        scope_time(k),
                        sample(0, k),
                        sample(1, k)
                    )
                }),
            channels: &[("1", "V"), ("2", "V")],
            ..Layout::default()
        },
        Layout {
            program: KEYSIGHT,
            series: "Infiniium, times and values",
            recognised: "rate, start, units",
            by_hand: "names",
            notes: "[channel.2]\nname = \"CH1\"\n",
            text: infiniium.to_owned() + "Data:,\n" + &rows(|k| format!("{},{}", t(k), v(0, k))),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: KEYSIGHT,
            series: "Infiniium, values",
            recognised: "rate, start, units",
            by_hand: "names",
            notes: "[channel.1]\nname = \"CH1\"\n",
            text: infiniium.to_owned() + "Data:\n" + &rows(|k| v(0, k)),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: KEYSIGHT,
            series: "BenchVue",
            text: "Time (s),CH1 (V),CH2 (V)\n".to_owned() + &table(""),
            ..Layout::default()
        },
    ]
}
