# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # A study on Dask
#
# Mean power over gap and load, on a cluster that here is this machine: two processes.

# %%
import tempfile

import matplotlib.pyplot as plt
from dask.distributed import Client, LocalCluster

import jounce

harvester = jounce.examples()["impact-harvester-2019"]
study = jounce.Study(
    harvester.changed({"run.duration": "4 s", "run.average_over": "2 s"}),
    {"stop.tip.gap": "0.25mm:3mm:12x", "circuit.load.resistance": "50kohm:2Mohm:8log"},
)
study

# %% [markdown]
# Any executor will do. The parts are written to the folder as they come back, so that the study can be stopped and taken up again.

# %%
folder = tempfile.mkdtemp()
with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster, Client(cluster) as client:
    result = study.run(folder, executor=client.get_executor())
table = result.table()
assert len(table) == 12 * 8 and result.status.failed_points == 0

# %% [markdown]
# The best of them, and the map.

# %%
frame = result.to_pandas()
frame.loc[frame["mean_power_w"].idxmax()]

# %%
power = table["mean_power_w"].reshape(8, 12)
gap_mm = 1e3 * table["stop.tip.gap"].reshape(8, 12)
load_kohm = 1e-3 * table["circuit.load.resistance"].reshape(8, 12)

# %%
figure, ax = plt.subplots(layout="constrained")
colours = ax.pcolormesh(gap_mm, load_kohm, 1e6 * power, shading="nearest")
ax.set(xlabel="Gap [mm]", ylabel="Load [kΩ]", yscale="log")
figure.colorbar(colours, label="Mean power [µW]")
