# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # Branches and basins
#
# A sweep shows the solutions that it happens to reach. A branch shows every periodic orbit, stable or not, and a basin its probability.

# %%
import jounce

harvester = jounce.examples()["impact-harvester-2019"]
branches = harvester.branch("drive.shaker.frequency", "11 Hz:14 Hz", seeds=4)
ax = branches.plot_branch()
branches

# %% [markdown]
# A sweep over the same range lies on the stable parts and jumps at the folds.

# %%
sweep = harvester.sweep("drive.shaker.frequency", "11 Hz:14 Hz:0.25 Hz", direction="both")
sweep.plot_sweep(ax)

# %% [markdown]
# At 12.2 Hz there are several attractors. From a hundred random starts, how often does each come?

# %%
basins = harvester.changed({"drive.shaker.frequency": "12.2 Hz"}).basins(starts=100)
basins.plot_basins()
basins

# %% [markdown]
# The folds, doublings and grazings while the gap changes: the bifurcation curves.

# %%
curves = harvester.bifurcations("drive.shaker.frequency", "12 Hz:13.5 Hz", "stop.tip.gap", "0.8 mm:1.2 mm", seeds=0)
curves.plot_bifurcations()
