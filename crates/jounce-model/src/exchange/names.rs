//! Table of names: `kind,index,name`, one line each.

use super::ExchangeFaults;
use std::collections::HashSet;
use std::fmt::Write as _;

const HEAD: &str = "kind,index,name";

/// What a line of the table names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NameKind {
    /// A degree of freedom, for the reader only.
    Degree,
    /// A row of the matrix `points`; without this matrix, a degree of freedom.
    Point,
    /// A column of the matrix `coupling`.
    Electrode,
}

impl NameKind {
    const ALL: [(Self, &str); 3] = [
        (Self::Degree, "degree"),
        (Self::Point, "point"),
        (Self::Electrode, "electrode"),
    ];

    fn word(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(kind, _)| *kind == self)
            .map_or("", |(_, word)| word)
    }
}

/// Names in the order of the table.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Names {
    /// Kind, index counted from 0, and name.
    pub lines: Vec<(NameKind, usize, String)>,
}

impl Names {
    /// Adds names of one kind with ascending indices.
    pub fn add<'a>(&mut self, kind: NameKind, names: impl IntoIterator<Item = &'a String>) {
        let lines = names.into_iter().enumerate();
        self.lines
            .extend(lines.map(|(index, name)| (kind, index, name.clone())));
    }

    /// Returns the faults of all names.
    pub fn faults(&self) -> Vec<String> {
        let names = self.lines.iter().map(|(_, _, name)| check_name(name));
        names.filter_map(Result::err).collect()
    }

    /// Returns the index and the name of each line of a kind.
    pub fn of(&self, kind: NameKind) -> impl Iterator<Item = (usize, &str)> + '_ {
        let lines = self.lines.iter().filter(move |line| line.0 == kind);
        lines.map(|(_, index, name)| (*index, name.as_str()))
    }

    /// Returns the table as text, with indices counted from 1.
    pub fn text(&self) -> String {
        let mut text = format!("{HEAD}\n");
        for (kind, index, name) in &self.lines {
            let _ = writeln!(text, "{},{},{name}", kind.word(), index + 1);
        }
        text
    }

    /// Reads the table of a file, with indices counted from 1.
    ///
    /// # Errors
    /// Every wrong line, and names given twice.
    pub fn read(text: &str, file: &str) -> Result<Self, ExchangeFaults> {
        Self::read_with(text, file, |_, index| {
            let number: Option<usize> = index.parse().ok().filter(|index| *index > 0);
            let number = number.map(|number| number - 1);
            number.ok_or_else(|| format!("the index {index:?} is not a number from 1"))
        })
    }

    /// Reads the table of a file, with an index in its own notation for each kind.
    ///
    /// # Errors
    /// Every wrong line, and names given twice.
    pub fn read_with(
        text: &str,
        file: &str,
        mut index_of: impl FnMut(NameKind, &str) -> Result<usize, String>,
    ) -> Result<Self, ExchangeFaults> {
        let mut names = Self::default();
        let mut seen = HashSet::new();
        let mut faults = Vec::new();
        let lines = text
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line.trim()));
        for (number, line) in lines.filter(|(_, line)| !line.is_empty()) {
            if number == 1 {
                if line.replace(' ', "") != HEAD {
                    faults.push(format!(
                        "{file}: the first line is {line:?}; it must be {HEAD:?}"
                    ));
                }
                continue;
            }
            match name_of(line, &mut index_of) {
                Ok((kind, _, name)) if !seen.insert((kind, name.clone())) => {
                    faults.push(format!(
                        "{file}, line {number}: the {} {name} is named twice",
                        kind.word()
                    ));
                }
                Ok(line) => names.lines.push(line),
                Err(message) => faults.push(format!("{file}, line {number}: {message}")),
            }
        }
        if faults.is_empty() {
            Ok(names)
        } else {
            Err(ExchangeFaults(faults))
        }
    }
}

fn name_of(
    line: &str,
    index_of: &mut impl FnMut(NameKind, &str) -> Result<usize, String>,
) -> Result<(NameKind, usize, String), String> {
    let words: Vec<&str> = line.split(',').map(str::trim).collect();
    let [kind, index, name] = words[..] else {
        return Err(format!("{line:?} has {} columns, not 3", words.len()));
    };
    let found = NameKind::ALL.iter().find(|(_, word)| *word == kind);
    let (kind, _) =
        found.ok_or_else(|| format!("the kind {kind:?} is not degree, point or electrode"))?;
    let index = index_of(*kind, index)?;
    check_name(name)?;
    Ok((*kind, index, name.to_owned()))
}

fn check_name(name: &str) -> Result<(), String> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    if name.is_empty() || !name.chars().all(allowed) {
        return Err(format!(
            "the name {name:?} must consist of letters, digits, _, - and ."
        ));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_back() {
        let mut names = Names::default();
        names.add(
            NameKind::Point,
            &["beam.tip".to_owned(), "table".to_owned()],
        );
        names.add(NameKind::Electrode, &["mfc".to_owned()]);
        assert_eq!(
            names.text(),
            "kind,index,name\npoint,1,beam.tip\npoint,2,table\nelectrode,1,mfc\n"
        );
        assert_eq!(Names::read(&names.text(), "names.csv").unwrap(), names);
    }

    #[test]
    fn all_faults_are_listed() {
        let text = "kind,index,name\npoint,0,tip\nplace,1,tip\npoint,1,my tip\npoint,1\npoint,2,a\npoint,3,a\n";
        let faults = Names::read(text, "names.csv").unwrap_err();
        assert_eq!(faults.0.len(), 5, "{faults}");
        assert!(faults.0[0].contains("line 2: the index \"0\" is not a number from 1"));
        assert!(faults.0[4].contains("line 7: the point a is named twice"));
    }
}
