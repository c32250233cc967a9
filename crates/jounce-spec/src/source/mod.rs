//! Text of a spec as a tree of values with their places.

mod lines;
mod node;
mod syntax;

pub(super) use lines::Lines;
pub(super) use node::{Entry, Node, SourcePlace, Value, value_of};
pub(super) use syntax::{Source, parse};
