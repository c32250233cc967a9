//! Plane of starts for basins of attraction, sized by the motion of the design.

use super::Design;
use crate::basins::BasinsOptions;
use crate::error::Error;
use crate::periodic;

/// Half width of the plane, in sizes of the motion (steady amplitude or gap).
const HALF_WIDTH: f64 = 5.0;
/// Smallest and largest number of starts.
const STARTS: std::ops::RangeInclusive<usize> = 4..=6561;

impl Design {
    /// Returns options whose starts form a square plane of displacement and velocity towards the
    /// stop instead of a cloud, with at most as many starts.
    ///
    /// # Errors
    /// [`Error::Option`] for a number of starts that is not allowed, [`Error::NoDrive`] and
    /// [`Error::DriveAtRest`], [`Error::Analysis`] for a design without a model.
    ///
    /// ```
    /// use jounce::{BasinsOptions, Harvester, live::Design};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let design = Design::new(&harvester, &[])?;
    /// let options = BasinsOptions { starts: 225, ..Default::default() };
    /// let plane = design.in_plane(&options)?;
    /// assert!(plane.grid[1].starts_with("velocity=-") && plane.grid[1].ends_with(":15x"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn in_plane(&self, options: &BasinsOptions) -> Result<BasinsOptions, Error> {
        let (starts, default) = (options.starts, BasinsOptions::default());
        if !STARTS.contains(&starts) {
            let expected = format!("it must be from {} to {}", STARTS.start(), STARTS.end());
            return Err(Error::option("starts", starts, expected));
        }
        self.drive_frequency_hz()?;
        let base = self.harvester().model()?;
        let plant = &base.kernel.plant;
        periodic::check_drives(plant, "a basin")?;
        let displacement_m = HALF_WIDTH * plant.scale_m();
        let tone = plant.tones.first();
        let velocity_m_s = displacement_m * tone.map_or(0.0, |tone| tone.angular_frequency_rad_s);
        let side = starts.isqrt();
        Ok(BasinsOptions {
            grid: vec![
                format!("displacement=-{displacement_m}m:{displacement_m}m:{side}x"),
                format!("velocity=-{velocity_m_s}m/s:{velocity_m_s}m/s:{side}x"),
            ],
            starts: default.starts,
            ..options.clone()
        })
    }

    /// Returns the frequency of the first drive, Hz.
    ///
    /// # Errors
    /// [`Error::NoDrive`], [`Error::Analysis`] for an aperiodic drive.
    pub fn drive_frequency_hz(&self) -> Result<f64, Error> {
        Ok(periodic::frequency(self.harvester(), "a basin")?.1)
    }
}
