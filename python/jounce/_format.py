"""Numbers, counts and tables as text."""

from __future__ import annotations

import math
from collections.abc import Sequence


def with_uncertainty(value: float, half_width: float, unit: str = "") -> str:
    """Formats a value with the half width of its interval, both to the second digit of the half width: ``(6.9 +- 4.9)e-6 W``."""
    suffix = f" {unit}" if unit else ""
    largest = max(abs(value), abs(half_width))
    if not (math.isfinite(value) and math.isfinite(half_width) and largest > 0.0):
        return f"{value:g} +- {half_width:g}{suffix}"
    power = _power_of_ten(largest)
    exponent = 0 if -3 <= power <= 5 else power
    digits = max(0, 1 + exponent - _power_of_ten(max(half_width, largest * 1e-12)))
    numbers = f"{value / 10.0**exponent:.{digits}f} +- {half_width / 10.0**exponent:.{digits}f}"
    return f"{numbers}{suffix}" if exponent == 0 else f"({numbers})e{exponent}{suffix}"


def _power_of_ten(value: float) -> int:
    return math.floor(math.log10(abs(value)))


def counted(number: int, noun: str, plural: str = "") -> str:
    """Returns a number with its noun, ``"1 branch"``."""
    return f"{number} {noun if number == 1 else plural or f'{noun}s'}"


def html_table(title: str, header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Returns a table in HTML."""
    import html

    head = "".join(f"<th>{html.escape(cell)}</th>" for cell in header)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows)
    heading = f"<thead><tr>{head}</tr></thead>" if any(header) else ""
    return f"<table><caption><b>{html.escape(title)}</b></caption>{heading}<tbody>{body}</tbody></table>"
