//! The coupled electromechanical system between its ports: linear, in real block-diagonal form,
//! with rows as outputs.
//!
//! This level does not depend on beams: a [`System`] is modes, loads, stops and drives; a [`Plant`]
//! is
//!
//! ```text
//! y' = A y + sum_ports b_p f_p(t),   x(t) = T y(t) + Re(X e^{i w t}),   x = (q, q', V, i)
//! ```
//!
//! with `A` made of 2 x 2 and 1 x 1 blocks, `y` the part of the state that the sinusoidal drives do
//! not force, and `X` the steady state under these drives without contact. Between contacts the
//! flow of `y` is therefore known exactly. Other drives are [`Signal`]s, linear in time between
//! breakpoints, whose response is also exact ([`Forcing`]).

mod base_motion;
mod block_diagonal;
mod bridge;
mod component;
mod conduction_path;
mod coupled_plant;
mod diagonal;
mod eigen_refinement;
mod electrical;
mod energy;
mod error;
mod event_function;
mod forcing;
mod leak;
mod lyapunov;
mod quadratic;
mod signal;
mod signal_meter;
mod stiff;
mod system;
mod tone;
mod wiring;

pub use block_diagonal::{BlockDiagonal, BlockPair};
pub use bridge::{Bridge, BridgeState, Conduction, Scheme, Storage};
pub use coupled_plant::{Plant, Port};
pub use coupled_plant::{dot, product};
pub use diagonal::Diagonal;
pub use electrical::{Across, BridgeNodes, Conductance, Electrical, ElectricalNode, Inductor};
pub use energy::{EnergyMeter, Meters};
pub use error::PlantError;
pub use event_function::{BridgeChange, EnergyOutlet, EventFunction, PowerOutput};
pub use forcing::{Forcing, LOCAL_TERMS, SignalSample};
pub use leak::Leak;
pub use lyapunov::{LyapunovSide, lyapunov};
pub use quadratic::Quadratics;
pub use signal::Signal;
pub use signal_meter::{SignalIntegrals, SignalMeter};
pub use system::driven;
pub use system::{Connection, Dashpot, Drive, Load, Stop, System};
pub use tone::Tone;
