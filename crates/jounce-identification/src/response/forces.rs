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
    let mut names: Vec<&String> = Vec::new();
    for name in positions.iter().filter(|name| !name.is_empty()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let missing: Vec<String> = positions
        .iter()
        .zip(records)
        .filter(|(name, _)| name.is_empty())
        .map(|(_, record)| record.name.clone())
        .collect();
    if names.len() > 1 && !missing.is_empty() {
        return Err(ResponseError::Places {
            places: names.into_iter().cloned().collect(),
            silent: missing,
        });
    }
    let message = "recordings do not give the place of the force; one place is assumed for all, \
        give the place in their notes";
    let issue = (!missing.is_empty() && records.len() > 1).then(|| {
        Issue::new(
            IssueKind::Assumed,
            missing.len(),
            None,
            format!("{} of {} {message}", missing.len(), records.len()),
        )
    });
    let enumerated = || records.iter().enumerate();
    let result = match names[..] {
        [] => {
            let name = records
                .first()
                .map(|record| input(record, choice))
                .transpose()?
                .map_or_else(String::new, |input| input.name.clone());
            vec![ReferenceRecords {
                name,
                records: enumerated().collect(),
            }]
        }
        [name] => vec![ReferenceRecords {
            name: name.clone(),
            records: enumerated().collect(),
        }],
        _ => {
            let records_of = |name: &&String| {
                enumerated()
                    .filter(|(k, _)| positions[*k] == **name)
                    .collect()
            };
            names
                .iter()
                .map(|name| ReferenceRecords {
                    name: (*name).clone(),
                    records: records_of(name),
                })
                .collect()
        }
    };
    Ok((result, issue))
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
