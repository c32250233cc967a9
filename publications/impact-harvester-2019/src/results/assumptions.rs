//! Assumptions that the paper does not specify: the default, the alternative, and the power at 13
//! Hz and 200 N with each.

use crate::harvester::{ABOVE_RESONANCE, PaperHarvester};
use crate::impact::long_run;
use crate::named::column;
use crate::{NamedTable, ReproduceError};
use jounce_control::Control;
use jounce_io::table::Table;
use jounce_model::structure::section::CrossSection;
use jounce_spec::Spec;
use rayon::prelude::*;

/// Question, default, alternative, keys to set for the alternative.
type Choice = (
    &'static str,
    &'static str,
    &'static str,
    &'static [(&'static str, &'static str)],
);

const CHOICES: [Choice; 13] = [
    ("all defaults", "", "", &[]),
    (
        "what the stop stands on",
        "ground (eq. 5 as printed)",
        "shaker table",
        &[("stop.tip.frame", "table")],
    ),
    (
        "damping of the 1 Hz table mode",
        "0.3",
        "0.05",
        &[("mass.table.damping_ratio", "0.05")],
    ),
    (
        "damping of the 1 Hz table mode",
        "0.3",
        "0.00194 (as mode 1)",
        &[("mass.table.damping_ratio", "0.00194")],
    ),
    (
        "stop and table damping together",
        "ground, 0.3",
        "shaker table, 0.00194",
        &[
            ("stop.tip.frame", "table"),
            ("mass.table.damping_ratio", "0.00194"),
        ],
    ),
    (
        "side of the stop",
        "positive",
        "negative",
        &[("stop.tip.side", "negative")],
    ),
    (
        "phase of the force at the start",
        "sine",
        "cosine",
        &[("drive.shaker.phase", "90 deg")],
    ),
    (
        "\"1 Hz rigid body mode\"",
        "table alone at 1 Hz",
        "coupled mode at 1 Hz",
        &[("mass.table.frequency", "1.0010692 Hz")],
    ),
    (
        "contact \"about 10 mm\" from the end",
        "10 mm",
        "11 mm",
        &[("beam.beam.point.tip", "304 mm")],
    ),
    (
        "patch \"about 9 mm\" from the root",
        "9 mm",
        "10 mm",
        &[("patch.mfc.start", "10 mm")],
    ),
    (
        "width of the patch",
        "30 mm (Table 1)",
        "28 mm (active width)",
        &[("patch.mfc.width", "28 mm")],
    ),
    (
        "bending stiffness under the patch",
        "thin skin (Table 2)",
        "laminate with patch mass",
        &[("patch.mfc.section", "laminate")],
    ),
    (
        "number of modes",
        "8",
        "9, ratio 0.0016",
        &[("reduction.modes", "9"), ("damping.beyond", "0.0016")],
    ),
];

/// One alternative and its results.
pub(crate) struct Variant {
    question: &'static str,
    default: &'static str,
    other: &'static str,
    /// Mean power over the last 10 s of 20 s and of the long run, W.
    pub power_w: [f64; 2],
    /// True where the run has settled, for each duration.
    pub settled: [bool; 2],
}

/// Runs every alternative.
pub(crate) fn variants(control: &Control) -> Result<Vec<Variant>, ReproduceError> {
    let owned = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    let mut choices: Vec<_> = CHOICES
        .iter()
        .map(|(question, default, other, keys)| {
            (
                *question,
                *default,
                *other,
                keys.iter().map(owned).collect(),
            )
        })
        .collect();
    let axis = (
        "effective neutral axis in eq. (2)",
        "of beam and patch",
        "mid-plane of the beam",
        mid_plane(&PaperHarvester::spec(&[])?),
    );
    choices.insert(choices.len() - 1, axis);
    choices
        .into_par_iter()
        .map(|(question, default, other, settings)| {
            Variant::compute((question, default, other), &settings, control)
        })
        .collect()
}

/// Returns the `d31` that gives the patch its moment about the mid-plane of the beam.
fn mid_plane(spec: &Spec) -> Vec<(String, String)> {
    let (beam, patch) = (&spec.beam["beam"], &spec.patch["mfc"]);
    let middle_m = beam.thickness_m + patch.thickness_m / 2.0;
    let lever_m = middle_m - CrossSection::covered(beam, std::iter::once(patch)).neutral_axis_m;
    let factor = (middle_m - beam.thickness_m / 2.0) / lever_m;
    vec![(
        "patch.mfc.d31".to_owned(),
        format!(
            "{} pC/N",
            patch.d31_m_per_v.unwrap_or_default() * factor * 1e12
        ),
    )]
}

impl Variant {
    fn compute(
        (question, default, other): (&'static str, &'static str, &'static str),
        settings: &[(String, String)],
        control: &Control,
    ) -> Result<Self, ReproduceError> {
        let harvester = PaperHarvester::with(settings, control)?;
        let (short, long) = (harvester.run(ABOVE_RESONANCE)?, long_run(&harvester)?);
        let power_w = [short.mean_power_w, long.mean_power_w];
        Ok(Self {
            question,
            default,
            other,
            power_w,
            settled: [short, long].map(|result| {
                result
                    .settlement
                    .is_some_and(|settlement| settlement.settled)
            }),
        })
    }
}

/// Returns the table of all alternatives.
pub(crate) fn table(variants: &[Variant]) -> Result<NamedTable, ReproduceError> {
    let default_w = variants
        .first()
        .map_or(f64::NAN, |variant| variant.power_w[0]);
    let table = Table::new(vec![
        column(
            variants,
            ("question", "", "What the paper leaves open"),
            |variant| variant.question.to_owned(),
        ),
        column(variants, ("default", "", "Our default"), |variant| {
            variant.default.to_owned()
        }),
        column(variants, ("other", "", "Other choice"), |variant| {
            variant.other.to_owned()
        }),
        column(
            variants,
            ("power_20_s_w", "W", "Mean power, last 10 of 20 s"),
            |variant| variant.power_w[0],
        ),
        column(variants, ("ratio", "", "Times the default"), |variant| {
            variant.power_w[0] / default_w
        }),
        column(variants, ("settled_20_s", "", "Settled"), |variant| {
            variant.settled[0]
        }),
        column(
            variants,
            ("power_100_s_w", "W", "Mean power, last 10 of 100 s"),
            |variant| variant.power_w[1],
        ),
        column(variants, ("settled_100_s", "", "Settled"), |variant| {
            variant.settled[1]
        }),
    ])?;
    Ok(NamedTable::new(
        "assumptions",
        "What changes at 13 Hz, 200 N and 1 MΩ with the other choice.",
        4,
        table,
    ))
}
