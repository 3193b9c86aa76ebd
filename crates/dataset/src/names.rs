//! Names and their abbreviations: which one is meant, and which one might have been meant.

/// A name with the shortest prefix that stands for it where several names share the prefix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Name {
    /// The whole name, in capitals.
    pub(crate) full: &'static str,
    /// Its least abbreviation.
    pub(crate) least: &'static str,
}

/// What a word means among a list of names.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Match {
    /// The name at this position.
    One(usize),
    /// Several names start with the word.
    Several(Vec<&'static str>),
    /// No name starts with the word.
    None,
}

/// Finds the name that `word` means: itself, else the only name that starts with it, else the
/// only one of these whose least abbreviation is no longer than the word.
pub(crate) fn find(word: &str, names: impl Iterator<Item = Name> + Clone) -> Match {
    let word = word.as_bytes();
    let starts = |name: &Name| {
        let start = name.full.as_bytes().get(..word.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(word))
    };
    let found = || names.clone().enumerate().filter(|(_, name)| starts(name));
    let mut first = None;
    let mut several = false;
    for (index, name) in found() {
        if name.full.len() == word.len() {
            return Match::One(index);
        }
        several |= first.is_some();
        first = first.or(Some(index));
    }
    match first {
        None => return Match::None,
        Some(index) if !several => return Match::One(index),
        Some(_) => {}
    }
    let mut allowed = found().filter(|(_, name)| word.len() >= name.least.len());
    match (allowed.next(), allowed.next()) {
        (Some((index, _)), None) => Match::One(index),
        _ => Match::Several(found().map(|(_, name)| name.full).collect()),
    }
}

/// The shortest name that `word` begins, else the name with the fewest edits from it, if these are
/// at most a third of its letters.
///
/// ```
/// let names = ["GUIDE", "HINGE"];
/// assert_eq!(dataset::nearest_name("guid", names.into_iter()), Some("GUIDE"));
/// assert_eq!(dataset::nearest_name("slider", names.into_iter()), None);
/// ```
pub fn nearest<'a>(word: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if word.is_empty() || word.len() > LONGEST_NAME {
        return None;
    }
    let begins = |name: &str| shared_start(word, name) == word.len();
    let most = |name: &str| 1.max(name.len().max(word.len()) / 3);
    names
        .filter(|name| begins(name) || name.len().abs_diff(word.len()) <= most(name))
        .map(|name| (edits(word.as_bytes(), name.as_bytes()), name))
        .filter(|(edits, name)| begins(name) || *edits <= most(name))
        .filter(|(edits, name)| *edits < name.len())
        // Of several, the one that starts like the word is meant.
        .min_by_key(|(edits, name)| {
            let unlike = usize::MAX - shared_start(word, name);
            (!begins(name), *edits, unlike)
        })
        .map(|(_, name)| name)
}

/// The number of letters that two names have in common at their starts.
fn shared_start(a: &str, b: &str) -> usize {
    let pairs = a.bytes().zip(b.bytes());
    pairs.take_while(|(a, b)| a.eq_ignore_ascii_case(b)).count()
}

/// No name of the language is longer than this.
const LONGEST_NAME: usize = 40;

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`, whatever the
/// case of the letters.
fn edits(a: &[u8], b: &[u8]) -> usize {
    let same = |i: usize, j: usize| a[i].eq_ignore_ascii_case(&b[j]);
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1; b.len() + 1];
        for j in 0..b.len() {
            let replaced = last[j] + usize::from(!same(i, j));
            row[j + 1] = replaced.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j) {
                row[j + 1] = row[j + 1].min(before_last[j - 1] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [Name; 4] = [
        Name {
            full: "REQUEST",
            least: "R",
        },
        Name {
            full: "RESULTS",
            least: "RES",
        },
        Name {
            full: "PART",
            least: "P",
        },
        Name {
            full: "PARTS",
            least: "PARTS",
        },
    ];

    #[test]
    fn the_exact_name_wins_then_the_only_one_then_the_least_abbreviation() {
        let find = |word| find(word, NAMES.into_iter());
        assert_eq!(find("part"), Match::One(2));
        assert_eq!(find("resu"), Match::One(1));
        assert_eq!(find("RE"), Match::One(0));
        assert_eq!(find("RES"), Match::One(1));
        assert_eq!(find("PRAT"), Match::None);
    }

    #[test]
    fn the_nearest_name_is_not_far() {
        let nearest = |word| nearest(word, NAMES.into_iter().map(|name| name.full));
        assert_eq!(nearest("PRAT"), Some("PART"));
        assert_eq!(nearest("RESULT"), Some("RESULTS"));
        assert_eq!(nearest("XYZZY"), None);
        assert_eq!(nearest("RESUL"), Some("RESULTS"));
        assert_eq!(nearest("PA"), Some("PART"));
        assert_eq!(nearest(""), None);
    }

    #[test]
    fn edits_count_swaps_once() {
        assert_eq!(edits(b"PRAT", b"PART"), 1);
        assert_eq!(edits(b"", b"PART"), 4);
        assert_eq!(edits(b"MU_STATC", b"MU_STATIC"), 1);
    }
}
