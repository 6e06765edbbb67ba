//! Whole files or none: written beside their place, synced, renamed. And texts, read only up to a length.

use crate::error::{Error, Result};
use std::fs::{File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// How the names of files in the making begin and end; between them are random letters.
const DRAFT: (&str, &str) = (".spiral-atlas-", ".part");

/// A byte order mark.
const MARK: &[u8] = "\u{feff}".as_bytes();

/// Most bytes of a recipe: an atlas carries it in its header, which is no longer than this.
pub(crate) const LONGEST_RECIPE: u64 = 1 << 20;

/// A file in the making: gone when dropped, in its place once kept.
///
/// Its writer holds a lock on it, which the system takes back when the writer dies, however that happens. So whoever
/// can lock a draft knows that nobody writes it any more, on this machine or on another one that shares the folder.
/// (Where a network folder is mounted without locks between machines, a draft may be lost to another machine; its
/// writer then ends with an error, never with a wrong file.)
#[derive(Debug)]
pub(crate) struct Draft {
    target: PathBuf,
    file: NamedTempFile,
}

impl Draft {
    /// Opens a temporary file in the folder of `path`; where `path` is a symbolic link, of the file it leads to.
    /// Drafts in that folder whose writers are dead are removed first: they may be large, and nothing else would ever
    /// remove them.
    ///
    /// # Errors
    /// Those of the system, and one for a target that exists but is no ordinary file: renaming would replace a device
    /// or a pipe.
    pub(crate) fn beside(path: &Path) -> io::Result<Draft> {
        let target = place(path)?;
        let folder = folder(&target);
        if !folder.is_dir() {
            return Err(io::Error::other(format!(
                "there is no folder `{}`; create it, or choose another",
                folder.display()
            )));
        }
        sweep(folder);
        loop {
            let mut builder = tempfile::Builder::new();
            builder.prefix(DRAFT.0).suffix(DRAFT.1);
            // Temporary files are private by default; these become ordinary ones.
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
            // The kind alone: the error names the temporary file.
            let file = builder.tempfile_in(folder).map_err(|e| e.kind())?;
            match file.as_file().try_lock() {
                // Another process may have found the file between its making and its lock, and taken it for a dead one.
                Err(TryLockError::WouldBlock) => {}
                Ok(()) if !file.path().exists() => {}
                // Without locks in this file system nothing can be removed there either.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok(Draft { target, file }),
            }
        }
    }

    /// The file to write to.
    pub(crate) fn file(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Puts the file in its place, on the disk.
    ///
    /// # Errors
    /// Those of the system; what was in the place before is then untouched.
    pub(crate) fn keep(self) -> io::Result<()> {
        self.file.as_file().sync_all()?;
        self.file.persist(&self.target).map_err(|e| e.error)?;
        // Makes the new name durable; only Unix lets a folder be opened for that.
        if cfg!(unix) { File::open(folder(&self.target))?.sync_all() } else { Ok(()) }
    }
}

/// Where a file really goes: to the end of a symbolic link. What is there now must be nothing or an ordinary file.
fn place(path: &Path) -> io::Result<PathBuf> {
    let target = if !path.is_symlink() {
        path.to_owned()
    } else if path.exists() {
        path.canonicalize()?
    } else {
        let end = path.read_link()?;
        return Err(io::Error::other(format!(
            "it is a symbolic link to `{}`, which does not exist; remove the link",
            end.display()
        )));
    };
    match target.metadata() {
        Ok(there) if there.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(there) if !there.is_file() => Err(io::Error::other("it is not an ordinary file; choose another name")),
        _ => Ok(target),
    }
}

/// Refuses a name that no file can be written to, because something else has it. For use before long work.
///
/// # Errors
/// [`Error::Io`], naming the path, when there is a folder, a device or a link that leads nowhere.
pub fn check_place(path: &Path) -> Result<()> {
    place(path).map(|_| ()).map_err(Error::io(path))
}

/// The folder of a file.
pub(crate) fn folder(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Removes the drafts in a folder that nobody writes any more. It is a service, so what fails here is left for the next
/// time.
fn sweep(folder: &Path) {
    for entry in folder.read_dir().into_iter().flatten().flatten() {
        let name = entry.file_name();
        let draft = name.to_str().is_some_and(|name| name.starts_with(DRAFT.0) && name.ends_with(DRAFT.1));
        if !draft || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        // Some network file systems lock only what is open for writing.
        if let Ok(file) = File::options().read(true).write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            // While the lock is held: a writer that made the file just now must find it gone.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Refuses a task that the disk has no room for.
///
/// # Arguments
/// - `folder`: where the files go; it need not exist yet.
/// - `what`: the files, for the message.
/// - `needed`: bytes; nothing that is there now counts as free, because an older file goes only once the new one is
///   whole.
///
/// # Errors
/// [`Error::Domain`] with both sizes. A file system that does not report its size is trusted.
pub fn check_room(folder: &Path, what: &str, needed: u64) -> Result<()> {
    let there =
        folder.ancestors().map(|p| if p.as_os_str().is_empty() { Path::new(".") } else { p }).find(|p| p.exists());
    match there.and_then(free) {
        Some(free) if free < needed => Err(Error::invalid(format!(
            "{what} would take {} and the disk of {} has {} free; choose another folder, free some room, or ask for \
             fewer nodes or fields",
            size(needed),
            folder.display(),
            size(free)
        ))),
        _ => Ok(()),
    }
}

/// Bytes that are free on the disk of a folder, where the system says.
#[cfg(not(target_family = "wasm"))]
fn free(folder: &Path) -> Option<u64> {
    fs4::statvfs(folder).ok().filter(|stats| stats.total_space() > 0).map(|stats| stats.available_space())
}

#[cfg(target_family = "wasm")]
fn free(_: &Path) -> Option<u64> {
    None
}

/// Bytes in words: in the largest unit that leaves a number above 1.
pub fn size(bytes: u64) -> String {
    let units = [(1u64 << 40, "TiB", 2), (1 << 30, "GiB", 2), (1 << 20, "MiB", 1), (1 << 10, "KiB", 1)];
    match units.into_iter().find(|(unit, ..)| bytes >= *unit) {
        Some((unit, name, digits)) => format!("{:.digits$} {name}", bytes as f64 / unit as f64),
        None => format!("{bytes} B"),
    }
}

/// Reads a text, of a file or of standard input for `-`, that must not be longer than `most` bytes. A byte order mark,
/// which some editors put at the start, is left out.
///
/// Pipes and devices are read too, since a shell hands them over as files; an endless one is left after `most` bytes.
///
/// # Errors
/// [`Error::Io`] that names the file: it cannot be read, is too long, or is no UTF-8 text.
pub fn read_text(path: &Path, most: u64) -> Result<String> {
    let read = || {
        let input: Box<dyn Read> =
            if path == Path::new("-") { Box::new(io::stdin()) } else { Box::new(File::open(path)?) };
        let mut bytes = Vec::new();
        input.take(most + 1).read_to_end(&mut bytes)?;
        if bytes.starts_with(MARK) {
            bytes.drain(..MARK.len());
        }
        if bytes.len() as u64 > most {
            return Err(io::Error::other(format!("it is longer than {}; so long a text is not read", size(most))));
        }
        String::from_utf8(bytes).map_err(|e| {
            let at = e.utf8_error().valid_up_to();
            io::Error::other(format!("it is no text: byte {at} and what follows is not UTF-8"))
        })
    };
    read().map_err(Error::io(if path == Path::new("-") { Path::new("(standard input)") } else { path }))
}

/// Writes a file whole or not at all.
///
/// # Errors
/// [`crate::Error::Io`], naming `path`, when the folder is missing, the disk is full, the target is no ordinary file,
/// and so on; an older file is then untouched.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    let write = || {
        let mut draft = Draft::beside(path)?;
        draft.file().write_all(bytes)?;
        draft.keep()
    };
    write().map_err(Error::io(path))
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

    fn drafts(folder: &Path) -> usize {
        folder
            .read_dir()
            .unwrap()
            .filter(|e| e.as_ref().unwrap().file_name().to_str().unwrap().ends_with(DRAFT.1))
            .count()
    }

    #[test]
    fn drafts_of_dead_writers_go_and_those_of_living_ones_stay() {
        let folder = tempfile::tempdir().unwrap();
        let alive = Draft::beside(&folder.path().join("alive")).unwrap();
        let draft = |middle: &str| folder.path().join(format!("{}{middle}{}", DRAFT.0, DRAFT.1));
        std::fs::write(draft("dead"), "nobody holds its lock").unwrap();
        std::fs::create_dir(draft("folder")).unwrap();
        std::fs::write(folder.path().join(".spiral-atlas-notes"), "another's").unwrap();
        std::os::unix::fs::symlink(folder.path().join(".spiral-atlas-notes"), draft("link")).unwrap();
        write_file(&folder.path().join("other"), b"x").unwrap();
        assert!(!draft("dead").exists() && draft("folder").exists() && draft("link").exists());
        assert!(folder.path().join(".spiral-atlas-notes").exists());
        assert_eq!(drafts(folder.path()), 3);
        alive.keep().unwrap();
        assert!(folder.path().join("alive").exists());
    }

    /// Many writers that each sweep before they write: none loses its draft to another.
    #[test]
    fn writers_at_the_same_time_do_not_harm_each_other() {
        let folder = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            for writer in 0..4 {
                let folder = folder.path();
                scope.spawn(move || {
                    for i in 0..100 {
                        write_file(&folder.join(format!("{writer}-{i}")), b"x").unwrap();
                    }
                });
            }
        });
        assert_eq!((drafts(folder.path()), folder.path().read_dir().unwrap().count()), (0, 400));
    }

    #[test]
    fn what_the_disk_cannot_hold_is_refused_with_both_sizes() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("not/there/yet");
        check_room(&deep, "this", 1).unwrap();
        let message = check_room(&deep, "`big`", 5 << 60).unwrap_err().to_string();
        assert!(message.starts_with("`big` would take 5242880.00 TiB") && message.contains("free;"), "{message}");
        assert!(message.contains(deep.to_str().unwrap()), "{message}");
        assert_eq!([12, 2048, 5 << 20, 3 << 29].map(size), ["12 B", "2.0 KiB", "5.0 MiB", "1.50 GiB"]);
    }

    #[test]
    fn texts_are_read_up_to_a_length() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read_text(&path, 5).unwrap(), "12345");
        let message = |path: &Path, most| read_text(path, most).unwrap_err().to_string();
        assert!(message(&path, 4).contains("longer than 4 B"));
        assert!(message(Path::new("/dev/zero"), 1 << 16).contains("/dev/zero: it is longer than 64.0 KiB"));
        std::fs::write(&path, b"ab\xff").unwrap();
        assert!(message(&path, 5).contains("byte 2"));
    }

    #[test]
    fn a_link_that_leads_nowhere_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("nowhere", &link).unwrap();
        let message = write_file(&link, b"x").unwrap_err().to_string();
        assert!(message.contains("symbolic link to `nowhere`"), "{message}");
        assert!(write_file(folder.path(), b"x").unwrap_err().to_string().contains("folder"));
    }
}
