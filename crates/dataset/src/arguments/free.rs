//! Arguments of a statement without a table of keywords.

use crate::source::Source;
use crate::syntax::{Item, TokenKind};
use std::ops::Range;

/// An argument whose name and value are taken as they are.
pub(crate) struct FreeArgument {
    /// The name, in capitals.
    pub(crate) name: String,
    /// The positions of name and value among the items.
    pub(crate) items: Range<usize>,
}

impl FreeArgument {
    /// The positions of what stands behind the name.
    pub(crate) fn rest(&self) -> Range<usize> {
        self.items.start + 1..self.items.end
    }
}

/// Splits `items` into arguments: each is a name and all up to a comma with a name behind it.
pub(crate) fn free(source: &Source, items: &[Item]) -> Vec<FreeArgument> {
    let kind = |at: usize| items.get(at).map(Item::kind);
    let mut arguments = Vec::new();
    let mut at = 0;
    while at < items.len() {
        if kind(at) != Some(TokenKind::Word) {
            at += 1;
            continue;
        }
        let first = at;
        at += 1;
        while at < items.len()
            && !(kind(at) == Some(TokenKind::Comma) && kind(at + 1) == Some(TokenKind::Word))
        {
            at += 1;
        }
        arguments.push(FreeArgument {
            name: source.slice(items[first].span()).to_ascii_uppercase(),
            items: first..at,
        });
    }
    arguments
}
