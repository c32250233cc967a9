//! Reads a study from its text.
//!
//! ```toml
//! spec = "harvester.toml"
//! sampling = "grid"
//! [set]
//! "run.duration" = "2 s"
//! [vary]
//! "stop.tip.gap" = "0.5mm:1.5mm:3x"
//! "drive.shaker.frequency" = "10Hz:14Hz:5x"
//! [quantity]
//! command = "run"
//! ```

use super::design::{Design, Varied};
use super::faults::FaultCollector;
use super::quantity::read::quantity;
use super::sampling::Sampling;
use super::sobol::MAX_DIMENSIONS;
use super::{Quantity, StudyError};
use jounce_spec::{KeyRange, SpecFile};
use toml_edit::{Item, Table};

/// Largest number of points of a study.
const MAX_POINTS: u64 = 1_000_000_000;

/// Largest number of drawn points: the Latin hypercube keeps their order in memory.
const MAX_DRAWN_POINTS: u64 = 100_000_000;

/// Default number of parts, if there are enough points.
const DEFAULT_PARTS: usize = 256;

/// Largest number of points of a part by default.
const MAX_POINTS_PER_PART: usize = 1000;

/// Content of the text of a study.
pub(super) struct StudyText {
    pub file: SpecFile,
    pub design: Design,
    pub quantity: Quantity,
    pub points_per_part: usize,
}

/// Reads a text; `file` finds the spec and its name in messages by the path in the text, `None` if
/// it names no path.
pub(super) fn read(
    text: &str,
    file: impl FnOnce(Option<&str>) -> Result<(SpecFile, String), StudyError>,
) -> Result<StudyText, StudyError> {
    let mut reader = FaultCollector::new(text);
    let Some(document) = reader.document() else {
        return Err(StudyError::Faults(reader.sorted()));
    };
    let root = document.as_table();
    reader.known(
        "",
        root,
        &[
            "spec",
            "sampling",
            "points",
            "seed",
            "points_per_part",
            "set",
            "vary",
            "quantity",
        ],
    );
    let path = reader.text("spec", root.get("spec"));
    let (mut file, name) = file(path).map_err(|error| unread_spec(text, root, error))?;
    settings(&mut reader, root.get("set"), &mut file);
    let mut reader = check_spec(reader, root.get("set"), &file, name)?;
    let sampling = sampling(&mut reader, root.get("sampling"));
    let varied = varied(&mut reader, root.get("vary"), &file, sampling);
    let seed = reader.integer("seed", root.get("seed"), (0, 1 << 53), 1);
    let points = number_of_samples(&mut reader, root, sampling);
    let quantity = quantity(&mut reader, root.get("quantity"), &file);
    check_sides(&mut reader, root.get("vary"), sampling, &varied);
    check_swept(&mut reader, root.get("vary"), &varied, &quantity);
    if !reader.faults.is_empty() {
        return Err(StudyError::Faults(reader.sorted()));
    }
    let design = Design::new(varied, sampling, points, seed);
    let usual = design
        .len()
        .div_ceil(DEFAULT_PARTS)
        .clamp(1, MAX_POINTS_PER_PART) as u64;
    let points_per_part = reader.integer(
        "points_per_part",
        root.get("points_per_part"),
        (1, 1_000_000),
        usual,
    ) as usize;
    if reader.faults.is_empty() {
        Ok(StudyText {
            file,
            design,
            quantity,
            points_per_part,
        })
    } else {
        Err(StudyError::Faults(reader.sorted()))
    }
}

/// Returns the error of a spec that cannot be read, with the place of its path.
fn unread_spec(text: &str, root: &Table, error: StudyError) -> StudyError {
    let StudyError::SpecFile(error) = error else {
        return error;
    };
    let mut reader = FaultCollector::new(text);
    let span = root.get("spec").and_then(Item::span);
    reader.fault("spec", span, format!("spec: {error}"));
    StudyError::Faults(reader.sorted())
}

/// Applies the keys with the same value at every point.
fn settings(reader: &mut FaultCollector, item: Option<&Item>, file: &mut SpecFile) {
    let Some(table) = reader.table("set", item) else {
        return;
    };
    for (key, item) in table {
        if item.as_value().is_none() {
            reader.fault(
                key,
                item.span(),
                format!("set.{key} must be a value; write the whole path as one key, \"stop.tip.gap\" = \"1 mm\""),
            );
            continue;
        }
        if let Err(fault) = file.set(key, item.as_str().unwrap_or(reader.bare(item))) {
            reader.fault(key, item.span(), fault.message);
        }
    }
}

/// Checks the spec; faults of a key in `[set]` are faults of the study.
fn check_spec<'t>(
    mut reader: FaultCollector<'t>,
    settings: Option<&Item>,
    file: &SpecFile,
    name: String,
) -> Result<FaultCollector<'t>, StudyError> {
    let Err(faults) = file.spec() else {
        return Ok(reader);
    };
    let of_settings = faults.as_slice().iter().filter(|fault| fault.set.is_some());
    for fault in of_settings {
        let item = settings.and_then(|settings| settings.get(&fault.key));
        let span = item.and_then(Item::span);
        reader.fault(&fault.key, span, format!("set: {}", fault.message));
    }
    Err(match reader.faults.is_empty() {
        true => StudyError::Spec { file: name, faults },
        false => StudyError::Faults(reader.sorted()),
    })
}

