//! Where the files of a project are read from: the disk, or texts in memory.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// Files by their paths.
pub trait Files {
    /// The bytes of a file.
    ///
    /// # Errors
    /// A file that does not exist or cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// Whether there is such a file.
    fn is_file(&self, path: &Path) -> bool;

    /// The files and folders in a folder; none where it cannot be read.
    fn in_folder(&self, folder: &Path) -> Vec<PathBuf>;
}

/// The files of the disk.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Files for Disk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }

    fn in_folder(&self, folder: &Path) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .collect()
    }
}

/// Texts in memory.
///
/// ```
/// use std::{collections::BTreeMap, path::PathBuf};
/// let text = "a part alone\nPART/1, GROUND\nEND\n";
/// let files = BTreeMap::from([(PathBuf::from("alone.adm"), text.as_bytes().to_vec())]);
/// let project = stiction::Project::load_from(&files, "alone.adm".as_ref(), Default::default())?;
/// assert_eq!(project.dataset().title, "a part alone");
/// # Ok::<(), stiction::InputError>(())
/// ```
impl Files for BTreeMap<PathBuf, Vec<u8>> {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let found = self.get(path).cloned();
        found.ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn is_file(&self, path: &Path) -> bool {
        self.contains_key(path)
    }

    fn in_folder(&self, folder: &Path) -> Vec<PathBuf> {
        let inside = |path: &&PathBuf| path.parent() == Some(folder);
        self.keys().filter(inside).cloned().collect()
    }
}
