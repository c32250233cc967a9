"""Random harvesters as spec files."""

MATERIALS = ("steel", "aluminium", "brass", "bronze", "silicon")
CERAMICS = ("PZT-5A", "PZT-5H", "MFC-P2", "PVDF")


def decades(draw, low, high):
    """Returns a logarithmically uniform number with four digits."""
    return f"{low * (high / low) ** draw.random():.4g}"


def table(draw):
    """Returns a shaker table."""
    return (
        f'[mass.table]\nmass = "{decades(draw, 1e-3, 3)} kg"\nfrequency = "{decades(draw, 0.5, 60)} Hz"\n'
        f"damping_ratio = {draw.choice((0.001, 0.01, 0.05, 0.1, 0.3, 1.7))}\n"
    )


def beam(draw, name, root, patches):
    """Returns a beam with its patches and masses; adds the patches of each circuit to `patches`."""
    length_mm, width_mm, thickness_mm = float(decades(draw, 60, 350)), float(decades(draw, 5, 40)), float(decades(draw, 0.15, 3))
    text = [
        f'[beam.{name}]\nmaterial = "{draw.choice(MATERIALS)}"\nlength = "{length_mm} mm"\nwidth = "{width_mm} mm"\n'
        f'thickness = "{thickness_mm} mm"\nroot = "{root}"\n'
    ]
    if draw.random() < 0.2:
        text.append(f'root_stiffness = "{decades(draw, 1, 1000)} N m/rad"\n')
    text.append(f'[beam.{name}.point]\np = "{draw.uniform(0.1, 0.95) * length_mm:.4g} mm"\n')
    start_mm = draw.uniform(0.02, 0.5) * length_mm
    reach_mm = draw.uniform(0.05, 0.95) * (length_mm - start_mm)
    ceramic, faces = draw.choice(CERAMICS), ("top", "bottom")[: draw.choice((1, 2))]
    for face in faces:
        text.append(
            f'[patch.{name}_{face}]\non = "{name}"\nface = "{face}"\nmaterial = "{ceramic}"\nstart = "{start_mm:.4g} mm"\n'
            f'length = "{reach_mm:.4g} mm"\nwidth = "{draw.uniform(0.2, 1) * width_mm:.4g} mm"\nthickness = "{decades(draw, 0.03, 1)} mm"\n'
        )
        if draw.random() < 0.1:
            text.append(f'leakage_resistance = "{decades(draw, 1e4, 1e8)} ohm"\n')
    patches.append([f"{name}_{face}" for face in faces])
    if draw.random() < 0.5:
        inertia = f'rotary_inertia = "{decades(draw, 1, 2000)} g mm^2"\n' if draw.random() < 0.4 else ""
        text.append(f'[mass.tip_{name}]\non = "{name}.end"\nmass = "{decades(draw, 0.01, 50)} g"\n{inertia}')
    return "".join(text)


def circuit(draw, index, names):
    """Returns the circuit of patches."""
    if len(names) == 1:
        patch = f'patch = "{names[0]}"\n'
    else:
        patch = f'patches = ["{names[0]}", "-{names[1]}"]\nwiring = "{draw.choice(("series", "parallel"))}"\n'
    resistance = f'resistance = "{decades(draw, 1e2, 1e7)} ohm"\n'
    kind = draw.choice(("resistor", "resistor", "resistor", "resistor", "inductor", "bridge", "battery", "sshi"))
    diode = f'diode_drop = "{draw.choice((0, 0.2, 0.6))} V"\n'
    more = {
        "resistor": resistance,
        "inductor": resistance + f'inductance = "{decades(draw, 0.1, 1e4)} H"\ninductor = "{draw.choice(("series", "parallel"))}"\n',
        "bridge": f'interface = "bridge"\nstorage = "{decades(draw, 0.01, 100)} uF"\n{resistance}{diode}',
        "battery": f'interface = "bridge"\nbattery = "{decades(draw, 0.1, 10)} V"\n{diode}',
        "sshi": f'interface = "{draw.choice(("parallel-sshi", "series-sshi"))}"\nbattery = "{decades(draw, 0.1, 10)} V"\n{diode}'
        f"quality_factor = {draw.choice((1, 5, 20))}\n",
    }
    return f"[circuit.c{index}]\n{patch}{more[kind]}"


