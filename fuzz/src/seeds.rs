//! First inputs of each reader, from the examples and from the writers of the tests: `CORPUS/READER/`.

#[path = "../../crates/jounce-experiment/tests/measured/formats/complete.rs"]
mod complete;
#[path = "../../crates/jounce-experiment/tests/measured/samples.rs"]
#[allow(dead_code, reason = "made for other tests too")]
mod samples;
#[path = "../../crates/jounce-experiment/tests/measured/formats/writers/mod.rs"]
mod writers;

use crate::readers::quantities::KINDS;
use crate::scratch;
use jounce_io::table::{Column, Manifest, Table};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes all seeds below the folder CORPUS.
pub fn write() {
    for (ending, bytes) in complete::complete_files(scratch::folder()) {
        let readers: &[&str] = match ending {
            "csv" => &["text", "force-table"],
            "uff" => &["uff", "import"],
            "h5" => &["hdf5"],
            other => &[other],
        };
        readers.iter().for_each(|reader| add(reader, &bytes));
    }
    let files = files(&root().join("examples"), "toml")
        .into_iter()
        .chain(files(
            &root().join("crates/jounce-spec/tests/corpus"),
            "toml",
        ));
    for path in files {
        let text = fs::read(&path).unwrap_or_default();
        ["spec", "study", "design", "features", "notes"]
            .iter()
            .for_each(|reader| add(reader, &text));
        quoted(&String::from_utf8_lossy(&text))
            .iter()
            .for_each(|text| add_quoted(text));
    }
    for path in files_of_text() {
        let text = fs::read(&path).unwrap_or_default();
        ["text", "uff", "import", "names"]
            .iter()
            .for_each(|reader| add(reader, &text));
    }
    written();
    table();
    dictionaries();
}

/// Source of each reader; the texts in quotes there are its dictionary, `CORPUS/READER.dict`.
const SOURCES: [(&str, &str); 22] = [
    ("quantity", "crates/jounce-units/src"),
    ("range", "crates/jounce-units/src"),
    ("spec", "crates/jounce-spec/src/keys"),
    ("override", "crates/jounce-spec/src/keys"),
    ("sweep-range", "crates/jounce-units/src"),
    ("force-table", "crates/jounce-data/src/read/format/text"),
    ("market", "crates/jounce-sparse/src"),
    ("notes", "crates/jounce-data/src/read/notes"),
    ("text", "crates/jounce-data/src/read/format/text"),
    ("uff", "crates/jounce-data/src/read/format/uff"),
    ("wav", "crates/jounce-data/src/read/format"),
    ("npy", "crates/jounce-data/src/read/format"),
    ("tdms", "crates/jounce-data/src/read/format/tdms"),
    ("lvm", "crates/jounce-data/src/read/format/lvm"),
    ("table-csv", "crates/jounce-io/src/table"),
    ("table-html", "crates/jounce-io/src/table"),
    ("study", "crates/jounce-analysis/src/study"),
    ("design", "crates/jounce-design/src/problem"),
    ("features", "crates/jounce-experiment/src/fit/features"),
    ("names", "crates/jounce-model/src/exchange"),
    ("link", "crates/jounce-explorer/src"),
    ("request", "crates/jounce-explorer/src"),
];

fn dictionaries() {
    for (reader, folder) in SOURCES {
        let mut words: Vec<String> = Vec::new();
        for path in files(&root().join(folder), "rs") {
            let text = fs::read_to_string(&path).unwrap_or_default();
            let code = text
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"));
            words.extend(code.flat_map(quoted));
        }
        words.retain(|word| {
            (2..=24).contains(&word.len())
                && word
                    .bytes()
                    .all(|byte| byte.is_ascii_graphic() && !b"{\\".contains(&byte))
        });
        words.sort();
        words.dedup();
        let lines: String = words.iter().map(|word| format!("\"{word}\"\n")).collect();
        fs::write(corpus().join(format!("{reader}.dict")), lines).expect("a file");
    }
}

/// A table of jounce in Parquet.
fn table() {
    let columns = vec![
        Column::new("x", "m", "a place", vec![0.1, f64::NAN]),
        Column::new("n", "", "a count", vec![1_u64, 2]),
        Column::new("t", "", "a text", vec!["a".to_owned(), "b".to_owned()]),
    ];
    let table = Table::new(columns).expect("columns of equal length");
    let bytes = table.to_parquet(&Manifest::new("").with("command", "run"));
    add("table-parquet", &bytes.expect("a table"));
}

