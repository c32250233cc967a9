//! Design: a harvester with the numbers that a page has set.

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_spec::{Faults, NumericKey, Spec, SpecFile};

/// Largest ratio of a change to the previous one for which that is extrapolated.
const MAX_CHANGE_RATIO: f64 = 4.0;

/// A harvester with the numbers that a page has set.
#[derive(Debug, Clone)]
pub struct Design {
    harvester: Harvester,
    /// Keys that the page has set.
    keys: Vec<String>,
}

impl PartialEq for Design {
    /// True where both give the same results: specs and set keys are equal.
    fn eq(&self, other: &Self) -> bool {
        self.spec() == other.spec() && self.keys == other.keys
    }
}

impl Design {
    /// Sets numbers of a harvester together; a key may be one that its spec lacks. A key that holds
    /// no number is refused, so a page cannot change the path of a file.
    ///
    /// # Errors
    /// [`Error::Spec`] with the faults of all keys.
    ///
    /// ```
    /// use jounce::{Harvester, live::Design};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let design = Design::new(&harvester, &[("stop.tip.gap".into(), "0.5 mm".into())])?;
    /// assert_eq!(design.harvester().get("stop.tip.gap")?.value_si, 0.5e-3);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn new(harvester: &Harvester, set: &[(String, String)]) -> Result<Self, Error> {
        let (mut file, mut faults) = (harvester.file().clone(), Vec::new());
        for (key, value) in set {
            let result = match NumericKey::find(harvester.spec(), key) {
                Err(fault) if value.trim().is_empty() => Err(fault.into()),
                Err(_) => check_added(&file, key, value),
                Ok(_) => Ok(()),
            };
            let result = result.and_then(|()| Ok(file.set(key, value)?));
            faults.extend(result.err().iter().flat_map(|all| all.as_slice().to_vec()));
        }
        if !faults.is_empty() {
            return Err(Error::Spec(faults.into()));
        }
        Ok(Self {
            harvester: Harvester::of(file, harvester.folder().to_path_buf())?,
            keys: set.iter().map(|(key, _)| key.clone()).collect(),
        })
    }

    /// Returns the harvester.
    pub fn harvester(&self) -> &Harvester {
        &self.harvester
    }

    /// Returns the spec.
    pub(super) fn spec(&self) -> &Spec {
        self.harvester.spec()
    }

    /// Returns a key with a number.
    pub(super) fn key(&self, path: &str) -> Result<NumericKey, Error> {
        Ok(self.harvester.file().numeric_key(path)?)
    }

    /// Returns the change from the last spec to this design, as a multiple of the change before;
    /// `None` where the two have different directions.
    pub(super) fn change_ratio(&self, previous: &Spec, last: &Spec) -> Option<f64> {
        let (mut dot, mut first_norm2, mut second_norm2) = (0.0, 0.0, 0.0);
        for path in &self.keys {
            let key = NumericKey::find(self.spec(), path).ok()?;
            let [a, b, c] = [previous, last, self.spec()].map(|spec| key.get(spec));
            let (a, b, c) = (a.ok()?, b.ok()?, c.ok()?);
            let size = b.abs().max(f64::MIN_POSITIVE);
            let (first, second) = ((b - a) / size, (c - b) / size);
            (dot, first_norm2, second_norm2) = (
                dot + first * second,
                first_norm2 + first * first,
                second_norm2 + second * second,
            );
        }
        let ratio = dot / first_norm2;
        // Where two keys change, each must change in proportion.
        let off_direction = second_norm2 - ratio * dot > 0.01 * second_norm2;
        (first_norm2 > 0.0 && ratio.abs() < MAX_CHANGE_RATIO && !off_direction).then_some(ratio)
    }
}

/// Checks that a key that the spec lacks holds a number once it is set.
fn check_added(file: &SpecFile, key: &str, value: &str) -> Result<(), Faults> {
    let mut changed = file.clone();
    changed.set(key, value)?;
    changed.numeric_key(key)?;
    Ok(())
}
