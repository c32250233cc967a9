"""An independent method for harvesters: Dormand and Prince's pair in physical coordinates, compiled by numba.

The state holds the modal coordinates and velocities, the voltage of each patch, and two numbers for each circuit: the current of its
inductor or the voltage of its storage, and the energy into its load. A step that ends past an event is bisected; a step sees no event
that begins and ends inside it.
"""

from collections import namedtuple

import numpy as np
from numba import njit

POWER, KELVIN_VOIGT, HUNT_CROSSLEY, CUBIC, RIGID = range(5)
RESISTOR, SERIES_INDUCTOR, PARALLEL_INDUCTOR, BRIDGE, PARALLEL_SSHI, SERIES_SSHI, SECE = range(7)

#: Equations of a harvester. `stops` are rows over the modes; `law_numbers` and `circuit_numbers` have one row for each stop and circuit.
Equations = namedtuple(
    "Equations",
    "stiffness damping stops gaps laws law_numbers coupling capacitance conductance circuits circuit_numbers patches signs tones forces",
)
#: Columns of `circuit_numbers`: load resistance, inductance or storage, forward drop and resistance of both diodes, inversion or
#: efficiency, battery, and conductance of the leakage.
OHM, STORAGE, DROP, DIODES, INVERSION, BATTERY, LEAKAGE = range(7)
#: Columns of `circuits`: interface, 1 for patches in series, and number of patches.
KIND, IS_SERIES, COUNT = range(3)

STAGES = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
    ]
)
TIMES = np.array([0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1])
FIFTH = np.array([35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84, 0])
FOURTH = np.array([5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40])

#: Reasons for which an integration ends.
DONE, STICKS, TOO_LONG = range(3)


@njit(cache=True)
def contact_force(law, numbers, depth, rate, closed):
    """Force of a stop."""
    if law == CUBIC:
        return depth * (numbers[0] + numbers[1] * depth * depth)
    if not closed or depth < 0 or law == RIGID:
        return 0.0
    if law == KELVIN_VOIGT:
        return max(0.0, numbers[0] * depth + numbers[1] * rate)
    factor = max(0.0, 1 + numbers[2] * rate) if law == HUNT_CROSSLEY else 1.0
    return numbers[0] * depth ** numbers[1] * factor


@njit(cache=True)
def approach(eq, state, stop):
    """Penetration of a stop and its rate."""
    modes = eq.stiffness.size
    row = eq.stops[stop]
    return np.dot(row, state[:modes]) - eq.gaps[stop], np.dot(row, state[modes : 2 * modes])


@njit(cache=True)
def patch_voltage(eq, state, circuit):
    """Voltage of the terminals of a circuit."""
    first, voltage = 2 * eq.stiffness.size, 0.0
    for j in range(eq.circuits[circuit, COUNT]):
        if j == 0 or eq.circuits[circuit, IS_SERIES]:
            voltage += eq.signs[circuit, j] * state[first + eq.patches[circuit, j]]
    return voltage


@njit(cache=True)
def displaced_current(eq, state, circuit):
    """Current of the charge that the motion displaces in a circuit, up to a factor."""
    modes, current = eq.stiffness.size, 0.0
    for j in range(eq.circuits[circuit, COUNT]):
        patch = eq.patches[circuit, j]
        one = eq.signs[circuit, j] * np.dot(eq.coupling[patch], state[modes : 2 * modes])
        current += one / eq.capacitance[patch] if eq.circuits[circuit, IS_SERIES] else one
    return current


@njit(cache=True)
def drawn_current(eq, state, circuit, rates, place):
    """Current that a circuit draws from its patches; sets the rates of its two numbers."""
    kind, numbers = eq.circuits[circuit, KIND], eq.circuit_numbers[circuit]
    voltage, held = patch_voltage(eq, state, circuit), state[place]
    if kind == RESISTOR:
        rates[place + 1] = voltage * voltage / numbers[OHM]
        return voltage / numbers[OHM]
    if kind == SERIES_INDUCTOR:
        rates[place], rates[place + 1] = (voltage - numbers[OHM] * held) / numbers[STORAGE], numbers[OHM] * held * held
        return held
    if kind == PARALLEL_INDUCTOR:
        rates[place], rates[place + 1] = voltage / numbers[STORAGE], voltage * voltage / numbers[OHM]
        return held + voltage / numbers[OHM]
    current = 0.0
    if kind in (BRIDGE, PARALLEL_SSHI):
        current = max(0.0, abs(voltage) - held - numbers[DROP]) / numbers[DIODES]
    if np.isfinite(numbers[STORAGE]):
        rates[place] = (current - held / numbers[OHM] - held * numbers[LEAKAGE]) / numbers[STORAGE]
        rates[place + 1] = held * held / numbers[OHM]
    else:
        rates[place + 1] = current * numbers[BATTERY]
    return current if voltage > 0 else -current


