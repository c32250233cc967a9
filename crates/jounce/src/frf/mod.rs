//! Frequency responses without contact.

mod options;
mod report;
mod result;

pub use options::FrfOptions;
pub use result::{FrfResponse, FrfResult};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::modes::held_masses;
use jounce_model::linear::{self, Frf, FrfInput};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes_holding;
use jounce_spec::{DriveKind, Gravity, Spec};

impl Harvester {
    /// Computes the frequency responses without contact in closed form: per newton on a point, or
    /// per m/s^2 of the base.
    ///
    /// # Errors
    /// [`Error::Option`] for a wrong frequency, a missing input or one that moves nothing,
    /// [`Error::Analysis`] for an unknown point or mass, a circuit that is not linear or an undamped
    /// resonance, [`Error::Stopped`].
    ///
    /// ```
    /// use jounce::{FrfOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/unimorph-erturk-2008/harvester.toml")?;
    /// let options = FrfOptions { base: true, low_hz: 40.0, high_hz: 60.0, ..Default::default() };
    /// let result = harvester.frf(&options)?;
    /// for response in &result.responses {
    ///     println!("{}: {:?} {}", response.name, response.highest(), response.unit);
    /// }
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn frf(&self, options: &FrfOptions) -> Result<FrfResult, Error> {
        let frequency_hz = options.frequencies_hz()?;
        let input = input(self.spec(), options)?;
        let held = held_masses(self.spec(), &options.hold, options.fixed_table);
        let functions = self.functions(&frequency_hz, &input, &held, options.open_circuit)?;
        if self.control().is_stopped() {
            return Err(Error::Stopped);
        }
        check_effect(&functions, &input)?;
        let response = |function: Frf| FrfResponse {
            name: function.response.name(),
            re: function.value.iter().map(|value| value.re).collect(),
            im: function.value.iter().map(|value| value.im).collect(),
            unit: function.response.unit(&input),
        };
        Ok(FrfResult {
            responses: functions.into_iter().map(response).collect(),
            input: match input {
                FrfInput::Force(point) => point,
                FrfInput::BaseAcceleration => "base".to_owned(),
            },
            held,
            frequency_hz,
        })
    }

    fn functions(
        &self,
        frequency_hz: &[f64],
        input: &FrfInput,
        held: &[String],
        open_circuit: bool,
    ) -> Result<Vec<Frf>, Error> {
        let mut spec = self.spec().clone();
        if open_circuit {
            spec.open_circuits();
        }
        spec.take_drives_away();
        spec.gravity = Gravity::default();
        spec.stop.clear();
        let modes = modes_holding(&spec, held)?;
        let motion = match input {
            FrfInput::BaseAcceleration => linear::FrfOutput::Displacement,
            FrfInput::Force(_) => linear::FrfOutput::Acceleration,
        };
        let points = modes.shape.keys().cloned().map(motion);
        let patches = modes.patch.keys().cloned();
        let patches = patches.map(linear::FrfOutput::Voltage);
        let loads = spec.circuit.keys().cloned();
        let loads = loads.map(linear::FrfOutput::LoadVoltage);
        let responses: Vec<_> = points.chain(patches).chain(loads).collect();
        let plant = Plant::new(System::assemble(&spec, modes)?)?;
        let is_stopped = || self.control().is_stopped();
        Ok(linear::frf_until(
            &plant,
            input,
            &responses,
            frequency_hz,
            &is_stopped,
        )?)
    }
}

/// Refuses an excitation without any response.
fn check_effect(functions: &[Frf], input: &FrfInput) -> Result<(), Error> {
    let mut values = functions.iter().flat_map(|function| &function.value);
    if values.any(|value| value.norm() > 0.0) {
        return Ok(());
    }
    let expected = "it moves nothing, so that all responses are 0";
    Err(match input {
        FrfInput::Force(point) => Error::option(
            "input",
            point,
            format!("{expected}; give a point that moves, or omit its mass from `hold`"),
        ),
        FrfInput::BaseAcceleration => Error::option("base", true, expected),
    })
}

/// Returns the excitation: by default the point of the first force.
fn input(spec: &Spec, options: &FrfOptions) -> Result<FrfInput, Error> {
    let mut drives = spec.drive.values();
    let force = drives.find(|drive| drive.kind == DriveKind::Force);
    match (options.base, &options.input) {
        (true, Some(point)) => Err(Error::option(
            "input",
            point,
            "the base is excited too: omit `input`, or omit `base`",
        )),
        (true, None) => base(spec),
        (false, Some(point)) => Ok(FrfInput::Force(point.clone())),
        (false, None) => match force {
            Some(drive) => Ok(FrfInput::Force(drive.at.clone())),
            None => Err(Error::option(
                "input",
                "missing",
                "this spec has no force: name a point, or give `base` to excite the base",
            )),
        },
    }
}

fn base(spec: &Spec) -> Result<FrfInput, Error> {
    let mut structures = spec.modal.iter();
    match structures.find(|(_, modal)| modal.participation_sqrt_kg.is_empty()) {
        None => Ok(FrfInput::BaseAcceleration),
        Some((name, _)) => Err(Error::option(
            "base",
            true,
            format!(
                "modal.{name}.participation_sqrt_kg is missing: it gives the excitation of this structure by the base"
            ),
        )),
    }
}
