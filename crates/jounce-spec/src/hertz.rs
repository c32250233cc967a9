//! Hertz's theory: stiffness of the contact of two smooth elastic bodies.
//!
//! Near the point of first touch the gap between the bodies is `A x^2 + B y^2`, `A <= B`. The
//! contact is an ellipse of semi-axes `a >= b`, and the force over the approach `delta` is
//!
//! ```text
//! F = k delta^(3/2),    k = (2 pi E* / 3) K^(-3/2) sqrt(D / A),    D = (K - E) / m
//! B / A = (K - D) / ((1 - m) D),    m = 1 - (b/a)^2,    1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
//! ```
//!
//! with the complete elliptic integrals `K(m)` and `E(m)`. For a circle, `A = B = 1/(2 R)`, this is
//! `k = (4/3) E* sqrt(R)`.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), equations (4.3), (4.26), (4.28); an
//! elastic half-space stands for each body, so the ellipse must be small compared with the radii
//! and thicknesses. Validation: the tests below, against the circle in closed form (1e-14), the
//! tables of bearing practice (4e-4) and the displacement of the pressure by quadrature.

use std::f64::consts::{FRAC_PI_2, TAU};

/// Exponent of Hertz's law for two smooth bodies.
pub const HERTZ_EXPONENT: f64 = 1.5;

/// Smallest `b/a` of the ellipse of contact that is resolved.
const MIN_AXIS_RATIO: f64 = 1e-8;
/// Halvings of the bracket of `ln (b/a)^2`, to roundoff.
const BISECTIONS: usize = 64;
/// Steps of the arithmetic-geometric mean; it converges quadratically.
const MAX_MEAN_STEPS: usize = 12;

/// Effective modulus `E*` of two bodies, Pa: `1/E* = sum (1 - nu^2)/E`. Each body is `(E, nu)`: Pa,
/// dimensionless.
pub fn effective_modulus_pa(bodies: [(f64, f64); 2]) -> f64 {
    let [one, other] = bodies.map(|(modulus_pa, ratio)| (1.0 - ratio * ratio) / modulus_pa);
    (one + other).recip()
}

/// Returns `[A, B]`, 1/m, `A <= B`: half the relative principal curvatures of two bodies whose
/// principal curvatures (1/m, positive for a convex body) have an angle (rad) between their first
/// planes. Source: Johnson (1985), equation (4.3).
pub fn relative_curvatures_per_m(one: [f64; 2], other: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let sum = one[0] + one[1] + other[0] + other[1];
    let (first, second) = (one[0] - one[1], other[0] - other[1]);
    // (first - second)^2 + 4 first second cos^2 is free of cancellation for crossed planes.
    let along = first + second * (2.0 * angle_rad).cos();
    let across = second * (2.0 * angle_rad).sin();
    let difference = along.hypot(across);
    [0.25 * (sum - difference), 0.25 * (sum + difference)]
}

/// Returns the contact stiffness, N/m^1.5, of bodies with the effective modulus `E*` (Pa) and the
/// curvatures `[A, B]` (1/m), `0 < A <= B`; NaN for other curvatures.
pub fn stiffness(modulus_pa: f64, curvatures_per_m: [f64; 2]) -> f64 {
    let [least, most] = curvatures_per_m;
    if !(least > 0.0 && most >= least) {
        return f64::NAN;
    }
    let integrals = EllipticIntegrals::of(axis_ratio(most / least));
    TAU / 3.0 * modulus_pa * (integrals.d / least).sqrt() / integrals.k.powf(1.5)
}

/// Returns `b/a` of the ellipse for `B/A >= 1`, by bisection.
fn axis_ratio(curvature_ratio: f64) -> f64 {
    let (mut low, mut high) = (MIN_AXIS_RATIO.ln(), 0.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let ratio = f64::exp(middle);
        let integrals = EllipticIntegrals::of(ratio);
        let too_slender =
            (integrals.k - integrals.d) / (ratio * ratio * integrals.d) > curvature_ratio;
        if too_slender {
            low = middle;
        } else {
            high = middle;
        }
    }
    high.exp()
}

/// Complete elliptic integrals `K` and `D = (K - E) / m`.
struct EllipticIntegrals {
    k: f64,
    d: f64,
}

