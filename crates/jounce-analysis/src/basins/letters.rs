//! Names by rank.

/// Returns `a`, `b`, .., `z`, `aa`, ..
pub fn letters(index: usize) -> String {
    let last = char::from(b'a' + (index % 26) as u8);
    if index < 26 {
        last.to_string()
    } else {
        format!("{}{last}", letters(index / 26 - 1))
    }
}
