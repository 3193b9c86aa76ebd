//! Files that are remembered as they are read, so that a model can be pickled.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use stiction::Files;

/// Texts by their paths.
pub(crate) type Texts = BTreeMap<PathBuf, Vec<u8>>;

/// Other files, with all that was read of them.
pub(crate) struct Recording<'a> {
    files: &'a dyn Files,
    read: RefCell<Texts>,
}

impl<'a> Recording<'a> {
    pub(crate) fn of(files: &'a dyn Files) -> Self {
        Self {
            files,
            read: RefCell::default(),
        }
    }

    /// What was read.
    pub(crate) fn into_texts(self) -> Texts {
        self.read.into_inner()
    }
}

impl Files for Recording<'_> {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let bytes = self.files.read(path)?;
        self.read
            .borrow_mut()
            .insert(path.to_owned(), bytes.clone());
        Ok(bytes)
    }

    fn is_file(&self, path: &Path) -> bool {
        self.files.is_file(path)
    }

    fn in_folder(&self, folder: &Path) -> Vec<PathBuf> {
        self.files.in_folder(folder)
    }
}
