//! Goals.

/// What the search maximises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// Mean power that a start of the cloud leads to, over its attractors.
    ExpectedPower,
    /// Mean power of the stable orbit with the largest one that a start reaches.
    StablePower,
    /// Half-power bandwidth over the frequency of the drive.
    Bandwidth,
    /// Mean power of a run, under noise or a recording.
    MeanPower,
}

impl Goal {
    /// All goals.
    pub const ALL: [Self; 4] = [
        Self::ExpectedPower,
        Self::StablePower,
        Self::Bandwidth,
        Self::MeanPower,
    ];

    /// Returns the name in a file.
    pub fn name(self) -> &'static str {
        match self {
            Self::ExpectedPower => "expected-power",
            Self::StablePower => "stable-power",
            Self::Bandwidth => "bandwidth",
            Self::MeanPower => "mean-power",
        }
    }

    /// True where the goal needs the attractors of a cloud of starts.
    pub fn needs_starts(self) -> bool {
        matches!(self, Self::ExpectedPower | Self::StablePower)
    }

    /// Returns the unit of the goal.
    pub fn unit(self) -> &'static str {
        match self {
            Self::ExpectedPower | Self::StablePower | Self::MeanPower => "W",
            Self::Bandwidth => "Hz",
        }
    }
}
