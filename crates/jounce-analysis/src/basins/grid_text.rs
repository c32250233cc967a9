//! Reading of the sides of a grid: `displacement=-5mm:5mm:21x`.

use super::grid::{Grid, GridAxis, GridSide};
use jounce_spec::Quantity;

/// Largest number of starts of a grid.
const MAX_GRID_STARTS: usize = 1_000_000;

/// Error of a grid of starts.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// The harvester has no stop.
    #[error(
        "a grid of starts needs a stop, at whose point the harvester is bent or struck: add [stop.NAME] to the spec"
    )]
    NoStop,
    /// The text does not specify a side.
    #[error(
        "{text}: {why}; write displacement=FROM:TO:Nx, velocity=FROM:TO:Nx or voltage=FROM:TO:Nx, as in displacement=-5mm:5mm:21x"
    )]
    Side {
        /// Text of the side.
        text: String,
        /// Reason of the failure.
        why: String,
    },
    /// Two sides have the same quantity.
    #[error("{text}: another side has this quantity; give each quantity once")]
    Twice {
        /// Text of the second side.
        text: String,
    },
    /// Too many starts.
    #[error("the grid has more than {MAX_GRID_STARTS} starts; give fewer values")]
    TooMany,
}

impl Grid {
    /// Reads the sides of a grid for a harvester with `stops` stops.
    ///
    /// # Errors
    /// [`GridError`].
    pub fn read(texts: &[String], stops: usize) -> Result<Self, GridError> {
        if stops == 0 {
            return Err(GridError::NoStop);
        }
        let sides = texts
            .iter()
            .map(|text| side(text))
            .collect::<Result<Vec<GridSide>, GridError>>()?;
        let twice = sides
            .iter()
            .enumerate()
            .find(|(k, side)| sides[..*k].iter().any(|other| other.axis == side.axis));
        if let Some((k, _)) = twice {
            return Err(GridError::Twice {
                text: texts[k].clone(),
            });
        }
        let starts = sides
            .iter()
            .try_fold(1_usize, |product, side| product.checked_mul(side.count))
            .filter(|starts| *starts <= MAX_GRID_STARTS);
        starts.map(|_| Self { sides }).ok_or(GridError::TooMany)
    }
}

fn side(text: &str) -> Result<GridSide, GridError> {
    let wrong = |reason: &str| GridError::Side {
        text: text.to_owned(),
        why: reason.to_owned(),
    };
    let (name, range) = text
        .split_once('=')
        .ok_or_else(|| wrong("`=` is missing"))?;
    let axis = match name.trim() {
        "displacement" => GridAxis::Displacement,
        "velocity" => GridAxis::Velocity,
        "voltage" => GridAxis::Voltage,
        _ => return Err(wrong("this quantity is unknown")),
    };
    let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
        return Err(wrong("the range must have three parts"));
    };
    let count = count
        .strip_suffix('x')
        .and_then(|count| count.parse().ok())
        .filter(|count| *count >= 2);
    let count = count.ok_or_else(|| wrong("the number of values must be 2x or more, as in 21x"))?;
    let ends = [from, to].map(|end| number(axis, end));
    let [Ok(from), Ok(to)] = ends else {
        return Err(wrong(
            &ends.into_iter().find_map(Result::err).unwrap_or_default(),
        ));
    };
    if from < to {
        Ok(GridSide {
            axis,
            from,
            to,
            count,
        })
    } else {
        Err(wrong("the range must go from a smaller to a larger value"))
    }
}

/// Reads a value and converts it to SI.
fn number(axis: GridAxis, text: &str) -> Result<f64, String> {
    let quantity = match axis {
        GridAxis::Displacement => Quantity::Length,
        GridAxis::Velocity => Quantity::Speed,
        GridAxis::Voltage => Quantity::Voltage,
    };
    quantity.read(text).map_err(|error| error.to_string())
}
