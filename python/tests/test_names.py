"""Calls have the options of the questions, under the same names."""

import inspect
import json

import pytest

import jounce
from jounce import _core

#: Options that Python splits into a key and its values.
SPLIT = {"over": {"key", "range"}, "against": {"key_2", "range_2"}}
QUESTIONS = json.loads(_core.questions())


def call(name):
    """Returns the call of a name like ``Spec.run``."""
    found = jounce
    for part in name.split("."):
        found = getattr(found, part)
    return found


@pytest.mark.parametrize("question", QUESTIONS, ids=[question["python"] for question in QUESTIONS])
def test_calls_have_the_options_of_the_questions(question):
    keywords = set(inspect.signature(call(question["python"])).parameters)
    missing = []
    for option in question["options"]:
        name = option["argument"].removeprefix("no-").replace("-", "_")
        if not (SPLIT.get(name, {name}) <= keywords or option["name"] in keywords):
            missing.append(name)
    assert missing == []
