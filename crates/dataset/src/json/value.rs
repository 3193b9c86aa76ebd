//! JSON values with their places: each is a slice of the text.

use crate::source::{Source, Span};
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// The members of an object in their order, names that occur twice included.
pub(super) struct Members<'a>(pub(super) Vec<(String, &'a RawValue)>);

impl<'de: 'a, 'a> Deserialize<'de> for Members<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Members<'de>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(Collect)
    }
}

/// A JSON value, what is in it not yet read.
pub(super) enum Json<'a> {
    Null,
    Bool(bool),
    /// The digits.
    Number(&'a str),
    String(String),
    Array(Vec<&'a RawValue>),
    Object(Members<'a>),
}

impl<'a> Json<'a> {
    /// Reads one level of a value.
    ///
    /// # Errors
    /// For a string with an escape that is no character; else the text is known to be JSON.
    pub(super) fn new(raw: &'a RawValue) -> Result<Self, serde_json::Error> {
        let text = raw.get();
        Ok(match text.as_bytes().first() {
            Some(b'{') => Self::Object(serde_json::from_str(text)?),
            Some(b'[') => Self::Array(serde_json::from_str(text)?),
            Some(b'"') => Self::String(serde_json::from_str(text)?),
            Some(b't') => Self::Bool(true),
            Some(b'f') => Self::Bool(false),
            Some(b'n') | None => Self::Null,
            Some(_) => Self::Number(text),
        })
    }

    /// What it is, for messages.
    pub(super) fn what(&self) -> String {
        match self {
            Self::Null => "null".to_string(),
            Self::Bool(value) => value.to_string(),
            Self::Number(digits) if digits.len() <= 30 => digits.to_string(),
            Self::Number(_) => "a number".to_string(),
            Self::String(_) => "a string".to_string(),
            Self::Array(_) => "a list".to_string(),
            Self::Object(_) => "an object".to_string(),
        }
    }
}

/// The place of a value in the text that it is a slice of.
pub(super) fn place(source: &Source, value: &RawValue) -> Span {
    let start = value.get().as_ptr() as usize - source.text().as_ptr() as usize;
    Span::new(start, start + value.get().len())
}

/// The place of the name of a member; that of its value where the name is written with escapes.
pub(super) fn name_place(source: &Source, name: &str, value: &RawValue) -> Span {
    let value = place(source, value);
    let before = source.slice(Span::new(0, value.start)).trim_end();
    let before = before.strip_suffix(':').unwrap_or(before).trim_end();
    let quoted = before
        .strip_suffix('"')
        .and_then(|before| before.strip_suffix(name));
    match quoted {
        Some(rest) if rest.ends_with('"') => Span::new(rest.len() - 1, before.len()),
        _ => value,
    }
}
