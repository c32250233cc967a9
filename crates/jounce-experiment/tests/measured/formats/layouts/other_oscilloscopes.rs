//! Oscilloscopes of other makers.

use super::oscilloscopes::{t, table, v};
use super::{Layout, rows, sample, scope_time};

pub(super) fn all() -> Vec<Layout> {
    [
        siglent(),
        lecroy(),
        picoscope(),
        instek(),
        owon_and_yokogawa(),
        rohde_schwarz(),
        hantek(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn siglent() -> Vec<Layout> {
    let siglent = "Record Length,Analog:400\nSample Interval,Analog:1.000000E-04\nVertical Units,CH1:V CH2:V\nVertical Scale,CH1:0.50 CH2:0.50\nVertical Offset,CH1:0.00 CH2:0.00\nHorizontal Units,s\nHorizontal Scale,4.0E-03\nModel Number,SDS1104X-E\nSerial Number,SDS00001\nSoftware Version,7.1.6\nSource,CH1,CH2\n";
    let atten = "Record Length,400\nSample Interval,CH1:0.0001000000000 CH2:0.0001000000000\nVertical Units,CH1:V CH2:V,,\nVertical Scale,CH1:0.50 CH2:0.50,,\nHorizontal Units,s,,\nHorizontal Scale,0.0040000000,,\nModel Number,ADS1202CL+,,\nSerial Number,ADS00001,,\nSoftware Version,3.01,,\n\nSource,CH1,CH2\n";
    vec![
        Layout {
            program: "Siglent",
            series: "SDS1000X-E, SDS2000X, SDS5000X",
            text: siglent.to_owned() + "Second,Volt,Volt\n" + &table(""),
            ..Layout::default()
        },
        Layout {
            program: "Siglent",
            series: "the same with heads `Second,Value`",
            text: siglent.to_owned() + "Second,Value,Value\n" + &table(""),
            ..Layout::default()
        },
        Layout {
            program: "Siglent, Atten",
            series: "SDS1000CNL, ADS1000CL",
            text: atten.to_owned() + "Second,Volt,Volt\n" + &table(""),
            ..Layout::default()
        },
    ]
}

fn lecroy() -> Vec<Layout> {
    let lecroy = "LECROYWS64Xs,10125,Waveform\nSegments,1,SegmentSize,400\nSegment,TrigTime,TimeSinceSegment1\n#1,05-Mar-2024 14:07:01,0\nTime,Ampl\n";
    vec![
        Layout {
            program: "Teledyne LeCroy",
            series: "WaveSurfer, WaveRunner, HDO: CSV",
            recognised: "rate, start, name `Ampl`",
            by_hand: "unit",
            notes: "[channel.Ampl]\nname = \"CH1\"\nunit = \"V\"\n",
            text: lecroy.to_owned() + &rows(|k| format!("{},{}", t(k), v(0, k))),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: "Teledyne LeCroy",
            series: "WaveSurfer, WaveRunner, HDO: text",
            recognised: "rate, start, name `Ampl`",
            by_hand: "unit",
            notes: "[channel.Ampl]\nname = \"CH1\"\nunit = \"V\"\n",
            text: lecroy.replace(',', " ") + &rows(|k| format!("{} {}", t(k), v(0, k))),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
    ]
}

const PICO: &[(&str, &str)] = &[("Channel A", "V"), ("Channel B", "V")];

/// Time in ms, a channel in V and one in mV.
fn picoscope_text(separator: char, comma: bool) -> String {
    let number = |x: f64| {
        if comma {
            format!("{x:.8}").replace('.', ",")
        } else {
            format!("{x:.8}")
        }
    };
    let row = |k: usize| {
        [1e3 * scope_time(k), sample(0, k), 1e3 * sample(1, k)]
            .map(number)
            .join(&separator.to_string())
    };
    [
        "Time,Channel A,Channel B\n(ms),(V),(mV)\n\n".replace(',', &separator.to_string()),
        rows(row),
    ]
    .concat()
}

fn picoscope() -> Vec<Layout> {
    vec![
        Layout {
            program: "PicoScope",
            series: "6 and 7",
            text: picoscope_text(',', false),
            channels: PICO,
            ..Layout::default()
        },
        Layout {
            program: "PicoScope",
            series: "6 and 7 with decimal commas",
            text: picoscope_text(';', true),
            channels: PICO,
            ..Layout::default()
        },
    ]
}

fn instek() -> Vec<Layout> {
    let instek = "Format,1.0B,\nMemory Length,400,\nTrigger Level,0.000e+00,\nSource,CH1,\nVertical Units,V,\nVertical Scale,5.000e-01,\nHorizontal Units,S,\nHorizontal Scale,4.000e-03,\nHorizontal Mode,Main,\nSampling Period,1.000e-04,\nFirmware,V1.09,\nTime,05-Mar-2024 14:07:01,\n";
    vec![
        Layout {
            program: "GW Instek",
            series: "GDS-1000, GDS-2000: times and values",
            text: instek.to_owned()
                + "Mode,Detail,\nWaveform Data,\n"
                + &rows(|k| format!("{},{},", t(k), v(0, k))),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: "GW Instek",
            series: "GDS-1000, GDS-2000: values",
            recognised: "rate, names, units",
            text: instek.to_owned()
                + "Mode,Detail,\nWaveform Data,\n"
                + &rows(|k| format!("{},", v(0, k))),
            start_s: 0.0,
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
    ]
}

fn owon_and_yokogawa() -> Vec<Layout> {
    let yokogawa = "\"Header Size\",12\n\"Model Name\",\"DLM2024\"\n\"BlockNumber\",1\n\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",400,400\n\"VUnit\",\"V\",\"V\"\n\"SampleRate\",1.0000e+04,1.0000e+04\n\"HResolution\",1.0000e-04,1.0000e-04\n\"HOffset\",-2.0000e-02,-2.0000e-02\n\"HUnit\",\"s\",\"s\"\n\"Date\",\"2024/03/05\",\"2024/03/05\"\n\"Time\",\"14:07:01.25\",\"14:07:01.25\"\n\n";
    vec![
        Layout {
            program: "OWON",
            series: "PDS, VDS",
            recognised: "rate, start, names, units; times that fall are refused",
            text: "#,Time(ms),CH1(mV),CH2(mV)\n".to_owned()
                + &rows(|k| {
                    format!(
                        "{k},{:.7},{:.2},{:.2}",
                        1e3 * scope_time(k),
                        1e3 * sample(0, k),
                        1e3 * sample(1, k)
                    )
                }),
            ..Layout::default()
        },
        Layout {
            program: "Yokogawa",
            series: "DLM2000, DL850",
            text: yokogawa.to_owned() + &rows(|k| format!(",{},{},", v(0, k), v(1, k))),
            ..Layout::default()
        },
    ]
}

fn rohde_schwarz() -> Vec<Layout> {
    vec![
        Layout {
            program: "Rohde & Schwarz",
            series: "RTB, RTM, RTA",
            text: "in s,CH1 in V,CH2 in V\n".to_owned() + &table(""),
            ..Layout::default()
        },
        Layout {
            program: "Rohde & Schwarz",
            series: "RTO, RTE: values, the settings in a file of their own",
            recognised: "",
            by_hand: "rate, names, units",
            notes: "rate = \"10 kHz\"\n[channel.1]\nname = \"CH1\"\nunit = \"V\"\n[channel.2]\nname = \"CH2\"\nunit = \"V\"\n",
            refused: "no rate is given",
            text: rows(|k| format!("{},{}", v(0, k), v(1, k))),
            start_s: 0.0,
            ..Layout::default()
        },
    ]
}

fn hantek() -> Vec<Layout> {
    vec![
        Layout {
            program: "OpenHantek",
            series: "6022",
            text: "\"t / s\",\"CH1 / V\",\"CH2 / V\"\n".to_owned() + &table(""),
            ..Layout::default()
        },
        Layout {
            program: "Hantek",
            series: "DSO2000: `nr,time,ch1,ch2`",
            recognised: "rate, names",
            by_hand: "units",
            notes: "[channel.ch1]\nname = \"CH1\"\nunit = \"V\"\n[channel.ch2]\nname = \"CH2\"\nunit = \"V\"\n",
            text: "nr,time,ch1,ch2\n".to_owned()
                + &rows(|k| {
                    format!(
                        "{k},{:e},{:.3},{:.3}",
                        k as f64 * 1e-4,
                        sample(0, k),
                        sample(1, k)
                    )
                }),
            start_s: 0.0,
            ..Layout::default()
        },
    ]
}
