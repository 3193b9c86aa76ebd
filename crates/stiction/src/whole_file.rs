//! Files that are there as a whole or not at all.

use std::io;
use std::path::{Path, PathBuf};

/// The name that a file has until it is whole: its own and `.part`.
///
/// ```
/// use std::path::Path;
/// assert_eq!(stiction::unfinished(Path::new("a/run.json")), Path::new("a/run.json.part"));
/// ```
#[must_use]
pub fn unfinished(path: &Path) -> PathBuf {
    path.with_added_extension("part")
}

/// Lets `write` write a file under its [`unfinished`] name and then gives it its own. What cannot be
/// written leaves nothing behind: it would only take space from a disk that may be full.
///
/// # Errors
/// Those of `write`, and a name that the file cannot be given.
///
/// ```
/// let folder = std::env::temp_dir().join(format!("whole-file-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let path = folder.join("notes.txt");
/// stiction::write_whole(&path, |part| std::fs::write(part, "all of it"))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "all of it");
/// let failed = stiction::write_whole(&path, |part| {
///     std::fs::write(part, "half")?;
///     Err(std::io::Error::other("full"))
/// });
/// assert!(failed.is_err() && !stiction::unfinished(&path).exists());
/// assert_eq!(std::fs::read_to_string(&path)?, "all of it");
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_whole(path: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let part = unfinished(path);
    let written = write(&part).and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        let _ = std::fs::remove_file(&part);
    }
    written
}
