//! Reads the quantity of a study from its table `[quantity]`.

use super::Quantity;
use super::evaluation::default_excitation;
use super::table::QuantityTable;
use crate::study::faults::FaultCollector;
use crate::{BifurcationSearch, BranchSearch, DiagramOrder, SweepOrder};
use jounce_model::linear::FrfOutput;
use jounce_spec::{Drive, DriveSignal, SpecFile, did_you_mean};
use toml_edit::{Item, Table};

/// Commands available in a study.
const COMMANDS: &[&str] = &[
    "run",
    "modes",
    "frf",
    "sweep",
    "diagram",
    "branch",
    "bifurcations",
    "basins",
    "ensemble",
    "noise",
];

impl Quantity {
    /// Returns the names of the options of a command in a study.
    pub fn options(command: &str) -> &'static [&'static str] {
        match command {
            "modes" => &["count"],
            "frf" => &["low", "high", "points"],
            "sweep" => &["over", "direction", "fixed_duration"],
            "diagram" => &["over", "direction", "tolerance"],
            "branch" => &["over", "seeds", "longest_period", "tolerance"],
            "bifurcations" => &["over", "against", "seeds", "longest_period", "tolerance"],
            "basins" => &[
                "starts",
                "seed",
                "spread",
                "tolerance",
                "longest_period",
                "max_cycles",
            ],
            "ensemble" => &["members", "seed"],
            _ => &[],
        }
    }
}

/// Reads the quantity with its options.
pub(in crate::study) fn quantity(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
) -> Quantity {
    let empty = Table::new();
    let table = reader.table("quantity", item).unwrap_or(&empty);
    let request = QuantityTable { table, file };
    if item.is_some() && !table.contains_key("command") {
        let reason = "quantity.command is missing; write command = \"run\", or another command, below [quantity]";
        reader.fault("quantity.command", table.span(), reason);
        return Quantity::Run;
    }
    let command = reader
        .text("quantity.command", table.get("command"))
        .unwrap_or("run");
    if COMMANDS.contains(&command) {
        let known = [&["command"], Quantity::options(command)].concat();
        reader.known("quantity.", table, &known);
    }
    match command {
        "run" => Quantity::Run,
        "modes" => Quantity::Modes {
            count: request.integer(reader, "count", 200, 3) as usize,
        },
        "frf" => request.frf(reader),
        "sweep" => request.sweep(reader),
        "diagram" => request.diagram(reader),
        "branch" => request.branch(reader),
        "bifurcations" => request.bifurcations(reader),
        "basins" => Quantity::Basins {
            starts: request.integer(reader, "starts", 1_000_000, 200) as usize,
            seed: request.integer(reader, "seed", 1 << 53, 1),
            spread: reader.positive("quantity.spread", table.get("spread"), 10.0),
            recognition: request.recognition(reader),
        },
        "ensemble" => Quantity::Ensemble {
            members: request.integer(reader, "members", 1_000_000, 16) as usize,
            seed: request.integer(reader, "seed", 1 << 53, 1),
        },
        "noise" => request.noise(reader),
        other => {
            let reason = format!(
                "quantity.command is \"{other}\"{}; it must be one of {}",
                did_you_mean(other, COMMANDS),
                COMMANDS.join(", ")
            );
            reader.fault("quantity.command", request.span("command"), reason);
            Quantity::Run
        }
    }
}

