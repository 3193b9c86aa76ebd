//! Every real dataset and command file of the corpus: what `stiction check` says about it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        if path.is_dir() {
            files(&path, found);
        } else if ["adm", "acf"].contains(&extension.to_ascii_lowercase().as_str()) {
            found.push(path);
        }
    }
}

/// Statement or argument that a message is about: its text up to the first figures.
fn subject(message: &str) -> String {
    message
        .split(|c: char| c.is_ascii_digit())
        .next()
        .unwrap_or(message)
        .trim()
        .to_owned()
}

#[test]
fn every_file_is_checked() {
    let Some(corpus) = reference_data::path("corpus") else {
        return;
    };
    let mut found = Vec::new();
    files(&corpus, &mut found);
    let mut refused: BTreeMap<String, (usize, Vec<usize>)> = BTreeMap::new();
    let (mut read, mut assembled) = (0, 0);
    for (number, path) in found.iter().enumerate() {
        let simulation = stiction::Project::load(path).and_then(|project| project.simulation());
        match simulation {
            Ok(mut simulation) => {
                read += 1;
                match simulation.assemble() {
                    Ok(_) => assembled += 1,
                    Err(error) => println!("{}: {error}", path.display()),
                }
            }
            Err(error) => {
                assert!(
                    !error.messages.is_empty(),
                    "{}: refused without a word",
                    path.display()
                );
                for message in error.messages.iter().filter(|message| message.is_error()) {
                    let key = format!(
                        "{:?}: {}",
                        message.diagnostic.code,
                        subject(&message.diagnostic.message)
                    );
                    let entry = refused.entry(key).or_default();
                    entry.0 += 1;
                    if entry.1.last() != Some(&number) {
                        entry.1.push(number);
                    }
                }
            }
        }
    }
    println!(
        "{} files, {read} can be simulated, {assembled} of them assemble",
        found.len()
    );
    let mut list: Vec<_> = refused.iter().collect();
    list.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    for (subject, (count, files)) in list {
        println!("{count:6} in {:2} files  {subject}", files.len());
    }
    assert!(found.len() > 70, "the corpus has 78 files");
}
