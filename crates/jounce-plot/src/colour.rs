//! Colours that colour-blind readers can distinguish.
//!
//! Source: M. Okabe, K. Ito, Color universal design (2008). Its yellow is omitted: it is invisible
//! on white paper.

/// A colour of a line, a marker or an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colour {
    /// The first colour of a series.
    #[default]
    Blue,
    /// Vermilion: red to most, distinguishable from green by all.
    Vermilion,
    /// Bluish green.
    Green,
    /// Reddish purple.
    Purple,
    /// Orange.
    Orange,
    /// Sky blue.
    Sky,
    /// Black on white paper, white on a dark page.
    Ink,
    /// Grey for comparisons: the linear case, reference lines, shaded areas.
    Grey,
}

impl Colour {
    /// Returns the colour of curve number `index`, from 0; the six colours repeat.
    pub fn nth(index: usize) -> Self {
        [
            Self::Blue,
            Self::Vermilion,
            Self::Green,
            Self::Purple,
            Self::Orange,
            Self::Sky,
        ][index % 6]
    }

    /// Returns the colour of motions of a period in drive cycles, the same in every picture: black
    /// for no period, one colour for each period up to 5 and one for all longer periods.
    pub fn of_period(period_cycles: u32) -> Self {
        match period_cycles {
            0 => Self::Ink,
            1 => Self::Blue,
            2 => Self::Vermilion,
            3 => Self::Green,
            4 => Self::Purple,
            5 => Self::Orange,
            _ => Self::Sky,
        }
    }

    /// Returns the colour as `#rrggbb`.
    pub(super) fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Vermilion => "#d55e00",
            Self::Green => "#009e73",
            Self::Purple => "#cc79a7",
            Self::Orange => "#e69f00",
            Self::Sky => "#56b4e9",
            Self::Ink => "#1a1a1a",
            Self::Grey => "#8a8a8a",
        }
    }
}