impl QuantityTable<'_> {
    fn frf(&self, reader: &mut FaultCollector) -> Quantity {
        let range_hz = (
            self.frequency(reader, "low", 1.0),
            self.frequency(reader, "high", 1000.0),
        );
        if range_hz.0 >= range_hz.1 {
            let reason = format!(
                "quantity.low is {} Hz and quantity.high {} Hz; low must be below high",
                range_hz.0, range_hz.1
            );
            reader.fault("quantity.low", self.span("low"), reason);
        }
        let points = reader.integer(
            "quantity.points",
            self.table.get("points"),
            (2, 1_000_000),
            2000,
        ) as usize;
        let input = self.file.spec().ok().as_ref().and_then(default_excitation);
        if input.is_none() {
            reader.fault(
                "quantity.command",
                self.span("command"),
                "frf needs a drive that says what shakes the harvester: a force or a base",
            );
        }
        let unit = input.map_or("", |input| {
            FrfOutput::LoadVoltage(String::new()).unit(&input)
        });
        Quantity::Frf {
            range_hz,
            points,
            unit,
        }
    }

    fn noise(&self, reader: &mut FaultCollector) -> Quantity {
        let noisy = |drive: &Drive| matches!(drive.signal, DriveSignal::Noise { .. });
        // Faults of the spec are reported elsewhere.
        if self
            .file
            .spec()
            .is_ok_and(|spec| !spec.drive.values().any(noisy))
        {
            let reason = "noise needs a drive with signal = \"noise\"; use \"run\" or \"frf\" for other drives";
            reader.fault("quantity.command", self.span("command"), reason);
        }
        Quantity::Noise
    }

    fn sweep(&self, reader: &mut FaultCollector) -> Quantity {
        let orders = [
            ("up", SweepOrder::Up),
            ("down", SweepOrder::Down),
            ("both", SweepOrder::Both),
            ("independent", SweepOrder::Independent),
        ];
        let direction = self.one_of(reader, "direction", &orders);
        let fixed_duration = self
            .table
            .get("fixed_duration")
            .map_or(Some(false), Item::as_bool);
        if fixed_duration.is_none() {
            reader.fault(
                "quantity.fixed_duration",
                self.span("fixed_duration"),
                "quantity.fixed_duration must be true or false",
            );
        }
        let (over, values) = match self.values(reader) {
            Some((range, text)) => (range.key().path().to_owned(), text.to_owned()),
            None => (String::new(), String::new()),
        };
        Quantity::Sweep {
            over,
            values,
            direction,
            fixed_duration: fixed_duration.unwrap_or_default(),
        }
    }

    fn diagram(&self, reader: &mut FaultCollector) -> Quantity {
        let order = self.one_of(
            reader,
            "direction",
            &[
                ("both", DiagramOrder::Both),
                ("up", DiagramOrder::Up),
                ("down", DiagramOrder::Down),
            ],
        );
        let tolerance = self.tolerance(reader, 1e-8);
        let (over, values) = match self.values(reader) {
            Some((range, _)) => (range.key().path().to_owned(), range.values().to_vec()),
            None => (String::new(), Vec::new()),
        };
        if values.windows(2).any(|pair| pair[0] >= pair[1]) {
            reader.fault(
                "quantity.over",
                self.span("over"),
                "quantity.over: the values of a diagram must rise",
            );
        }
        Quantity::Diagram {
            over,
            values,
            order,
            tolerance,
        }
    }

    fn branch(&self, reader: &mut FaultCollector) -> Quantity {
        let (over, range) = self.ends(reader, "over", "drive.shaker.frequency=4Hz:20Hz");
        Quantity::Branch {
            over,
            range,
            seeds: self.seeds(reader, BranchSearch::DEFAULT_SEEDS),
            longest_period: self.integer(reader, "longest_period", 1000, 12) as u32,
            tolerance: self.tolerance(reader, 5e-10),
        }
    }

    fn bifurcations(&self, reader: &mut FaultCollector) -> Quantity {
        let over = self.ends(reader, "over", "drive.shaker.frequency=4Hz:20Hz");
        let against = self.ends(reader, "against", "stop.tip.gap=0.5mm:1.5mm");
        Quantity::Bifurcations {
            keys: [over.0, against.0],
            ranges: [over.1, against.1],
            seeds: self.seeds(reader, BifurcationSearch::DEFAULT_SEEDS),
            longest_period: self.integer(reader, "longest_period", 1000, 2) as u32,
            tolerance: self.tolerance(reader, 1e-9),
        }
    }
}
