//! Arguments of a hammer or shaker test, which `frf --measured` and `modes --measured` share.

use crate::failure::Failure;
use crate::measured_file::{manifest, parse_positive, print_issues, record};
use crate::output::line;
use clap::{Args, ValueEnum};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::Manifest;
use jounce_measure::read;
use jounce_measure::recording::{Over, Recording};
use jounce_measure::response::{
    ChannelChoice, ComplexParts, Excitation, MeasuredResponses, bridged, paired,
};
use jounce_measure::spectral::{Estimator, HitWarning, ImpactHit, ImpactSettings};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Place of the noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Noise {
    /// On the responses only.
    H1,
    /// On the force only.
    H2,
    /// On both.
    Hv,
}

/// Contents of two columns of a file over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Functions {
    /// Real and imaginary part.
    ReIm,
    /// Magnitude and phase in degrees.
    SizeDegrees,
    /// Magnitude and phase in radians.
    SizeRadians,
}

/// Arguments of a hammer test.
#[derive(Debug, Args)]
pub struct HammerArguments {
    /// Recordings of a hammer or shaker test instead of a spec: input and responses over time, with
    /// one or more hits or a continuous input, at one or more excitation points; or one file of
    /// response functions over frequency. CSV or text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF
    /// or LVM; by default the spec is used.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub measured: Vec<PathBuf>,
    /// Channel of the force, by name; by default the first one in newtons.
    #[arg(long, value_name = "CHANNEL", requires = "measured")]
    force: Option<String>,
    /// With --measured: channel of the input, which need not be a force (acceleration, velocity or
    /// displacement of the base, or a voltage). Without it: point of the spec that the force acts
    /// on. By default the first channel in newtons, or the point of the first drive.
    #[arg(long, value_name = "CHANNEL", conflicts_with = "force")]
    pub input: Option<String>,
    /// Channel of a response, by name; can be given several times; by default all but the input.
    #[arg(long, value_name = "CHANNEL", requires = "measured")]
    pub response: Vec<String>,
    /// Estimator: h1 for noise on the responses, h2 for noise on the force, hv for noise on both.
    #[arg(long, value_enum, default_value = "h1", requires = "measured")]
    estimator: Noise,
    /// For hv: spectral density of the response noise divided by that of the force noise, in
    /// squares of their SI units; a number above 0.
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 1.0,
        requires = "measured"
    )]
    noise_ratio: f64,
    /// Length of a block, as in 2s; by default a record with one hit is a block, else the shortest
    /// time between two hits; with a shaker an eighth of the shortest record.
    #[arg(long, value_name = "TIME", requires = "measured")]
    block: Option<String>,
    /// Sets the force after each hit, which is noise, to zero; by default it is unchanged.
    #[arg(long, requires = "measured")]
    force_window: bool,
    /// Exponential window on force and responses that ends at this ratio, a number between 0 and 1,
    /// as in 0.01; its damping is subtracted from the modes; by default none.
    #[arg(long, value_name = "NUMBER", requires = "measured")]
    end_ratio: Option<f64>,
    /// Treats the force as the force of a shaker: half-overlapping blocks with a Hann window. This
    /// is the default for a continuous force of both signs.
    #[arg(long, requires = "measured")]
    shaker: bool,
    /// Contents of every two columns of a file over frequency whose header does not mark them as
    /// response functions; by default only complex channels, as NAME.re and NAME.im, are response
    /// functions.
    #[arg(long, value_enum, value_name = "PARTS", requires = "measured")]
    functions: Option<Functions>,
    /// Interpolates lines of response functions that are not numbers linearly; by default they are
    /// refused.
    #[arg(long, requires = "measured")]
    bridge: bool,
}

impl HammerArguments {
    /// Returns the responses; a file over frequency is returned unchanged.
    pub fn responses(&self) -> Result<MeasuredResponses, Failure> {
        let settings = self.settings()?;
        if let [file] = &self.measured[..] {
            let recordings = self.prepare(read::file(file)?.recordings)?;
            if recordings
                .iter()
                .all(|recording| recording.over == Over::Frequency)
            {
                let responses = MeasuredResponses::from_functions(&recordings)?;
                print_issues(&responses.findings, None);
                return Ok(responses);
            }
        }
        let records = self
            .measured
            .iter()
            .map(|file| record(file))
            .collect::<Result<Vec<_>, _>>()?;
        let excitation = match (&self.input, &self.force) {
            (Some(channel), _) => Excitation::Channel(channel.clone()),
            (None, Some(channel)) => Excitation::Force(channel.clone()),
            (None, None) => Excitation::FirstForce,
        };
        let channels = ChannelChoice {
            excitation,
            responses: self.response.clone(),
        };
        let responses = MeasuredResponses::of_hits(&records, &channels, &settings)?;
        let used_channels: Vec<&str> = responses
            .outputs
            .iter()
            .chain([&responses.input])
            .map(String::as_str)
            .collect();
        print_issues(&responses.findings, Some(&used_channels));
        Ok(responses)
    }

