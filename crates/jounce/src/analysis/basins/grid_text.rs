//! Sides of a grid as text: `displacement=-5mm:5mm:21x`.

use super::grid::{Grid, GridAxis, GridSide};
use crate::spec::Quantity;

/// Most starts of a grid.
const MAX_GRID_STARTS: usize = 1_000_000;

/// Why a grid cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// A harvester without a stop.
    #[error(
        "a grid of starts needs a stop, whose point is bent or struck: add [stop.NAME] to the spec"
    )]
    NoStop,
    /// A text that is no side.
    #[error(
        "{text}: {why}; write displacement=FROM:TO:Nx, velocity=FROM:TO:Nx or voltage=FROM:TO:Nx, as in displacement=-5mm:5mm:21x"
    )]
    Side {
        /// The text.
        text: String,
        /// What is wrong.
        why: String,
    },
    /// Two sides of one kind.
    #[error("{text}: this side is given twice")]
    Twice {
        /// The second.
        text: String,
    },
    /// Too many starts.
    #[error("more than {MAX_GRID_STARTS} starts; give fewer values")]
    TooMany,
}

impl Grid {
    /// Reads the sides of a grid for a harvester with so many stops.
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
    let wrong = |why: &str| GridError::Side {
        text: text.to_owned(),
        why: why.to_owned(),
    };
    let (name, range) = text
        .split_once('=')
        .ok_or_else(|| wrong("there is no `=`"))?;
    let axis = match name.trim() {
        "displacement" => GridAxis::Displacement,
        "velocity" => GridAxis::Velocity,
        "voltage" => GridAxis::Voltage,
        _ => return Err(wrong("this is no side")),
    };
    let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
        return Err(wrong("the range has not three parts"));
    };
    let count = count
        .strip_suffix('x')
        .and_then(|count| count.parse().ok())
        .filter(|count| *count >= 2);
    let count = count.ok_or_else(|| wrong("the number of values must be 2x or more"))?;
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

/// A value in SI.
fn number(axis: GridAxis, text: &str) -> Result<f64, String> {
    let length = |text: &str| {
        Quantity::Length
            .read(text)
            .map_err(|error| error.to_string())
    };
    match axis {
        GridAxis::Displacement => length(text),
        GridAxis::Velocity => length(
            text.strip_suffix("/s")
                .ok_or_else(|| format!("{text} is no velocity, as 0.5m/s is"))?
                .trim(),
        ),
        GridAxis::Voltage => {
            let volts = text
                .strip_suffix('V')
                .and_then(|number| number.trim().parse().ok())
                .filter(|volts: &f64| volts.is_finite());
            volts.ok_or_else(|| format!("{text} is no voltage in V, as 10V is"))
        }
    }
}
