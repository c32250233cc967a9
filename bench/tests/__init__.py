"""Tests of the benches themselves; they need nothing but Python."""
