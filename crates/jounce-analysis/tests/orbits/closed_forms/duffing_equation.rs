//! Integration of the Duffing equation and its linearisation, with its folds and cusps.

use jounce_linalg::Mat;
use std::f64::consts::TAU;

/// `x'' + 2 zeta w0 x' + w0^2 x + b x^3 = f sin(w t)` over a period, with its linearisation.
pub struct Oracle {
    pub square: f64,
    pub damping: f64,
    pub b: f64,
    pub force: f64,
}

impl Oracle {
    /// `(x, v)` and the four entries of the linearisation.
    fn rate(&self, t: f64, w: f64, y: &[f64; 6]) -> [f64; 6] {
        let [x, v, a, b, c, d] = *y;
        let pull = self.square + 3.0 * self.b * x * x;
        let force =
            self.force * (w * t).sin() - self.damping * v - self.square * x - self.b * x * x * x;
        [
            v,
            force,
            c,
            d,
            -self.damping * c - pull * a,
            -self.damping * d - pull * b,
        ]
    }

    /// Classical fourth-order Runge-Kutta with 4000 steps; its error is 1e-13 for such a motion.
    pub fn period(&self, w: f64, x: f64, v: f64) -> [f64; 6] {
        let (steps, mut y) = (4000, [x, v, 1.0, 0.0, 0.0, 1.0]);
        let h = TAU / w / f64::from(steps);
        for k in 0..steps {
            let t = h * f64::from(k);
            let add =
                |by: f64, r: &[f64; 6]| -> [f64; 6] { std::array::from_fn(|i| y[i] + by * r[i]) };
            let k1 = self.rate(t, w, &y);
            let k2 = self.rate(t + 0.5 * h, w, &add(0.5 * h, &k1));
            let k3 = self.rate(t + 0.5 * h, w, &add(0.5 * h, &k2));
            let k4 = self.rate(t + h, w, &add(h, &k3));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        }
        y
    }

    /// Zero at a fold: the orbit closes, and one of its multipliers is 1.
    fn fold(&self, [x, v, w]: [f64; 3]) -> [f64; 3] {
        let y = self.period(w, x, v);
        [
            y[0] - x,
            y[1] - v,
            (y[2] - 1.0) * (y[5] - 1.0) - y[3] * y[4],
        ]
    }

    /// Newton's method with differences.
    pub fn nearest_fold(&self, mut at: [f64; 3]) -> [f64; 3] {
        for _ in 0..6 {
            let value = self.fold(at);
            let columns: [[f64; 3]; 3] = std::array::from_fn(|j| {
                let shifted = |by: f64| {
                    self.fold(std::array::from_fn(|i| {
                        at[i] + if i == j { by } else { 0.0 }
                    }))
                };
                let (up, down) = (shifted(1e-6), shifted(-1e-6));
                std::array::from_fn(|i| (up[i] - down[i]) / 2e-6)
            });
            let det = |c: &[[f64; 3]; 3]| {
                c[0][0] * (c[1][1] * c[2][2] - c[2][1] * c[1][2])
                    - c[1][0] * (c[0][1] * c[2][2] - c[2][1] * c[0][2])
                    + c[2][0] * (c[0][1] * c[1][2] - c[1][1] * c[0][2])
            };
            let all = det(&columns);
            at = std::array::from_fn(|j| {
                let mut replaced = columns;
                replaced[j] = value;
                at[j] - det(&replaced) / all
            });
        }
        at
    }
}

/// Zero at a cusp of the folds at `(x, v, w, f)`: in addition, the multiplier remains 1 along its
/// eigenvector.
fn cusp(square: f64, damping: f64, b: f64, [x, v, w, force]: [f64; 4]) -> [f64; 4] {
    let oracle = Oracle {
        square,
        damping,
        b,
        force,
    };
    let y = oracle.period(w, x, v);
    let length = y[4].hypot(y[2] - 1.0);
    let along = [-y[4] / length, (y[2] - 1.0) / length];
    let [closed, rest, fold] = oracle.fold([x, v, w]);
    let shifted = |step: f64| oracle.fold([x + step * along[0], v + step * along[1], w])[2];
    [closed, rest, fold, (shifted(1e-3) - shifted(-1e-3)) / 2e-3]
}

/// Newton's method with differences.
pub fn nearest_cusp(square: f64, damping: f64, b: f64, mut at: [f64; 4]) -> [f64; 4] {
    for _ in 0..8 {
        let value = cusp(square, damping, b, at);
        let shifted = |j: usize, by: f64| {
            cusp(
                square,
                damping,
                b,
                std::array::from_fn(|i| at[i] + if i == j { by } else { 0.0 }),
            )
        };
        let columns: [[f64; 4]; 4] = std::array::from_fn(|j| {
            let (up, down) = (shifted(j, 1e-5), shifted(j, -1e-5));
            std::array::from_fn(|i| (up[i] - down[i]) / 2e-5)
        });
        let derivative = Mat::from_fn(4, 4, |i, j| columns[j][i]);
        let change = jounce_linalg::solve(&derivative, &Mat::from_fn(4, 1, |i, _| value[i]));
        at = std::array::from_fn(|j| at[j] - change[(j, 0)]);
    }
    at
}
