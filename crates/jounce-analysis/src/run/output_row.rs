//! Outputs of a plant in block coordinates: voltages, strains, displacements.

use jounce_linalg::c64;
use jounce_model::plant::Plant;
use jounce_model::structure::PlaceStrain;

/// Source of an output.
#[derive(Debug, Clone, Copy)]
pub(super) enum OutputSource {
    /// Voltage across the resistor of a load.
    Load(usize),
    /// Voltage across a patch.
    Patch(usize),
    /// Strain of a patch at one of its places.
    Strain(usize, usize),
    /// Displacement of a named point.
    Point(usize),
}

/// Output in block coordinates.
#[derive(Debug, PartialEq)]
pub(super) struct OutputRow {
    /// One row, or those of the three strains in the plane of a plate.
    rows: Vec<LinearRow>,
}

/// Row of a linear output.
#[derive(Debug, PartialEq)]
struct LinearRow {
    row: Vec<f64>,
    /// Complex amplitude of the output of each tone.
    steady: Vec<c64>,
    /// Output at the zero of all states.
    zero: f64,
}

impl OutputRow {
    pub fn of(plant: &Plant, source: OutputSource) -> Self {
        let (electrical, modes) = (&plant.electrical, &plant.system.modes);
        let linear = |row: Vec<f64>, zero: f64| LinearRow::new(plant, row, zero);
        let of_shape = |shape: &Vec<f64>| linear(plant.displacement_row(shape), 0.0);
        let rows = match source {
            OutputSource::Load(load) => vec![linear(plant.load_voltage_row(load), 0.0)],
            OutputSource::Patch(patch) => {
                let zeros_v = electrical.patch[patch]
                    .iter()
                    .map(|(node, factor)| factor * electrical.zero_v[*node]);
                vec![linear(plant.voltage_row(patch), zeros_v.sum())]
            }
            OutputSource::Strain(patch, place) => {
                let own = modes.patch.values().nth(patch);
                let rows = own.map_or(&[][..], |own| own.strain[place].rows());
                rows.iter().map(of_shape).collect()
            }
            OutputSource::Point(point) => modes
                .shape
                .values()
                .nth(point)
                .map(of_shape)
                .into_iter()
                .collect(),
        };
        Self { rows }
    }

    /// Writes the phasor of each tone of a plant at a time.
    pub fn phasors(plant: &Plant, time_s: f64, phasors: &mut Vec<c64>) {
        phasors.clear();
        let tones = plant.tones.iter();
        phasors.extend(tones.map(|tone| c64::cis(tone.angular_frequency_rad_s * time_s)));
    }

    /// Returns the output in a state, for the phasors of the tones.
    pub fn value(&self, phasors: &[c64], state: &[f64]) -> f64 {
        match &self.rows[..] {
            [row] => row.value(phasors, state),
            rows => {
                let values: Vec<f64> = rows.iter().map(|row| row.value(phasors, state)).collect();
                PlaceStrain::of_values(&values)
            }
        }
    }
}

impl LinearRow {
    fn new(plant: &Plant, row: Vec<f64>, zero: f64) -> Self {
        let steady = plant.steady_output(&row).into_iter().collect();
        Self { row, steady, zero }
    }

    fn value(&self, phasors: &[c64], state: &[f64]) -> f64 {
        let free: f64 = self.row.iter().zip(state).map(|(c, y)| c * y).sum();
        let steady: f64 = self
            .steady
            .iter()
            .zip(phasors)
            .map(|(amplitude, phasor)| (phasor * amplitude).re)
            .sum();
        free + steady + self.zero
    }
}
