//! Contact laws of the force pulses of a hammer.

mod options;
mod report;
mod result;

pub use options::ContactOptions;
pub use result::{ContactResult, FixedLawResult, ForceTableResult, HitResult};

use crate::error::Error;
use crate::recording::Recording;
use jounce_experiment::draw::PulseFigure;
use jounce_identification::contact::fit;
use jounce_signal::Samples;
use jounce_signal::spectral::{HitSearch, hits};

impl Recording {
    /// Finds the hits in a force and fits contact time, exponent and restitution of each; with the
    /// mass of the hammer also speed, stiffness and a table of force over penetration. The struck body is assumed to be at rest during
    /// a contact.
    ///
    /// # Errors
    /// [`Error::Option`], those of the choice of a channel, [`Error::Signal`], and
    /// [`Error::Spectral`] for a record without a hit.
    ///
    /// ```
    /// use jounce::{ContactOptions, Harvester, RigOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let hammer = Some("beam.hammer".to_owned());
    /// let test = RigOptions { hammer, hits: 1, contact_s: 8e-3, ..Default::default() };
    /// let recording = harvester.rig(&test)?.recording;
    /// let result = recording.contact(&ContactOptions::default())?;
    /// assert!((result.hits[0].contact_time_s / 8e-3 - 1.0).abs() < 0.1);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn contact(&self, options: &ContactOptions) -> Result<ContactResult, Error> {
        options.check()?;
        let record = self.load(options)?;
        let force = &record.channels[0];
        let samples = Samples::new(&force.values, record.rate())?;
        let search = HitSearch::default();
        let found = hits(&samples, search)?;
        let (mut hits, mut pulses, mut force_tables) = (Vec::new(), Vec::new(), Vec::new());
        for hit in &found {
            let law = fit(&samples, hit, options.mass_kg);
            pulses.push(PulseFigure::of(&samples, hit, law.as_ref().ok()));
            if let Some(mass_kg) = options.mass_kg {
                let body = (mass_kg, options.speed_m_s);
                force_tables.push(ForceTableResult::of(&samples, hit, &law, body));
            }
            let rate_hz = samples.rate_hz();
            hits.push(HitResult::new(hit, law, rate_hz, search.edge_ratio));
        }
        Ok(ContactResult {
            channel: force.name.clone(),
            mass_kg: options.mass_kg,
            hits,
            force_tables,
            issues: record.issues,
            pulses,
        })
    }
}
