//! Saved address of a page for the next server of the same spec, to which an open page reconnects.
//!
//! Each spec has one small file that only its owner may read, since the token in it grants access.

use sha2::{Digest, Sha256};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Port and token of the last server of a spec.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedAddress {
    /// The port.
    pub port: u16,
    /// The token.
    pub token: String,
}

/// Returns the folder of this system for the state of programs; `None` where the system specifies
/// no folder.
pub fn state_folder() -> Option<PathBuf> {
    let absolute_path = |name: &str| {
        std::env::var_os(name)
            .map(PathBuf::from)
            .filter(|path| path.is_absolute())
    };
    let state = absolute_path("XDG_STATE_HOME")
        .or_else(|| Some(absolute_path("HOME")?.join(".local/state")));
    Some(
        state
            .or_else(|| absolute_path("LOCALAPPDATA"))?
            .join("jounce"),
    )
}

/// Returns the file of a spec.
fn address_file(folder: &Path, spec: &Path) -> PathBuf {
    let canonical_path = spec.canonicalize().unwrap_or_else(|_| spec.to_path_buf());
    let path_bytes = canonical_path.as_os_str().as_encoded_bytes();
    let digest = format!("{:x}", Sha256::digest(path_bytes));
    folder.join(format!("explore-{digest:.16}"))
}

impl SavedAddress {
    /// Reads the saved address of a spec. A file that others may read or write is ignored.
    pub fn read(folder: &Path, spec: &Path) -> Option<Self> {
        let path = address_file(folder, spec);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let metadata = std::fs::symlink_metadata(&path).ok()?;
            if !metadata.is_file() || metadata.permissions().mode() & 0o077 != 0 {
                return None;
            }
        }
        let text = std::fs::read_to_string(path).ok()?;
        let (port, token) = text.trim().split_once(' ')?;
        let is_token = token.len() == 32 && token.bytes().all(|letter| letter.is_ascii_hexdigit());
        Some(Self {
            port: port.parse().ok()?,
            token: token.to_owned(),
        })
        .filter(|_| is_token)
    }

    /// Saves the address.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn write(&self, folder: &Path, spec: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        // Only its owner can read a temporary file, from its creation.
        let mut temporary = tempfile::NamedTempFile::new_in(folder)?;
        writeln!(temporary, "{} {}", self.port, self.token)?;
        temporary
            .persist(address_file(folder, spec))
            .map_err(|error| error.error)?;
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_read_back_unless_others_can_read_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let (one, other) = (folder.path().join("a.toml"), folder.path().join("b.toml"));
        let address = SavedAddress {
            port: 4321,
            token: "0123456789abcdef0123456789abcdef".into(),
        };
        assert_eq!(SavedAddress::read(folder.path(), &one), None);
        address.write(folder.path(), &one).unwrap();
        assert_eq!(
            (
                SavedAddress::read(folder.path(), &one),
                SavedAddress::read(folder.path(), &other)
            ),
            (Some(address.clone()), None)
        );
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let path = address_file(folder.path(), &one);
            std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o640)).unwrap();
            assert_eq!(SavedAddress::read(folder.path(), &one), None);
        }
        std::fs::write(address_file(folder.path(), &other), "80 short").unwrap();
        assert_eq!(SavedAddress::read(folder.path(), &other), None);
    }
}