@njit(cache=True)
def set_rates(eq, time, state, force, slope, since, closed, rates):
    """Sets the derivative of a state under a force that is linear in time."""
    modes, patches = eq.stiffness.size, eq.capacitance.size
    speed, volts = state[modes : 2 * modes], state[2 * modes : 2 * modes + patches]
    rates[:] = 0.0
    rates[:modes] = speed
    rates[modes : 2 * modes] = force + slope * (time - since) - eq.stiffness * state[:modes] - eq.damping * speed
    for k in range(eq.tones.shape[0]):
        rates[modes : 2 * modes] += eq.forces[k] * np.sin(eq.tones[k, 0] * time + eq.tones[k, 1])
    for e in range(patches):
        rates[modes : 2 * modes] += eq.coupling[e] * volts[e]
        rates[2 * modes + e] = -np.dot(eq.coupling[e], speed) - eq.conductance[e] * volts[e]
    for stop in range(eq.gaps.size):
        depth, rate = approach(eq, state, stop)
        rates[modes : 2 * modes] -= eq.stops[stop] * contact_force(eq.laws[stop], eq.law_numbers[stop], depth, rate, closed[stop])
    for circuit in range(eq.circuits.shape[0]):
        current = drawn_current(eq, state, circuit, rates, 2 * modes + patches + 2 * circuit)
        charge, capacitance = 0.0, 0.0
        for j in range(eq.circuits[circuit, COUNT]):
            patch = eq.patches[circuit, j]
            charge += eq.signs[circuit, j] * rates[2 * modes + patch]
            capacitance += eq.capacitance[patch]
        for j in range(eq.circuits[circuit, COUNT]):
            patch, sign = eq.patches[circuit, j], eq.signs[circuit, j]
            if eq.circuits[circuit, IS_SERIES]:
                rates[2 * modes + patch] -= sign * current
            else:
                rates[2 * modes + patch] = sign * (charge - current) / capacitance * eq.capacitance[patch]
    rates[2 * modes : 2 * modes + patches] /= eq.capacitance


@njit(cache=True)
def pending_event(eq, state, closed, rising):
    """Number of a stop, or of a circuit after the stops, whose event has passed; -1 for none."""
    for stop in range(eq.gaps.size):
        depth, rate = approach(eq, state, stop)
        if eq.laws[stop] == RIGID:
            if depth > 0 and rate > 0:
                return stop
        elif eq.laws[stop] != CUBIC and closed[stop] != (depth > 0):
            return stop
    for circuit in range(eq.circuits.shape[0]):
        if eq.circuits[circuit, KIND] >= PARALLEL_SSHI:
            current = displaced_current(eq, state, circuit)
            if current < 0 if rising[circuit] else current > 0:
                return eq.gaps.size + circuit
    return -1


@njit(cache=True)
def close_switch(eq, state, circuit):
    """Applies the switch of a circuit to a state."""
    modes, patches, count = eq.stiffness.size, eq.capacitance.size, eq.circuits[circuit, COUNT]
    kind, numbers, place = eq.circuits[circuit, KIND], eq.circuit_numbers[circuit], 2 * modes + patches + 2 * circuit
    voltage, held, storage = patch_voltage(eq, state, circuit), state[place], numbers[STORAGE]
    capacitance = 0.0
    for j in range(count):
        one = eq.capacitance[eq.patches[circuit, j]]
        capacitance += 1 / one if eq.circuits[circuit, IS_SERIES] else one
    if eq.circuits[circuit, IS_SERIES]:
        capacitance = 1 / capacitance
    after = voltage
    if kind == PARALLEL_SSHI:
        after = -numbers[INVERSION] * voltage
    elif kind == SERIES_SSHI:
        charge = max(0.0, (1 + numbers[INVERSION]) * (abs(voltage) - held - numbers[DROP]) / (1 / capacitance + 1 / storage))
        after = voltage - np.sign(voltage) * charge / capacitance
        if np.isfinite(storage):
            state[place] += charge / storage
        else:
            state[place + 1] += charge * numbers[BATTERY]
    else:
        arrives, after = numbers[INVERSION] * 0.5 * capacitance * voltage * voltage, 0.0
        if np.isfinite(storage):
            state[place] = np.sqrt(held * held + 2 * arrives / storage)
        else:
            state[place + 1] += arrives
    for j in range(count):
        patch, sign = eq.patches[circuit, j], eq.signs[circuit, j]
        if eq.circuits[circuit, IS_SERIES]:
            state[2 * modes + patch] += sign * (after - voltage) * capacitance / eq.capacitance[patch]
        else:
            state[2 * modes + patch] = sign * after


