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
fn ids(answer: &DiagramResult) -> Vec<&str> {
    let of = |k: usize| {
        let history = answer.history.as_ref()?;
        Some(history.attractors[history.homes[k]?].id.as_str())
    };
    (0..answer.visits.len())
        .map(|k| of(k).unwrap_or_default())
        .collect()
}

/// Prints the result as one JSON object on stdout.
pub fn json(key: &NumericKey, answer: &DiagramResult) {
    let ids = ids(answer);
    let points: Vec<_> = (answer.visits.iter().zip(&ids))
        .map(|(visit, id)| {
            serde_json::json!({
                "parameter": visit.parameter,
                "direction": visit.direction,
                "start": visit.start,
                "attractor": (!id.is_empty()).then_some(id),
                "motion": visit.motion,
                "period_cycles": visit.period_cycles,
                "contacts_per_period": visit.contacts_per_period,
                "mean_power_w": visit.mean_power_w,
                "section": visit.section,
            })
        })
        .collect();
    let attractors = answer.history.as_ref().map(|history| &history.attractors);
    print(
        &serde_json::json!({ "over": key.path(), "unit": key.unit(), "points": points, "attractors": attractors }),
    );
}

/// Prints the result as lines of text.
pub fn text(key: &NumericKey, answer: &DiagramResult) {
    if let Some(history) = &answer.history {
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
    for visit in &answer.visits {
        line(format!(
            "{:>14.6}  {:<11}  {:<9}  {:>6}  {:>8}    {:.6e}",
            visit.parameter,
            visit.direction.name(),
            visit.motion.name(),
            visit.period_cycles,
            visit.contacts_per_period,
            visit.mean_power_w
        ));
    }
}

/// Formats one attractor: its range, its origin and its end.
fn life(key: &NumericKey, attractor: &AttractorTrack) {
    let (Some(first), Some(last)) = (attractor.seen.first(), attractor.seen.last()) else {
        return;
    };
    let unit = key.unit();
    let turn = |turn: &Option<Transition>, verb: &str, way: &str| {
        let other = |turn: &Transition| {
            turn.other
                .as_ref()
                .map_or_else(String::new, |other| format!(" {way} {other}"))
        };
        turn.as_ref().map_or_else(String::new, |turn| {
            format!(", {verb} at {} {unit}{}", turn.parameter, other(turn))
        })
    };
    line(format!(
        "{:<12} {:<9} from {} to {} {unit}, {:.3e} to {:.3e} W{}{}",
        attractor.id,
        attractor.motion.name(),
        first.parameter,
        last.parameter,
        first.mean_power_w,
        last.mean_power_w,
        turn(&attractor.born, "born", "off"),
        turn(&attractor.died, "gone", "to")
    ));
}

/// Returns a table with one row for each point of the section.
pub fn points(key: &NumericKey, answer: &DiagramResult) -> Result<Table, Failure> {
    let ids = ids(answer);
    let all: Vec<(&DiagramPoint, &str, &SectionPoint)> = (answer.visits.iter().zip(&ids))
        .flat_map(|(visit, id)| visit.section.iter().map(move |point| (visit, *id, point)))
        .collect();
    let number =
        |name: &str, unit: &str, about: &str, value: fn(&DiagramPoint, &SectionPoint) -> f64| {
            Column::new(
                name,
                unit,
                about,
                all.iter()
                    .map(|(visit, _, point)| value(visit, point))
                    .collect::<Vec<f64>>(),
            )
        };
    let count = |name: &str, about: &str, value: fn(&DiagramPoint) -> u64| {
        Column::new(
            name,
            "",
            about,
            all.iter()
                .map(|(visit, ..)| value(visit))
                .collect::<Vec<u64>>(),
        )
    };
    let text = |name: &str, about: &str, value: &dyn Fn(&DiagramPoint, &str) -> String| {
        Column::new(
            name,
            "",
            about,
            all.iter()
                .map(|(visit, id, _)| value(visit, id))
                .collect::<Vec<String>>(),
        )
    };
    Ok(Table::new(vec![
        number("parameter", &key.unit(), key.path(), |visit, _| {
            visit.parameter
        }),
        text("direction", "direction of the sweep", &|visit, _| {
            visit.direction.name().to_owned()
        }),
        count("start", "number of the start in its cloud", |visit| {
            visit.start as u64
        }),
        text(
            "attractor",
            "id of the attractor, with --direction starts only",
            &|_, id| id.to_owned(),
        ),
        text("motion", "orbit, chaos, torus or undecided", &|visit, _| {
            visit.motion.name().to_owned()
        }),
        count(
            "period_cycles",
            "period in drive cycles, 0 without a period",
            |visit| u64::from(visit.period_cycles),
        ),
        count(
            "contacts_per_period",
            "contacts per period, 0 without a period",
            |visit| visit.contacts_per_period,
        ),
        number(
            "mean_power_w",
            "W",
            "mean power of all loads",
            |visit, _| visit.mean_power_w,
        ),
        number(
            "displacement_m",
            "m",
            "displacement towards the stop at the start of a drive cycle",
            |_, point| point.displacement_m,
        ),
        number(
            "velocity_m_per_s",
            "m/s",
            "velocity towards the stop",
            |_, point| point.velocity_m_per_s,
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
    let all: Vec<(&AttractorTrack, &TrackPoint)> = history
        .attractors
        .iter()
        .flat_map(|attractor| attractor.seen.iter().map(move |seen| (attractor, seen)))
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: fn(&TrackPoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            all.iter()
                .map(|(_, seen)| value(seen))
                .collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "id",
            "",
            "id of the attractor",
            all.iter()
                .map(|(attractor, _)| attractor.id.clone())
                .collect::<Vec<_>>(),
        ),
        number("parameter", &key.unit(), key.path(), |seen| seen.parameter),
        number("mean_power_w", "W", "mean power of all loads", |seen| {
            seen.mean_power_w
        }),
        number("fraction", "", "share of the starts", |seen| seen.fraction),
        number(
            "fraction_low",
            "",
            "lower end of the 95 % interval of the share",
            |seen| seen.fraction_low,
        ),
        number(
            "fraction_high",
            "",
            "upper end of the 95 % interval of the share",
            |seen| seen.fraction_high,
        ),
    ])?)
}
