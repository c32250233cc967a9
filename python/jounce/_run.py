"""One run and its result."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._format import counted
from ._history import History
from ._result import Floats, Integers, Result
from ._state import State

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RunResult(Result):
    """Means over the averaging window at the end of a run, and the energy balance of the complete run."""

    mean_power_w: Annotated[float, Along("", "W", "mean power of all loads and rectified circuits")]
    voltage_rms_v: Annotated[
        float | None,
        About(
            "rms voltage of the first load, or of the storage of the first rectified circuit without a load; ``None`` without either", "V"
        ),
    ]
    voltage_peak_v: Annotated[
        float | None,
        About("largest voltage of the first load, or of the first patch without a load; ``None`` without either or without a record", "V"),
    ]
    load: Annotated[list[str], About("names of the loads")]
    load_mean_power_w: Annotated[Floats, Along("load", "W", "mean power")]
    load_voltage_rms_v: Annotated[Floats, Along("load", "V", "voltage, rms")]
    load_voltage_peak_v: Annotated[
        Floats,
        Along(
            "load",
            "V",
            "voltage, peak",
            detail="largest magnitude in the averaging window; NaN without a record of it: "
            "with drives without a common period, and with more than 10000 drive cycles without steady state",
        ),
    ]
    patch: Annotated[list[str], About("names of the patches")]
    patch_voltage_peak_v: Annotated[Floats, Along("patch", "V", "voltage, peak")]
    patch_strain_peak: Annotated[
        Floats, Along("patch", "1", "strain of the outer face, peak", detail="NaN for a structure given by its modes, and as the voltage")
    ]
    point: Annotated[list[str], About("names of the points that move")]
    point_displacement_peak_m: Annotated[
        Floats, Along("point", "m", "displacement relative to the base, peak", detail="window and NaN as of the peak voltage of a load")
    ]
    rectified: Annotated[list[str], About("names of the rectified circuits")]
    rectified_mean_power_w: Annotated[Floats, Along("rectified", "W", "mean power")]
    rectified_voltage_rms_v: Annotated[Floats, Along("rectified", "V", "voltage of the storage, rms")]
    rectified_mean_current_a: Annotated[Floats, Along("rectified", "A", "mean current of the diodes")]
    rectified_storage_w: Annotated[Floats, Along("rectified", "W", "mean power that fills the storage")]
    rectified_diode_loss_w: Annotated[Floats, Along("rectified", "W", "mean power lost in diodes")]
    rectified_switch_loss_w: Annotated[Floats, Along("rectified", "W", "mean power lost in the switch")]
    rectified_leakage_w: Annotated[Floats, Along("rectified", "W", "mean power lost by leakage")]
    rectified_regulator_loss_w: Annotated[Floats, Along("rectified", "W", "mean power lost in the regulator")]
    device: Annotated[list[str], About("circuits with a device behind a regulator")]
    device_cold_start_s: Annotated[Floats, Along("device", "s", "time to the first start", detail="NaN where the device never starts")]
    device_on_fraction: Annotated[Floats, Along("device", "1", "share of the time on")]
    device_starts: Annotated[Integers, Along("device", "1", "starts of the device")]
    device_longest_outage_s: Annotated[Floats, Along("device", "s", "longest time off")]
    device_completed_tasks: Annotated[Integers, Along("device", "1", "completed measurements and transmissions")]
    device_interrupted_tasks: Annotated[Integers, Along("device", "1", "tasks that an outage interrupted")]
    device_energy_per_day_j: Annotated[Floats, Along("device", "J", "energy delivered to the device per day")]
    device_available_w: Annotated[Floats, Along("device", "W", "mean power that arrives at the storage, without its leakage")]
    device_needed_w: Annotated[Floats, Along("device", "W", "mean power that the regulator needs to stay on")]
    device_margin_w: Annotated[Floats, Along("device", "W", "available minus needed power")]
    charge: Annotated[
        list[str],
        About(
            "circuits whose diodes feed a capacitor; the charge balance in the averaging window is ``passed = load + leakage + storage``"
        ),
    ]
    charge_passed_c: Annotated[Floats, Along("charge", "C", "charge through the diodes")]
    charge_load_c: Annotated[Floats, Along("charge", "C", "charge through the load or the regulator")]
    charge_leakage_c: Annotated[Floats, Along("charge", "C", "charge through the leakage of the storage")]
    charge_storage_c: Annotated[Floats, Along("charge", "C", "charge added to the storage")]
    charge_residual_relative: Annotated[Floats, Along("charge", "1", "residual of the charge balance, relative to the largest term")]
    leak: Annotated[list[str], About("patches with leakage")]
    leak_mean_power_w: Annotated[Floats, Along("leak", "W", "mean power lost by leakage of a patch")]
    stop: Annotated[list[str], About("names of the stops")]
    stop_contacts: Annotated[Integers, Along("stop", "1", "contacts that began")]
    stop_contact_rate_hz: Annotated[Floats, Along("stop", "1/s", "contacts per second")]
    stop_mean_impact_velocity_m_s: Annotated[Floats, Along("stop", "m/s", "mean impact velocity", detail="0 without a contact")]
    stop_max_impact_velocity_m_s: Annotated[Floats, Along("stop", "m/s", "largest impact velocity")]
    stop_mean_contact_duration_s: Annotated[Floats, Along("stop", "s", "mean contact duration", detail="0 without a contact")]
    stop_max_contact_duration_s: Annotated[Floats, Along("stop", "s", "longest contact duration")]
    stop_contact_duty: Annotated[Floats, Along("stop", "1", "share of the time in contact")]
    stop_max_penetration_m: Annotated[Floats, Along("stop", "m", "largest penetration")]
    stop_max_contact_force_n: Annotated[Floats, Along("stop", "N", "largest contact force")]
    stop_impulse_n_s: Annotated[Floats, Along("stop", "N s", "time integral of the contact force")]
    max_penetration_m: Annotated[float, Along("", "m", "largest penetration of the stop")]
    max_contact_force_n: Annotated[float, Along("", "N", "largest contact force")]
    contacts: Annotated[int, Along("", "1", "contacts that began", detail="summed over the stops")]
    contact_duty: Annotated[float, Along("", "1", "share of the time in contact", detail="summed over the stops")]
    settled: Annotated[bool | None, About("True where the run has settled; ``None`` where the drives have no common period")]
    period_cycles: Annotated[int | None, About("period in drive cycles; ``None`` where the drives have no common period")]
    periodicity_change: Annotated[float, About("relative change of the state over its period; NaN without a common period")]
    distance_to_orbit: Annotated[float, About("relative distance of the state to the periodic orbit; NaN without a common period")]
    warnings: Annotated[list[str], About("warnings of the run")]
    energy_residual_relative: Annotated[
        float,
        Along(
            "",
            "1",
            "energy residual of the run",
            detail="input minus all outputs and the stored energy, relative to the largest energy of the run",
        ),
    ]
    is_trivial: Annotated[
        bool, Along("", "1", "no contact began and no energy flowed by more than roundoff", detail="the residual has no meaning then")
    ]
    energies_j: Annotated[
        dict[str, float],
        About(
            "energies of the complete run: ``input_j``, ``loads_j``, ``rectified_j`` (into loads and batteries behind rectifiers), "
            "``rectified_loss_j`` (in their diodes, switches and regulators, and by leakage), ``leaks_j`` (by leakage of patches), "
            "``damping_j``, "
            "``contact_loss_j``, ``stored_j``",
            "J",
        ),
    ]
    duration_s: Annotated[float, About("simulated time", "s")]
    average_over_s: Annotated[float, About("length of the averaging window", "s")]
    tolerance: Annotated[float, About("required relative error")]
    end: Annotated[State, About("state at the end")]
    work: Annotated[dict[str, int], About("numbers of steps and iterations")]
    history: Annotated[History | None, About("recorded end of the run; ``None`` unless requested")]
    wall_time_s: Annotated[float, About("wall time of the call, with the model and the record; not compared between results", "s")] = (
        dataclasses.field(compare=False)
    )
    integration_wall_time_s: Annotated[float, About("wall time of the integration alone; not compared between results", "s")] = (
        dataclasses.field(compare=False)
    )

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        fields, history = dict(fields), fields["history"]
        if history is not None:
            history = History._from_core({**history, "manifest": fields["manifest"]})
        energies = _sums(fields.pop("energies"))
        return super()._from_core({**cls._filled(fields), "energies_j": energies, "history": history, "end": State(fields["end"])})

    def _peaks(self) -> list[tuple[str, float]]:
        """Returns the largest voltage of each load, and of each patch without a load."""
        peaks = list(zip(self.load, map(float, self.load_voltage_peak_v)))
        patch_peaks = zip(self.patch, map(float, self.patch_voltage_peak_v))
        return peaks + [(name, volts) for name, volts in patch_peaks if volts not in self.load_voltage_peak_v]

    def _summary(self) -> list[tuple[str, str]]:
        settled = (
            f"period of {counted(self.period_cycles, 'drive cycle')}"
            if self.settled and self.period_cycles is not None
            else f"NOT settled, change {self.periodicity_change:.1e}"
        )
        cause = "a regulator switches at its own times" if self.device else "no drives with a common period"
        settled = f"no period: {cause}" if self.settled is None else settled
        return [
            ("mean power", f"{self.mean_power_w:.6e} W"),
            *((f"voltage, rms ({name})", f"{volts:.6g} V") for name, volts in zip(self.load, self.load_voltage_rms_v)),
            *((f"voltage, peak ({name})", f"{volts:.6g} V") for name, volts in self._peaks() if not np.isnan(volts)),
            *(
                (f"displacement, peak ({name})", f"{peak:.6g} m")
                for name, peak in zip(self.point, self.point_displacement_peak_m)
                if not np.isnan(peak)
            ),
            *(
                (f"strain, peak ({name})", f"{1e6 * peak:.2f} ppm")
                for name, peak in zip(self.patch, self.patch_strain_peak)
                if not np.isnan(peak)
            ),
            *((f"storage, rms ({name})", f"{volts:.6g} V") for name, volts in zip(self.rectified, self.rectified_voltage_rms_v)),
            *((f"device ({name})", self._device_summary(k)) for k, name in enumerate(self.device)),
            *((f"leakage ({name})", f"{power:.6e} W") for name, power in zip(self.leak, self.leak_mean_power_w)),
            ("contacts", f"{self.contacts} in {self.average_over_s:g} s, {100 * self.contact_duty:.2f} % of the time"),
            ("penetration, peak", f"{self.max_penetration_m:.4e} m, force {self.max_contact_force_n:.4e} N"),
            ("energy residual", f"{self.energy_residual_relative:.1e} of the largest energy"),
            ("settled", settled),
            *(("warning", text) for text in self.warnings),
        ]

    def _device_summary(self, k: int) -> str:
        tasks = f"{self.device_completed_tasks[k]} tasks completed, {self.device_interrupted_tasks[k]} interrupted"
        share = f"on for {100 * self.device_on_fraction[k]:.2f} % of the time"
        return f"{share}, longest outage {self.device_longest_outage_s[k]:.4g} s, {tasks}, margin {self.device_margin_w[k]:.3e} W"

    @property
    def is_transient(self) -> bool:
        """True where the run has not settled, although its drives have a common period."""
        return self.settled is False

    def to_dict(self) -> dict[str, Any]:
        """Returns every number and name except the record."""
        excluded = ("history", "end", "manifest")
        return {field.name: getattr(self, field.name) for field in dataclasses.fields(self) if field.name not in excluded}

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` of the means over loads, patches, circuits and stops, without the record."""
        settling = {
            "settled": Variable((), bool(self.settled), "1", "settled at the end of the average"),
            "period_cycles": Variable((), self.period_cycles or 0, "1", "period in drive cycles, 0 without a period"),
        }
        coords = {
            name: Variable((name,), getattr(self, name), "", name)
            for name in ("load", "patch", "point", "rectified", "device", "charge", "leak", "stop")
        }
        return self._dataset({**self._variables(), **settling}, coords)

    def _parts(self) -> dict[str, Dataset]:
        return {} if self.history is None else {"history": self.history.to_xarray()}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with one row."""
        flat = {key: [value] for key, value in self.to_dict().items() if isinstance(value, (bool, int, float))}
        return self._frame(flat)

    def recorded(self) -> History:
        """Returns the record; raises ArgumentError without one."""
        if self.history is None:
            raise ArgumentError('this run has no record; compute it with run(record="1 s")')
        return self.history

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        recorded = {} if self.history is None else self.history._pictures()
        return {**recorded, "energy": self.plot_energy}

    def plot_time_history(self, ax: Axes | None = None, channel: str | None = None) -> Axes:
        """Draws a channel of the record over time, see :meth:`History.channels`."""
        return self.recorded().plot_time_history(ax, channel)

    def plot_spectrum(self, ax: Axes | None = None, channel: str | None = None) -> Axes:
        """Draws the amplitude spectrum of a channel of the record."""
        return self.recorded().plot_spectrum(ax, channel)

    def plot_poincare(self, ax: Axes | None = None, point: str | None = None) -> Axes:
        """Draws velocity over displacement of a point once per drive cycle."""
        return self.recorded().plot_poincare(ax, point)

    def plot_energy(self, ax: Axes | None = None) -> Axes:
        """Draws the energy outputs as shares of the input energy."""
        from ._plot.energy import plot_energy

        return plot_energy(self, ax)


def _sums(energies: dict[str, Any]) -> dict[str, float]:
    """Returns the energies with those of all loads, circuits and patches added."""
    rectified = energies["rectified"]

    def over(*names: str) -> float:
        return float(sum(own[name] for own in rectified for name in names))

    return {
        "input_j": energies["input_j"],
        "loads_j": float(sum(energies["loads_j"])),
        "rectified_j": over("load_j", "battery_j"),
        "rectified_loss_j": over("diodes_j", "switch_j", "leakage_j", "regulator_j"),
        "leaks_j": float(sum(energies["leaks_j"])),
        "damping_j": energies["damping_j"],
        "contact_loss_j": energies["contact_loss_j"],
        "stored_j": energies["stored_j"],
    }