def stop(draw, index, points):
    """Returns a stop between two points."""
    at = draw.choice(points)
    frames = ["ground"] + [point for point in points if point != at]
    kind = draw.choice(("hertz", "hertz", "spring", "kelvin-voigt", "hunt-crossley", "cubic", "rigid"))
    gap_mm = draw.choice(("0", decades(draw, 1e-3, 5), decades(draw, 1e-3, 5), decades(draw, 1e-3, 5), "-" + decades(draw, 1e-4, 0.3)))
    exponent = draw.choice((1.2, 1.5, 1.5, 2, 3))
    if kind == "rigid" and gap_mm.startswith("-"):
        gap_mm = gap_mm[1:]
    stiffness = decades(draw, 1e1, 1e10)
    law = {
        "hertz": f'exponent = {exponent}\nstiffness = "{stiffness} N/m^{exponent}"\n',
        "spring": f'stiffness = "{stiffness} N/m"\n',
        "kelvin-voigt": f'stiffness = "{stiffness} N/m"\ndamping = "{decades(draw, 1e-3, 1e3)} N s/m"\n',
        "hunt-crossley": f'exponent = {exponent}\nstiffness = "{stiffness} N/m^{exponent}"\ndamping = "{decades(draw, 1e-2, 100)} s/m"\n',
        "cubic": f'stiffness = "{draw.choice(("0", decades(draw, 1, 1e4)))} N/m"\ncubic_stiffness = "{decades(draw, 1e3, 1e11)} N/m^3"\n',
        "rigid": f"restitution = {draw.choice((0, 0.3, 0.5, 0.8, 0.95, 1))}\n",
    }
    side = draw.choice(("positive", "negative"))
    place = f'[stop.s{index}]\nat = "{at}"\nframe = "{draw.choice(frames)}"\nside = "{side}"\n'
    return f'{place}law = "{kind}"\ngap = "{gap_mm} mm"\n{law[kind]}'


def drive(draw, points):
    """Returns the drive."""
    kind, unit, low, high = draw.choice(
        (("force", "N", 1e-2, 50), ("base-acceleration", "m/s^2", 0.1, 30), ("base-displacement", "mm", 1e-3, 1))
    )
    at = f'at = "{draw.choice(points)}"\n' if kind == "force" else ""
    signals = ("sine", "sine", "sine", "chirp", "half-sine") + (() if kind == "base-displacement" else ("noise",))
    signal, amplitude = draw.choice(signals), f'amplitude = "{decades(draw, low, high)} {unit}"\n'
    more = {
        "sine": f'{amplitude}frequency = "{decades(draw, 2, 200)} Hz"\n',
        "chirp": f'{amplitude}from = "{decades(draw, 2, 300)} Hz"\nto = "{decades(draw, 2, 300)} Hz"\n'
        f'duration = "{draw.uniform(0.5, 1.5):.3g} s"\n',
        "half-sine": f'{amplitude}duration = "{decades(draw, 1e-3, 0.1)} s"\nstart = "{draw.uniform(0, 0.5):.3g} s"\n',
        "noise": f'psd = "{decades(draw, 1e-6, 1e-2)} ({unit})^2/Hz"\nhigh = "{decades(draw, 5, 300)} Hz"\n',
    }
    return f'[drive.d0]\nkind = "{kind}"\nsignal = "{signal}"\n{at}{more[signal]}'


def settings(draw):
    """Returns damping, reduction and run."""
    return (
        f"[damping]\nbeyond = {draw.choice((0.0005, 0.005, 0.02, 0.1))}\n"
        f"[reduction]\nmodes = {draw.choice((1, 2, 3, 5, 8, 12, 20))}\n"
        f'[run]\nduration = "1.5 s"\naverage_over = "{draw.choice((0.5, 1, 1.5))} s"\n'
        f"tolerance = {draw.choice(('1e-3', '1e-5', '1e-7', '1e-7', '1e-9'))}\n"
    )


def spec(draw, circuit=circuit, drive=drive, settings=settings):
    """Returns a spec; `draw` is a `random.Random`. Other functions may draw the circuits, the drives and the settings."""
    parts, points, patches = [], [], []
    has_table = draw.random() < 0.5
    if has_table:
        parts.append(table(draw))
        points.append("table")
    for name in ("a", "b")[: 1 if draw.random() < 0.75 else 2]:
        parts.append(beam(draw, name, "table" if has_table and draw.random() < 0.8 else "ground", patches))
        points += [f"{name}.p", f"{name}.end"]
    if draw.random() < 0.15:
        parts.append(f'[mass.ball]\non = "nothing"\nmass = "{decades(draw, 1e-5, 1e-2)} kg"\nvelocity = "{draw.uniform(-1, 1):.3g} m/s"\n')
        points.append("ball")
    parts += [circuit(draw, index, patch) for index, patch in enumerate(patches)]
    parts += [stop(draw, index, points) for index in range(draw.choice((0, 1, 1, 1, 2, 2, 3, 4)))]
    if draw.random() < 0.35:
        parts.append('[gravity]\nacceleration = "-9.81 m/s^2"\n')
    parts += [drive(draw, points), settings(draw)]
    return "\n".join(parts)