fn sampling(reader: &mut FaultCollector, item: Option<&Item>) -> Sampling {
    let Some(name) = reader.text("sampling", item) else {
        return Sampling::Grid;
    };
    let choice = Sampling::ALL
        .into_iter()
        .find(|sampling| sampling.name() == name);
    if choice.is_none() {
        let names = Sampling::ALL.map(Sampling::name).join(", ");
        reader.fault(
            "sampling",
            item.and_then(Item::span),
            format!("sampling is \"{name}\"; it must be one of {names}"),
        );
    }
    choice.unwrap_or(Sampling::Grid)
}

fn number_of_samples(reader: &mut FaultCollector, root: &Table, sampling: Sampling) -> usize {
    let item = root.get("points");
    match (item, sampling.draws()) {
        (None, true) => reader.missing(
            "points",
            None,
            format!(
                "points is missing; sampling = \"{}\" needs their number",
                sampling.name()
            ),
        ),
        (Some(item), false) => {
            let reason = format!(
                "points does not go with sampling = \"{}\", whose values say how many there are",
                sampling.name()
            );
            reader.fault("points", item.span(), reason);
        }
        (Some(_), true) | (None, false) => {}
    }
    reader.integer("points", item, (1, MAX_DRAWN_POINTS), 1) as usize
}

/// Hint for a drawn key without the ends of its range.
const DRAWN_RANGE_HINT: &str =
    "drawn values need a range FROM:TO, or FROM:TO:log above 0, from a smaller to a larger value";

fn no_key(reason: &str) -> String {
    format!(
        "vary names no key{reason}; write [vary] and \"stop.tip.gap\" = \"0.5mm:1.5mm:3x\" below it"
    )
}

/// Reads the keys to be varied, with their values.
fn varied(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
    sampling: Sampling,
) -> Vec<Varied> {
    let table = reader.table("vary", item);
    let Some(table) = table.filter(|table| !table.is_empty()) else {
        let reason = item.map_or(": the table [vary] is missing", |_| "");
        reader.fault("vary", item.and_then(Item::span), no_key(reason));
        return Vec::new();
    };
    let mut entries = Vec::new();
    for (key, item) in table {
        if file.sets(key) {
            let message =
                format!("vary.{key}: [set] gives this key too; remove it from one of the two");
            reader.fault(key, item.span(), message);
        }
        let Some(text) = item.as_str() else {
            reader.fault(key, item.span(), format!("vary.{key} must be a text, as in \"0.5mm:1.5mm:3x\", under the whole path as one key"));
            continue;
        };
        let (range, logarithmic) = match text.strip_suffix(":log").filter(|_| sampling.draws()) {
            Some(range) => (range, true),
            None => (text, false),
        };
        if sampling.draws() && range.split([':', ',']).count() != 2 {
            reader.fault(
                key,
                item.span(),
                format!("{key}: {text:?} cannot be drawn from; {DRAWN_RANGE_HINT}"),
            );
            continue;
        }
        // The values of a drawn key are the two ends of its range.
        let range = if sampling.draws() {
            range.replacen(':', ",", 1)
        } else {
            range.to_owned()
        };
        let faults = match file.numeric_key(key) {
            Err(faults) => faults.as_slice().to_vec(),
            Ok(numeric) => match KeyRange::parse(numeric, &range) {
                Err(fault) => vec![fault],
                Ok(range) => {
                    entries.push(Varied {
                        key: range.key().clone(),
                        values: range.values().to_vec(),
                        logarithmic,
                    });
                    Vec::new()
                }
            },
        };
        faults
            .into_iter()
            .for_each(|fault| reader.fault(key, item.span(), fault.message));
    }
    entries
}

/// Refuses to vary a key that the quantity sweeps.
fn check_swept(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    varied: &[Varied],
    quantity: &Quantity,
) {
    for (option, swept) in quantity.swept() {
        if varied.iter().any(|one| one.key.path() == swept) {
            let span = item.and_then(|item| item.get(swept)).and_then(Item::span);
            let message = format!(
                "vary.{swept}: quantity.{option} gives the values of this key; remove it from one of the two"
            );
            reader.fault(swept, span, message);
        }
    }
}

/// Checks that the values are compatible.
fn check_sides(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    sampling: Sampling,
    varied: &[Varied],
) {
    let span = item.and_then(Item::span);
    let count = varied.first().map_or(0, |first| first.values.len());
    for one in varied {
        let ends =
            matches!(one.values[..], [low, high] if low < high && (!one.logarithmic || low > 0.0));
        if sampling.draws() && !ends {
            reader.fault(
                one.key.path(),
                span.clone(),
                format!("{}: {DRAWN_RANGE_HINT}", one.key.path()),
            );
        }
        if sampling == Sampling::List && one.values.len() != count {
            let reason = format!(
                "has {} values where {} has {count}; a list takes them side by side",
                one.values.len(),
                varied[0].key.path()
            );
            reader.fault(
                one.key.path(),
                span.clone(),
                format!("{} {reason}", one.key.path()),
            );
        }
    }
    let points = varied.iter().try_fold(1_u64, |product, one| {
        product.checked_mul(one.values.len() as u64)
    });
    if sampling == Sampling::Grid && points.is_none_or(|points| points > MAX_POINTS) {
        reader.fault(
            "vary",
            span.clone(),
            format!("the grid has more than {MAX_POINTS} points; give fewer values"),
        );
    }
    if sampling == Sampling::Sobol && varied.len() > MAX_DIMENSIONS {
        reader.fault(
            "vary",
            span,
            format!(
                "sampling = \"sobol\" takes at most {MAX_DIMENSIONS} keys; use \"latin-hypercube\""
            ),
        );
    }
}
