//! Harmonic balance, condensed to the ports of the stops.
//!
//! ```text
//! R^a_n = S^a_n + sum_b G^ab_n f^b_n - d^a_n,   f_n = 1/T int F(d - gap, d') e^(-i n w t / p) dt,   |n| <= N
//! ```
//!
//! The unknowns are the harmonics of the displacements of the ports, one after the other. The plant
//! enters only by its exact compliance `G` between the ports ([`compliance`]), whatever the number
//! of modes. `S` holds the drive and, at `n = 0`, the static deflection under gravity. A force that
//! starts like `t^(3/2)` and lasts a small fraction of the period must not be sampled at equal
//! times: each sample that enters or leaves the contact bends the residual. Here the edges of each
//! contact are roots of the trigonometric polynomial `d` ([`contact`]), and the integral between
//! them uses a quadrature that converges fast for every law ([`nodes`]). The harmonics above `N`
//! are omitted, and `N` grows until the requested error is met.
//!
//! `J`, `J'` are the slopes of the law at the nodes, `w` their weights and `K(t)` the response to
//! an impulse in these harmonics. Newton's linear system then has as unknowns the forces `x` at the
//! nodes of all stops ([`condensed`]), with `K` tabulated for each pair of stops
//! ([`compliance_table`]):
//!
//! ```text
//! x_q - J_q sum_p K^ab(t_q - t_p) w_p x_p - J'_q sum_p K'^ab(t_q - t_p) w_p x_p = J_q r_q + J'_q r'_q
//! ```
//!
//! with `q` at stop `a` and `p` at stop `b`.
//!
//! The error estimate is independent: the exact flow is integrated over a period from the state
//! that the forces give. The Newton correction of that flow is the distance to the orbit, and the
//! mean power integrated there is compared with the mean power of the harmonics. The estimate
//! includes truncation and quadrature, whatever the decay of the spectrum (`n^-2.5` for Hertz,
//! where an estimate that expects geometric decay would be wrong).
//!
//! Limits: rigid stops, diodes, and free bodies, whose compliance at frequency zero is infinite.
//!
//! Validation: `crates/jounce-analysis/tests/orbits/balance` compares with shooting, also
//! for several stops and under gravity.

mod angles;
mod compliance;
mod compliance_table;
mod condensed;
mod contact;
mod evaluation;
mod fourier_grid;
mod impulses;
mod method;
mod motion;
mod nodes;
mod quadrature;
mod transfer_function;

pub use evaluation::BalanceEvaluation;
pub use method::HarmonicBalance;
