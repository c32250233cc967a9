//! Derivative of the flow.

mod conduction_states;
mod jacobian;
