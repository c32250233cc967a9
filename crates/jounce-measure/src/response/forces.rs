//! Recordings of a hammer or shaker test by the place of their input.

use super::excitation::input;
use super::{ChannelChoice, ResponseError};
use jounce_data::recording::{Channel, Issue, IssueKind, Recording};

/// The recordings of one place of the force.
pub(super) struct ReferenceRecords<'a> {
    /// The place and the direction; the channel of the force where neither is told.
    pub name: String,
    /// The recordings with their numbers.
    pub records: Vec<(usize, &'a Recording)>,
}

/// Place and direction of a sensor as one text; empty where nothing is told.
pub(super) fn place(channel: &Channel) -> String {
    [channel.place.as_str(), channel.direction.as_str()]
        .join(" ")
        .trim()
        .to_owned()
}

/// The places in the order in which they first come. Where none of several recordings tells its place, or some do and tell one place, it is taken
/// for that of all, which is a finding.
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
    let about = "recordings do not tell where the force acts; it is taken to act at one place in all, give the place in the notes beside them";
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

/// Refuses sensors that one name stands for at two places.
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
