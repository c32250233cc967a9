//! Piecewise polynomials with continuous slope along one direction of a plate.
//!
//! On an element of half length `h` the functions of `t` from -1 to 1 are the four cubic Hermite
//! polynomials (value and slope at each end) and, for degree `p > 3`, the double integrals of the
//! Legendre polynomials of order 2 to `p - 2`, which vanish with their slope at both ends. Every
//! function is a sum of Legendre polynomials, so that all integrals are exact:
//!
//! ```text
//! int f g dx = h sum_k 2 / (2k + 1) f_k g_k,     d/dx P_n = 1/h (... + (2n - 5) P_(n-3) + (2n - 1) P_(n-1))
//! ```

use jounce_linalg::Mat;
use jounce_spec::Edge;

/// Functions along one direction.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Ends of the elements, m.
    nodes_m: Vec<f64>,
    degree: usize,
    /// Number of functions that the edges leave.
    pub functions: usize,
    /// Index of each function of each element among them; `None` where an edge holds it.
    index: Vec<Vec<Option<usize>>>,
    /// Length that makes slopes displacements, m.
    slope_scale_m: f64,
}

/// Integrals of the functions of one element over it.
pub(super) struct ElementIntegrals {
    /// `int f_i f_j dx`, m.
    pub values: Mat<f64>,
    /// `int f_i' f_j' dx`, 1/m.
    pub slopes: Mat<f64>,
    /// `int f_i'' f_j'' dx`, 1/m^3.
    pub curvatures: Mat<f64>,
    /// `int f_i'' f_j dx`, 1/m.
    pub curvature_value: Mat<f64>,
}

impl Line {
    /// Functions of degree `degree`, at least 3, on elements between `nodes_m`.
    pub fn new(nodes_m: Vec<f64>, degree: usize, edges: [Edge; 2]) -> Self {
        let elements = nodes_m.len() - 1;
        let mut functions = 0;
        let mut next = |held: bool| {
            (!held).then(|| {
                functions += 1;
                functions - 1
            })
        };
        let mut node = |edge: Edge| [next(edge != Edge::Free), next(edge == Edge::Clamped)];
        let mut nodes = vec![node(edges[0])];
        nodes.extend((1..elements).map(|_| node(Edge::Free)));
        nodes.push(node(edges[1]));
        let index = nodes
            .windows(2)
            .map(|ends| {
                let bubbles: Vec<_> = (3..degree).map(|_| next(false)).collect();
                ends.iter().flatten().copied().chain(bubbles).collect()
            })
            .collect();
        let slope_scale_m = (nodes_m[elements] - nodes_m[0]) / elements as f64;
        Self {
            nodes_m,
            degree,
            functions,
            index,
            slope_scale_m,
        }
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.index.len()
    }

    /// Indices of the functions of an element.
    pub fn index(&self, element: usize) -> &[Option<usize>] {
        &self.index[element]
    }

    /// Returns the middle of an element, m.
    pub fn middle_m(&self, element: usize) -> f64 {
        (self.nodes_m[element] + self.nodes_m[element + 1]) / 2.0
    }

    /// Returns the start and the end of an element, m.
    pub fn ends_m(&self, element: usize) -> [f64; 2] {
        [self.nodes_m[element], self.nodes_m[element + 1]]
    }

    /// Returns the element at a position; between two elements the second.
    pub fn element_at(&self, position_m: f64) -> usize {
        let after = self.nodes_m.partition_point(|node| *node <= position_m);
        after.saturating_sub(1).min(self.elements() - 1)
    }

    /// Returns the integrals over an element.
    pub fn integrals(&self, element: usize) -> ElementIntegrals {
        let [values, slopes, curvatures] =
            [0, 1, 2].map(|derivative| self.coefficients(element, derivative));
        let half_m = self.half_m(element);
        let product = |f: &[Vec<f64>], g: &[Vec<f64>]| {
            Mat::from_fn(f.len(), g.len(), |i, j| {
                let terms = f[i].iter().zip(&g[j]).enumerate();
                half_m
                    * terms
                        .map(|(k, (f, g))| 2.0 / (2 * k + 1) as f64 * f * g)
                        .sum::<f64>()
            })
        };
        ElementIntegrals {
            values: product(&values, &values),
            slopes: product(&slopes, &slopes),
            curvatures: product(&curvatures, &curvatures),
            curvature_value: product(&curvatures, &values),
        }
    }

