# ---
# jupyter:
#   jupytext:
#     text_representation:
#       format_name: percent
# ---

# %% [markdown]
# # From MATLAB to jounce
#
# The usual way: write the modal equations, give them to `ode45`, wait. SciPy's `solve_ivp` with `RK45` is that method; beside it the same
# harvester in jounce.
#
# ```text
# q_i'' + 2 z_i w_i q_i' + w_i^2 q_i - theta_i V = phi_i(table) F(t) - phi_i(tip) f(delta)
# C V' + V / R + sum theta_i q_i' = 0,      f(delta) = k max(delta, 0)^1.5,  delta = sum phi_i(tip) q_i - gap
# ```
#
# MATLAB:
#
# ```text
# w = 2*pi*f;  delta = @(q) max(phi_tip'*q - gap, 0);
# rhs = @(t,y) [y(n+1:2*n);
#               -2*z.*w.*y(n+1:2*n) - w.^2.*y(1:n) + theta*y(end) + phi_table*F*sin(W*t) - phi_tip*k*delta(y(1:n))^1.5;
#               (-y(end)/R - theta'*y(n+1:2*n))/C];
# [t,y] = ode45(rhs, [0 2], zeros(2*n+1,1), odeset('RelTol',1e-6,'AbsTol',1e-9));
# ```

# %%
import time

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

import jounce

harvester = jounce.examples()["impact-harvester-2019"]
harvester.set({"reduction.modes": 4, "run.duration": "2 s", "run.average_over": "1 s", "run.tolerance": 1e-9})
modes = harvester.modes()
n, w, z = len(modes), 2 * np.pi * modes.frequency_hz, modes.damping_ratio
tip, table = (modes.shape[modes.point.index(name)] for name in ("beam.tip", "table"))
theta = modes.coupling_n_per_v[0]
gap, stiffness, capacitance, resistance = map(
    harvester.si, ("stop.tip.gap", "stop.tip.stiffness", "patch.mfc.capacitance", "circuit.load.resistance")
)
force, frequency = harvester.si("drive.shaker.amplitude"), 2 * np.pi * harvester.si("drive.shaker.frequency")


def rhs(t, y):
    """The right-hand side as in MATLAB."""
    q, v, volts = y[:n], y[n : 2 * n], y[-1]
    contact = stiffness * max(tip @ q - gap, 0.0) ** 1.5
    acceleration = -2 * z * w * v - w**2 * q + theta * volts + table * force * np.sin(frequency * t) - tip * contact
    return np.concatenate([v, acceleration, [(-volts / resistance - theta @ v) / capacitance]])


begun = time.perf_counter()
times = np.linspace(1.0, 2.0, 20001)
solution = solve_ivp(rhs, (0.0, 2.0), np.zeros(2 * n + 1), "RK45", t_eval=times, rtol=1e-6, atol=1e-9)
ode45_s = time.perf_counter() - begun
ode45_w = np.trapezoid(solution.y[-1] ** 2, times) / resistance

# %% [markdown]
# The same in jounce: the spec holds all of it.

# %%
run = harvester.run(record="1 s")
print(f"ode45: {ode45_w:.6e} W in {ode45_s:.2f} s; jounce: {run.mean_power_w:.6e} W in {run.wall_time_s:.4f} s")
# Two seconds of an impacting motion from rest: both agree to the tolerance of ode45.
assert abs(ode45_w / run.mean_power_w - 1.0) < 1e-3

# %%
ax = run.plot_time_history(channel="mfc.voltage")
ax.plot(times, solution.y[-1], "--", label="ode45")
ax.legend()

# %%
history = run.recorded()
difference = np.interp(history.time_s, times, solution.y[-1]) - history.voltage_v[0]
figure, ax = plt.subplots(layout="constrained")
ax.plot(history.time_s, difference)
ax.set(xlabel="Time [s]", ylabel="Voltage, ode45 less jounce [V]")

# %%
run.plot_energy()
run
