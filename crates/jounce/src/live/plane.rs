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
    /// stop instead of a cloud, with at most as many starts. `grid` may have the ends of both sides,
    /// `displacement=FROM:TO`; a side without them has the size of the motion.
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
    /// let grid = vec!["displacement=0 mm:2 mm".to_owned()];
    /// let plane = design.in_plane(&BasinsOptions { grid, ..options })?;
    /// assert_eq!(plane.grid[0], "displacement=0 mm:2 mm:15x");
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
        let of = |name: &str, half_width: f64, unit: &str| {
            let is_own = |text: &&String| text.split('=').next() == Some(name);
            let own = options.grid.iter().find(is_own).cloned();
            let ends =
                own.unwrap_or_else(|| format!("{name}=-{half_width}{unit}:{half_width}{unit}"));
            format!("{ends}:{side}x")
        };
        Ok(BasinsOptions {
            grid: vec![
                of("displacement", displacement_m, "m"),
                of("velocity", velocity_m_s, "m/s"),
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
