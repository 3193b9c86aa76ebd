//! Damaged models: whatever a file says, it is checked or refused, without a panic and without end.

use std::sync::atomic::{AtomicUsize, Ordering};

use stiction::{Project, check};

use crate::shared::scratch_folder;

/// Reads, lowers and assembles damaged texts. `STICTION_FUZZ_CHECKS` sets their number.
#[test]
fn damaged_models_are_checked_or_refused() {
    let folder = scratch_folder();
    let number = AtomicUsize::new(0);
    let assembled = damaged_texts::each("STICTION_FUZZ_CHECKS", 2_000, |bytes| {
        let file = folder.join(format!("{}.adm", number.fetch_add(1, Ordering::Relaxed)));
        std::fs::write(&file, bytes).unwrap();
        let checked = Project::load(&file).and_then(|project| check(&project));
        std::fs::remove_file(&file).unwrap();
        match checked {
            Ok(_) => 1,
            Err(error) => {
                assert!(!error.to_string().is_empty());
                0
            }
        }
    });
    println!("{assembled} of them can be simulated");
    std::fs::remove_dir_all(folder).unwrap();
}
