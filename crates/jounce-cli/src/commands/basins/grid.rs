//! `--grid SIDE=FROM:TO:Nx`: reading the sides of a plane or box of starts, and their axes in the picture.

use crate::failure::Failure;
use jounce::picture::Axis;
use jounce::spec::Quantity;
use jounce::study::{Grid, GridAxis, GridSide, SectionPoint};

/// Most starts of a grid.
const MOST: usize = 1_000_000;

/// Reads the sides; `None` without any.
pub fn read(texts: &[String], stops: usize) -> Result<Option<Grid>, Failure> {
    if texts.is_empty() {
        return Ok(None);
    }
    if stops == 0 {
        return Err(Failure::Input("--grid needs a stop, whose point is bent or struck: add [stop.NAME] to the spec".to_owned()));
    }
    let sides = texts.iter().map(|text| side(text)).collect::<Result<Vec<GridSide>, Failure>>()?;
    let twice = sides.iter().enumerate().find(|(k, side)| sides[..*k].iter().any(|other| other.axis == side.axis));
    if let Some((k, _)) = twice {
        return Err(Failure::usage(format!("--grid {}: this side is given twice", texts[k])));
    }
    let starts = sides.iter().try_fold(1_usize, |product, side| product.checked_mul(side.count)).filter(|starts| *starts <= MOST);
    match starts {
        Some(_) => Ok(Some(Grid { sides })),
        None => Err(Failure::usage(format!("--grid: more than {MOST} starts; give fewer values"))),
    }
}

fn side(text: &str) -> Result<GridSide, Failure> {
    let wrong = |why: &str| {
        Failure::usage(format!(
            "--grid {text}: {why}; write displacement=FROM:TO:Nx, velocity=FROM:TO:Nx or voltage=FROM:TO:Nx, as in displacement=-5mm:5mm:21x"
        ))
    };
    let (name, range) = text.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
    let axis = match name.trim() {
        "displacement" => GridAxis::Displacement,
        "velocity" => GridAxis::Velocity,
        "voltage" => GridAxis::Voltage,
        _ => return Err(wrong("this is no side")),
    };
    let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
        return Err(wrong("the range has not three parts"));
    };
    let count = count.strip_suffix('x').and_then(|count| count.parse().ok()).filter(|count| *count >= 2);
    let count = count.ok_or_else(|| wrong("the number of values must be 2x or more"))?;
    let ends = [from, to].map(|end| number(axis, end));
    let [Ok(from), Ok(to)] = ends else { return Err(wrong(&ends.into_iter().find_map(Result::err).unwrap_or_default())) };
    if from < to { Ok(GridSide { axis, from, to, count }) } else { Err(wrong("the range must go from a smaller to a larger value")) }
}

/// A value in SI.
fn number(axis: GridAxis, text: &str) -> Result<f64, String> {
    let length = |text: &str| Quantity::Length.read(text).map_err(|error| error.to_string());
    match axis {
        GridAxis::Displacement => length(text),
        GridAxis::Velocity => length(text.strip_suffix("/s").ok_or_else(|| format!("{text} is no velocity, as 0.5m/s is"))?.trim()),
        GridAxis::Voltage => {
            let volts = text.strip_suffix('V').and_then(|number| number.trim().parse().ok()).filter(|volts: &f64| volts.is_finite());
            volts.ok_or_else(|| format!("{text} is no voltage in V, as 10V is"))
        }
    }
}

/// The axis in the picture.
pub fn axis(axis: GridAxis) -> Axis {
    match axis {
        GridAxis::Displacement => Axis::linear("Displacement towards the stop", "m"),
        GridAxis::Velocity => Axis::linear("Velocity", "m/s"),
        GridAxis::Voltage => Axis::linear("Voltage", "V"),
    }
}

/// Where a start lies on it.
pub fn value(axis: GridAxis, point: &SectionPoint) -> f64 {
    match axis {
        GridAxis::Displacement => point.displacement_m,
        GridAxis::Velocity => point.velocity_m_per_s,
        GridAxis::Voltage => point.voltage_v,
    }
}
