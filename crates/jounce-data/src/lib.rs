//! Recordings: channels in SI units, and readers of instrument files.
//!
//! ```
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("floor.csv");
//! std::fs::write(&path, "time (ms),floor (g)\n0,0.5\n1,-0.5\n2,0.5\n")?;
//! let recording = jounce_data::read::record(&path)?;
//! assert_eq!((recording.rate(), recording.channel("floor")?.values[0]), (1000.0, 4.903325));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod read;
pub mod recording;

pub mod write;