    /// Returns the integral of every function, or of its derivative, over an element.
    pub fn integral(&self, element: usize, derivative: usize) -> Vec<f64> {
        let half_m = self.half_m(element);
        let local = self.coefficients(element, derivative);
        self.spread(element, local.iter().map(|series| 2.0 * half_m * series[0]))
    }

    /// Returns every function, or its derivative, at a position.
    pub fn at(&self, position_m: f64, derivative: usize) -> Vec<f64> {
        let element = self.element_at(position_m);
        let t = (position_m - self.middle_m(element)) / self.half_m(element);
        let legendre = legendre(t, self.degree + 1);
        let local = self.coefficients(element, derivative);
        let sum = |series: &Vec<f64>| series.iter().zip(&legendre).map(|(c, p)| c * p).sum();
        self.spread(element, local.iter().map(sum))
    }

    fn half_m(&self, element: usize) -> f64 {
        (self.nodes_m[element + 1] - self.nodes_m[element]) / 2.0
    }

    fn spread(&self, element: usize, local: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut values = vec![0.0; self.functions];
        for (index, value) in self.index[element].iter().zip(local) {
            if let Some(index) = index {
                values[*index] = value;
            }
        }
        values
    }

    /// Returns the Legendre coefficients of the functions of an element, or of a derivative.
    fn coefficients(&self, element: usize, derivative: usize) -> Vec<Vec<f64>> {
        let half_m = self.half_m(element);
        let mut all = functions(self.degree, half_m / self.slope_scale_m);
        for _ in 0..derivative {
            for series in &mut all {
                *series = differentiated(series, half_m);
            }
        }
        all
    }
}

/// Returns the Legendre coefficients of the functions of an element. Slopes are per unit of a
/// reference length, of which the half length of the element is `half`.
fn functions(degree: usize, half: f64) -> Vec<Vec<f64>> {
    let padded = |terms: &[f64]| {
        let mut series = terms.to_vec();
        series.resize(degree + 1, 0.0);
        series
    };
    let mut all = vec![
        padded(&[0.5, -0.6, 0.0, 0.1]),
        padded(&[half / 6.0, -half / 10.0, -half / 6.0, half / 10.0]),
        padded(&[0.5, 0.6, 0.0, -0.1]),
        padded(&[-half / 6.0, -half / 10.0, half / 6.0, half / 10.0]),
    ];
    for j in 2..degree.saturating_sub(1) {
        let n = (2 * j) as f64;
        // The curvature of each function has unit norm.
        let scale = ((n + 1.0) / 2.0).sqrt();
        let mut series = vec![0.0; degree + 1];
        series[j - 2] = scale / ((n + 1.0) * (n - 1.0));
        series[j] = -2.0 * scale / ((n - 1.0) * (n + 3.0));
        series[j + 2] = scale / ((n + 1.0) * (n + 3.0));
        all.push(series);
    }
    all
}

/// Returns the derivative of a Legendre series by the position.
fn differentiated(series: &[f64], half_m: f64) -> Vec<f64> {
    let count = series.len();
    let coefficient = |k: usize| {
        let sum: f64 = series.iter().skip(k + 1).step_by(2).sum();
        (2 * k + 1) as f64 * sum / half_m
    };
    (0..count).map(coefficient).collect()
}

/// Returns `P_0(t) .. P_(count-1)(t)`.
fn legendre(t: f64, count: usize) -> Vec<f64> {
    let mut values = vec![1.0, t];
    for j in 1..count.saturating_sub(1) {
        let n = j as f64;
        values.push(((2.0 * n + 1.0) * t * values[j] - n * values[j - 1]) / (n + 1.0));
    }
    values.truncate(count);
    values
}
