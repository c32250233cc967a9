//! Harmonic balance, condensed to the port.
//!
//! ```text
//! R_n = S_n + G_n f_n - d_n,   f_n = 1/T int F(d - gap, d') e^(-i n w t / p) dt,   |n| <= N
//! ```
//!
//! The unknowns are the harmonics of the displacement of the port; the plant enters by its exact compliance `G` alone, however
//! many modes it has. A force that starts like `t^(3/2)` and lasts a small part of the period must not be sampled at equal times:
//! its samples enter and leave the contact one by one, and every one bends the residual. Here the edges of each contact are roots
//! of the trigonometric polynomial `d` ([`contact`]), and the integral runs between them by a rule that converges fast for every
//! law ([`nodes`]). What is left out are the harmonics above `N`, and `N` grows until the error asked for is met.
//!
//! With `J`, `J'` the slopes of the law at the nodes, `w` their weights and `K(t)` the response to an impulse in these harmonics,
//! Newton's linear system is one for the forces `x` at the nodes ([`condensed`]), `K` being tabulated ([`response`]):
//!
//! ```text
//! x_q - J_q sum_p K(t_q - t_p) w_p x_p - J'_q sum_p K'(t_q - t_p) w_p x_p = J_q r_q + J'_q r'_q
//! ```
//!
//! The error estimate comes from outside: the exact flow is marched over a period from the state that the forces give, and the
//! Newton correction of that flow is the distance to the orbit; the mean power marched from there is held against that of the
//! harmonics. It sees truncation and quadrature at once, whatever the law makes of the tail of the spectrum (`n^-2.5` for Hertz,
//! where an estimate that expects geometric decay would be wrong).
//!
//! Validation: `tests/orbits/balance.rs` compares with shooting.

mod angles;
mod condensed;
mod contact;
mod impulses;
mod method;
mod motion;
mod nodes;
mod place;
mod response;
mod rule;

pub use method::HarmonicBalance;
pub use place::Balance;
