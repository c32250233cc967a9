//! Oscilloscopes.

use super::{Layout, rows, sample, scope_time};

const RIGOL: &str = "Rigol";
const TEKTRONIX: &str = "Tektronix";
const KEYSIGHT: &str = "Keysight";

fn v(channel: usize, k: usize) -> String {
    format!("{:.4e}", sample(channel, k))
}

fn t(k: usize) -> String {
    format!("{:.6e}", scope_time(k))
}

/// `t,a,b` in each row, with an end.
fn table(end: &str) -> String {
    rows(|k| format!("{},{},{}{end}", t(k), v(0, k), v(1, k)))
}

/// Settings next to the first rows, as in older Tektronix files, three or five fields wide.
fn with_settings(settings: &[&str], blank: &str, row: impl Fn(usize) -> String) -> String {
    rows(|k| format!("{},{}", settings.get(k).unwrap_or(&blank), row(k)))
}

pub(super) fn all() -> Vec<Layout> {
    [rigol(), tektronix(), keysight(), others()]
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

fn tektronix() -> Vec<Layout> {
    let older = [
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
    let quoted_settings = [
        "\"Record Length\",400,\"Points\"",
        "\"Sample Interval\",1e-04,s",
        "\"Trigger Point\",200,\"Samples\"",
        "\"Trigger Time\",0.34,s",
        "\"\",,",
        "\"Horizontal Offset\",-0.02,s",
    ];
    let model = "Model,MDO3014\nFirmware Version,1.22\n\nWaveform Type,ANALOG,\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.004,\nHorizontal Delay,0,\nSample Interval,0.0001,\nRecord Length,400,\nGating,0.0% to 100.0%,\nProbe Attenuation,10,10\nVertical Units,V,V\nVertical Offset,0,0\nVertical Scale,0.5,0.5\nVertical Position,0,0\n,,\n,,\n,,\nLabel,,\nTIME,CH1,CH2\n";
    let newer = "Model,MSO58\nFirmware Version,1.28.1\n\nWaveform Type,ANALOG\nPoint Format,Y\nHorizontal Units,s\nHorizontal Scale,0.004\nHorizontal Delay,0\nSample Interval,1e-04\nRecord Length,400\nGating,0.0% to 100.0%\nProbe Attenuation,1,1\nVertical Units,V,V\nVertical Offset,0,0\nVertical Scale,1,1\nVertical Position,0,0\n\n\nLabel,,\nTIME,CH1,CH2\n";
    let one = |k: usize| format!("{:.12},{},", scope_time(k), v(0, k));
    vec![
        Layout {
            program: TEKTRONIX,
            series: "TDS1000, TDS2000, TBS1000, DPO2000: settings beside the first rows",
            text: with_settings(&older, ",,", one),
            channels: &[("CH1", "V")],
            ..Layout::default()
        },
        Layout {
            program: TEKTRONIX,
            series: "DPO7000, MSO70000: settings in quotes beside the first rows",
            recognised: "rate, start",
            by_hand: "names, units",
            notes: "[channel.5]\nname = \"CH1\"\nunit = \"V\"\n",
            text: with_settings(&quoted_settings, ",,", |k| format!("{},{}", t(k), v(0, k))),
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

fn others() -> Vec<Layout> {
    let siglent = "Record Length,Analog:400\nSample Interval,Analog:1.000000E-04\nVertical Units,CH1:V CH2:V\nVertical Scale,CH1:0.50 CH2:0.50\nVertical Offset,CH1:0.00 CH2:0.00\nHorizontal Units,s\nHorizontal Scale,4.0E-03\nModel Number,SDS1104X-E\nSerial Number,SDS00001\nSoftware Version,7.1.6\nSource,CH1,CH2\n";
    let atten = "Record Length,400\nSample Interval,CH1:0.0001000000000 CH2:0.0001000000000\nVertical Units,CH1:V CH2:V,,\nVertical Scale,CH1:0.50 CH2:0.50,,\nHorizontal Units,s,,\nHorizontal Scale,0.0040000000,,\nModel Number,ADS1202CL+,,\nSerial Number,ADS00001,,\nSoftware Version,3.01,,\n\nSource,CH1,CH2\n";
    let instek = "Format,1.0B,\nMemory Length,400,\nTrigger Level,0.000e+00,\nSource,CH1,\nVertical Units,V,\nVertical Scale,5.000e-01,\nHorizontal Units,S,\nHorizontal Scale,4.000e-03,\nHorizontal Mode,Main,\nSampling Period,1.000e-04,\nFirmware,V1.09,\nTime,05-Mar-2024 14:07:01,\n";
    let yokogawa = "\"Header Size\",12\n\"Model Name\",\"DLM2024\"\n\"BlockNumber\",1\n\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",400,400\n\"VUnit\",\"V\",\"V\"\n\"SampleRate\",1.0000e+04,1.0000e+04\n\"HResolution\",1.0000e-04,1.0000e-04\n\"HOffset\",-2.0000e-02,-2.0000e-02\n\"HUnit\",\"s\",\"s\"\n\"Date\",\"2024/03/05\",\"2024/03/05\"\n\"Time\",\"14:07:01.25\",\"14:07:01.25\"\n\n";
    let lecroy = "LECROYWS64Xs,10125,Waveform\nSegments,1,SegmentSize,400\nSegment,TrigTime,TimeSinceSegment1\n#1,05-Mar-2024 14:07:01,0\nTime,Ampl\n";
    let pico = |separator: char, comma: bool| {
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
    };
    const PICO: &[(&str, &str)] = &[("Channel A", "V"), ("Channel B", "V")];
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
        Layout {
            program: "PicoScope",
            series: "6 and 7",
            text: pico(',', false),
            channels: PICO,
            ..Layout::default()
        },
        Layout {
            program: "PicoScope",
            series: "6 and 7 with decimal commas",
            text: pico(';', true),
            channels: PICO,
            ..Layout::default()
        },
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
            by_hand: RATE_BY_HAND_AND_NAMES,
            notes: "rate = \"10 kHz\"\n[channel.1]\nname = \"CH1\"\nunit = \"V\"\n[channel.2]\nname = \"CH2\"\nunit = \"V\"\n",
            refused: "no rate is given",
            text: rows(|k| format!("{},{}", v(0, k), v(1, k))),
            start_s: 0.0,
            ..Layout::default()
        },
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

const RATE_BY_HAND_AND_NAMES: &str = "rate, names, units";
