"""Runs jounce and its peers on one model and compares their times at equal errors."""
