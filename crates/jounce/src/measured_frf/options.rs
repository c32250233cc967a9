//! Options of the frequency responses of a hammer or shaker test.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, refuse_changed, time_s};
use clap::ValueEnum;
use jounce_identification::response::{ChannelChoice, ComplexParts, Excitation};
use jounce_signal::spectral::{Estimator, ImpactSettings};
use serde::{Deserialize, Serialize};

/// Options of [`crate::Recording::measured_frf`], and of the responses from which
/// [`crate::Recording::measured_modes`] identifies modes.
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeasuredFrfOptions {
    /// Channel of the force, by name; by default the first one in newtons.
    #[arg(long, value_name = "CHANNEL")]
    pub force: Option<String>,
    /// Channel of the input, which need not be a force: acceleration, velocity or displacement of
    /// the base, or a voltage; by default the first channel in newtons.
    #[arg(long, value_name = "CHANNEL")]
    pub input: Option<String>,
    /// Channel of a response, by name; can be given several times; by default all but the input.
    #[arg(long, value_name = "CHANNEL")]
    pub response: Vec<String>,
    /// Estimator: h1 for noise on the responses, h2 for noise on the force, hv for noise on both.
    #[arg(long, value_enum, default_value = "h1")]
    pub estimator: FrfEstimator,
    /// For hv: spectral density of the response noise divided by that of the force noise, in
    /// squares of their SI units; a number above 0.
    #[arg(long, value_name = "NUMBER", default_value_t = 1.0)]
    pub noise_ratio: f64,
    /// Length of a block, as in 2s; by default a record with one hit is a block, else the shortest
    /// time between two hits; with a shaker an eighth of the shortest record.
    #[arg(long = "block", value_name = "TIME", value_parser = time_s)]
    pub block_s: Option<f64>,
    /// Sets the force after each hit, which is noise, to zero; by default it is unchanged.
    #[arg(long)]
    pub force_window: bool,
    /// Exponential window on force and responses that ends at this ratio, a number between 0 and 1,
    /// as in 0.01; its damping is subtracted from the modes; by default none.
    #[arg(long, value_name = "NUMBER")]
    pub end_ratio: Option<f64>,
    /// Treats the force as the force of a shaker: half-overlapping blocks with a Hann window. This
    /// is the default for a continuous force of both signs.
    #[arg(long)]
    pub shaker: bool,
    /// Contents of every two columns of a file over frequency whose header does not mark them as
    /// response functions; by default only complex channels, as NAME.re and NAME.im, are response
    /// functions.
    #[arg(long, value_enum, value_name = "PARTS")]
    pub functions: Option<FunctionParts>,
    /// Interpolates lines of response functions that are not numbers linearly; by default they are
    /// refused.
    #[arg(long)]
    pub bridge: bool,
}

/// Estimator of frequency responses, by the place of the noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrfEstimator {
    /// On the responses only.
    H1,
    /// On the force only.
    H2,
    /// On both.
    Hv,
}

/// Contents of two columns of a file over frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FunctionParts {
    /// Real and imaginary part.
    ReIm,
    /// Magnitude and phase in degrees.
    SizeDegrees,
    /// Magnitude and phase in radians.
    SizeRadians,
}

impl Default for MeasuredFrfOptions {
    fn default() -> Self {
        defaults()
    }
}

impl MeasuredFrfOptions {
    pub(super) fn settings(&self) -> Result<ImpactSettings, Error> {
        let noise_ratio = check_above_zero("noise_ratio", self.noise_ratio, "")?;
        if self.estimator != FrfEstimator::Hv {
            let expected = "it applies to the `estimator` hv; choose it, or omit this";
            refuse_changed(self, &["noise_ratio"], expected)?;
        }
        let &Self {
            force_window,
            end_ratio,
            shaker,
            ..
        } = self;
        if let Some(ratio) = end_ratio.filter(|ratio| !(*ratio > 0.0 && *ratio < 1.0)) {
            let expected = "it must be between 0 and 1; try 0.01";
            return Err(Error::option("end_ratio", ratio, expected));
        }
        let block_s = self.block_s;
        let block_s = block_s.map(|block_s| check_above_zero("block", block_s, "s"));
        Ok(ImpactSettings {
            estimator: match self.estimator {
                FrfEstimator::H1 => Estimator::H1,
                FrfEstimator::H2 => Estimator::H2,
                FrfEstimator::Hv => Estimator::Hv { noise_ratio },
            },
            block_s: block_s.transpose()?,
            force_window,
            end_ratio,
            shaker,
        })
    }

    pub(super) fn choice(&self) -> Result<ChannelChoice, Error> {
        let excitation = match (&self.input, &self.force) {
            (Some(input), Some(_)) => {
                let expected = "`force` is also given; give one of them";
                return Err(Error::option("input", input, expected));
            }
            (Some(channel), None) => Excitation::Channel(channel.clone()),
            (None, Some(channel)) => Excitation::Force(channel.clone()),
            (None, None) => Excitation::FirstForce,
        };
        Ok(ChannelChoice {
            excitation,
            responses: self.response.clone(),
        })
    }

    pub(super) fn parts(&self) -> Option<ComplexParts> {
        self.functions.map(|parts| match parts {
            FunctionParts::ReIm => ComplexParts::ReIm,
            FunctionParts::SizeDegrees => ComplexParts::SizeDegrees,
            FunctionParts::SizeRadians => ComplexParts::SizeRadians,
        })
    }

    /// Refuses the options of an input, for a test without one.
    pub(crate) fn refuse_input(&self) -> Result<(), Error> {
        let of_input = [
            "force",
            "input",
            "estimator",
            "noise_ratio",
            "block_s",
            "force_window",
            "end_ratio",
            "shaker",
            "functions",
            "bridge",
        ];
        let expected = "`free_decay` and `output_only` are for tests without a measured input: omit it, or omit them";
        refuse_changed(self, &of_input, expected)
    }
}
