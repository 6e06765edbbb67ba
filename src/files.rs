//! Whole files or none: written beside their place, synced, renamed.

use std::fs::File;
use std::io::{Error, Result, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file in the making: gone when dropped, in its place once kept.
#[derive(Debug)]
pub(crate) struct Draft {
    target: PathBuf,
    file: NamedTempFile,
}

impl Draft {
    /// Opens a temporary file in the folder of `path`; where `path` is a symbolic link, of the file it leads to.
    ///
    /// # Errors
    /// Those of the system, and one for a target that exists but is no ordinary file: renaming would replace a device or a pipe.
    pub fn beside(path: &Path) -> Result<Draft> {
        let target = if path.is_symlink() { path.canonicalize()? } else { path.to_owned() };
        if target.metadata().is_ok_and(|m| !m.is_file()) {
            return Err(Error::other("is not an ordinary file; choose another name"));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".spiral-atlas-").suffix(".part");
        // Temporary files are private by default; these become ordinary ones.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let folder = folder(&target);
        if !folder.is_dir() {
            return Err(Error::other(format!("there is no folder `{}`", folder.display())));
        }
        // The kind alone: the error names the temporary file.
        let file = builder.tempfile_in(folder).map_err(|e| e.kind())?;
        Ok(Draft { target, file })
    }

    /// The file to write to.
    pub fn file(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Puts the file in its place, on the disk.
    ///
    /// # Errors
    /// Those of the system; what was in the place before is then untouched.
    pub fn keep(self) -> Result<()> {
        self.file.as_file().sync_all()?;
        self.file.persist(&self.target).map_err(|e| e.error)?;
        // Makes the new name durable; only Unix lets a folder be opened for that.
        if cfg!(unix) { File::open(folder(&self.target))?.sync_all() } else { Ok(()) }
    }
}

fn folder(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a file whole or not at all.
///
/// # Errors
/// [`crate::Error::Io`], naming `path`, when the folder is missing, the disk is full, the target is no ordinary file, and so on;
/// an older file is then untouched.
pub fn write_file(path: &Path, bytes: &[u8]) -> crate::Result<()> {
    let write = || {
        let mut draft = Draft::beside(path)?;
        draft.file().write_all(bytes)?;
        draft.keep()
    };
    write().map_err(crate::Error::io(path))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn links_are_followed_and_devices_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        std::fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_file(&link, b"new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        // A socket stands for every special file: making one needs no rights.
        let special = folder.path().join("special");
        let _socket = std::os::unix::net::UnixListener::bind(&special).unwrap();
        let message = write_file(&special, b"x").unwrap_err().to_string();
        assert!(message.contains("special") && message.contains("ordinary file"), "{message}");
        assert!(!special.metadata().unwrap().is_file());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3, "nothing else is left");
    }
}
