//! Figures 4 and 5: tip acceleration and open-circuit patch voltage per hammer force 15 mm from the
//! root, with fixed table.

use crate::harvester::PaperHarvester;
use crate::{NamedFigure, NamedTable, ReproduceError};
use jounce_io::table::{Column, Table};
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes_holding;
use jounce_plot::{ResponseLine as Curve, Scale, frequency_responses};

/// The two complex frequency responses, per newton.
pub(crate) struct HammerTest {
    frequency_hz: Vec<f64>,
    /// Tip acceleration, m/s^2/N.
    acceleration: Curve,
    /// Patch voltage, V/N.
    voltage: Curve,
}

impl HammerTest {
    /// Computes the responses from 1 to 1000 Hz.
    pub fn compute() -> Result<Self, ReproduceError> {
        let spec = PaperHarvester::spec(&[])?;
        let mut system = System::assemble(&spec, modes_holding(&spec, &["table".to_owned()])?)?;
        // Without its resistor the patch is open.
        system.loads.clear();
        system.stops.clear();
        system.drives.clear();
        let plant = Plant::new(system)?;
        let frequency_hz = frequencies_hz(&plant);
        let labels = [
            FrfOutput::Acceleration("beam.tip".to_owned()),
            FrfOutput::Voltage("mfc".to_owned()),
        ];
        let hammer = FrfInput::Force("beam.hammer".to_owned());
        let mut curves = frf(&plant, &hammer, &labels, &frequency_hz)?
            .into_iter()
            .map(|result| Curve {
                label: result.response.name(),
                re: result.value.iter().map(|z| z.re).collect(),
                im: result.value.iter().map(|z| z.im).collect(),
            });
        let mut next = || curves.next().expect("frf returns every requested response");
        Ok(Self {
            acceleration: next(),
            voltage: next(),
            frequency_hz,
        })
    }

    /// Returns figures 4 and 5.
    pub fn figures(&self) -> Vec<NamedFigure> {
        let draw = |title: &str, quantity: &str, unit: &str, curve: &Curve| {
            frequency_responses(
                title,
                quantity,
                unit,
                Scale::Linear,
                &self.frequency_hz,
                std::slice::from_ref(curve),
            )
        };
        let acceleration = draw(
            "Tip acceleration per hammer force",
            "Acceleration per force",
            "m/s^2/N",
            &self.acceleration,
        );
        let voltage = draw(
            "Open-circuit patch voltage per hammer force",
            "Voltage per force",
            "V/N",
            &self.voltage,
        );
        vec![
            NamedFigure::new(
                "figure-4",
                "Figure 4. Frequency response of the acceleration 10 mm from the free end; hammer 15 mm from the root, table fixed, patch open.",
                acceleration,
            ),
            NamedFigure::new(
                "figure-5",
                "Figure 5. Frequency response of the open-circuit voltage of the patch, same hammer.",
                voltage,
            ),
        ]
    }

    /// Returns the data of both figures.
    pub fn table(&self) -> Result<NamedTable, ReproduceError> {
        let table = Table::new(vec![
            Column::new("frequency_hz", "Hz", "Frequency", self.frequency_hz.clone()),
            Column::new(
                "acceleration_re_m_s2_n",
                "m/(s^2 N)",
                "Tip acceleration, real part",
                self.acceleration.re.clone(),
            ),
            Column::new(
                "acceleration_im_m_s2_n",
                "m/(s^2 N)",
                "Tip acceleration, imaginary part",
                self.acceleration.im.clone(),
            ),
            Column::new(
                "voltage_re_v_n",
                "V/N",
                "Patch voltage, real part",
                self.voltage.re.clone(),
            ),
            Column::new(
                "voltage_im_v_n",
                "V/N",
                "Patch voltage, imaginary part",
                self.voltage.im.clone(),
            ),
        ])?;
        Ok(NamedTable::new(
            "figures-4-5",
            "Figures 4 and 5: frequency responses to a force 15 mm from the root.",
            4,
            table,
        ))
    }
}

/// Returns frequencies in steps of 0.5 Hz. Near each resonance the step is an eighth of its half
/// width, to resolve the peak.
fn frequencies_hz(plant: &Plant) -> Vec<f64> {
    let mut all: Vec<f64> = (2..=2000).map(|i| f64::from(i) / 2.0).collect();
    for value in plant
        .diagonal
        .block
        .eigenvalues()
        .iter()
        .filter(|value| value.im > 0.0)
    {
        let (centre_hz, width_hz) = (
            value.im / std::f64::consts::TAU,
            value.re.abs() / std::f64::consts::TAU,
        );
        all.extend((-64..=64).map(|i| centre_hz + width_hz * f64::from(i) / 8.0));
    }
    all.retain(|frequency_hz| (1.0..=1000.0).contains(frequency_hz));
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}
