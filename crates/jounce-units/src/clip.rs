//! User text in messages.

/// Largest number of characters of a user text in a message.
const MAX_QUOTED_CHARS: usize = 64;

/// Returns a user text, shortened for a message.
pub fn clip(text: &str) -> String {
    let mut clipped = String::new();
    for (count, c) in text.chars().enumerate() {
        match c {
            _ if count == MAX_QUOTED_CHARS => {
                clipped.push_str("...");
                break;
            }
            // A control character would corrupt the terminal that shows the message.
            c if c.is_control() => clipped.extend(c.escape_debug()),
            c => clipped.push(c),
        }
    }
    clipped
}
