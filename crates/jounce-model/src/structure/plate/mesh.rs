//! A plate divided into elements: stiffness, mass and rows of points.

use super::laminate::Laminate;
use super::layout::PlateLayout;
use super::line::{ElementIntegrals, Line};
use jounce_sparse::{SparseError, SymmetricMatrix};
use jounce_spec::PlatePoint;

/// Elements of a plate.
#[derive(Debug, Clone)]
pub(super) struct PlateMesh<'l, 'a> {
    pub layout: &'l PlateLayout<'a>,
    pub x: Line,
    pub y: Line,
    /// Laminate of each element, along y first.
    laminates: Vec<Laminate>,
}

/// Row, column and value of an entry of a matrix.
type Entry = (usize, usize, f64);

/// Product of a function of x and a function of y: displacement or derivative of displacement per
/// unit of each degree of freedom.
#[derive(Debug, Clone)]
pub(super) struct ProductRow {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
}

impl<'l, 'a> PlateMesh<'l, 'a> {
    /// Divides a plate at `cuts_m`, which include those of the layout, into elements of at most
    /// `longest_m` with polynomials of a degree.
    pub fn new(
        layout: &'l PlateLayout<'a>,
        cuts_m: [Vec<f64>; 2],
        longest_m: f64,
        degree: usize,
    ) -> Self {
        let [across_x, across_y] = cuts_m.map(|cuts| divided(&cuts, longest_m));
        let plate = layout.plate;
        let x = Line::new(across_x, degree, [plate.left, plate.right]);
        let y = Line::new(across_y, degree, [plate.front, plate.back]);
        let cells = (0..x.elements()).flat_map(|i| (0..y.elements()).map(move |j| (i, j)));
        let laminates = cells
            .map(|(i, j)| {
                layout.laminate_at(PlatePoint {
                    x_m: x.middle_m(i),
                    y_m: y.middle_m(j),
                })
            })
            .collect();
        Self {
            layout,
            x,
            y,
            laminates,
        }
    }

    /// Number of degrees of freedom.
    pub fn unknowns(&self) -> usize {
        self.x.functions * self.y.functions
    }

    /// Returns the elements: indices along x and y, and laminate.
    pub fn elements(&self) -> impl Iterator<Item = (usize, usize, &Laminate)> {
        let columns = self.y.elements();
        self.laminates
            .iter()
            .enumerate()
            .map(move |(index, laminate)| (index / columns, index % columns, laminate))
    }

    /// Returns the displacement, or a derivative of the given orders by x and y, at a point.
    pub fn row(&self, point: PlatePoint, derivative: [usize; 2]) -> ProductRow {
        ProductRow {
            x: self.x.at(point.x_m, derivative[0]),
            y: self.y.at(point.y_m, derivative[1]),
        }
    }

    /// Returns the integral of the displacement, or of a derivative, over an element.
    pub fn integral(&self, [i, j]: [usize; 2], derivative: [usize; 2]) -> ProductRow {
        ProductRow {
            x: self.x.integral(i, derivative[0]),
            y: self.y.integral(j, derivative[1]),
        }
    }

    /// Returns the stiffness and the mass matrix.
    ///
    /// # Errors
    /// `NotFinite`.
    pub fn matrices(&self) -> Result<[SymmetricMatrix; 2], SparseError> {
        let of_line = |line: &Line| {
            (0..line.elements())
                .map(|element| line.integrals(element))
                .collect::<Vec<_>>()
        };
        let (along_x, along_y) = (of_line(&self.x), of_line(&self.y));
        let mut entries = [Vec::new(), Vec::new()];
        for (i, j, laminate) in self.elements() {
            self.add_element([i, j], laminate, [&along_x[i], &along_y[j]], &mut entries);
        }
        let [stiffness, mut mass] = entries;
        for (_, fixed, point) in &self.layout.masses {
            self.add_mass(*point, fixed.mass_kg, &mut mass);
        }
        let unknowns = self.unknowns();
        Ok([
            SymmetricMatrix::from_lower(unknowns, stiffness)?,
            SymmetricMatrix::from_lower(unknowns, mass)?,
        ])
    }

