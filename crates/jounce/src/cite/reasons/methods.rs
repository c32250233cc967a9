//! Periodic orbits and attractors of a nonlinear harvester under sinusoids.

use super::Reasons;
use jounce_spec::{Interface, Spec, StopLaw};

pub(super) fn add(spec: &Spec, reasons: &mut Reasons) {
    let switches = |interface: Interface| interface != Interface::Resistor;
    let is_nonlinear =
        !spec.stop.is_empty() || spec.circuit.values().any(|one| switches(one.interface));
    let is_periodic = !spec.drive.is_empty()
        && spec
            .drive
            .values()
            .all(|drive| drive.frequency_hz().is_some());
    // A regulator switches at its own times.
    if !(is_nonlinear && is_periodic && spec.regulator.is_empty()) {
        return;
    }
    let is_compliant = |law: StopLaw| !matches!(law, StopLaw::Rigid { .. });
    if spec.stop.values().any(|stop| is_compliant(stop.law)) {
        let quadrature = "harmonic balance: quadrature of contacts (`branch`)";
        reasons.add("davis-rabinowitz-1984", quadrature);
    }
    let continuation = "continuation of periodic orbits (`branch`, `bifurcations`)";
    reasons.add("doedel-1991", continuation);
    let folds = "folds and period doublings (`branch`, `bifurcations`)";
    reasons.add("govaerts-2000", folds);
    let bifurcations = "Neimark-Sacker points (`branch`, `bifurcations`)";
    reasons.add("kuznetsov-2004", bifurcations);
    if !spec.stop.is_empty() {
        reasons.add("nordmark-1991", "grazing points (`branch`, `bifurcations`)");
    }
    reasons.add("wilson-1927", "confidence intervals of shares (`basins`)");
    reasons.add(
        "van-den-berg-lessard-2015",
        "proof of attraction (`basins`)",
    );
    reasons.add("das-2017", "quasi-periodic attractors (`basins`)");
}
