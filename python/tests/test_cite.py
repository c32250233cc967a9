"""BibTeX of citations, read by another program."""

import json

import pytest
from pybtex.database import parse_string
from pybtex.richtext import Text

import jounce

EXAMPLES = sorted(jounce.examples())


def plain(tex: str) -> str:
    """Returns a text without the notation of TeX, as Unicode."""
    return Text.from_latex(tex.replace("--", "\N{EN DASH}")).render_as("text")


@pytest.mark.parametrize("name", EXAMPLES)
def test_another_program_reads_the_same_citations(name):
    result = jounce.examples()[name].cite()
    entries = parse_string(result.bibtex(), "bibtex").entries
    assert list(entries) == list(result) and len(entries) == len(result.citations)
    assert set(result.citations[1].reasons) and result.citations[0].key == "jounce"
    for key, citation in result.items():
        fields = entries[key].fields
        assert plain(fields["title"]) == citation.title
        container = fields.get("journal", fields.get("booktitle", ""))
        assert plain(container) == citation.container
        assert fields.get("year") == (None if citation.year is None else str(citation.year))
        assert fields.get("doi", "") == citation.doi and plain(fields.get("pages", "")) == citation.pages
        authors = [plain(str(person)) for person in entries[key].persons.get("author", [])]
        assert authors == citation.authors


def test_the_source_of_a_spec_is_cited_and_an_unknown_one_is_refused(harvester):
    harvester["source"] = jounce.Source(publications=["hunt-crossley-1975"])
    assert harvester.cite()["hunt-crossley-1975"].reasons == ["source of this harvester"]
    assert harvester.cite().manifest["options"] == {"command": "cite"}
    with pytest.raises(jounce.SpecError, match="did you mean `hertz-1881`"):
        harvester["source.publications"] = ["hertz-1882"]
    assert json.dumps(harvester.cite().bibtex()).isascii()