@njit(cache=True)
def apply_events(eq, state, closed, rising, counts):
    """Applies all events of a state; False where a point sticks to a rigid stop. `counts` holds the fastest impact and the steps."""
    modes = eq.stiffness.size
    while True:
        event = pending_event(eq, state, closed, rising)
        if event < 0:
            return True
        if event >= eq.gaps.size:
            circuit = event - eq.gaps.size
            rising[circuit] = not rising[circuit]
            close_switch(eq, state, circuit)
        elif eq.laws[event] != RIGID:
            closed[event] = not closed[event]
        else:
            row, restitution = eq.stops[event], eq.law_numbers[event, 0]
            _, rate = approach(eq, state, event)
            counts[0] = max(counts[0], rate)
            if rate < 1e-3 * counts[0] or restitution == 0:
                return False
            state[modes : 2 * modes] -= (1 + restitution) * rate / np.dot(row, row) * row


@njit(cache=True)
def take_step(eq, time, length, state, force, slope, since, closed, stages, end, error):
    """Sets the state at the end of a step and its error."""
    for s in range(6):
        for i in range(state.size):
            end[i] = state[i]
            for j in range(s):
                end[i] += length * STAGES[s, j] * stages[j, i]
        set_rates(eq, time + TIMES[s] * length, end, force, slope, since, closed, stages[s])
    for i in range(state.size):
        end[i] = state[i]
        for j in range(6):
            end[i] += length * FIFTH[j] * stages[j, i]
    set_rates(eq, time + length, end, force, slope, since, closed, stages[6])
    for i in range(state.size):
        error[i] = 0.0
        for j in range(7):
            error[i] += length * (FIFTH[j] - FOURTH[j]) * stages[j, i]


@njit(cache=True)
def integrate(eq, since, until, state, force, slope, closed, rising, counts, sizes, tolerance, longest, length, most_steps):
    """Integrates from one time to another; changes the state and its events. Returns the reason of the end, its time and a step length."""
    stages, end, error, time = np.zeros((7, state.size)), np.zeros(state.size), np.zeros(state.size), since
    while True:
        if not apply_events(eq, state, closed, rising, counts):
            return STICKS, time, length
        if time >= until:
            return DONE, time, length
        counts[1] += 1
        if counts[1] > most_steps:
            return TOO_LONG, time, length
        step = min(length, longest)
        lands = time + step >= until
        if lands:
            step = until - time
        take_step(eq, time, step, state, force, slope, since, closed, stages, end, error)
        sizes[:] = np.maximum(sizes, np.abs(end))
        excess = np.max(np.abs(error) / sizes) / tolerance
        if not excess <= 1 and step > 1e-13:
            length = step * max(0.2, 0.9 * excess**-0.2) if np.isfinite(excess) else 0.2 * step
            continue
        length = step * min(4.0, 0.9 * max(excess, 1e-9) ** -0.2)
        if pending_event(eq, end, closed, rising) >= 0:
            low, high = 0.0, 1.0
            while high - low > 1e-15:
                middle = 0.5 * (low + high)
                take_step(eq, time, step * middle, state, force, slope, since, closed, stages, end, error)
                if pending_event(eq, end, closed, rising) >= 0:
                    high = middle
                else:
                    low = middle
            take_step(eq, time, step * high, state, force, slope, since, closed, stages, end, error)
            lands, step = lands and high == 1.0, step * high
        state[:] = end
        time = until if lands else time + step