    /// Returns recordings with their columns paired and their lines interpolated as requested.
    fn prepare(&self, recordings: Vec<Recording>) -> Result<Vec<Recording>, Failure> {
        let parts = self.functions.map(|functions| match functions {
            Functions::ReIm => ComplexParts::ReIm,
            Functions::SizeDegrees => ComplexParts::SizeDegrees,
            Functions::SizeRadians => ComplexParts::SizeRadians,
        });
        let recordings = match parts {
            Some(parts) => paired(recordings, parts)?,
            None => recordings,
        };
        Ok(if self.bridge {
            bridged(recordings)
        } else {
            recordings
        })
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, command: &str) -> Result<Manifest, Failure> {
        let manifest =
            manifest(command, &self.measured)?.with("estimator", format!("{:?}", self.estimator));
        let manifest = manifest
            .with("force_window", self.force_window)
            .with("end_ratio", self.end_ratio.unwrap_or(1.0));
        Ok(manifest
            .with("shaker", self.shaker)
            .with("input", self.input.clone().unwrap_or_default()))
    }

    fn settings(&self) -> Result<ImpactSettings, Failure> {
        if !(self.noise_ratio > 0.0 && self.noise_ratio.is_finite()) {
            return Err(Failure::usage(format!(
                "--noise-ratio {}: it must be above 0",
                self.noise_ratio
            )));
        }
        if let Some(ratio) = self
            .end_ratio
            .filter(|ratio| !(*ratio > 0.0 && *ratio < 1.0))
        {
            return Err(Failure::usage(format!(
                "--end-ratio {ratio}: it must be between 0 and 1; try 0.01"
            )));
        }
        let estimator = match self.estimator {
            Noise::H1 => Estimator::H1,
            Noise::H2 => Estimator::H2,
            Noise::Hv => Estimator::Hv {
                noise_ratio: self.noise_ratio,
            },
        };
        let block_s = self
            .block
            .as_ref()
            .map(|text| parse_positive("--block", text, Unit::Time))
            .transpose()?;
        Ok(ImpactSettings {
            estimator,
            block_s,
            force_window: self.force_window,
            end_ratio: self.end_ratio,
            shaker: self.shaker,
        })
    }
}

/// Number of hits that are listed for each fault; for more hits only the count is printed.
const MAX_LISTED_HITS: usize = 3;

/// Prints the hits and their faults, or the blocks of a shaker test.
pub fn print_hits(responses: &MeasuredResponses) {
    if let Some(block_s) = responses.block_s {
        if responses.hits.is_empty() {
            let blocks = responses
                .functions
                .first()
                .map_or(0, |function| function.blocks);
            line(format!(
                "continuous input (shaker): {blocks} blocks of {block_s:.6} s averaged, half overlapping, Hann"
            ));
        } else {
            let used_count = responses.hits.iter().filter(|hit| hit.used).count();
            line(format!(
                "{used_count} hits of {} averaged, blocks of {block_s:.6} s",
                responses.hits.len()
            ));
        }
    }
    print_warnings(&responses.hits);
    let unused: Vec<usize> = (1..)
        .zip(&responses.hits)
        .filter(|(_, hit)| !hit.used)
        .map(|(number, _)| number)
        .collect();
    if !unused.is_empty() {
        line(format!(
            "left out: {}, whose blocks would extend beyond the record",
            hit_list(&unused)
        ));
    }
}

/// Prints the faults of hits: the first few of each fault, and the number of the others.
fn print_warnings(hits: &[ImpactHit]) {
    let mut faults: BTreeMap<&str, Vec<(usize, String)>> = BTreeMap::new();
    for (number, ImpactHit { hit, .. }) in (1..).zip(hits) {
        for warning in &hit.warnings {
            let fault = faults.entry(fault(*warning)).or_default();
            // A hit with many bounces is one double hit.
            if fault.last().is_none_or(|(last, _)| *last != number) {
                fault.push((
                    number,
                    format!(
                        "warning: hit {number} of {:.4} N {warning}",
                        hit.peak_force_n
                    ),
                ));
            }
        }
    }
    for (fault, messages) in faults {
        messages
            .iter()
            .take(MAX_LISTED_HITS)
            .for_each(|(_, message)| line(message));
        let other_hits: Vec<usize> = messages
            .iter()
            .skip(MAX_LISTED_HITS)
            .map(|(number, _)| *number)
            .collect();
        if !other_hits.is_empty() {
            line(format!("warning: also {fault}: {}", hit_list(&other_hits)));
        }
    }
}

/// `hit 4, 5, 6 and 20 more`.
fn hit_list(hits: &[usize]) -> String {
    let numbers: Vec<String> = hits
        .iter()
        .take(MAX_LISTED_HITS)
        .map(ToString::to_string)
        .collect();
    let remaining_count = hits.len().saturating_sub(MAX_LISTED_HITS);
    let suffix = if remaining_count > 0 {
        format!(" and {remaining_count} more")
    } else {
        String::new()
    };
    format!("hit {}{suffix}", numbers.join(", "))
}

fn fault(warning: HitWarning) -> &'static str {
    match warning {
        HitWarning::Double { .. } => "double",
        HitWarning::Clipped { .. } => "clipped",
        HitWarning::Coarse { .. } => "coarse",
        HitWarning::Cut => "cut",
        HitWarning::Ringing { .. } => "while a response still moves",
    }
}
