//! Bases: supports whose motion a drive prescribes.

use super::{Drive, DriveKind};
use crate::Spec;
use std::collections::BTreeSet;

/// The base that always exists.
pub const GROUND: &str = "ground";

impl Drive {
    /// Returns the base whose motion the drive prescribes; `None` for a force.
    pub fn base(&self) -> Option<&str> {
        match self.kind {
            DriveKind::Force => None,
            DriveKind::BaseAcceleration | DriveKind::BaseDisplacement if self.at.is_empty() => {
                Some(GROUND)
            }
            DriveKind::BaseAcceleration | DriveKind::BaseDisplacement => Some(&self.at),
        }
    }
}

impl Spec {
    /// Returns the bases other than the ground, which their drives name.
    pub fn bases(&self) -> BTreeSet<&str> {
        self.drive
            .values()
            .filter_map(Drive::base)
            .filter(|base| *base != GROUND)
            .collect()
    }

    /// Removes all drives. Their bases become parts of the fixed ground.
    pub fn take_drives_away(&mut self) {
        let bases: BTreeSet<String> = self.bases().into_iter().map(str::to_owned).collect();
        self.drive.clear();
        let roots = self.beam.values_mut().map(|beam| &mut beam.root);
        let plates = self.plate.values_mut().map(|plate| &mut plate.on);
        let under = self.mass.values_mut().map(|mass| &mut mass.on);
        let frames = self.stop.values_mut().map(|stop| &mut stop.frame);
        roots
            .chain(plates)
            .chain(under)
            .chain(frames)
            .filter(|name| bases.contains(*name))
            .for_each(|name| *name = GROUND.to_owned());
    }

    /// True for the ground and every other base.
    pub fn is_base(&self, name: &str) -> bool {
        name == GROUND || self.drive.values().any(|drive| drive.base() == Some(name))
    }

    /// Returns the base under a base, a mass or a point, to which its displacements are relative.
    /// The base of a free mass is the ground.
    pub fn base_under<'s>(&'s self, point: &'s str) -> &'s str {
        let mut at = point;
        for _ in 0..=self.mass.len() + self.beam.len() {
            at = match at.split_once('.') {
                Some((body, _)) => self.support_of_body(body),
                None if self.is_base(at) => return at,
                None => self.mass.get(at).map_or(GROUND, |mass| &mass.on),
            };
        }
        GROUND
    }

    /// Returns the support of a beam or a plate; the ground for any other body.
    fn support_of_body(&self, body: &str) -> &str {
        let beam = self.beam.get(body).map(|beam| beam.root.as_str());
        let plate = || self.plate.get(body).map(|plate| plate.on.as_str());
        beam.or_else(plate).unwrap_or(GROUND)
    }
}