impl EllipticIntegrals {
    /// Computes the integrals for `sqrt(1 - m)` by the arithmetic-geometric mean:
    /// `K = pi / (2 M)`, `D = K sum 2^(n-1) q_n`, `q_n = c_n^2 / m`. Source: Abramowitz and
    /// Stegun, 17.6, with `c_(n+1) = c_n^2 / (4 a_(n+1))`, which is free of cancellation.
    fn of(complement: f64) -> Self {
        let parameter = (1.0 - complement) * (1.0 + complement);
        let (mut mean, mut geometric) = (1.0_f64, complement);
        let (mut sum, mut weight, mut share) = (0.0, 0.5, 1.0);
        for _ in 0..MAX_MEAN_STEPS {
            sum += weight * share;
            weight *= 2.0;
            (mean, geometric) = (0.5 * (mean + geometric), (mean * geometric).sqrt());
            share *= share * parameter / (16.0 * mean * mean);
        }
        let k = FRAC_PI_2 / mean;
        Self { k, d: k * sum }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn assert_close(value: f64, exact: f64, allowed: f64) {
        let error = (value / exact - 1.0).abs();
        assert!(error < allowed, "{value:e} {exact:e}: {error:e}");
    }

    #[test]
    fn a_circle_has_the_closed_form() {
        for (modulus_pa, radius_m) in [(110e9, 5e-3), (1e6, 0.2)] {
            let curvature_per_m = 0.5 / radius_m;
            let exact = 4.0 / 3.0 * modulus_pa * f64::sqrt(radius_m);
            assert_close(stiffness(modulus_pa, [curvature_per_m; 2]), exact, 1e-14);
            let nearly = [curvature_per_m, curvature_per_m * (1.0 + 1e-9)];
            assert_close(stiffness(modulus_pa, nearly), exact, 1e-9);
        }
    }

    /// Table 6.1 of T. A. Harris, *Rolling Bearing Analysis*: `F(rho) = (B - A)/(B + A)` and
    /// `delta*`, the approach relative to `(3 Q / (2 E* sum rho))^(2/3) sum rho / 2`, four digits.
    #[test]
    fn an_ellipse_has_the_approach_of_the_bearing_tables() {
        for (difference, approach) in [
            (0.0, 1.0),
            (0.1075, 0.9974),
            (0.3204, 0.9761),
            (0.4795, 0.9429),
            (0.5916, 0.9077),
            (0.6716, 0.8733),
            (0.7332, 0.8394),
            (0.7948, 0.7961),
            (0.83495, 0.7602),
        ] {
            let k = stiffness(1.0, [1.0 - difference, 1.0 + difference].map(|x| 0.25 * x));
            let computed = (2.0 / 3.0 * f64::powf(2.0, 1.5) / k).powf(2.0 / 3.0);
            assert_close(computed, approach, 4e-4);
        }
    }

    /// Another program: mpmath with 30 digits; `E* = 1`, `A = 1/2`.
    #[test]
    fn slender_ellipses_are_those_of_a_second_program() {
        for (ratio, exact) in [
            (1.5, 1.208_926_841_327_13),
            (3.0, 1.038_490_664_414_7),
            (10.0, 0.831_545_553_074_336),
            (100.0, 0.605_073_092_589_95),
        ] {
            assert_close(stiffness(1.0, [0.5, 0.5 * ratio]), exact, 1e-13);
        }
    }

    /// Displacement of an elastic half-space under `p0 sqrt(1 - (x/a)^2 - (y/b)^2)` at a point of
    /// the ellipse: `u = 1/(pi E*) integral p / r`. The integral along a chord has a closed form,
    /// and the trapezoidal rule over the angle converges exponentially. Measured: 2e-13.
    #[test]
    fn the_pressure_of_an_ellipse_displaces_the_surface_by_the_approach() {
        let displacement = |[a, b]: [f64; 2], [x, y]: [f64; 2]| {
            let rays = 4000;
            let chord = |index: i32| {
                let (s, c) = (PI * f64::from(index) / f64::from(rays)).sin_cos();
                let gamma = (c / a).powi(2) + (s / b).powi(2);
                let beta = x * c / (a * a) + y * s / (b * b);
                let alpha = 1.0 - (x / a).powi(2) - (y / b).powi(2);
                PI / (2.0 * gamma.sqrt()) * (alpha + beta * beta / gamma)
            };
            (0..rays).map(chord).sum::<f64>() / f64::from(rays)
        };
        for b in [1.0, 0.6, 0.1] {
            let axes = [1.0, b];
            let approach = displacement(axes, [0.0, 0.0]);
            let curvatures = [
                (approach - displacement(axes, [0.5, 0.0])) / 0.25,
                (approach - displacement(axes, [0.0, 0.5 * b])) / (0.25 * b * b),
            ];
            let force = 2.0 / 3.0 * PI * b;
            assert_close(
                stiffness(1.0, curvatures),
                force / approach.powf(1.5),
                1e-11,
            );
        }
    }

    #[test]
    fn curvatures_of_crossed_and_parallel_cylinders() {
        let cylinder = [100.0, 0.0];
        let crossed = relative_curvatures_per_m(cylinder, cylinder, 0.5 * PI);
        assert_close(crossed[0], 50.0, 1e-14);
        assert_close(crossed[1], 50.0, 1e-14);
        let parallel = relative_curvatures_per_m(cylinder, cylinder, 0.0);
        assert_eq!(parallel, [0.0, 100.0]);
        assert!(stiffness(1.0, parallel).is_nan());
    }
}
