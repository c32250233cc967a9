//! Search for the best design, with each better one as soon as it is found.

use super::DesignFields;
use crate::design::DesignOptions;
use crate::error::Error;
use crate::live::Design;
use jounce_control::Control;
use jounce_design::{DesignOutcome, Improvement};
use serde::Serialize;
use std::collections::BTreeMap;

/// A better design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BetterDesign {
    /// The design with its goal and its limits.
    #[serde(flatten)]
    pub improvement: Improvement,
    /// Values of the free keys in the units of their controls.
    pub shown: Vec<(String, String)>,
}

/// The best design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundDesign {
    /// Result of the search.
    #[serde(flatten)]
    pub outcome: DesignOutcome,
    /// Values of the free keys in the units of their controls.
    pub shown: Vec<(String, String)>,
    /// Message where no design keeps all limits.
    pub violation_text: Option<String>,
}

impl Design {
    /// Searches for the best design, as `jounce design` does with the file of the fields. `better`
    /// is called with each better design as soon as it is found. All cores work on the search.
    ///
    /// # Errors
    /// [`Error::Design`] with all faults of the fields, or where no design can be evaluated;
    /// [`Error::Stopped`] before the first design.
    ///
    /// ```
    /// use jounce::{Control, Harvester, live::{Design, DesignFields}};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let fields = DesignFields {
    ///     free: vec![("circuit.load.resistance".into(), "10 kohm:3 Mohm:log".into())],
    ///     maximise: "expected-power".into(),
    ///     starts: "4".into(),
    ///     evaluations: "40".into(),
    ///     ..Default::default()
    /// };
    /// let design = Design::new(&harvester, &[])?;
    /// let found = design.search(&fields, &Control::default(), &|better| println!("{:?}", better.shown))?;
    /// assert!(found.outcome.best.expected_power_w > found.outcome.before.expected_power_w);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn search(
        &self,
        fields: &DesignFields,
        control: &Control,
        better: &(dyn Fn(BetterDesign) + Sync),
    ) -> Result<FoundDesign, Error> {
        let problem = self.harvester().design(&fields.text(None))?;
        let units = self.units();
        let report = |improvement: &Improvement| {
            better(BetterDesign {
                shown: self.shown(&units, &improvement.set),
                improvement: improvement.clone(),
            });
        };
        let options = DesignOptions::default();
        let found = problem
            .with_control(control)
            .run_and_report(&options, &report)?;
        let violation_text = (!found.outcome.feasible).then(|| found.violation_text());
        Ok(FoundDesign {
            shown: self.shown(&units, &found.outcome.best.set),
            violation_text,
            outcome: found.outcome,
        })
    }

    /// Returns the unit of each control with its size, SI.
    fn units(&self) -> BTreeMap<String, (String, f64)> {
        let controls = self.controls().into_iter();
        controls
            .map(|control| (control.key, (control.unit, control.factor)))
            .collect()
    }

    /// Returns values in the units of their controls.
    fn shown(
        &self,
        units: &BTreeMap<String, (String, f64)>,
        set: &BTreeMap<String, String>,
    ) -> Vec<(String, String)> {
        let shown = |(key, text): (&String, &String)| {
            let value_si = self.key(key).ok().and_then(|own| own.read(text).ok());
            let text = match (value_si, units.get(key)) {
                (Some(value_si), Some((unit, factor))) if !unit.is_empty() => {
                    format!("{} {unit}", value_si / factor)
                }
                _ => text.clone(),
            };
            (key.clone(), text)
        };
        set.iter().map(shown).collect()
    }
}
