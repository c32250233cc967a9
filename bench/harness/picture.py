"""The work-precision figure: CPU time against the relative error of the mean power, one panel per plant and case."""

from __future__ import annotations

from pathlib import Path

from .measure import Result


def draw(results: dict[str, list[Result]], modes: dict[str, int], paths: list[Path]) -> None:
    """Draws all panels into one figure and saves it under every path."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "jounce"
    import matplotlib.pyplot as plt

    panels = [(plant, case) for plant, found in results.items() for case in dict.fromkeys(r.case for r in found)]
    peers = list(dict.fromkeys(r.peer for found in results.values() for r in found))
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.2 * columns, 3.6 * rows + 0.9), sharex=True, sharey=True, squeeze=False)
    own = {"color": "black", "linewidth": 2.2, "zorder": 5}
    styles = {"jounce": own, "jounce, first run": own | {"linestyle": "--", "linewidth": 1.4}}
    colours = plt.get_cmap("tab20")
    for axis, (plant, case) in zip(axes.flat, panels, strict=False):
        for index, peer in enumerate(peers):
            ladder = [r for r in results[plant] if (r.case, r.peer) == (case, peer) and r.error and r.cpu_s]
            style = styles.get(peer, {"color": colours(index), "linewidth": 1.1})
            axis.plot([r.error for r in ladder], [1e3 * r.median_s for r in ladder], marker="o", markersize=3, label=peer, **style)
        axis.set(xscale="log", yscale="log", title=f"{modes[plant]} modes, {case}")
        axis.grid(True, which="major", linewidth=0.3)
        axis.tick_params(labelbottom=True)
    axes.flat[0].invert_xaxis()
    for axis in axes.flat[len(panels) :]:
        axis.set_visible(False)
    figure.supxlabel("relative error of the mean power")
    figure.supylabel("CPU time of 20 s, ms")
    handles, labels = axes.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, fontsize=8)
    figure.set_layout_engine("constrained")
    for path in paths:
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=160, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)
