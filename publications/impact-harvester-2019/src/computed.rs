//! All numbers of the reproduction, for tables, figures and claims.

use super::ReproduceError;
use super::impact::Impact;
use crate::results::assumptions::{Variant, variants};
use crate::results::frequency_responses::HammerTest;
use crate::results::orbits::PaperOrbits;
use crate::results::power_over_frequency::{FEWER_LEVELS_N, LEVELS_N};
use crate::results::table_2::Frequencies;
use jounce_control::Control;

/// All computed results.
pub(super) struct Computed {
    pub table_2: Frequencies,
    pub hammer: HammerTest,
    /// Results with the stop on the ground: eq. (5) as printed, the default.
    pub ground: Impact,
    /// Results with the stop on the shaker table.
    pub table: Impact,
    pub orbits: PaperOrbits,
    pub variants: Vec<Variant>,
}

impl Computed {
    /// Computes all results.
    pub fn new(control: &Control, progress: &dyn Fn(&str)) -> Result<Self, ReproduceError> {
        progress("Table 2, figures 4 and 5: modes and frequency responses");
        let (table_2, hammer) = (Frequencies::compute()?, HammerTest::compute()?);
        progress(
            "figures 6 to 9, with the stop on the ground and on the table: about 1700 runs of 20 s",
        );
        let (ground, table) = rayon::join(
            || Impact::compute("ground", &LEVELS_N, control),
            || Impact::compute("table", &FEWER_LEVELS_N, control),
        );
        progress("branches under figure 6, and jumps against the gap");
        let orbits = PaperOrbits::compute(control)?;
        progress("assumptions: 13 Hz and 200 N with the other choices");
        Ok(Self {
            table_2,
            hammer,
            ground: ground?,
            table: table?,
            orbits,
            variants: variants(control)?,
        })
    }
}
