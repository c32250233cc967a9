# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # Your own rig
#
# From recordings of a test rig to a model that agrees with them. The rig is a virtual one here, so that the truth is known: a beam that is
# 1 % thicker than in its drawing, and sensors with noise. Put your files in its place.

# %%
import tempfile
from pathlib import Path

import numpy as np

import jounce

folder = Path(tempfile.mkdtemp())
harvester = jounce.examples()["impact-harvester-2019"]
built = harvester.changed({"beam.beam.thickness": f"{1.01 * harvester.si('beam.beam.thickness')} m"})

# %% [markdown]
# ## A hammer test
#
# Four hits on the clamped beam, an accelerometer near its end. jounce reads logger files with their units and reports every issue.

# %%
clamped = {"hammer": "beam.hammer", "at": ["beam.tip"], "hold": ["table"], "rate": "1024 Hz"}
built.rig(**clamped, hits=4, block="8 s", noise=0.001).write(folder / "hits.csv")
hits = jounce.read_recordings(folder / "hits.csv")
hits

# %%
# The beam rings longer than a block: an exponential window ends it, and its damping is taken off the modes.
modes = jounce.measured_modes(hits, end_ratio=0.01, between="20 Hz:350 Hz")
modes.frf.plot_frf()
modes.plot_stabilisation()
modes

# %% [markdown]
# ## The model follows
#
# The thickness was known to 5 %, the three frequencies are good to 0.1 %. The fit is to modes at short circuit; the load of 1 Mohm
# lifts the measured ones by up to 0.08 %.

# %%
measured = [{"number": number, "frequency": f"{hz} Hz"} for number, hz in enumerate(modes.frequency_hz, start=2)]
fit = harvester.fit({"hold": ["table"], "frequency_deviation": 1e-3, "free": {"beam.beam.thickness": 0.05}, "mode": measured})
fit.plot_fit()
# The truth lies in the 95 % interval, and within 0.1 % of the fit.
assert fit.low[0] < built.si("beam.beam.thickness") < fit.high[0]
assert abs(fit.after[0] / built.si("beam.beam.thickness") - 1.0) < 1e-3
print(f"thickness {1e3 * fit.after[0]:.4f} mm, the truth is {1e3 * built.si('beam.beam.thickness'):.4f} mm")
fit

# %% [markdown]
# ## Power against the load
#
# One record for each resistance, with an interval that respects correlation.

# %%
loads = ["100 kohm", "300 kohm", "1 Mohm", "3 Mohm"]
shaken = built.changed({"drive.shaker.frequency": "12 Hz", "run.duration": "6 s", "run.average_over": "4 s"})
records = [shaken.changed({"circuit.load.resistance": load}).rig(rate="1 kHz", noise=0.01) for load in loads]
power = jounce.power(records, loads, drive="12 Hz")
power.plot_power()
simulated_w = np.array([shaken.changed({"circuit.load.resistance": load}).run().mean_power_w for load in loads])
assert np.allclose(power.mean_power_w, simulated_w, rtol=5e-3)
power

# %% [markdown]
# ## Segments of one solution each
#
# The shaker level is raised while the logger runs. The arrays of two records make one.

# %%
quiet = shaken.changed({"drive.shaker.amplitude": "20 N"}).rig(rate="1 kHz", noise=0.01)
voltage = np.concatenate([quiet["mfc.voltage"], records[2]["mfc.voltage"]])
segments = jounce.Recording.of(voltage, 1000.0, units="V").segments("12 Hz", resistance="1 Mohm")
segments.plot_segments()
assert len(segments) == 2 and segments.rms[1] > segments.rms[0]
segments
