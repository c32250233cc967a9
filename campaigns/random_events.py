"""Random harvesters with many events: circuits with switches, impulses, recordings and several drives at once."""

from functools import partial

from random_spec import decades
from random_spec import spec as random_spec


def spec(draw, folder):
    """Returns a spec; its recordings are written to a folder."""
    return random_spec(draw, circuit, partial(drives, folder=folder), settings)


def circuit(draw, index, names):
    """Returns the circuit of patches."""
    if len(names) == 1:
        text = f'[circuit.c{index}]\npatch = "{names[0]}"\n'
    else:
        pair = f'"{names[0]}", "{draw.choice(("-", "-", ""))}{names[1]}"'
        text = f'[circuit.c{index}]\npatches = [{pair}]\nwiring = "{draw.choice(("series", "parallel"))}"\n'
    resistance = f'resistance = "{decades(draw, 1e3, 1e7)} ohm"\n'
    kind = draw.choice(("resistor", "inductor", "bridge", "parallel-sshi", "series-sshi", "sece"))
    if kind == "resistor":
        return text + resistance
    if kind == "inductor":
        return f'{text}{resistance}inductance = "{decades(draw, 1, 1e4)} H"\ninductor = "{draw.choice(("series", "parallel"))}"\n'
    text += f'interface = "{kind}"\n'
    if draw.random() < 0.7:
        text += f'storage = "{decades(draw, 1e-3, 10)} uF"\n{resistance}'
        if draw.random() < 0.3:
            text += f'leakage_resistance = "{decades(draw, 1e4, 1e8)} ohm"\n'
    else:
        text += f'battery = "{decades(draw, 1e-2, 10)} V"\n'
    if kind == "sece":
        return f"{text}efficiency = {draw.choice((0.5, 0.9, 1))}\n"
    text += f'diode_drop = "{draw.choice((0, 0, 0.01, 0.2))} V"\n'
    if kind != "series-sshi":
        text += f'diode_resistance = "{decades(draw, 1e2, 1e5)} ohm"\n'
    return text if kind == "bridge" else f"{text}quality_factor = {draw.choice((0.5, 1, 5, 20))}\n"


def drives(draw, points, folder):
    """Returns one to three drives."""
    return "\n".join(drive(draw, points, folder, number) for number in range(draw.choice((1, 1, 2, 3))))


def drive(draw, points, folder, number):
    """Returns a sinusoid, a step of velocity or a recording."""
    kinds = (("force", "N", 1e-2, 50), ("base-acceleration", "m/s^2", 0.1, 30), ("base-displacement", "mm", 1e-3, 1))
    kind, unit, low, high = draw.choice(kinds)
    signal = draw.choice(("sine", "sine", "velocity-step", "recording"))
    if signal == "velocity-step":
        kind, unit = "base-acceleration", "m/s^2"
    elif signal == "recording" and kind == "base-displacement":
        signal = "sine"
    text = f'[drive.d{number}]\nkind = "{kind}"\nsignal = "{signal}"\n'
    if kind == "force":
        text += f'at = "{draw.choice(points)}"\n'
    if signal == "velocity-step":
        velocity = draw.choice((-1, 1)) * float(decades(draw, 1e-3, 1))
        return f'{text}velocity = "{velocity} m/s"\nstart = "{draw.choice((0, draw.uniform(0, 0.1))):.5g} s"\n'
    if signal == "sine":
        text += f'amplitude = "{decades(draw, low, high)} {unit}"\nfrequency = "{decades(draw, 5, 200)} Hz"\n'
        return text if draw.random() < 0.5 else f'{text}phase = "{draw.uniform(-3, 3):.3g} rad"\n'
    step_s, amplitude = draw.choice((1e-3, 1 / 1024, 5e-3)), float(decades(draw, low, high))
    rows = [f"{step_s * k!r},{amplitude * draw.uniform(-1, 1)!r}\n" for k in range(draw.choice((5, 40, 300)))]
    (folder / f"recording{number}.csv").write_text(f"time [s],x [{unit}]\n{''.join(rows)}", encoding="utf-8")
    start_s = draw.choice((0, draw.uniform(0, 0.05)))
    return f'{text}file = "recording{number}.csv"\nmean = "kept"\nstart = "{start_s:.5g} s"\n'


def settings(draw):
    """Returns damping, reduction and run."""
    return (
        f"[damping]\nbeyond = {draw.choice((0.0005, 0.005, 0.02, 0.1))}\n[reduction]\nmodes = {draw.choice((1, 2, 3, 5))}\n"
        '[run]\nduration = "0.2 s"\naverage_over = "0.2 s"\ntolerance = 1e-9\n'
    )
