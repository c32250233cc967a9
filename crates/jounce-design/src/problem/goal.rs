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
    /// Mean power of one run from `run.start`, by default from rest: for noise and recordings.
    MeanPower,
    /// Share of the time that the device behind the regulator is on, in a run.
    TimeOn,
    /// Mean power that arrives at the storage minus the power that the regulator needs to stay on,
    /// in a run.
    PowerMargin,
}

impl Goal {
    /// All goals.
    pub const ALL: [Self; 6] = [
        Self::ExpectedPower,
        Self::StablePower,
        Self::Bandwidth,
        Self::MeanPower,
        Self::TimeOn,
        Self::PowerMargin,
    ];

    /// Returns the name in a file.
    pub fn name(self) -> &'static str {
        match self {
            Self::ExpectedPower => "expected-power",
            Self::StablePower => "stable-power",
            Self::Bandwidth => "bandwidth",
            Self::MeanPower => "mean-power",
            Self::TimeOn => "time-on",
            Self::PowerMargin => "power-margin",
        }
    }

    /// True where the goal needs the attractors of a cloud of starts.
    pub fn needs_starts(self) -> bool {
        matches!(self, Self::ExpectedPower | Self::StablePower)
    }

    /// True where a run gives the goal.
    pub fn needs_run(self) -> bool {
        self.needs_device() || self == Self::MeanPower
    }

    /// True where the goal needs a device behind a regulator.
    pub fn needs_device(self) -> bool {
        matches!(self, Self::TimeOn | Self::PowerMargin)
    }

    /// Returns the title of an axis.
    pub fn title(self) -> &'static str {
        match self {
            Self::ExpectedPower => "Expected power",
            Self::StablePower => "Power of the best stable orbit",
            Self::Bandwidth => "Half-power bandwidth",
            Self::MeanPower => "Mean power",
            Self::TimeOn => "Share of the time on",
            Self::PowerMargin => "Power margin",
        }
    }

    /// Returns the goal of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|goal| goal.name() == name)
    }

    /// Returns the unit of the goal.
    pub fn unit(self) -> &'static str {
        match self {
            Self::ExpectedPower | Self::StablePower | Self::MeanPower | Self::PowerMargin => "W",
            Self::Bandwidth => "Hz",
            Self::TimeOn => "",
        }
    }
}
