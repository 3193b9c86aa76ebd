//! One line of the layout, broken where it is too long.

use crate::syntax::TokenKind;

/// The columns of a line, as Adams View fills them.
pub(super) const WIDTH: usize = 80;

/// A token of a line.
pub(super) struct Piece<'a> {
    pub(super) text: &'a str,
    pub(super) kind: TokenKind,
    /// The blanks before it.
    pub(super) before: &'a str,
}

/// Where a line may be broken.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Breaks {
    Never,
    /// Behind a comma.
    Commas,
    /// Behind a comma, the colon of IF, or a `+` or `-` between two terms.
    Terms,
    /// There, and behind `*`, `/` and `**` as well.
    Factors,
}

/// Writes the pieces behind `start` and breaks the line between pieces where it is longer than
/// [`WIDTH`]. Each new line starts with the comma that continues it: behind a comma both are one,
/// and in an expression it means nothing.
pub(super) fn fill(start: &str, pieces: &[Piece], breaks: Breaks) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = start.to_string();
    let mut width = columns(start);
    let mut is_empty = true;
    for group in groups(pieces, breaks) {
        let starts_line = !is_empty && width + group_columns(group) > WIDTH;
        if starts_line {
            lines.push(std::mem::replace(&mut line, ", ".to_string()));
            width = 2;
        }
        for (index, piece) in group.iter().enumerate() {
            if !(starts_line && index == 0) {
                line.push_str(piece.before);
                width += columns(piece.before);
            }
            line.push_str(piece.text);
            width += columns(piece.text);
        }
        is_empty = false;
    }
    lines.push(line);
    lines
}

fn columns(text: &str) -> usize {
    text.chars().count()
}

fn group_columns(group: &[Piece]) -> usize {
    let columns = group
        .iter()
        .map(|piece| columns(piece.before) + columns(piece.text));
    columns.sum()
}

/// The pieces between which the line may be broken: terms and arguments, and factors where a term
/// is longer than a line.
fn groups<'a>(pieces: &'a [Piece<'a>], breaks: Breaks) -> Vec<&'a [Piece<'a>]> {
    let split = |breaks: Breaks| {
        let mut groups = Vec::new();
        let mut first = 0;
        for at in 0..pieces.len() {
            if at + 1 == pieces.len() || breaks_behind(pieces, at, breaks) {
                groups.push(&pieces[first..=at]);
                first = at + 1;
            }
        }
        groups
    };
    let groups = split(breaks);
    let too_long = |group: &&[Piece]| group_columns(group) > WIDTH - 2;
    if breaks == Breaks::Terms && groups.iter().any(too_long) {
        return split(Breaks::Factors);
    }
    groups
}

/// Whether a line may end behind this piece.
fn breaks_behind(pieces: &[Piece], at: usize, breaks: Breaks) -> bool {
    let operand = at.checked_sub(1).is_some_and(|before| {
        matches!(
            pieces[before].kind,
            TokenKind::Number | TokenKind::Word | TokenKind::RightParenthesis
        )
    });
    match (pieces[at].kind, breaks) {
        (_, Breaks::Never) => false,
        (TokenKind::Comma, _) => true,
        (TokenKind::Colon, Breaks::Terms | Breaks::Factors) => true,
        (TokenKind::Plus | TokenKind::Minus, Breaks::Terms | Breaks::Factors) => operand,
        (TokenKind::Star | TokenKind::Slash | TokenKind::Power, Breaks::Factors) => operand,
        _ => false,
    }
}
