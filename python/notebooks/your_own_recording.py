# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # Your own recording
#
# A measured acceleration drives the harvester. Here it is made up: a machine at 9 Hz with a ripple, in the form of SEP005 as many
# loggers' readers give it.

# %%
import numpy as np

import jounce

time_s = np.arange(0.0, 10.0, 1e-3)
ripple = np.random.default_rng(1).normal(size=time_s.size)
recording = {"name": "floor", "unit_str": "m/s**2", "fs": 1000.0, "data": 2.0 * np.sin(2 * np.pi * 9.0 * time_s) + 0.2 * ripple}
spectrum = jounce.spectrum(recording)
assert abs(spectrum.frequency_hz[spectrum.amplitude_peak.argmax()] - 9.0) < 0.1
spectrum.plot_spectrum()

# %% [markdown]
# It drives the base.

# %%
tables = jounce.examples()["impact-harvester-2019"].to_dict()
tables["drive"] = {"floor": jounce.Drive(kind="base-acceleration", recording=recording)}
tables["run"] = {"duration": "10 s", "average_over": "8 s"}
harvester = jounce.Spec(tables)

# %% [markdown]
# What does it give, and what would it give without the stop? A recording has no period, so there is no steady state to reach.

# %%
run = harvester.run(record="2 s")
run.plot_time_history()
assert run.settled is None and run.contacts > 0
run

# %%
run.plot_spectrum()

# %%
without = jounce.Spec({key: table for key, table in tables.items() if key != "stop"})
print(f"with the stop {1e6 * run.mean_power_w:.3g} µW, without {1e6 * without.run().mean_power_w:.3g} µW")
