//! Shard: one of several processes that share a study.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Shard `index` of `of`, from 1: it takes every `of`-th part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    /// Number of the shard, from 1.
    pub index: usize,
    /// Number of shards.
    pub of: usize,
}

impl Shard {
    /// The complete study.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// True for a part of this shard.
    pub fn takes(self, part: usize) -> bool {
        part % self.of == self.index - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(index, of)| Some((index.trim().parse().ok()?, of.trim().parse().ok()?)));
        match numbers {
            Some((index, of)) if (1..=of).contains(&index) => Ok(Self { index, of }),
            _ => Err(format!(
                "\"{text}\" is no shard; write I/N with I from 1 to N, as in 3/8"
            )),
        }
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl TryFrom<String> for Shard {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn every_part_falls_to_one_shard() {
        for part in 0..50 {
            assert_eq!(
                (1..=7)
                    .filter(|index| Shard {
                        index: *index,
                        of: 7
                    }
                    .takes(part))
                    .count(),
                1
            );
        }
    }

    #[test]
    fn invalid_shards_are_refused() {
        assert_eq!("3/8".parse::<Shard>().unwrap(), Shard { index: 3, of: 8 });
        for wrong in ["0/8", "9/8", "3", "3/0", "a/b", "-1/2", "1/2/3", ""] {
            assert!(
                wrong.parse::<Shard>().unwrap_err().contains("write I/N"),
                "{wrong}"
            );
        }
    }
}
