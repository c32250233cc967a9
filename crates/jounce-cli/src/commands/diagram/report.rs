//! Result of `jounce diagram` as JSON, as text and as tables.

use super::DiagramResult;
use crate::failure::Failure;
use crate::output::{line, print};
use jounce_core::analysis::{
    AttractorTrack, AttractorTracks, DiagramPoint, SectionPoint, TrackPoint, Transition,
};
use jounce_core::spec::NumericKey;
use jounce_core::table::{Column, Table};

/// Returns the attractor id of each point; empty without a history, or for a failed run.
fn ids(result: &DiagramResult) -> Vec<&str> {
    let attractor_id = |k: usize| {
        let history = result.history.as_ref()?;
        Some(history.attractors[history.homes[k]?].id.as_str())
    };
    (0..result.points.len())
        .map(|k| attractor_id(k).unwrap_or_default())
        .collect()
}

/// Prints the result as one JSON object on stdout.
pub fn json(key: &NumericKey, result: &DiagramResult) {
    let ids = ids(result);
    let points: Vec<_> = (result.points.iter().zip(&ids))
        .map(|(point, id)| {
            serde_json::json!({
                "parameter": point.parameter,
                "direction": point.direction,
                "start": point.start,
                "attractor": (!id.is_empty()).then_some(id),
                "motion": point.motion,
                "period_cycles": point.period_cycles,
                "contacts_per_period": point.contacts_per_period,
                "mean_power_w": point.mean_power_w,
                "section": point.section,
            })
        })
        .collect();
    let attractors = result.history.as_ref().map(|history| &history.attractors);
    print(
        &serde_json::json!({ "over": key.path(), "unit": key.unit(), "points": points, "attractors": attractors }),
    );
}

/// Prints the result as lines of text.
pub fn text(key: &NumericKey, result: &DiagramResult) {
    if let Some(history) = &result.history {
        history
            .attractors
            .iter()
            .for_each(|attractor| life(key, attractor));
        return;
    }
    line(format!(
        "{:>14}  direction    motion     period  contacts    mean_power_w",
        format!("parameter [{}]", key.unit())
    ));
    for point in &result.points {
        line(format!(
            "{:>14.6}  {:<11}  {:<9}  {:>6}  {:>8}    {:.6e}",
            point.parameter,
            point.direction.name(),
            point.motion.name(),
            point.period_cycles,
            point.contacts_per_period,
            point.mean_power_w
        ));
    }
}

/// Formats one attractor: its range, its origin and its end.
fn life(key: &NumericKey, attractor: &AttractorTrack) {
    let (Some(first_point), Some(last_point)) = (attractor.seen.first(), attractor.seen.last())
    else {
        return;
    };
    let unit = key.unit();
    let transition = |transition: &Option<Transition>, verb: &str, preposition: &str| {
        let other = |transition: &Transition| {
            transition
                .other
                .as_ref()
                .map_or_else(String::new, |other| format!(" {preposition} {other}"))
        };
        transition.as_ref().map_or_else(String::new, |transition| {
            format!(
                ", {verb} at {} {unit}{}",
                transition.parameter,
                other(transition)
            )
        })
    };
    line(format!(
        "{:<12} {:<9} from {} to {} {unit}, {:.3e} to {:.3e} W{}{}",
        attractor.id,
        attractor.motion.name(),
        first_point.parameter,
        last_point.parameter,
        first_point.mean_power_w,
        last_point.mean_power_w,
        transition(&attractor.born, "born", "off"),
        transition(&attractor.died, "gone", "to")
    ));
}

/// Returns a table with one row for each point of the section.
pub fn points(key: &NumericKey, result: &DiagramResult) -> Result<Table, Failure> {
    let ids = ids(result);
    let rows: Vec<(&DiagramPoint, &str, &SectionPoint)> = (result.points.iter().zip(&ids))
        .flat_map(|(point, id)| {
            point
                .section
                .iter()
                .map(move |section_point| (point, *id, section_point))
        })
        .collect();
    let number =
        |name: &str, unit: &str, about: &str, value: fn(&DiagramPoint, &SectionPoint) -> f64| {
            Column::new(
                name,
                unit,
                about,
                rows.iter()
                    .map(|(point, _, section_point)| value(point, section_point))
                    .collect::<Vec<f64>>(),
            )
        };
    let count = |name: &str, about: &str, value: fn(&DiagramPoint) -> u64| {
        Column::new(
            name,
            "",
            about,
            rows.iter()
                .map(|(point, ..)| value(point))
                .collect::<Vec<u64>>(),
        )
    };
    let text = |name: &str, about: &str, value: &dyn Fn(&DiagramPoint, &str) -> String| {
        Column::new(
            name,
            "",
            about,
            rows.iter()
                .map(|(point, id, _)| value(point, id))
                .collect::<Vec<String>>(),
        )
    };
    Ok(Table::new(vec![
        number("parameter", &key.unit(), key.path(), |point, _| {
            point.parameter
        }),
        text("direction", "direction of the sweep", &|point, _| {
            point.direction.name().to_owned()
        }),
        count("start", "number of the start in its cloud", |point| {
            point.start as u64
        }),
        text(
            "attractor",
            "id of the attractor, with --direction starts only",
            &|_, id| id.to_owned(),
        ),
        text("motion", "orbit, chaos, torus or undecided", &|point, _| {
            point.motion.name().to_owned()
        }),
        count(
            "period_cycles",
            "period in drive cycles, 0 without a period",
            |point| u64::from(point.period_cycles),
        ),
        count(
            "contacts_per_period",
            "contacts per period, 0 without a period",
            |point| point.contacts_per_period,
        ),
        number(
            "mean_power_w",
            "W",
            "mean power of all loads",
            |point, _| point.mean_power_w,
        ),
        number(
            "displacement_m",
            "m",
            "displacement towards the stop at the start of a drive cycle",
            |_, section_point| section_point.displacement_m,
        ),
        number(
            "velocity_m_per_s",
            "m/s",
            "velocity towards the stop",
            |_, section_point| section_point.velocity_m_per_s,
        ),
        number(
            "voltage_v",
            "V",
            "voltage of the first patch",
            |_, point| point.voltage_v,
        ),
    ])?)
}

/// Returns a table with one row for each attractor at each value.
pub fn attractors(key: &NumericKey, history: &AttractorTracks) -> Result<Table, Failure> {
    let samples: Vec<(&AttractorTrack, &TrackPoint)> = history
        .attractors
        .iter()
        .flat_map(|attractor| attractor.seen.iter().map(move |sample| (attractor, sample)))
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: fn(&TrackPoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            samples
                .iter()
                .map(|(_, sample)| value(sample))
                .collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "id",
            "",
            "id of the attractor",
            samples
                .iter()
                .map(|(attractor, _)| attractor.id.clone())
                .collect::<Vec<_>>(),
        ),
        number("parameter", &key.unit(), key.path(), |sample| {
            sample.parameter
        }),
        number("mean_power_w", "W", "mean power of all loads", |sample| {
            sample.mean_power_w
        }),
        number("fraction", "", "share of the starts", |sample| {
            sample.fraction
        }),
        number(
            "fraction_low",
            "",
            "lower end of the 95 % interval of the share",
            |sample| sample.fraction_low,
        ),
        number(
            "fraction_high",
            "",
            "upper end of the 95 % interval of the share",
            |sample| sample.fraction_high,
        ),
    ])?)
}
