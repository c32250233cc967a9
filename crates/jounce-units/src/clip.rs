//! Texts from the user in messages.

/// Characters of a text that a message shows.
const MAX_QUOTED_CHARS: usize = 64;

/// A text from the user, short enough for a message.
pub fn clip(text: &str) -> String {
    let mut clipped = String::new();
    for (count, c) in text.chars().enumerate() {
        match c {
            _ if count == MAX_QUOTED_CHARS => {
                clipped.push_str("...");
                break;
            }
            // A control character would garble the terminal that shows the message.
            c if c.is_control() => clipped.extend(c.escape_debug()),
            c => clipped.push(c),
        }
    }
    clipped
}
