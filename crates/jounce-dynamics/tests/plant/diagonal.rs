//! Diagonal form against the physical matrices, the secular equation and free decay.

use crate::systems::{bench, menagerie};
use jounce_linalg::{Mat, c64};
use jounce_model::plant::{Plant, System};
use jounce_model::reference::{Harmonic, PiezoResistor};

/// `A` on `(q, q', V)`, written from the equations, and the factors from states to square roots of
/// energies.
pub fn physical_matrix(system: &System) -> (Mat<f64>, Vec<f64>) {
    let (modes, n) = (&system.modes, system.modes.len());
    let size = 2 * n + modes.patch.len();
    let mut a = Mat::zeros(size, size);
    let mut scale = vec![1.0; size];
    for i in 0..n {
        let w = modes.frequency_rad_s[i];
        a[(i, n + i)] = 1.0;
        a[(n + i, i)] = -w * w;
        a[(n + i, n + i)] = -2.0 * modes.damping_ratio[i] * w;
        scale[i] = if w > 0.0 { w } else { 1.0 };
    }
    for (k, (name, patch)) in modes.patch.iter().enumerate() {
        let row = 2 * n + k;
        scale[row] = patch.capacitance_f.sqrt();
        for load in system
            .loads
            .iter()
            .filter(|load| load.connections[0].patch == *name)
        {
            a[(row, row)] = -1.0 / (load.resistance_ohm * patch.capacitance_f);
        }
        for i in 0..n {
            a[(n + i, row)] = patch.coupling_n_per_v[i];
            a[(row, n + i)] = -patch.coupling_n_per_v[i] / patch.capacitance_f;
        }
    }
    (a, scale)
}

#[test]
fn blocks_are_the_plant_in_other_coordinates() {
    for (name, system) in [("bench", bench()), ("menagerie", menagerie())] {
        let plant = Plant::new(system.clone()).unwrap();
        let (a, scale) = physical_matrix(&system);
        let (t, inverse) = (&plant.diagonal.to_physical, &plant.diagonal.from_physical);
        let n = plant.len();
        let unit = |j: usize| {
            (0..n)
                .map(|i| f64::from(u8::from(i == j)))
                .collect::<Vec<_>>()
        };
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|j| plant.diagonal.block.apply(&unit(j)))
            .collect();
        let blocks = Mat::from_fn(n, n, |i, j| columns[j][i]);
        let residual = &a * t - t * &blocks;
        let size = Mat::from_fn(n, n, |i, j| scale[i] * a[(i, j)] / scale[j]).amax();
        let worst = (0..n * n)
            .map(|k| (scale[k / n] * residual[(k / n, k % n)]).abs())
            .fold(0.0, f64::max)
            / size;
        let identity = (t * inverse - Mat::<f64>::identity(n, n)).amax();
        eprintln!("{name}: A T - T J {worst:.1e}, T T^-1 - I {identity:.1e}");
        assert!(worst < 1e-13, "{name}: {worst:e}");
        // Without scaling, the identity mixes volts with metres: a factor of the largest ratio of
        // the scales.
        assert!(identity < 1e-8, "{name}: {identity:e}");
    }
}

/// `C l + 1/R + l sum theta^2 / (l^2 + 2 zeta w l + w^2) = 0`: one Newton step must not move an
/// eigenvalue.
#[test]
fn eigenvalues_solve_the_secular_equation() {
    let system = bench();
    let (modes, patch) = (&system.modes, &system.modes.patch["harvester.mfc"]);
    let plant = Plant::new(system.clone()).unwrap();
    for l in plant.diagonal.block.eigenvalues() {
        let mut value = l * patch.capacitance_f + 1.0 / system.loads[0].resistance_ohm;
        let mut slope = c64::new(patch.capacitance_f, 0.0);
        for (i, theta) in patch.coupling_n_per_v.iter().enumerate() {
            let (w, zeta) = (modes.frequency_rad_s[i], modes.damping_ratio[i]);
            let dynamic = l * l + l * (2.0 * zeta * w) + w * w;
            value += l * (theta * theta) / dynamic;
            slope += (c64::new(w * w, 0.0) - l * l) * (theta * theta) / (dynamic * dynamic);
        }
        let newton_step = (value / slope).norm() / l.norm();
        eprintln!("{l:?}: {newton_step:.1e}");
        assert!(newton_step < 1e-12, "{l:?}: {newton_step:e}");
    }
}

