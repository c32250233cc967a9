//! Names by rank.

/// Returns `a`, `b`, .., `z`, `aa`, ..
pub fn letters(place: usize) -> String {
    let last = char::from(b'a' + (place % 26) as u8);
    if place < 26 {
        last.to_string()
    } else {
        format!("{}{last}", letters(place / 26 - 1))
    }
}
