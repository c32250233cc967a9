//! Data set 55: data at nodes, here mode shapes.

use super::blocks::Block;
use super::numbers::numbers;
use crate::read::contents::ModeShape;
use crate::read::error::Damage;
use crate::recording::IssuePlace;

/// Header lines of data set 55.
const LINES: usize = 8;

/// Kind of the data of a data set 55.
struct Kind {
    /// Type of analysis: 2 for normal modes, 3 and 7 for complex ones.
    analysis: f64,
    is_complex: bool,
    /// Number of values at each node.
    per_node: usize,
}

/// Reads a mode shape.
pub(super) fn read(block: &Block) -> Result<ModeShape, Damage> {
    let kind = Kind::read(block)?;
    let numbers = row(block, 7)?;
    let (frequency_hz, damping_ratio) = frequency(kind.analysis, &numbers);
    let (mut nodes, mut real, mut imaginary) = (Vec::new(), Vec::new(), Vec::new());
    let step = 1 + usize::from(kind.is_complex);
    let mut line = LINES;
    while line < block.lines.len() {
        let node = row(block, line)?;
        let [node] = node[..] else {
            let why = "expected the number of a node".to_owned();
            return Err(damage(block, line, why));
        };
        line += 1;
        let mut values = Vec::new();
        while values.len() < kind.per_node * step {
            values.extend(row(block, line)?);
            line += 1;
        }
        nodes.push(node as i64);
        let part = |k: usize| -> Vec<f64> {
            values
                .chunks(step)
                .take(kind.per_node)
                .map(|value| value.get(k).copied().unwrap_or(0.0))
                .collect()
        };
        real.push(part(0));
        imaginary.push(part(1));
    }
    Ok(ModeShape {
        frequency_hz,
        damping_ratio,
        modal_mass: modal_mass(kind.analysis, &numbers),
        nodes,
        real,
        imaginary: kind.is_complex.then_some(imaginary),
    })
}

impl Kind {
    fn read(block: &Block) -> Result<Self, Damage> {
        let numbers = row(block, 5)?;
        let [_, analysis, _, _, data, per_node, ..] = numbers[..] else {
            let why = format!("expected six whole numbers, found {}", numbers.len());
            return Err(damage(block, 5, why));
        };
        let is_complex = data == 5.0;
        if !(is_complex || data == 2.0) || !(1.0..=6.0).contains(&per_node) {
            let why = format!(
                "{per_node} values of type {data} at each node: 1 to 6 of type 2 or 5 can be read"
            );
            return Err(damage(block, 5, why));
        }
        Ok(Self {
            analysis,
            is_complex,
            per_node: per_node as usize,
        })
    }
}

/// Numbers of a line of the data set.
fn row(block: &Block, line: usize) -> Result<Vec<f64>, Damage> {
    let mut result = Vec::new();
    let text = block.lines.get(line).ok_or_else(|| {
        damage(
            block,
            line,
            "it is missing: is the file truncated?".to_owned(),
        )
    })?;
    numbers(text, &mut result)
        .map_err(|word| damage(block, line, format!("{word:?} is not a number")))?;
    Ok(result)
}

fn damage(block: &Block, line: usize, why: String) -> Damage {
    Damage::at(
        IssuePlace::Byte(block.start),
        format!("line {} of the data set: {why}", line + 1),
    )
}

/// Reads frequency and damping: direct for normal modes (2), from the eigenvalue in rad/s for
/// complex modes (3, 7). A normal mode has a viscous damping ratio or, if that is 0, a loss factor,
/// which is twice the ratio at resonance.
fn frequency(analysis: f64, numbers: &[f64]) -> (f64, f64) {
    let at = |k: usize| numbers.get(k).copied().unwrap_or(f64::NAN);
    if analysis == 3.0 || analysis == 7.0 {
        let modulus = at(0).hypot(at(1));
        return (modulus / std::f64::consts::TAU, -at(0) / modulus);
    }
    let damping = match (at(2), at(3)) {
        (0.0, loss_factor) if loss_factor > 0.0 => loss_factor / 2.0,
        (ratio, _) => ratio,
    };
    (at(0), if analysis == 2.0 { damping } else { f64::NAN })
}

/// Returns the modal mass of a normal mode; 0 stands for none.
fn modal_mass(analysis: f64, numbers: &[f64]) -> f64 {
    let mass = numbers.get(1).copied().filter(|mass| *mass > 0.0);
    mass.filter(|_| analysis == 2.0).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::{frequency, modal_mass};

    #[test]
    fn normal_modes_give_their_modal_mass() {
        assert_eq!(modal_mass(2.0, &[12.5, 0.3, 0.013, 0.0]), 0.3);
        assert!(modal_mass(2.0, &[12.5, 0.0, 0.013, 0.0]).is_nan());
        assert!(modal_mass(3.0, &[-3.0, 4.0, 1.0, 0.0, 0.0, 0.0]).is_nan());
    }

    #[test]
    fn modes_give_their_damping_in_each_form() {
        assert_eq!(frequency(2.0, &[12.5, 1.0, 0.013, 0.0]), (12.5, 0.013));
        assert_eq!(frequency(2.0, &[12.5, 1.0, 0.0, 0.04]), (12.5, 0.02));
        assert_eq!(frequency(2.0, &[12.5, 1.0, 0.0]), (12.5, 0.0));
        let (hertz, damping) = frequency(3.0, &[-3.0, 4.0, 1.0, 0.0, 0.0, 0.0]);
        assert!((hertz - 5.0 / std::f64::consts::TAU).abs() < 1e-15 && damping == 0.6);
        assert!(frequency(5.0, &[12.5, 1.0, 0.013]).1.is_nan());
    }
}
