//! Studies: many runs of one spec.
