//! Regulators and devices: reading, library, and faults.

use jounce_spec::{CHIP_LIBRARY, NumericKey, Spec};

const SPEC: &str = include_str!("../../../../examples/wireless-sensor/harvester.toml");

fn faults(change: &[(&str, &str)]) -> String {
    let mut text = SPEC.to_owned();
    for (from, to) in change {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    Spec::from_toml(&text).map_or_else(|faults| faults.to_string(), |_| String::new())
}

#[test]
fn a_chip_gives_the_values_that_are_omitted() {
    let spec = Spec::from_toml(SPEC).unwrap();
    let (regulator, chip) = (&spec.regulator["supply"], &CHIP_LIBRARY[0]);
    assert_eq!(
        (regulator.start_v, regulator.idle_a),
        (chip.regulator.start_v, 450e-9)
    );
    let own = SPEC.replacen(
        "chip = \"LTC3588-1\"",
        "chip = \"LTC3588-1\"\nefficiency = 0.7",
        1,
    );
    let mut spec = Spec::from_toml(&own).unwrap();
    assert_eq!(spec.regulator["supply"].efficiency, 0.7);
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
    let period = NumericKey::find(&spec, "device.sensor.period").unwrap();
    period.set(&mut spec, 10.0).unwrap();
    assert_eq!(spec.device["sensor"].period_s, Some(10.0));
    let fault = period.set(&mut spec, 0.01).unwrap_err().to_string();
    assert!(
        fault.contains("must be longer than measuring and sending together"),
        "{fault}"
    );
}

/// A change of the spec, and a part of the message about it.
const FAULTS: &[((&str, &str), &str)] = &[
    (
        (
            "chip = \"LTC3588-1\"",
            "chip = \"LTC3588-1\"\nstart_voltage = \"3 V\"",
        ),
        "regulator.supply.start_voltage: 3 V must be above the stop voltage of 3.67 V",
    ),
    (
        (
            "chip = \"LTC3588-1\"",
            "chip = \"LTC3588-1\"\noutput_voltage = \"4 V\"",
        ),
        "regulator.supply.stop_voltage: 3.67 V must be at least the output voltage of 4 V",
    ),
    (
        ("chip = \"LTC3588-1\"", "chip = \"LTC3588\""),
        "\"LTC3588\" is not known (did you mean `LTC3588-1`?)",
    ),
    (
        ("chip = \"LTC3588-1\"", "start_voltage = \"5 V\""),
        "`stop_voltage` is missing",
    ),
    (
        ("device = \"sensor\"", "device = \"senser\""),
        "circuit.store.device: there is no device \"senser\" (did you mean `sensor`?)",
    ),
    (
        ("device = \"sensor\"", ""),
        "supplies no device; give `device`",
    ),
    (
        (
            "regulator = \"supply\"",
            "regulator = \"supply\"\nresistance = \"1 Mohm\"",
        ),
        "give exactly one of `resistance` or `regulator`",
    ),
    (
        ("regulator = \"supply\"", "resistance = \"1 Mohm\""),
        "has no regulator; give `regulator` in place of",
    ),
    (
        ("storage = \"100 uF\"", "battery = \"3 V\""),
        "has no effect with a battery, whose voltage is fixed; give `storage`",
    ),
    (
        ("regulator = \"supply\"", ""),
        "one of `resistance` or `regulator` is missing",
    ),
    (("send_time = \"5 ms\"", ""), "is given without `send_time`"),
    (
        ("period = \"5 s\"", ""),
        "measures or sends without a `period`",
    ),
    (
        ("period = \"5 s\"", "period = \"25 ms\""),
        "device.sensor.period: 0.025 s must be longer",
    ),
];

#[test]
fn wrong_regulators_and_devices_are_reported() {
    for (change, message) in FAULTS {
        let found = faults(&[*change]);
        assert!(found.contains(message), "{change:?}:\n{found}");
    }
}
