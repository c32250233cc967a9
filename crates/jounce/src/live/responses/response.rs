//! Response over a key: first the branches near those of the previous design, then all branches.

use super::carry::{CarriedBranches, DraftProblem, TOLERANCE};
use super::response_result::{ResponseBranch, ResponseResult};
use super::stored_response::{StoredResponse, known_orbits};
use crate::branch::{budget_note, search_note};
use crate::error::Error;
use crate::live::{Design, KeySpan, LiveAnalysis};
use crate::options::check_tolerance;
use jounce_analysis::{
    Bandwidth, BandwidthSearch, BranchOptions, BranchSearch, LineErrors, Model, OrbitMethodKind,
    Parameter,
};
use jounce_control::Control;
use jounce_model::plant::System;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Largest number of seeds of a response that the user waits for.
const MAX_LIVE_SEEDS: usize = 1000;

/// Options of [`LiveAnalysis::fine_response`]. Its defaults are coarser than those of `jounce
/// branch`, so that the response of a slider arrives within a few seconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ResponseOptions {
    /// Relative tolerance of the integration that computes the orbits.
    pub tolerance: f64,
    /// Number of values inside the range at which orbits are sought by integration; they find
    /// isolated branches.
    pub seeds: usize,
    /// Longest period of a branch, in drive cycles.
    pub longest_period: u32,
}

impl Default for ResponseOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-9,
            seeds: 6,
            longest_period: 8,
        }
    }
}

impl ResponseOptions {
    fn check(&self) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        if self.seeds > MAX_LIVE_SEEDS {
            let expected = format!("it must be at most {MAX_LIVE_SEEDS}");
            return Err(Error::option("seeds", self.seeds, expected));
        }
        if self.longest_period == 0 {
            let expected = "it must be at least 1";
            return Err(Error::option("longest_period", 0, expected));
        }
        Ok(())
    }
}

impl LiveAnalysis {
    /// Computes the branches over a key near those of the last response over this key. Without
    /// one, continuation starts from the orbits on which the harvester settles at both ends of the
    /// range. Of the options it has the longest period. The response is stored under its number.
    ///
    /// # Errors
    /// [`Error::Spec`] and [`Error::Option`] for the key and its range, [`Error::Analysis`] for a
    /// design without a model.
    ///
    /// ```
    /// use jounce::{Control, Harvester, live::{Design, KeySpan, LiveAnalysis, ResponseOptions}};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let span = KeySpan { over: "drive.shaker.frequency".into(), from: 12.9, to: 13.0 };
    /// let (analysis, options) = (LiveAnalysis::default(), ResponseOptions::default());
    /// for (id, gap) in (1..).zip(["1 mm", "0.99 mm"]) {
    ///     let design = Design::new(&harvester, &[("stop.tip.gap".into(), gap.into())])?;
    ///     let response = analysis.coarse_response(id, &design, &span, &options, &Control::default())?;
    ///     assert!(!response.branches.is_empty());
    /// }
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn coarse_response(
        &self,
        id: u64,
        design: &Design,
        span: &KeySpan,
        options: &ResponseOptions,
        control: &Control,
    ) -> Result<ResponseResult, Error> {
        options.check()?;
        let (key, range) = (span.key(design)?, span.ends());
        let base = self.model(design.spec(), control)?;
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let problem = DraftProblem {
            design,
            base: &base,
            parameter: &parameter,
            range,
            longest_period: options.longest_period,
        };
        let (carried, linear) = rayon::join(
            || problem.branches(self.last_response(key.path())),
            || self.linear.curve(design.spec(), &parameter, range),
        );
        let mut result = ResponseResult::new(&key, system(&base), linear, &carried.branches);
        let errors = LineErrors {
            family: &parameter,
            kernel: &base.kernel,
            range,
            tolerance: TOLERANCE,
        };
        for (drawn, branch) in result.branches.iter_mut().zip(&carried.branches) {
            drawn.line_error = errors.of(branch);
        }
        result.draft = Some(carried.draft.with_lines(&result.branches));
        let CarriedBranches {
            branches,
            origin,
            draft,
        } = carried;
        // No line of a branch is known where diodes hardly conduct. Its orbits are those of roundoff.
        let is_known =
            |drawn: &ResponseBranch| drawn.line_error.iter().any(|error| error.is_finite());
        let known = branches
            .iter()
            .zip(&result.branches)
            .filter(|(_, drawn)| is_known(drawn));
        let stored = StoredResponse {
            spec: design.spec().clone(),
            key,
            range,
            known_orbits: known_orbits(known.map(|(branch, _)| branch)),
            branches: Arc::new(branches),
            origin,
            draft: Some(draft),
        };
        self.store(id, stored, control);
        Ok(result)
    }

