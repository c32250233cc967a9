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
import jounce

harvester = jounce.examples()["impact-harvester-2019"]
harvester.plot_harvester()

# %% [markdown]
# The beam as clamped: the natural frequencies of the paper's Table 2.

# %%
harvester.modes(hold="table")

# %% [markdown]
# Mean power over the drive frequency, swept up and down. Where the two differ, the harvester has more than one solution.

# %%
ax = None
for force in ("50 N", "200 N"):
    swept = harvester.changed({"drive.shaker.amplitude": force}).sweep("drive.shaker.frequency", "4 Hz:16 Hz:0.5 Hz", direction="both")
    ax = swept.plot_sweep(ax, force)

# %% [markdown]
# One run at 13 Hz: its voltage, and where the energy of the drive went.

# %%
run = harvester.run(record="0.5 s")
run.plot_time_history()
run.plot_energy()
run
