//! Random networks of springs and masses, many of them in several free parts, against dense algebra.

use jounce_linalg::{Mat, inverse_cholesky_factor, symmetric_eigen};
use jounce_sparse::{SymmetricMatrix, lowest_modes};

/// Pseudorandom numbers from 0 to 1 (xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }
}

fn network(numbers: &mut Numbers, size: usize) -> [SymmetricMatrix; 2] {
    let (mut stiffness, mut mass) = (Vec::new(), Vec::new());
    let springs = (size as f64 * (0.7 + 2.0 * numbers.next())) as usize;
    for _ in 0..springs {
        let (i, j) = (numbers.below(size), numbers.below(size));
        if i != j {
            let k = 10f64.powf(4.0 * numbers.next() - 2.0);
            stiffness.extend([(i, i, k), (j, j, k), (i, j, -k), (j, i, -k)]);
            let m = 0.2 * numbers.next();
            mass.extend([(i, i, m), (j, j, m), (i, j, m / 2.0), (j, i, m / 2.0)]);
        }
    }
    for i in 0..size {
        mass.push((i, i, 0.1 + numbers.next()));
        if numbers.next() < 0.02 {
            stiffness.push((i, i, numbers.next()));
        }
    }
    [stiffness, mass].map(|entries| SymmetricMatrix::from_entries(size, entries).unwrap())
}

#[test]
fn random_networks() {
    let mut numbers = Numbers(12345);
    for trial in 0..600 {
        let size = 2 + numbers.below(120);
        let [stiffness, mass] = network(&mut numbers, size);
        let count = 1 + numbers.below((size - 1).min(25));
        let dense = |a: &SymmetricMatrix| Mat::from_fn(size, size, |i, j| a.entry(i, j));
        let inverse = inverse_cholesky_factor(&dense(&mass)).unwrap();
        let reduced = &inverse * dense(&stiffness) * inverse.transpose();
        let (exact, _) = symmetric_eigen(&reduced).unwrap();
        let modes = lowest_modes(&stiffness, &mass, count, 1e-10).unwrap();
        // The first elastic eigenvalue where all modes are rigid-body modes.
        let elastic = exact.iter().find(|value| **value > 1e-6);
        let scale = exact[count - 1].max(elastic.copied().unwrap_or(1.0));
        for (value, exact) in modes.eigenvalue.iter().zip(&exact) {
            assert!(
                (value - exact).abs() < 1e-8 * scale,
                "trial {trial}: {value} for {exact}"
            );
        }
        let products = modes.shape.transpose() * dense(&mass) * &modes.shape;
        let error = (products - Mat::identity(count, count)).amax();
        assert!(error < 1e-7, "trial {trial}: {error}");
    }
}
