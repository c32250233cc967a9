//! Frequency response functions without contact.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::integrate::Control;
use jounce_core::linear::{self, Frf, FrfInput, FrfResponse};
use jounce_core::plant::{Plant, System};
use jounce_core::spec::{DriveKind, Gravity};
use jounce_core::structure::modes_holding;
use numpy::{Complex64, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes acceleration of every point and voltage of every patch and circuit per newton on
/// `input`; or, for an acceleration of the base, displacement and voltages per m/s^2.
#[pyfunction]
pub fn frf<'py>(
    py: Python<'py>,
    spec: &Spec,
    frequency_hz: PyReadonlyArray1<'py, f64>,
    input: Option<String>,
    base: bool,
    hold: Vec<String>,
    open_circuit: bool,
) -> PythonResult<'py> {
    let frequency_hz = frequency_hz.as_array().to_vec();
    let input = input_of(spec, input, base)?;
    let outcome = cancellable(py, None, |control| {
        let functions = responses(spec, &frequency_hz, &input, &hold, open_circuit, control)?;
        Failure::unless_stopped(control, functions)
    });
    let options = [
        ("input", input_name(&input)),
        ("hold", hold.join(" ")),
        ("open_circuit", open_circuit.to_string()),
    ];
    to_python_result(py, outcome, |functions| {
        into_python(
            py,
            functions,
            &input,
            hold,
            frequency_hz,
            spec.manifest("frf", &options),
        )
    })
}

fn into_python<'py>(
    py: Python<'py>,
    functions: Vec<Frf>,
    input: &FrfInput,
    hold: Vec<String>,
    frequency_hz: Vec<f64>,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let response_dict = PyDict::new(py);
    for frf in functions {
        let values: Vec<Complex64> = frf
            .value
            .iter()
            .map(|value| Complex64::new(value.re, value.im))
            .collect();
        response_dict.set_item(
            frf.response.name(),
            (
                numpy::PyArray1::from_vec(py, values),
                frf.response.unit(input),
            ),
        )?;
    }
    let dict = PythonDict::new(py)
        .with("input", input_name(input))?
        .with("held", hold)?
        .with("responses", response_dict)?
        .with("manifest", manifest)?;
    Ok(dict.array("frequency_hz", frequency_hz)?.dict())
}

fn input_name(input: &FrfInput) -> String {
    match input {
        FrfInput::Force(point) => point.clone(),
        FrfInput::BaseAcceleration => "base".to_owned(),
    }
}

/// Returns the excitation: by default the point of the first force.
fn input_of(spec: &Spec, point_name: Option<String>, base: bool) -> Result<FrfInput, Failure> {
    let argument_error = |message: String| Err(Failure::new("ArgumentError", message));
    if base {
        if point_name.is_some() {
            return argument_error("input and base are both given; give one of them".to_owned());
        }
        return match spec
            .spec()
            .modal
            .iter()
            .find(|(_, modal)| modal.participation_sqrt_kg.is_empty())
        {
            None => Ok(FrfInput::BaseAcceleration),
            Some((name, _)) => argument_error(format!(
                "modal.{name}.participation_sqrt_kg is missing: it gives the excitation of this structure by the base"
            )),
        };
    }
    let force_drive = spec
        .spec()
        .drive
        .values()
        .find(|drive| drive.kind == DriveKind::Force);
    match point_name.or_else(|| force_drive.map(|drive| drive.at.clone())) {
        Some(point) => Ok(FrfInput::Force(point)),
        None => {
            argument_error("this spec has no force: name the excitation point with input=\"POINT\", or excite the base with base=True".to_owned())
        }
    }
}

fn responses(
    spec: &Spec,
    frequency_hz: &[f64],
    input: &FrfInput,
    hold: &[String],
    open_circuit: bool,
    control: &Control,
) -> Result<Vec<Frf>, Failure> {
    let mut spec = spec.spec().clone();
    if open_circuit {
        spec.open_circuits();
    }
    spec.take_drives_away();
    spec.gravity = Gravity::default();
    spec.stop.clear();
    let modes = modes_holding(&spec, hold)?;
    let motion = if *input == FrfInput::BaseAcceleration {
        FrfResponse::Displacement
    } else {
        FrfResponse::Acceleration
    };
    let points = modes.shape.keys().map(|point| motion(point.clone()));
    let patches = modes
        .patch
        .keys()
        .map(|patch| FrfResponse::Voltage(patch.clone()));
    let loads = spec
        .circuit
        .keys()
        .map(|load| FrfResponse::LoadVoltage(load.clone()));
    let responses: Vec<FrfResponse> = points.chain(patches).chain(loads).collect();
    let plant = Plant::new(System::assemble(&spec, modes)?)?;
    Ok(linear::frf_until(
        &plant,
        input,
        &responses,
        frequency_hz,
        &|| control.is_stopped(),
    )?)
}
