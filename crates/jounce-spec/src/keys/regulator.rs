//! `[regulator.NAME]`

use crate::key::{Key, Keyed, Kind, Range};
use crate::{CHIPS, Chip, Quantity, Regulator};

impl Keyed for Regulator {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            chip: String::new(),
            start_v: f64::NAN,
            stop_v: f64::NAN,
            output_v: f64::NAN,
            efficiency: f64::NAN,
            idle_a: f64::NAN,
            quiescent_a: f64::NAN,
        }
    }
}

static KEYS: &[Key<Regulator>] = &[
    Key::text(
        "chip",
        Kind::Choice(CHIPS),
        "integrated circuit whose data sheet gives the values omitted here",
        |r: &Regulator| r.chip.clone(),
        fill,
    )
    .optional(),
    Key::quantity(
        "start_voltage",
        Quantity::Voltage,
        "storage voltage at which the regulator starts and the device with it; above the stop voltage",
        |r: &Regulator| r.start_v,
        |r, x| r.start_v = x,
    )
    .within(Range::POSITIVE)
    .unless("chip"),
    Key::quantity(
        "stop_voltage",
        Quantity::Voltage,
        "storage voltage at which the regulator stops; at least the output voltage",
        |r: &Regulator| r.stop_v,
        |r, x| r.stop_v = x,
    )
    .within(Range::POSITIVE)
    .unless("chip"),
    Key::quantity(
        "output_voltage",
        Quantity::Voltage,
        "voltage at the device",
        |r: &Regulator| r.output_v,
        |r, x| r.output_v = x,
    )
    .within(Range::POSITIVE)
    .unless("chip"),
    Key::number(
        "efficiency",
        "power at the device over the power that the converter draws from the storage for it",
        |r: &Regulator| r.efficiency,
        |r, x| r.efficiency = x,
    )
    .within(Range { low: 0.0, open: true, high: 1.0 })
    .unless("chip"),
    Key::quantity(
        "idle_current",
        Quantity::Current,
        "current from the storage while the regulator is off, at the start voltage; it is proportional to the storage voltage",
        |r: &Regulator| r.idle_a,
        |r, x| r.idle_a = x,
    )
    .within(Range::POSITIVE)
    .unless("chip"),
    Key::quantity(
        "quiescent_current",
        Quantity::Current,
        "current from the storage while the regulator is on, in addition to that for the device",
        |r: &Regulator| r.quiescent_a,
        |r, x| r.quiescent_a = x,
    )
    .within(Range::NOT_NEGATIVE)
    .unless("chip"),
];

/// Takes the values from the library.
fn fill(regulator: &mut Regulator, name: &str) {
    if let Some(chip) = Chip::named(name) {
        *regulator = chip.regulator.clone();
    }
    name.clone_into(&mut regulator.chip);
}
