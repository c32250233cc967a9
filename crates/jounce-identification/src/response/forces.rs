//! Groups recordings of a hammer or shaker test by the location of their input.

use super::excitation::input;
use super::{ChannelChoice, ResponseError};
use jounce_data::recording::{Channel, Issue, IssueKind, Recording};

/// Recordings of one force location.
pub(super) struct ReferenceRecords<'a> {
    /// Location and direction; the force channel if neither is given.
    pub name: String,
    /// Recordings with their indices.
    pub records: Vec<(usize, &'a Recording)>,
}

/// Location and direction of a sensor as text; empty if not given.
pub(super) fn force_position(channel: &Channel) -> String {
    [channel.place.as_str(), channel.direction.as_str()]
        .join(" ")
        .trim()
        .to_owned()
}

/// Groups by location, in order of first occurrence. If no recording gives its location, or those
/// that do give the same one, it is assumed for all, with an issue.
pub(super) fn references<'a>(
    records: &'a [Recording],
    choice: &ChannelChoice,
) -> Result<(Vec<ReferenceRecords<'a>>, Option<Issue>), ResponseError> {
    let positions = records
        .iter()
        .map(|record| Ok(force_position(input(record, choice)?)))
        .collect::<Result<Vec<String>, ResponseError>>()?;
    let names = unique(positions.iter().filter(|name| !name.is_empty()).cloned());
    let missing: Vec<String> = positions
        .iter()
        .zip(records)
        .filter(|(name, _)| name.is_empty())
        .map(|(_, record)| record.name.clone())
        .collect();
    if names.len() > 1 && !missing.is_empty() {
        return Err(ResponseError::Places {
            places: names,
            silent: missing,
        });
    }
    let issue = assumed_place_issue(missing.len(), records.len());
    let all = || records.iter().enumerate();
    let one_place = |name: String| {
        vec![ReferenceRecords {
            name,
            records: all().collect(),
        }]
    };
    let result = match &names[..] {
        [] => one_place(match records.first() {
            Some(record) => input(record, choice)?.name.clone(),
            None => String::new(),
        }),
        [name] => one_place(name.clone()),
        _ => {
            let at_place = |name: &String| ReferenceRecords {
                name: name.clone(),
                records: all().filter(|(k, _)| positions[*k] == *name).collect(),
            };
            names.iter().map(at_place).collect()
        }
    };
    Ok((result, issue))
}

/// Reports that recordings without a place are assigned to that of the others.
fn assumed_place_issue(missing: usize, recordings: usize) -> Option<Issue> {
    let message = "recordings do not give the place of the force; one place is assumed for all, \
        give the place in their notes";
    (missing > 0 && recordings > 1).then(|| {
        Issue::new(
            IssueKind::Assumed,
            missing,
            None,
            format!("{missing} of {recordings} {message}"),
        )
    })
}

/// Different names in order of first occurrence.
pub(super) fn unique(all: impl Iterator<Item = String>) -> Vec<String> {
    let mut result: Vec<String> = Vec::new();
    for one in all {
        if !result.contains(&one) {
            result.push(one);
        }
    }
    result
}

/// Refuses sensors with one name at two locations.
pub(super) fn check_sensors(records: &[Recording], names: &[String]) -> Result<(), ResponseError> {
    for name in names {
        let mut first: Option<(String, &str)> = None;
        for record in records {
            let position = force_position(record.channel(name)?);
            match &first {
                None if !position.is_empty() => first = Some((position, &record.name)),
                Some((first_position, recording))
                    if !position.is_empty() && position != *first_position =>
                {
                    let positions = [
                        format!("{first_position} in {recording}"),
                        format!("{position} in {}", record.name),
                    ];
                    return Err(ResponseError::Moved {
                        channel: name.clone(),
                        places: positions,
                    });
                }
                _ => {}
            }
        }
    }
    Ok(())
}
