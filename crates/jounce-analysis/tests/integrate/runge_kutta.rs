//! The classical method of Runge and Kutta, which shares no code with the library.

/// Integrates `x' = rates(t, x)` from time 0 in equal steps.
pub fn runge_kutta<const N: usize>(
    rates: impl Fn(f64, [f64; N]) -> [f64; N],
    mut x: [f64; N],
    end_s: f64,
    steps: u32,
) -> [f64; N] {
    let h = end_s / f64::from(steps);
    let add =
        |x: [f64; N], k: [f64; N], f: f64| -> [f64; N] { std::array::from_fn(|i| x[i] + f * k[i]) };
    for k in 0..steps {
        let t = f64::from(k) * h;
        let a = rates(t, x);
        let b = rates(t + 0.5 * h, add(x, a, 0.5 * h));
        let c = rates(t + 0.5 * h, add(x, b, 0.5 * h));
        let d = rates(t + h, add(x, c, h));
        x = std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    x
}