/// Free decay of a mode of any damping against the textbook solution.
#[test]
fn free_critical_and_overdamped_modes_flow_exactly() {
    let w: f64 = 25.0;
    for (frequency_rad_s, zeta) in [
        (0.0, 0.0),
        (w, 0.0),
        (w, 0.3),
        (w, 1.0),
        (w, 1.0 + 1e-9),
        (w, 1.7),
        (w, 80.0),
    ] {
        let problem = Harmonic {
            mass_kg: 1.0,
            frequency_rad_s,
            damping_ratio: zeta,
            amplitude_n: 0.0,
            drive_hz: 1.0,
        };
        let mut system = problem.system();
        system.drives.clear();
        let plant = Plant::new(system).unwrap();
        let y = plant.from_physical(&[0.3, -2.0], 0.0);
        for time_s in [1e-3, 0.1, 2.0] {
            let x = plant.to_physical(&plant.diagonal.block.flow(time_s, &y), time_s);
            let exact = decay(frequency_rad_s, zeta, [0.3, -2.0], time_s);
            let error = (x[0] - exact[0]).abs().max((x[1] - exact[1]).abs() / w) / 0.3;
            // Near critical damping the two eigenvectors almost coincide, and digits are lost in
            // their difference.
            let allowed = if zeta > 1.0 && zeta < 1.1 {
                1e-10
            } else {
                1e-12
            };
            assert!(
                error < allowed,
                "w {frequency_rad_s}, zeta {zeta}, t {time_s}: {error:e}"
            );
        }
    }
}

/// A mode at and near critical damping with a weakly coupled patch, whose circuit is two million
/// times faster. The voltage follows the velocity, `V = -R theta q'`, up to a millionth.
#[test]
fn critically_damped_modes_with_a_fast_circuit_flow_exactly() {
    let (w, theta) = (11.2, 1e-6);
    for zeta in [1.0, 1.0 - 1e-12, 1.0 + 1e-9, 1.0 - 1e-7, 0.9999, 1.001] {
        let problem = PiezoResistor {
            mass_kg: 0.02,
            frequency_rad_s: w,
            damping_ratio: zeta,
            coupling_n_per_v: theta,
            capacitance_f: 1.3e-9,
            resistance_ohm: 31.9,
        };
        let plant = Plant::new(problem.system(1.0, 1.0)).unwrap();
        let (t, inverse) = (&plant.diagonal.to_physical, &plant.diagonal.from_physical);
        for time_s in [0.01, 0.1, 0.5] {
            let start = [1e-3, -2e-2, 0.0];
            let y: Vec<f64> = (0..3)
                .map(|i| (0..3).map(|j| inverse[(i, j)] * start[j]).sum())
                .collect();
            let after = plant.diagonal.block.flow(time_s, &y);
            let x: Vec<f64> = (0..3)
                .map(|i| (0..3).map(|j| t[(i, j)] * after[j]).sum())
                .collect();
            let [q, v] = decay(w, zeta, [start[0], start[1]], time_s);
            let voltage = -31.9 * theta / 0.02_f64.sqrt() * v;
            let errors = [
                (x[0] - q) * w / 1e-2,
                (x[1] - v) / 1e-2,
                x[2] / voltage - 1.0,
            ];
            eprintln!("{zeta} {time_s}: {errors:?}");
            assert!(
                errors[0].abs().max(errors[1].abs()) < 1e-9 && errors[2].abs() < 2e-6,
                "{zeta}: {errors:?}"
            );
        }
    }
}

fn decay(w: f64, zeta: f64, [x, v]: [f64; 2], t: f64) -> [f64; 2] {
    if w == 0.0 {
        return [x + v * t, v];
    }
    // cos-like and sin-like solutions of x'' + 2 zeta w x' + w^2 x = 0
    let (c, s) = match zeta {
        z if z < 1.0 => {
            let d = w * (1.0 - z * z).sqrt();
            (
                (d * t).cos() * (-z * w * t).exp(),
                (d * t).sin() / d * (-z * w * t).exp(),
            )
        }
        1.0 => ((-w * t).exp(), t * (-w * t).exp()),
        z => {
            let d = w * ((z - 1.0) * (z + 1.0)).sqrt();
            let slow = -w * w / (z * w + d);
            match d * t < 1.0 {
                true => (
                    (d * t).cosh() * (-z * w * t).exp(),
                    (d * t).sinh() / d * (-z * w * t).exp(),
                ),
                false => {
                    let (a, b) = ((slow * t).exp(), ((-z * w - d) * t).exp());
                    (0.5 * (a + b), (a - b) / (2.0 * d))
                }
            }
        }
    };
    let b = zeta * w;
    [x * (c + b * s) + v * s, v * (c - b * s) - w * w * x * s]
}
