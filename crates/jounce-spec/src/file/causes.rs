//! Overrides that cause faults of a file.

use super::{Fault, SpecFile};

impl SpecFile {
    /// Returns the file with those overrides that a condition on their number accepts.
    fn with_overrides(&self, is_wanted: impl Fn(usize) -> bool) -> Self {
        let mut file = Self::from_text(self.text.clone()).in_folder(&self.folder);
        let wanted = self.overrides.iter().enumerate();
        for (_, change) in wanted.filter(|(index, _)| is_wanted(*index)) {
            // A key that exists with all overrides may be absent with some of them.
            let (key, value) = change.assignment();
            file.set(&key, value).ok();
        }
        file
    }

    /// Names the overrides in faults of the file that the file alone does not have: those without
    /// which the fault is absent, or all where no single one is the cause.
    pub(super) fn with_causes(&self, faults: Vec<Fault>) -> Vec<Fault> {
        if self.overrides.is_empty() {
            return faults;
        }
        let found = |file: Self| file.read_spec().err().unwrap_or_default();
        let own = found(self.with_overrides(|_| false));
        if (faults.iter()).all(|fault| fault.set.is_some() || own.contains(fault)) {
            return faults;
        }
        let numbers = 0..self.overrides.len();
        let without: Vec<Vec<Fault>> = numbers
            .map(|number| found(self.with_overrides(|other| other != number)))
            .collect();
        let causes = |fault: &Fault| {
            let is_cause = |number: &usize| !without[*number].contains(fault);
            let mut causes: Vec<usize> = (0..without.len()).filter(is_cause).collect();
            if causes.is_empty() {
                causes = (0..without.len()).collect();
            }
            let causes = causes
                .iter()
                .map(|number| self.overrides[*number].to_string());
            causes.collect::<Vec<_>>().join(" ")
        };
        let with_cause = |fault: Fault| match fault.set.is_none() && !own.contains(&fault) {
            true => Fault {
                message: format!("{}; caused by {}", fault.message, causes(&fault)),
                ..fault
            },
            false => fault,
        };
        faults.into_iter().map(with_cause).collect()
    }
}
