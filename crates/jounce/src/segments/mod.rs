//! Segments of a recording: parts that show one attractor each.

mod options;
mod report;
mod result;

pub use options::SegmentsOptions;
pub use result::{SegmentResult, SegmentsResult};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::check_drive;
use crate::recording::Recording;
use jounce_experiment::segmentation::{
    RecordSegment, SegmentMatches, Segmentation, match_segments, segments_watched,
};
use jounce_experiment::solution::{as_recorded, solutions};
use jounce_signal::Samples;
use jounce_signal::spectral::{mean_power_if_long, signal};

impl Recording {
    /// Cuts a long recording under a harmonic drive into segments of one attractor each. With a
    /// model, set to the drive and the resistance of the recording, each segment is matched with
    /// the attractors of the model.
    ///
    /// # Errors
    /// [`Error::Option`], those of the choice of a channel, [`Error::Signal`],
    /// [`Error::Segmentation`], [`Error::Solution`], and [`Error::Stopped`] after a stop by the
    /// control.
    ///
    /// ```
    /// use jounce::{Harvester, RigOptions, SegmentsOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let mut harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// harvester.set("run.average_over", "4 s")?;
    /// let drive_hz = Some(harvester.get("drive.shaker.frequency")?.value_si);
    /// let recording = harvester.rig(&RigOptions { rate_hz: 512.0, ..Default::default() })?.recording;
    /// let result = recording.segments(None, &SegmentsOptions { drive_hz, ..Default::default() })?;
    /// assert_eq!(result.segments.len(), 1);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn segments(
        &self,
        model: Option<&Harvester>,
        options: &SegmentsOptions,
    ) -> Result<SegmentsResult, Error> {
        let drive_hz = options.check(model.is_some())?;
        let record = self.load(options)?;
        check_drive(drive_hz, record.rate(), (0.25, "a quarter of"))?;
        let channel = &record.channels[0];
        let samples = signal(channel, record.rate())?;
        let segmentation = segments_watched(&samples, drive_hz, self.control())?;
        let matches = match model {
            Some(model) => self.matches(model, options, &samples, &segmentation, drive_hz)?,
            None => Vec::new(),
        };
        let segment = |(number, segment): (usize, &RecordSegment)| {
            let part = Samples::new(&channel.values[segment.start..segment.end], record.rate())?;
            let power = (options.resistance_ohm)
                .map(|ohm| mean_power_if_long(&part, ohm, false))
                .transpose()?;
            let power = power.flatten();
            Ok(SegmentResult::new(segment, power, matches.get(number)))
        };
        let segments = segmentation.segments.iter().enumerate().map(segment);
        let segments = segments.collect::<Result<Vec<_>, Error>>()?;
        let places = record.grid.places();
        let first = places.first().copied().unwrap_or_default();
        Ok(SegmentsResult {
            channel: channel.name.clone(),
            unit: channel.unit.clone(),
            drive_hz,
            resistance_ohm: options.resistance_ohm,
            segments,
            joints: segmentation.joints.clone(),
            uncertainty_s: segmentation.uncertainty_s,
            rate_hz: record.rate(),
            time_s: places.iter().map(|place| place - first).collect(),
            values: channel.values.clone(),
            issues: record.issues,
            segmentation,
        })
    }

    /// Matches each segment with the attractors of a model.
    fn matches(
        &self,
        model: &Harvester,
        options: &SegmentsOptions,
        samples: &Samples<'_>,
        segmentation: &Segmentation,
        drive_hz: f64,
    ) -> Result<Vec<SegmentMatches>, Error> {
        let mut spec = model.spec().clone();
        let load = options.load.as_deref();
        as_recorded(&mut spec, drive_hz, options.resistance_ohm, load);
        let known = solutions(&spec, &options.search(), self.control())?;
        // A stopped search is incomplete.
        if self.control().is_stopped() {
            return Err(Error::Stopped);
        }
        let of_segment = |segment: &RecordSegment| {
            match_segments(samples, drive_hz, segment, &known, options.within)
        };
        Ok(segmentation.segments.iter().map(of_segment).collect())
    }
}
