//! Harmonic balance, condensed to the ports of the stops.
//!
//! ```text
//! R^a_n = S^a_n + sum_b G^ab_n f^b_n - d^a_n,   f_n = 1/T int F(d - gap, d') e^(-i n w t / p) dt,   |n| <= N
//! ```
//!
//! The unknowns are the harmonics of the displacements of the ports, one after the other; the plant enters by its exact compliance `G`
//! between them alone ([`compliance`]), however many modes it has. `S` holds the drive and, at `n = 0`, the sag under gravity. A force that starts like `t^(3/2)` and lasts a small part of the period must not be sampled at equal times:
//! its samples enter and leave the contact one by one, and every one bends the residual. Here the edges of each contact are roots
//! of the trigonometric polynomial `d` ([`contact`]), and the integral runs between them by a rule that converges fast for every
//! law ([`nodes`]). What is left out are the harmonics above `N`, and `N` grows until the error asked for is met.
//!
//! With `J`, `J'` the slopes of the law at the nodes, `w` their weights and `K(t)` the response to an impulse in these harmonics,
//! Newton's linear system is one for the forces `x` at the nodes of all stops ([`condensed`]), `K` being tabulated for each pair of them
//! ([`compliance_table`]):
//!
//! ```text
//! x_q - J_q sum_p K^ab(t_q - t_p) w_p x_p - J'_q sum_p K'^ab(t_q - t_p) w_p x_p = J_q r_q + J'_q r'_q
//! ```
//!
//! with `q` at stop `a` and `p` at stop `b`.
//!
//! The error estimate comes from outside: the exact flow is marched over a period from the state that the forces give, and the
//! Newton correction of that flow is the distance to the orbit; the mean power marched from there is held against that of the
//! harmonics. It sees truncation and quadrature at once, whatever the law makes of the tail of the spectrum (`n^-2.5` for Hertz,
//! where an estimate that expects geometric decay would be wrong).
//!
//! Limits: rigid stops, diodes, and bodies that nothing brings back, whose compliance at rest is infinite.
//!
//! Validation: `tests/orbits/balance.rs` compares with shooting, `tests/orbits/several.rs` over several stops and under gravity.

mod angles;
mod compliance;
mod compliance_table;
mod condensed;
mod contact;
mod evaluation;
mod impulses;
mod method;
mod motion;
mod nodes;
mod quadrature;

pub use evaluation::BalanceEvaluation;
pub use method::HarmonicBalance;
