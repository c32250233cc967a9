"""A program as a user would write it, for the type checkers alone; an ignored line must be an error."""

# pyright: strict, reportUnnecessaryTypeIgnoreComment=true, reportUnknownMemberType=false

from typing import assert_type

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from xarray import Dataset

import jounce


def best_gap(harvester: jounce.Spec, gaps: list[str]) -> tuple[str, float]:
    powers = {gap: harvester.changed({"stop.tip.gap": gap}).run().mean_power_w for gap in gaps}
    best = max(powers, key=lambda gap: powers[gap])
    return best, powers[best]


def sweep(harvester: jounce.Spec) -> NDArray[np.float64]:
    result = harvester.sweep("drive.shaker.frequency", "10 Hz:14 Hz:0.5 Hz", direction="both", progress=lambda done, total, left: None)
    assert_type(result, jounce.SweepResult)
    return result.mean_power_w


def stable_points(harvester: jounce.Spec) -> int:
    return sum(int(branch.stable.sum()) for branch in harvester.branch("drive.shaker.frequency", ("12 Hz", "13 Hz")))


def faults(text: str) -> list[tuple[int, int, str]]:
    try:
        jounce.Spec(text)
    except jounce.SpecError as error:
        return [(fault.line, fault.column, fault.message) for fault in error.faults]
    return []


def measured(path: str, harvester: jounce.Spec) -> tuple[float, jounce.Spec]:
    modes = jounce.measured_modes(path, between="20 Hz:350 Hz")
    assert_type(modes, jounce.MeasuredModes)
    fit = harvester.fit({"free": {"beam.beam.thickness": 0.05}, "mode": [{"number": 1, "frequency": f"{modes.frequency_hz[0]} Hz"}]})
    return float(jounce.power(path, "1 kohm").mean_power_w[0]), fit.spec


def rigid(harvester: jounce.Spec) -> jounce.Spec:
    stop = jounce.Stop(at="beam.tip", law="rigid", restitution=0.8, gap="1 mm")
    jounce.Stop(at="beam.tip", law="rigid", gapp="1 mm")  # type: ignore[call-arg]
    jounce.Stop(at="beam.tip", law="hertzz", gap="1 mm")  # type: ignore[arg-type]
    jounce.Stop(at="beam.tip", law="rigid", gap=0.001)  # type: ignore[arg-type]
    jounce.Stop(law="rigid", gap="1 mm")  # type: ignore[call-arg]
    jounce.Spec(run={"durationn": "1 s"})  # type: ignore[arg-type]
    jounce.Spec(stop={"tip": {"at": "beam.tip", "law": "hertzz", "gap": "1 mm"}})  # type: ignore[dict-item]
    return jounce.Spec(harvester, stop={"tip": stop})


def tables() -> jounce.Spec:
    return jounce.Spec(
        beam={"arm": {"length": "0.1 m", "width": "10 mm", "thickness": "1 mm", "material": "steel"}},
        run={"duration": "1 s", "average_over": "0.5 s"},
    )


def pictures(result: jounce.FrfResult) -> tuple[str, list[str]]:
    axes = result.plot_frf(response="mfc.voltage")
    assert_type(axes, Axes)
    dataset = result.to_xarray()
    assert_type(dataset, Dataset)
    return axes.get_title(), [str(name) for name in dataset.data_vars]
