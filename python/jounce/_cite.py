"""Publications behind a harvester."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Self

from ._fields import About, Variable
from ._named import Named
from ._result import Data, Result

if TYPE_CHECKING:
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False)
class Citation(Data):
    """Publication, or jounce itself, with the reasons to cite it."""

    key: Annotated[str, About("key in BibTeX")]
    kind: Annotated[str, About('``"article"``, ``"book"``, ``"collection"`` or ``"other"``')]
    reasons: Annotated[list[str], About("why the harvester uses it")]
    authors: Annotated[list[str], About('authors, each ``"Family, Given"``, or a name without such parts')]
    title: Annotated[str, About("title")]
    container: Annotated[str, About("journal or collection; empty for others")]
    volume: Annotated[str, About("volume; empty without one")]
    number: Annotated[str, About("issue; empty without one")]
    pages: Annotated[str, About("pages, or the number of the article; empty without")]
    year: Annotated[int | None, About("year; ``None`` for the program")]
    publisher: Annotated[str, About("publisher; empty for an article")]
    doi: Annotated[str, About("DOI; empty where it is not known")]
    url: Annotated[str, About("address; empty for a publication")]
    version: Annotated[str, About("version of the program; empty for a publication")]
    text: Annotated[str, About("the citation in one line")]
    bibtex: Annotated[str, About("the citation as an entry of BibTeX")]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class CiteResult(Result, Named[Citation]):
    """What a publication of results should cite: a mapping of the citations by their keys, jounce itself first."""

    _noun = "citation"

    citations: Annotated[list[Citation], About("citations; jounce itself is the first")]

    @classmethod
    def _from_core_cite(cls, core_result: tuple[str, str]) -> Self:
        fields, manifest = (json.loads(text) for text in core_result)
        return cls(citations=[Citation(**one) for one in fields["citations"]], manifest=manifest)

    def _named(self) -> Mapping[str, Citation]:
        return {one.key: one for one in self.citations}

    def bibtex(self) -> str:
        """Returns all citations as a file of BibTeX."""
        return "\n".join(one.bibtex for one in self.citations)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` of the text, the DOI and the reasons of each ``citation``, by its key."""
        texts = {
            "text": [one.text for one in self.citations],
            "doi": [one.doi for one in self.citations],
            "reasons": ["; ".join(one.reasons) for one in self.citations],
        }
        variables = {name: Variable(("citation",), values, "", name) for name, values in texts.items()}
        return self._dataset(variables, {"citation": Variable(("citation",), list(self), "", "key")})

    def _summary(self) -> list[tuple[str, str]]:
        return [(one.key, one.text) for one in self.citations]
