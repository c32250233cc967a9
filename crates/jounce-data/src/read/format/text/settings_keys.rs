//! Keys of instrument settings.
//!
//! Keys of all programs are in one list, because no key has two meanings. `Sample Interval` is the
//! step of Tektronix and Siglent, `Increment` of Rigol, `XInc` of Keysight, `Sampling Period` of GW
//! Instek, `HResolution` of Yokogawa.

/// Keys of a step, in lower case without spaces.
pub(super) const STEP_KEYS: [&str; 19] = [
    "sampleinterval",
    "samplinginterval",
    "sampleperiod",
    "samplingperiod",
    "increment",
    "xincrement",
    "xinc",
    "tinc",
    "deltax",
    "deltat",
    "dt",
    "timeincrement",
    "timestep",
    "timeinterval",
    "timeresolution",
    "hresolution",
    "timedelta",
    "interval",
    "samplingtime",
];

/// Keys of a rate.
pub(super) const RATE_KEYS: [&str; 14] = [
    "samplerate",
    "samplingrate",
    "samplefrequency",
    "samplingfrequency",
    "samplefreq",
    "samplingfreq",
    "samplespersecond",
    "scanrate",
    "datarate",
    "acquisitionrate",
    "recordingrate",
    "rate",
    "fs",
    "sps",
];

/// Keys of the time of the first sample.
pub(super) const START_KEYS: [&str; 9] = [
    "start",
    "starttime",
    "xorigin",
    "xorg",
    "xzero",
    "x0",
    "t0",
    "timeorigin",
    "hoffset",
];

/// Keys of the units of channels.
pub(super) const UNIT_KEYS: [&str; 8] = [
    "verticalunits",
    "verticalunit",
    "yunits",
    "yunit",
    "vunit",
    "yunitlabel",
    "units",
    "unit",
];

/// Keys of the unit of the time.
pub(super) const TIME_UNIT_KEYS: [&str; 7] = [
    "horizontalunits",
    "horizontalunit",
    "xunits",
    "xunit",
    "hunit",
    "timeunits",
    "timeunit",
];

/// Keys of the names of channels.
pub(super) const NAME_KEYS: [&str; 4] = ["source", "sources", "tracename", "tracenames"];

/// Keys above the rows without needed information; a line with such a key is not a heading line.
const OTHER_KEYS: [&str; 46] = [
    "recordlength",
    "memorylength",
    "points",
    "samples",
    "samplecount",
    "blocksize",
    "model",
    "modelnumber",
    "serialnumber",
    "firmware",
    "firmwareversion",
    "softwareversion",
    "format",
    "pointformat",
    "ptfmt",
    "mode",
    "date",
    "time",
    "triggertime",
    "triggerpoint",
    "triggerlevel",
    "triggerposition",
    "verticalscale",
    "verticaloffset",
    "verticalposition",
    "horizontalscale",
    "horizontaloffset",
    "horizontalposition",
    "horizontalmode",
    "probeattenuation",
    "probeatten",
    "proberatio",
    "probetype",
    "label",
    "gating",
    "type",
    "count",
    "revision",
    "waveformtype",
    "segments",
    "segment",
    "operator",
    "comment",
    "title",
    "tracename",
    "blocknumber",
];

/// Splits a key into the key without brackets and punctuation, and the unit in the brackets.
pub(super) fn key(text: &str) -> (String, String) {
    let text = text
        .trim()
        .trim_matches('"')
        .trim_start_matches(['#', '%', '!', ';', '*'])
        .trim()
        .trim_end_matches([':', '='])
        .trim();
    let (name, unit) = match text.find(['(', '[']).filter(|at| *at > 0) {
        Some(at) => (
            &text[..at],
            text[at + 1..].trim_end_matches([')', ']']).trim(),
        ),
        None => (text, ""),
    };
    (
        name.chars()
            .filter(|c| !c.is_whitespace() && !"_-.".contains(*c))
            .flat_map(char::to_lowercase)
            .collect(),
        unit.to_owned(),
    )
}

/// True for the key of a step or a start, also in `t0 = -0.01`. Such a field is not a column
/// heading.
pub(super) fn is_of_time(field: &str) -> bool {
    let name = field.split('=').next().unwrap_or_default();
    let (name, _) = key(name);
    STEP_KEYS.contains(&name.as_str()) || START_KEYS.contains(&name.as_str())
}

/// True for a line that begins with a key followed by its value.
pub(super) fn is_pair(fields: &[String]) -> bool {
    let [first, second, ..] = fields else {
        return false;
    };
    let (name, _) = key(first);
    let lists = [
        &STEP_KEYS[..],
        &RATE_KEYS,
        &START_KEYS,
        &UNIT_KEYS,
        &TIME_UNIT_KEYS,
        &OTHER_KEYS,
    ];
    let is_key = lists.iter().any(|list| list.contains(&name.as_str()));
    // `time,model` is a heading line; `Time,12-Mar-2020 14:25:31` is not.
    let is_head = [
        "time", "date", "rate", "interval", "start", "dt", "count", "label", "points", "samples",
        "segment",
    ]
    .contains(&name.as_str())
        && second.trim().starts_with(char::is_alphabetic);
    // `Frame:,DSO90404A`.
    first.trim().trim_matches('"').ends_with(':') || is_key && !is_head
}
