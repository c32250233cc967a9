//! Noise: its samples, the exact response to it, and means over realisations.

use super::Reasons;
use jounce_spec::{DriveSignal, Spec};

pub(super) fn add(spec: &Spec, reasons: &mut Reasons) {
    let is_noise = |signal: &DriveSignal| matches!(signal, DriveSignal::Noise { .. });
    let noise = spec
        .drive
        .iter()
        .filter(|(_, drive)| is_noise(&drive.signal));
    for (name, _) in noise {
        reasons.add(
            "shinozuka-jan-1972",
            format!("drive {name}: samples of noise"),
        );
        reasons.add(
            "gawronski-juang-1990",
            format!("drive {name}: exact mean squares under noise in a band (`noise`)"),
        );
        reasons.add(
            "bendat-piersol-2010",
            format!("drive {name}: bandwidths and densities (`noise`, `ensemble`)"),
        );
        reasons.add(
            "efron-stein-1981",
            format!("drive {name}: confidence intervals over realisations (`ensemble`)"),
        );
        for stop in spec.stop.keys() {
            let rate = format!("stop {stop}: crossing rate of its gap (`noise`)");
            reasons.add("rice-1945", rate);
        }
    }
}
