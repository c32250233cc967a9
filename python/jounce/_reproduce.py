"""Reproduction of the 2019 paper."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from . import _core
from ._arguments import check_integers, options
from ._fields import About, Variable
from ._format import html_table
from ._progress import Progress, progress_callback
from ._result import Result, make_manifest, result_or_raise

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class ReproduceResult(Result):
    """Claims of the paper with a verdict on each, and the files of the report."""

    report: Annotated[Path, About("report, one HTML file")]
    tables: Annotated[list[Path], About("tables, CSV with a manifest and JSON")]
    figures: Annotated[list[Path], About("figures, SVG, PNG and PDF")]
    claim: Annotated[list[str], About("claims of the paper")]
    holds: Annotated[list[bool], About("True where the claim holds")]
    evidence: Annotated[list[str], About("numbers of the evidence of each claim")]

    def __len__(self) -> int:
        return len(self.claim)

    def _summary(self) -> list[tuple[str, str]]:
        verdicts = [("holds" if holds else "does NOT hold", claim) for claim, holds in zip(self.claim, self.holds)]
        return [("report", str(self.report)), ("files", f"{len(self.tables)} tables, {len(self.figures)} figures"), *verdicts]

    def _repr_html_(self) -> str:
        rows = [[claim, "yes" if holds else "no", evidence] for claim, holds, evidence in zip(self.claim, self.holds, self.evidence)]
        return html_table("Claims of the paper", ["claim", "holds", "evidence"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``claim``."""
        holds = Variable(("claim",), self.holds, "1", "the claim holds")
        evidence = Variable(("claim",), self.evidence, "", "numbers of the evidence")
        return self._dataset({"holds": holds, "evidence": evidence}, {"claim": Variable(("claim",), self.claim, "", "claim of the paper")})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each claim."""
        return self._frame({"claim": self.claim, "holds": self.holds, "evidence": self.evidence})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        from ._plot.reproduce import plot_figure

        pngs = (path for path in self.figures if path.suffix == ".png")
        return {"claims": self.plot_claims, **{path.stem: partial(plot_figure, path) for path in pngs}}

    def plot_claims(self, ax: Axes | None = None) -> Axes:
        """Draws a dot for each claim at its verdict; the quantities besides ``claims`` are the figures of the report."""
        from ._plot.reproduce import plot_claims

        return plot_claims(self, ax)


def reproduce(
    out: str | PathLike[str] = "report", *, threads: int | None = None, progress: bool | Progress | None = None
) -> ReproduceResult:
    """Computes the tables, figures and claims of the 2019 impact-harvester paper, ``jounce reproduce``: about ten seconds on two cores.

    ``report.html``, ``tables/`` and ``figures/`` are written into the folder ``out``, which is created if missing. The numbers are bitwise
    equal for any number of threads. ``progress`` reports finished runs and searches; the total increases as they become known.

    References
    ----------
    "Experimental validation of an impact off-resonance energy harvester" (2019).
    """
    check_integers(threads=threads)
    with progress_callback(progress) as callback:
        fields = result_or_raise(_core.reproduce(options(out=fspath(out), threads=threads), callback))
    paths = {"report": Path(fields["report"]), **{name: [Path(path) for path in fields[name]] for name in ("tables", "figures")}}
    return ReproduceResult(manifest=make_manifest("reproduce"), **ReproduceResult._filled({**fields, **paths}))
