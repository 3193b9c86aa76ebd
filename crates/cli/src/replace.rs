//! Files are replaced as a whole or not at all.

use std::fs::Permissions;
use std::io::{self, Write};
use std::path::Path;

/// Writes a file under another name in the same folder and then gives it its own, so that whatever
/// happens the old or the new file is there. A link is followed; permissions stay.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let old = std::fs::metadata(path).ok();
    let target = match old {
        Some(_) => path.canonicalize()?,
        None => path.to_path_buf(),
    };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    let permissions: Option<Permissions> = old.map(|old| old.permissions());
    match &permissions {
        Some(permissions) => {
            builder.permissions(permissions.clone());
        }
        // A new file is for whom files are of who makes it, not for its maker alone.
        #[cfg(unix)]
        None => {
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        }
        #[cfg(not(unix))]
        None => {}
    }
    // Without the name of the other file, which means nothing to anybody.
    let file = builder.tempfile_in(folder);
    let mut file = file.map_err(|error| io::Error::from(error.kind()))?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    if let Some(permissions) = permissions {
        file.as_file().set_permissions(permissions)?;
    }
    file.persist(target)?;
    Ok(())
}
