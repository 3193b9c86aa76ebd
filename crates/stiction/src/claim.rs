//! One run at a time writes into a folder.

use std::path::Path;

use crate::session::OutputError;

/// Keeps a folder for one run until it is dropped or its process ends, however it ends.
///
/// It is a lock of the operating system on the folder itself, which leaves nothing behind. Where the file
/// system has no locks, and elsewhere than on Unix, nothing is kept.
#[derive(Debug)]
pub struct Claim {
    #[cfg(unix)]
    _folder: std::fs::File,
}

impl Claim {
    /// Claims a folder that exists.
    ///
    /// # Errors
    /// Another run has claimed it; or it cannot be opened.
    ///
    /// ```
    /// use stiction::Claim;
    /// let folder = std::env::temp_dir().join(format!("claim-{}", std::process::id()));
    /// std::fs::create_dir_all(&folder).unwrap();
    /// let first = Claim::of(&folder)?;
    /// # #[cfg(unix)]
    /// assert!(Claim::of(&folder).unwrap_err().cause.contains("another run"));
    /// drop(first);
    /// assert!(Claim::of(&folder).is_ok());
    /// # std::fs::remove_dir(&folder).unwrap();
    /// # Ok::<(), stiction::OutputError>(())
    /// ```
    pub fn of(folder: &Path) -> Result<Self, OutputError> {
        Self::of_free(folder)?.ok_or_else(|| {
            let cause = "another run is writing results into this folder; wait for it, or choose another one";
            OutputError::at(folder, &cause)
        })
    }

    /// Claims a folder that exists; none where another process has claimed it.
    ///
    /// # Errors
    /// It cannot be opened.
    #[cfg(unix)]
    pub fn of_free(folder: &Path) -> Result<Option<Self>, OutputError> {
        let opened =
            std::fs::File::open(folder).map_err(|error| OutputError::at(folder, &error))?;
        Ok(match opened.try_lock() {
            Err(std::fs::TryLockError::WouldBlock) => None,
            // Without locks there is nothing to ask.
            Ok(()) | Err(std::fs::TryLockError::Error(_)) => Some(Self { _folder: opened }),
        })
    }

    /// Claims a folder that exists.
    ///
    /// # Errors
    /// None where folders cannot be locked.
    #[cfg(not(unix))]
    pub fn of_free(_: &Path) -> Result<Option<Self>, OutputError> {
        Ok(Some(Self {}))
    }
}