    /// Returns the mass that moves with each degree of freedom under a unit translation.
    pub fn translated_mass(&self) -> Vec<f64> {
        let mut sum = vec![0.0; self.unknowns()];
        for (i, j, laminate) in self.elements() {
            let row = self.integral([i, j], [0, 0]);
            row.add_to(&mut sum, laminate.mass_kg_m2);
        }
        for (_, mass, point) in &self.layout.masses {
            self.row(*point, [0, 0]).add_to(&mut sum, mass.mass_kg);
        }
        sum
    }

    /// Adds the entries of the lower triangle of an element.
    fn add_element(
        &self,
        [i, j]: [usize; 2],
        laminate: &Laminate,
        [x, y]: [&ElementIntegrals; 2],
        [stiffness, mass]: &mut [Vec<Entry>; 2],
    ) {
        let bending = laminate.stiffness_n_m;
        let columns = self.y.functions;
        let (in_x, in_y) = (retained(self.x.index(i)), retained(self.y.index(j)));
        let pairs = |of: &[(usize, usize)]| -> Vec<_> {
            let with = |one: &(usize, usize)| of.iter().map(|other| (*one, *other)).collect();
            of.iter().flat_map(|one| -> Vec<_> { with(one) }).collect()
        };
        let along_y = pairs(&in_y);
        for ((a, row_x), (b, column_x)) in pairs(&in_x) {
            for &((c, row_y), (d, column_y)) in &along_y {
                let (row, column) = (row_x * columns + row_y, column_x * columns + column_y);
                if row < column {
                    continue;
                }
                let (ab, cd) = ((a, b), (c, d));
                let mixed = x.curvature_value[ab] * y.curvature_value[(d, c)]
                    + x.curvature_value[(b, a)] * y.curvature_value[cd];
                let along_x = bending.xx * x.curvatures[ab] * y.values[cd];
                let along_y = bending.yy * x.values[ab] * y.curvatures[cd];
                let twist = 4.0 * bending.shear * x.slopes[ab] * y.slopes[cd];
                let energy = along_x + along_y + bending.xy * mixed + twist;
                stiffness.push((row, column, energy));
                let value = laminate.mass_kg_m2 * x.values[ab] * y.values[cd];
                mass.push((row, column, value));
            }
        }
    }

    /// Adds the entries of the lower triangle of a mass at a point.
    fn add_mass(&self, point: PlatePoint, mass_kg: f64, mass: &mut Vec<Entry>) {
        let row = self.row(point, [0, 0]).entries();
        for (i, one) in &row {
            let lower = row.iter().filter(|(j, _)| j <= i);
            mass.extend(lower.map(|(j, other)| (*i, *j, mass_kg * one * other)));
        }
    }
}

/// Returns the local and the global index of each function that the edges leave.
fn retained(index: &[Option<usize>]) -> Vec<(usize, usize)> {
    let global = index.iter().enumerate();
    global
        .filter_map(|(local, global)| Some((local, (*global)?)))
        .collect()
}

impl ProductRow {
    /// Returns the entries that are not zero, with their degrees of freedom.
    pub fn entries(&self) -> Vec<(usize, f64)> {
        let columns = self.y.len();
        let of = |(i, x): (usize, &f64)| {
            let x = *x;
            let along_y = self.y.iter().enumerate();
            along_y.map(move |(j, y)| (i * columns + j, x * y))
        };
        let all = self.x.iter().enumerate().flat_map(of);
        all.filter(|(_, value)| *value != 0.0).collect()
    }

    /// Adds a multiple of the row to `sum`.
    pub fn add_to(&self, sum: &mut [f64], factor: f64) {
        for (index, value) in self.entries() {
            sum[index] += factor * value;
        }
    }
}

/// Divides each interval into equal elements of at most `longest_m`.
fn divided(cuts_m: &[f64], longest_m: f64) -> Vec<f64> {
    let mut nodes_m = vec![cuts_m[0]];
    for ends in cuts_m.windows(2) {
        let length_m = ends[1] - ends[0];
        let parts = (length_m / longest_m - 1e-9).ceil().max(1.0) as usize;
        nodes_m.extend((1..parts).map(|k| ends[0] + length_m * k as f64 / parts as f64));
        nodes_m.push(ends[1]);
    }
    nodes_m
}
