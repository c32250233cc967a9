# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # The paper in ten lines
#
# The harvester of *Experimental validation of an impact off-resonance energy harvester* (2019): a beam on a shaker
# table that strikes a stop.

# %%
import numpy as np

import jounce

harvester = jounce.examples()["impact-harvester-2019"]
harvester.plot_harvester()

# %% [markdown]
# The beam as clamped: the natural frequencies of the paper's Table 2.

# %%
modes = harvester.modes(hold="table")
assert np.allclose(modes.frequency_hz[:4], [8.66, 50.3, 140.9, 278.9], rtol=1e-3)
modes

# %% [markdown]
# Mean power over the drive frequency, swept up and down. Where the two differ, the harvester has more than one solution.

# %%
ax = None
for force in ("50 N", "200 N"):
    swept = harvester.changed({"drive.shaker.amplitude": force}).sweep("drive.shaker.frequency", "4 Hz:16 Hz:0.5 Hz", direction="both")
    ax = swept.plot_sweep(ax, force)
    if force == "50 N":
        differences = np.abs(swept.going("up").mean_power_w / swept.going("down").mean_power_w - 1.0)
        assert differences[swept.going("up").parameter == 12.0] > 1.0, "at 12 Hz the harvester has more than one solution"

# %% [markdown]
# One run at 13 Hz: its voltage, and where the energy of the drive went.

# %%
run = harvester.run(record="0.5 s")
run.plot_time_history()
run.plot_energy()
outputs_j = sum(energy_j for name, energy_j in run.energies_j.items() if name != "input_j")
assert abs(outputs_j / run.energies_j["input_j"] - 1.0) < 1e-6
run
