//! `[device.NAME]`

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::{Device, Quantity};

impl Keyed for Device {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            sleep_a: f64::NAN,
            measure_a: None,
            measure_s: None,
            send_a: None,
            send_s: None,
            period_s: None,
        }
    }
}

static KEYS: &[Key<Device>] = &[
    Key::quantity(
        "sleep_current",
        Quantity::Current,
        "current of the device outside measurements and transmissions; without a period, always",
        |d: &Device| d.sleep_a,
        |d, x| d.sleep_a = x,
    )
    .within(Range::NOT_NEGATIVE),
    optional(
        "measure_current",
        Quantity::Current,
        "current of the device during a measurement",
        Slot::Optional {
            get: |d: &Device| d.measure_a,
            set: |d, x| d.measure_a = Some(x),
        },
    ),
    optional(
        "measure_time",
        Quantity::Time,
        "length of a measurement, at the start of each period",
        Slot::Optional {
            get: |d: &Device| d.measure_s,
            set: |d, x| d.measure_s = Some(x),
        },
    ),
    optional(
        "send_current",
        Quantity::Current,
        "current of the device during a transmission",
        Slot::Optional {
            get: |d: &Device| d.send_a,
            set: |d, x| d.send_a = Some(x),
        },
    ),
    optional(
        "send_time",
        Quantity::Time,
        "length of a transmission, after the measurement",
        Slot::Optional {
            get: |d: &Device| d.send_s,
            set: |d, x| d.send_s = Some(x),
        },
    ),
    optional(
        "period",
        Quantity::Time,
        "period of the duty cycle: measure, send, sleep; the first begins when the regulator starts",
        Slot::Optional {
            get: |d: &Device| d.period_s,
            set: |d, x| d.period_s = Some(x),
        },
    ),
];

const fn optional(
    name: &'static str,
    quantity: Quantity,
    doc: &'static str,
    slot: Slot<Device>,
) -> Key<Device> {
    Key::with_slot(name, Kind::Quantity(quantity), doc, slot)
        .within(Range::POSITIVE)
        .optional()
}
