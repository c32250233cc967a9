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
import numpy as np

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


def distance_to_branches(hz, power_w):
    """Relative difference between a power and that of the nearest stable orbit at a frequency."""
    nearest = np.inf
    for branch in branches:
        ends = zip(branch.parameter, branch.parameter[1:], branch.mean_power_w, branch.mean_power_w[1:], branch.stable)
        for hz_0, hz_1, power_0_w, power_1_w, stable in ends:
            if stable and min(hz_0, hz_1) <= hz <= max(hz_0, hz_1) and hz_0 != hz_1:
                on_branch_w = power_0_w + (power_1_w - power_0_w) * (hz - hz_0) / (hz_1 - hz_0)
                nearest = min(nearest, abs(power_w / on_branch_w - 1.0))
    return nearest


distances = [distance_to_branches(hz, power_w) for hz, power_w in zip(sweep.parameter[sweep.settled], sweep.mean_power_w[sweep.settled])]
assert np.max(distances) < 0.01, "a settled point of the sweep lies on a stable branch"

# %% [markdown]
# At 12.55 Hz there are several attractors. From a hundred random starts, how often does each come?

# %%
basins = harvester.changed({"drive.shaker.frequency": "12.55 Hz"}).basins(starts=100)
assert len(basins) > 1 and (basins.fraction > 0.0).all()
basins.plot_basins()
basins

# %% [markdown]
# The folds, tori and peaks of power while the gap changes: the bifurcation curves.

# %%
curves = harvester.bifurcations("drive.shaker.frequency", "12 Hz:13.5 Hz", "stop.tip.gap", "0.8 mm:1.2 mm", seeds=0)
assert {"fold", "neimark-sacker", "peak"} <= {curve.kind for curve in curves}
curves.plot_bifurcations()
