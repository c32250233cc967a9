"""Runs jounce beside its peers on one model and sets their times against their errors."""