    /// Returns the harvester without contact before the first response over a key: a first picture
    /// within milliseconds. Returns `None` after a response over the key.
    ///
    /// # Errors
    /// As [`Self::coarse_response`].
    pub fn first_response(
        &self,
        design: &Design,
        span: &KeySpan,
        control: &Control,
    ) -> Result<Option<ResponseResult>, Error> {
        let (key, range) = (span.key(design)?, span.ends());
        if self.last_response(key.path()).is_some() {
            return Ok(None);
        }
        let base = self.model(design.spec(), control)?;
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let linear = self.linear.curve(design.spec(), &parameter, range);
        Ok(Some(ResponseResult::new(&key, system(&base), linear, &[])))
    }

    /// Finds the branches over a key by the search of `jounce branch`, which also starts from the
    /// orbits of the last response over this key. The response is stored under
    /// its number, in place of the coarse one.
    ///
    /// # Errors
    /// As [`Self::coarse_response`], [`Error::Option`] for an option, and [`Error::Orbit`] for
    /// drives without a common period.
    pub fn fine_response(
        &self,
        id: u64,
        design: &Design,
        span: &KeySpan,
        options: &ResponseOptions,
        control: &Control,
    ) -> Result<ResponseResult, Error> {
        options.check()?;
        let (key, range) = (span.key(design)?, span.ends());
        let base = self.model(design.spec(), control)?;
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method: OrbitMethodKind::Shooting,
            tolerance: options.tolerance,
            seeds: options.seeds,
            longest_period: options.longest_period,
        };
        let stored = self.last_response(key.path());
        let search_options = BranchOptions {
            known_orbits: stored
                .map(|stored| stored.known_orbits.clone())
                .unwrap_or_default(),
            ..Default::default()
        };
        let branches = search.run_with(&search_options)?;
        let linear = self.linear.curve(design.spec(), &parameter, range);
        let mut result = ResponseResult::new(&key, system(&base), linear, &branches);
        result.note = Some(search_note(options.seeds, options.longest_period));
        result.budget_note = budget_note(&branches, search_options.budget);
        let stored = StoredResponse {
            spec: design.spec().clone(),
            key,
            range,
            known_orbits: known_orbits(branches.iter()),
            branches: Arc::new(branches),
            origin: None,
            draft: None,
        };
        self.store(id, stored, control);
        Ok(result)
    }

    /// Returns the peak and the half-power bandwidth of a stored fine response; `None` without a
    /// stable orbit.
    ///
    /// # Errors
    /// [`Error::Option`] for a response that is no longer stored.
    pub fn bandwidth(
        &self,
        response: u64,
        options: &ResponseOptions,
        control: &Control,
    ) -> Result<Option<Bandwidth>, Error> {
        let stored = self.stored_response(response)?;
        let base = self.model(&stored.spec, control)?;
        let search = BandwidthSearch {
            base: &base,
            parameter: &stored.parameter(&base),
            range: stored.range,
            tolerance: options.tolerance,
        };
        Ok(search.run(&stored.branches).together)
    }

    /// Stores a response, unless its computation was stopped.
    fn store(&self, id: u64, response: StoredResponse, control: &Control) {
        if !control.is_stopped() {
            self.responses.store(id, Arc::new(response));
        }
    }
}

/// Returns the modes, circuits and stops of a harvester.
fn system(base: &Model) -> &System {
    &base.kernel.plant.system
}
