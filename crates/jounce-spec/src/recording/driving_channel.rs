//! Selects the channel of a recording that drives a base or a point.

use jounce_data::recording::{ChannelHead, Issue, IssueKind, Quantity, find_channel};

use super::RecordingError;

/// Returns the number of the driving channel: the channel with the given name or number. Without a
/// name it is the only varying channel of the quantity, or the only varying channel without a unit.
///
/// # Errors
/// The named channel does not exist, or no channel fits, or several do.
pub fn driving_channel(
    (recording, heads, issues): (&str, &[ChannelHead<'_>], &[Issue]),
    channel: Option<&str>,
    quantity: Quantity,
) -> Result<usize, RecordingError> {
    if let Some(channel) = channel {
        return Ok(find_channel(recording, heads, channel)?);
    }
    let is_constant = |name: &str| {
        issues
            .iter()
            .any(|f| f.kind == IssueKind::Constant && f.channel.as_deref() == Some(name))
    };
    let moves = |k: &usize| !is_constant(heads[*k].name);
    let measuring: Vec<usize> = (0..heads.len())
        .filter(|k| heads[*k].quantity == quantity)
        .filter(moves)
        .collect();
    let silent = || {
        (0..heads.len())
            .filter(|k| heads[*k].may_be(quantity))
            .filter(moves)
            .collect()
    };
    let fitting = if measuring.is_empty() {
        silent()
    } else {
        measuring
    };
    let name = |head: &ChannelHead<'_>| {
        if head.has_unit() {
            format!("{} ({})", head.name, head.unit)
        } else {
            head.name.to_owned()
        }
    };
    match fitting[..] {
        [only] => Ok(only),
        [] => Err(RecordingError::None {
            channels: heads.iter().map(name).collect(),
            wanted: quantity.si_unit(),
        }),
        _ => Err(RecordingError::Several {
            channels: fitting.iter().map(|k| name(&heads[*k])).collect(),
        }),
    }
}
