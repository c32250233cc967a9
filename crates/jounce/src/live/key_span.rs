//! Range of a key between two values.

use super::Design;
use crate::error::Error;
use jounce_spec::{KeyRange, NumericKey};
use serde::{Deserialize, Serialize};

/// Largest number of values of a sweep of the page.
const MAX_POINTS: usize = 400;

/// Range of a key between two values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeySpan {
    /// The key.
    pub over: String,
    /// Lower end, SI.
    pub from: f64,
    /// Upper end, SI.
    pub to: f64,
}

impl KeySpan {
    /// Returns the range as the command line takes it, `12 Hz:13 Hz`.
    ///
    /// # Errors
    /// [`Error::Spec`] and [`Error::Option`] for an unknown key or ends that it does not allow.
    ///
    /// ```
    /// use jounce::{Harvester, live::{Design, KeySpan}};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let design = Design::new(&harvester, &[])?;
    /// let span = KeySpan { over: "drive.shaker.frequency".into(), from: 12.0, to: 13.0 };
    /// assert_eq!(span.text(&design)?, "12 Hz:13 Hz");
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn text(&self, design: &Design) -> Result<String, Error> {
        let key = self.key(design)?;
        Ok(format!("{}:{}", key.show(self.from), key.show(self.to)))
    }

    /// Returns both ends, SI.
    pub(super) fn ends(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// Returns the key after a check that it allows both ends.
    pub(super) fn key(&self, design: &Design) -> Result<NumericKey, Error> {
        let key = design.key(&self.over)?;
        let (from, to) = self.ends();
        if !(from < to && from.is_finite() && to.is_finite()) {
            return Err(Error::option(
                "over",
                format!("{}={from}:{to}", self.over),
                "the range must go from a smaller to a larger value",
            ));
        }
        for value in [from, to] {
            key.set(&mut design.spec().clone(), value)?;
        }
        Ok(key)
    }
}

/// Returns so many values of a key between two ends; `spacing` is `x` or `log`.
pub(super) fn values(
    key: NumericKey,
    (from, to): (f64, f64),
    points: usize,
    spacing: &str,
) -> Result<KeyRange, Error> {
    let points = points.clamp(2, MAX_POINTS);
    let text = format!("{}:{}:{points}{spacing}", key.show(from), key.show(to));
    Ok(KeyRange::parse(key, &text)?)
}
