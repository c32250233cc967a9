"""Tests of the benches; they need only Python."""
