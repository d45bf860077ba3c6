//! A file that is there when it is whole.

use std::fs::{self, File, Permissions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// A file that is written beside its place and renamed when it is whole; until then its place is as it was. What is no
/// plain file (`/dev/null`, a pipe) is written to.
pub struct Whole(Part);

enum Part {
    Beside(NamedTempFile, PathBuf),
    There(File),
}

impl Whole {
    /// The file to be.
    ///
    /// # Errors
    /// A folder is there, or nothing can be written.
    pub fn new(path: &Path) -> io::Result<Whole> {
        // Behind a link the file itself is replaced, not the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let before = fs::metadata(&path).ok();
        if let Some(before) = &before {
            if before.is_dir() {
                return Err(io::Error::from(ErrorKind::IsADirectory));
            }
            if !before.is_file() {
                return Ok(Whole(Part::There(File::options().write(true).open(&path)?)));
            }
            // A file that must not be written to must not be replaced either.
            File::options().append(true).open(&path)?;
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let beside = beside(folder)?;
        if let Some(before) = before {
            beside.as_file().set_permissions(before.permissions())?;
        }
        Ok(Whole(Part::Beside(beside, path)))
    }

    /// Puts it to its place.
    ///
    /// # Errors
    /// It cannot be written to the end; its place is as it was.
    pub fn finish(self) -> io::Result<()> {
        match self.0 {
            Part::Beside(beside, path) => {
                // Some disks say only now that they are full.
                beside.as_file().sync_all()?;
                beside.persist(path)?;
                Ok(())
            }
            Part::There(mut file) => file.flush(),
        }
    }
}

impl Write for Whole {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.0 {
            Part::Beside(beside, _) => beside.write(bytes),
            Part::There(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.0 {
            Part::Beside(beside, _) => beside.flush(),
            Part::There(file) => file.flush(),
        }
    }
}

fn beside(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".stiffarm-");
    // Readable like any new file; by default a temporary one is its owner's alone.
    let permissions = readable();
    if let Some(permissions) = permissions {
        builder.permissions(permissions);
    }
    builder.tempfile_in(folder)
}

#[cfg(unix)]
fn readable() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt as _;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn readable() -> Option<Permissions> {
    None
}