/// Inputs that no example has.
fn written() {
    let matrix =
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 200\n2 1 -100\n2 2 100\n";
    let array = "%%MatrixMarket matrix array real general\n2 1\n0\n1\n";
    ["market", "import"]
        .iter()
        .for_each(|reader| add(reader, matrix.as_bytes()));
    add("market", array.as_bytes());
    add(
        "import",
        [matrix, matrix, array, "kind,index,name\npoint,1,tip\n"]
            .join("\n====\n")
            .as_bytes(),
    );
    add(
        "force-table",
        b"penetration (mm),force (N)\n0,0\n0.1,3\n0.2,9\n",
    );
    add("notes", b"rate = \"25.6 kHz\"\ntime = \"1\"\nover = \"time\"\n[channel.2]\nname = \"a\"\nunit = \"N\"\nscale = 2\nplace = \"tip\"\ndirection = \"-z\"\nuse = true\n");
    add("shard", b"3/8");
    add(
        "link",
        b"jounce:?set=stop.wall.gap%3D0.9%20mm&over=drive.force.frequency&from=12&to=14&spec=AwA",
    );
    add(
        "link",
        b"http://127.0.0.1:4321/0123abcd/#set=stop.wall.gap%3D0.9+mm&over=a&from=12&to=14.5",
    );
    add("start-state", br#"{"displacement": [0.1], "velocity": [0], "voltage_v": [], "current_a": [], "drive_angle_rad": [3.4]}"#);
    add("journal", b"{\"index\":0,\"parameter\":1.0,\"direction\":\"up\",\"mean_power_w\":0.0,\"voltage_rms_v\":null,\"max_penetration_m\":0.0,\"contact_rate_hz\":0.1,\"settled\":true,\"period_cycles\":1,\"energy_residual_relative\":1e-9,\"simulated_time_s\":9.5,\"exceeded\":[],\"end\":{\"displacement\":[0.1],\"velocity\":[0.0],\"voltage_v\":[],\"drive_angle_rad\":[0.0]}}\n");
    let manifest = r#"{"created_by": "jounce", "version": "0.1.0", "spec_sha256": "", "options": {"command": "run"}}"#;
    let columns = r#"[{"name": "x", "unit": "m", "about": "", "kind": "float"}, {"name": "n", "unit": "", "about": "", "kind": "count"}, {"name": "t", "unit": "", "about": "", "kind": "text"}]"#;
    let notes = format!(r#""manifest": {manifest}, "columns": {columns}"#);
    add(
        "table-csv",
        format!("{{{notes}}}\n====\nx,n,t\n0.1,1,a\nNaN,2,\"b,\"\n").as_bytes(),
    );
    add(
        "table-html",
        format!(r#"{{{notes}, "values": [[0.1, "NaN"], [1, 2], ["a", "b"]]}}"#).as_bytes(),
    );
    add("table-json", format!(r#"{{"manifest": {manifest}, "columns": {{"x": [0.1, null]}}, "units": {{"x": "m"}}, "about": {{"x": ""}}}}"#).as_bytes());
    let kinds = ["design", "modes", "design-offer"].map(|kind| {
        format!(r#"{{"id": 1, "ask": "{kind}", "set": [["stop.wall.gap", "0.9 mm"]]}}"#)
    });
    kinds
        .iter()
        .for_each(|request| add("request", request.as_bytes()));
    for fields in [
        r#""ask": "response", "over": "drive.force.frequency", "from": 0.1, "to": 0.2, "seeds": 3, "longest_period": 2"#,
        r#""ask": "sweep", "over": "stop.wall.gap", "from": 1, "to": 2, "points": 9"#,
        r#""ask": "basins", "starts": 225, "tolerance": 1e-6"#,
        r#""ask": "export", "over": "stop.wall.gap", "from": 1, "to": 2"#,
        r#""ask": "design-search", "free": [["stop.wall.gap", "0.2 m:3 m"]], "maximise": "stable-power", "starts": "20""#,
        r#""ask": "shake", "by": {"noise": {"density": 1, "low_hz": 1, "high_hz": 9}}"#,
        r#""ask": "shake", "by": {"recording": {"name": "a.csv", "bytes": "AAAA", "channel": null, "scale": 1}}"#,
        r#""ask": "stop", "what": "sweep""#,
    ] {
        add("request", format!("{{\"id\": 2, {fields}}}").as_bytes());
    }
}

/// Adds a quoted text of a spec: a quantity, a range, or the value of an override.
fn add_quoted(text: &str) {
    for (index, kind) in KINDS.iter().enumerate() {
        let input = format!("{}{text}", char::from(b'0' + index as u8));
        if kind.read(text).is_ok() {
            add("quantity", input.as_bytes());
            let number = text.trim_end_matches(|c: char| !c.is_ascii_digit());
            let unit = &text[number.len()..];
            for range in [
                format!("{text}:1e9{unit}:3x"),
                format!("{text}:1e9{unit}:4log"),
                format!("0{unit}:{text}:{text}"),
                format!("{text},{text}"),
            ] {
                add("range", format!("{}{range}", &input[..1]).as_bytes());
            }
        }
    }
    for (base, key) in ["0stop.wall.gap", "1stop.tip.gap", "1drive.shaker.frequency"]
        .iter()
        .map(|key| key.split_at(1))
    {
        add("override", format!("{base}{key}={text}").as_bytes());
        add(
            "sweep-range",
            format!("{base}{key}={text}:{text}:{text}").as_bytes(),
        );
    }
}

/// Writes an input under a name from its bytes, so that equal ones are written once.
fn add(reader: &str, bytes: &[u8]) {
    let folder = corpus().join(reader);
    let name = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
    });
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join(format!("{name:016x}")), bytes).expect("a file");
}

fn corpus() -> PathBuf {
    PathBuf::from(std::env::var_os("CORPUS").unwrap_or_else(|| "corpus".into()))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn files_of_text() -> Vec<PathBuf> {
    ["csv", "uff"]
        .iter()
        .flat_map(|ending| files(&root().join("examples"), ending))
        .collect()
}

/// Returns the files with an ending below a folder.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for path in fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
    {
        match path.is_dir() {
            true => found.extend(files(&path, ending)),
            false if path.extension().is_some_and(|own| own == ending) => found.push(path),
            false => {}
        }
    }
    found
}

/// Returns the texts in quotes.
fn quoted(text: &str) -> Vec<String> {
    text.split('"')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}
