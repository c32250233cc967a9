//! Comparison of a picture with the file in the folder of its example.

use crate::rows::folder;
use jounce_plot::Figure;

/// Coordinates have two decimals; another machine may round the last one differently.
const ALLOWED_PX: f64 = 0.05;

/// Compares a figure with the stored one, or stores it where `JOUNCE_DRAW` is set.
pub fn check(example: &str, name: &str, figure: &Figure) {
    let path = folder(example).join(name).with_extension("svg");
    let drawn = figure.to_svg().unwrap();
    if std::env::var_os("JOUNCE_DRAW").is_some() {
        std::fs::write(&path, drawn).unwrap();
        return;
    }
    let stored = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    if let Some((new_piece, stored_piece)) = difference(&drawn, &stored) {
        panic!(
            "{}: drawn {new_piece:?}, kept {stored_piece:?}; draw it again with JOUNCE_DRAW=1",
            path.display()
        );
    }
}

/// Returns the first pieces of two texts that differ by more than rounding.
fn difference<'t>(one: &'t str, other: &'t str) -> Option<(&'t str, &'t str)> {
    let pieces = |text: &'t str| {
        text.split([' ', '"', 'L', 'M', '>', '<'])
            .collect::<Vec<&str>>()
    };
    let (one, other) = (pieces(one), pieces(other));
    if one.len() != other.len() {
        return Some(("as many pieces", "others"));
    }
    let same = |a: &str, b: &str| {
        a == b
            || matches!((a.parse::<f64>(), b.parse::<f64>()), (Ok(a), Ok(b)) if (a - b).abs() < ALLOWED_PX)
    };
    one.into_iter().zip(other).find(|(a, b)| !same(a, b))
}

#[test]
fn only_rounding_is_allowed() {
    assert_eq!(
        difference("<path d=\"M1 2L3 4\"/>", "<path d=\"M1.01 2L3 3.99\"/>"),
        None
    );
    assert_eq!(
        difference("<path d=\"M1 2L3 4\"/>", "<path d=\"M1 2L3 4.2\"/>"),
        Some(("4", "4.2"))
    );
    assert_eq!(difference("<text>a", "<text>b"), Some(("a", "b")));
}
