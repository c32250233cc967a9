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
pub(super) fn place(channel: &Channel) -> String {
    [channel.place.as_str(), channel.direction.as_str()]
        .join(" ")
        .trim()
        .to_owned()
}

/// Groups by location, in order of first occurrence. If no recording gives its location, or those
/// that do give the same one, it is assumed for all, with an issue.
pub(super) fn references<'a>(
    records: &'a [Recording],
    chosen: &ChannelChoice,
) -> Result<(Vec<ReferenceRecords<'a>>, Option<Issue>), ResponseError> {
    let told = records
        .iter()
        .map(|record| Ok(place(input(record, chosen)?)))
        .collect::<Result<Vec<String>, ResponseError>>()?;
    let mut names: Vec<&String> = Vec::new();
    for name in told.iter().filter(|name| !name.is_empty()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let silent: Vec<String> = told
        .iter()
        .zip(records)
        .filter(|(name, _)| name.is_empty())
        .map(|(_, record)| record.name.clone())
        .collect();
    if names.len() > 1 && !silent.is_empty() {
        return Err(ResponseError::Places {
            places: names.into_iter().cloned().collect(),
            silent,
        });
    }
    let about = "recordings do not give the place of the force; one place is assumed for all, \
        give the place in their notes";
    let finding = (!silent.is_empty() && records.len() > 1).then(|| {
        Issue::new(
            IssueKind::Assumed,
            silent.len(),
            None,
            format!("{} of {} {about}", silent.len(), records.len()),
        )
    });
    let numbered = || records.iter().enumerate();
    let found = match names[..] {
        [] => {
            let name = records
                .first()
                .map(|record| input(record, chosen))
                .transpose()?
                .map_or_else(String::new, |input| input.name.clone());
            vec![ReferenceRecords {
                name,
                records: numbered().collect(),
            }]
        }
        [name] => vec![ReferenceRecords {
            name: name.clone(),
            records: numbered().collect(),
        }],
        _ => {
            let of = |name: &&String| numbered().filter(|(k, _)| told[*k] == **name).collect();
            names
                .iter()
                .map(|name| ReferenceRecords {
                    name: (*name).clone(),
                    records: of(name),
                })
                .collect()
        }
    };
    Ok((found, finding))
}

/// Refuses sensors with one name at two locations.
pub(super) fn check_sensors(records: &[Recording], names: &[String]) -> Result<(), ResponseError> {
    for name in names {
        let mut first: Option<(String, &str)> = None;
        for record in records {
            let here = place(record.channel(name)?);
            match &first {
                None if !here.is_empty() => first = Some((here, &record.name)),
                Some((there, recording)) if !here.is_empty() && here != *there => {
                    let places = [
                        format!("{there} in {recording}"),
                        format!("{here} in {}", record.name),
                    ];
                    return Err(ResponseError::Moved {
                        channel: name.clone(),
                        places,
                    });
                }
                _ => {}
            }
        }
    }
    Ok(())
}
