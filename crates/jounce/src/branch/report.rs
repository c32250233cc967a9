//! Figure of branches, and the quantity that it shows.

use super::{Bifurcation, Branch, BranchPoint, BranchQuantity, BranchResult};
use jounce_analysis::BandLimit;
use jounce_plot as picture;
use jounce_plot::{Axis, BranchLine, BranchMark, Colour, Figure};

/// Returns a limit of a half-power interval in words.
///
/// ```
/// assert_eq!(jounce::parts::band_limit_text(jounce::parts::BandLimit::Stability), "stability lost");
/// ```
pub fn band_limit_text(limit: BandLimit) -> &'static str {
    match limit {
        BandLimit::Maximum => "maximum",
        BandLimit::HalfPower => "half power",
        BandLimit::Stability => "stability lost",
        BandLimit::End => "end of the branch",
    }
}

impl BranchQuantity {
    /// Returns the value at a bifurcation.
    pub fn at(self, bifurcation: &Bifurcation) -> f64 {
        match self {
            Self::MeanPower => bifurcation.mean_power_w,
            Self::Displacement => bifurcation.displacement_peak_m,
        }
    }

    /// Returns the unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::MeanPower => "W",
            Self::Displacement => "m",
        }
    }

    fn value(self, point: &BranchPoint) -> f64 {
        match self {
            Self::MeanPower => point.mean_power_w,
            Self::Displacement => point.displacement_peak_m,
        }
    }

    fn axis(self) -> Axis {
        match self {
            Self::MeanPower => Axis::log("Mean power", self.unit()),
            Self::Displacement => Axis::linear("Displacement amplitude", self.unit()),
        }
    }
}

impl BranchResult {
    /// Returns the figure of the branches with their bifurcations: mean power over the key, or
    /// displacement without a circuit.
    pub fn figure(&self) -> Figure {
        let quantity = self.quantity;
        let line = |branch: &Branch| {
            let label = format!("period {}", branch.period_cycles);
            branch_line(branch, label, |point| quantity.value(point))
        };
        let mark = |bifurcation: &Bifurcation| {
            let kind = bifurcation.level.as_deref();
            BranchMark {
                kind: kind.unwrap_or(bifurcation.kind.name()).to_owned(),
                parameter: bifurcation.parameter,
                value: quantity.at(bifurcation),
            }
        };
        let lines: Vec<BranchLine> = self.branches.iter().map(line).collect();
        let bifurcations = self.branches.iter().flat_map(|branch| &branch.bifurcations);
        let marks: Vec<BranchMark> = bifurcations.map(mark).collect();
        picture::branches(
            &format!("Branches of periodic orbits over {}", self.key),
            Axis::linear(&self.key, &self.unit),
            quantity.axis(),
            &lines,
            &marks,
        )
    }
}

/// Returns a branch as a line of a figure.
pub(crate) fn branch_line(
    branch: &Branch,
    label: String,
    value: impl FnMut(&BranchPoint) -> f64,
) -> BranchLine {
    let points = &branch.points;
    BranchLine {
        label,
        colour: Colour::of_period(branch.period_cycles),
        parameter: points.iter().map(|point| point.parameter).collect(),
        value: points.iter().map(value).collect(),
        stable: points.iter().map(|point| point.stable).collect(),
    }
}
