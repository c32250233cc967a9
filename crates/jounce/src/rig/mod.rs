//! Virtual test rig: simulated recordings of the sensors of a test.

mod hammer;
mod options;
mod result;
mod shaker;

pub use options::RigOptions;
pub use result::{BaseMotion, RigResult};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::modes::held_masses;

impl Harvester {
    /// Simulates the recordings of sensors in a test, so that the true parameters are known: the
    /// averaging window of the run, coexisting solutions, a recorded base motion, or a hammer test.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Rig`], [`Error::Solution`], and [`Error::Stopped`] after a stop
    /// by the control.
    ///
    /// ```
    /// use jounce::{Harvester, RigOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let hammer = Some("beam.hammer".to_owned());
    /// let test = RigOptions { hammer, hits: 1, rate_hz: 512.0, contact_s: 8e-3, ..Default::default() };
    /// let result = harvester.rig(&test)?;
    /// assert_eq!(result.samples, 2048);
    /// assert_eq!(result.channels[0], "force");
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn rig(&self, options: &RigOptions) -> Result<RigResult, Error> {
        options.check()?;
        let mut spec = self.spec().clone();
        // Masses of the model are fixed, masses of the instruments are free.
        let fixed = held_masses(&spec, &options.hold, options.fixed_table);
        options.add_instruments(&mut spec)?;
        match &options.hammer {
            Some(point) => {
                let recording = hammer::record(spec, point, &fixed, options)?;
                Ok(RigResult::new(recording, None, options.seed))
            }
            None => shaker::record(self, spec, &fixed, options),
        }
    }
}
