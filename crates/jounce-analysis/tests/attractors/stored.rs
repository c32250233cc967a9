//! Brute-force endings of the starts of random harvesters, in files of this repository: brute force
//! needs hours for them.
//!
//! A file has a line for each attractor, with the ending of the first start that reaches it, and a
//! line with the number of the attractor of each start.

use crate::agreement::groups;
use crate::brute::Ending;
use crate::endings::{ending_of, line};
use std::path::PathBuf;

fn path(index: usize) -> PathBuf {
    let name = format!("tests/attractors/stored/harvester-{index}.txt");
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Writes the endings of all starts of a harvester.
pub fn write(index: usize, endings: &[Ending]) {
    let path = path(index);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text(endings)).unwrap();
}

/// Returns the endings of all starts of a harvester, if they are stored.
pub fn read(index: usize) -> Option<Vec<Ending>> {
    Some(parsed(&std::fs::read_to_string(path(index)).ok()?))
}

fn text(endings: &[Ending]) -> String {
    let groups = groups(endings);
    let mut text = String::new();
    for group in &groups {
        text += &format!("{}\n", line(&endings[group[0]]));
    }
    let number = |start: usize| {
        groups
            .iter()
            .position(|group| group.contains(&start))
            .unwrap()
    };
    let numbers: Vec<String> = (0..endings.len())
        .map(|start| number(start).to_string())
        .collect();
    text + &numbers.join(" ") + "\n"
}

fn parsed(text: &str) -> Vec<Ending> {
    let lines: Vec<&str> = text.lines().collect();
    let (starts, attractors) = lines.split_last().unwrap();
    let attractors: Vec<Ending> = attractors
        .iter()
        .map(|line| ending_of(line).unwrap())
        .collect();
    let number = |text: &str| text.parse::<usize>().unwrap();
    starts
        .split(' ')
        .map(|text| attractors[number(text)].clone())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brute::Kind;

    fn ending(kind: Kind, mean_power_w: f64) -> Ending {
        Ending {
            kind,
            mean_power_w,
            strobe: vec![vec![1.0 / 3.0, mean_power_w], vec![0.5, 5e7 / 3.0]],
            size: 7.0_f64.sqrt(),
            power_scale_w: 1e-9 / 7.0,
            exponent: None,
            cycles: 477,
        }
    }

    #[test]
    fn stored_endings_are_read_as_written() {
        let all = [
            ending(Kind::Periodic(2), 0.1),
            ending(Kind::Chaos, 0.2),
            ending(Kind::Periodic(2), 0.1),
            ending(Kind::Periodic(2), 0.3),
        ];
        assert_eq!(format!("{:?}", parsed(&text(&all))), format!("{all:?}"));
    }
}
