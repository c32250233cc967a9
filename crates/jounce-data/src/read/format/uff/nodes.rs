//! Data set 55: data at nodes, here mode shapes.

use super::blocks::Block;
use super::numbers::numbers;
use crate::read::contents::ModeShape;
use crate::read::error::Damage;
use crate::recording::IssuePlace;

/// Header lines of data set 55.
const LINES: usize = 8;

pub(super) fn read(block: &Block) -> Result<ModeShape, Damage> {
    let damage = |line: usize, why: String| {
        Damage::at(
            IssuePlace::Byte(block.start),
            format!("line {} of the data set: {why}", line + 1),
        )
    };
    let row = |line: usize| {
        let mut result = Vec::new();
        let text = block
            .lines
            .get(line)
            .ok_or_else(|| damage(line, "it is missing: is the file truncated?".to_owned()))?;
        numbers(text, &mut result)
            .map_err(|word| damage(line, format!("{word:?} is not a number")))?;
        Ok::<_, Damage>(result)
    };
    let kind = row(5)?;
    let [_, analysis, _, _, data, per_node, ..] = kind[..] else {
        return Err(damage(
            5,
            format!("expected six whole numbers, found {}", kind.len()),
        ));
    };
    let complex = data == 5.0;
    if !(complex || data == 2.0) || !(1.0..=6.0).contains(&per_node) {
        return Err(damage(
            5,
            format!(
                "{per_node} values of type {data} at each node: 1 to 6 of type 2 or 5 can be read"
            ),
        ));
    }
    let per_node = per_node as usize;
    let (frequency_hz, damping_ratio) = frequency(analysis, &row(7)?);
    let (mut nodes, mut real, mut imaginary) = (Vec::new(), Vec::new(), Vec::new());
    let expected = per_node * (1 + usize::from(complex));
    let mut line = LINES;
    while line < block.lines.len() {
        let node = row(line)?;
        let [node] = node[..] else {
            return Err(damage(line, "expected the number of a node".to_owned()));
        };
        line += 1;
        let mut values = Vec::new();
        while values.len() < expected {
            values.extend(row(line)?);
            line += 1;
        }
        nodes.push(node as i64);
        let step = 1 + usize::from(complex);
        real.push(
            values
                .chunks(step)
                .take(per_node)
                .map(|value| value[0])
                .collect(),
        );
        imaginary.push(
            values
                .chunks(step)
                .take(per_node)
                .map(|value| value.get(1).copied().unwrap_or(0.0))
                .collect(),
        );
    }
    Ok(ModeShape {
        frequency_hz,
        damping_ratio,
        nodes,
        real,
        imaginary: complex.then_some(imaginary),
    })
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

#[cfg(test)]
mod tests {
    use super::frequency;

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
