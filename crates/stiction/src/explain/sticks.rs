//! Stick intervals from what is counted at the outputs.
//!
//! An output tells how many sticks have begun, when the present or last one began and when the last
//! complete one ended. That gives every interval as long as at most one begins between two outputs;
//! of more only the last is known, and the others are told as one.

use super::record::Record;

/// A time during which a joint stuck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickInterval {
    /// When it began.
    pub start: f64,
    /// When it ended; `None` where it lasts at the end of the results.
    pub end: Option<f64>,
    /// Time spent sticking within.
    pub stuck: f64,
    /// Number of sticks in it: one, or several that fell between two outputs and cannot be told
    /// apart.
    pub sticks: usize,
}

/// The stick intervals of the outputs of a friction.
pub(super) fn intervals(records: &[Record<'_>]) -> Vec<StickInterval> {
    let Some(last) = records.last() else {
        return Vec::new();
    };
    let mut intervals = Vec::new();
    // The interval that has not ended.
    let mut open: Option<StickInterval> = None;
    let mut before: Option<&Record<'_>> = None;
    for record in records {
        let begun = record.sticks() - before.map_or(0, Record::sticks).min(record.sticks());
        let latest = StickInterval {
            start: record.stick_start(),
            end: None,
            stuck: 0.0,
            sticks: 1,
        };
        // Sticks that have ended since the output before; one that goes on is not among them.
        let ended = usize::from(open.is_some())
            .saturating_add(begun)
            .saturating_sub(usize::from(record.sticking()));
        let told = usize::from(begun > 0 && !record.sticking());
        let (time, stuck) = before.map_or((record.time(), 0.0), |b| (b.time(), b.stuck_time()));
        if ended > 1 || (ended == 1 && begun > 1) {
            // They cannot be told apart: from the start of the first to the end of the last.
            let start = open.map_or(time, |open| open.start);
            let (now, earlier) = (
                record.stuck_time(),
                open.map_or(0.0, |open| time - open.start),
            );
            let going_on = if record.sticking() {
                record.time() - record.stick_start()
            } else {
                0.0
            };
            intervals.push(StickInterval {
                start,
                end: Some(record.stick_end()),
                stuck: (earlier + now - stuck - going_on).max(0.0),
                sticks: ended,
            });
        } else if ended == 1 {
            let one = if told == 1 {
                latest
            } else {
                open.unwrap_or(latest)
            };
            intervals.push(one.ended(record.stick_end()));
        }
        open = match (record.sticking(), begun) {
            (false, _) => None,
            (true, 0) => open.or(Some(latest)),
            (true, _) => Some(latest),
        };
        before = Some(record);
    }
    if let Some(open) = open {
        let stuck = (last.time() - open.start).max(0.0);
        intervals.push(StickInterval { stuck, ..open });
    }
    intervals
}

impl StickInterval {
    fn ended(self, end: f64) -> Self {
        Self {
            end: Some(end),
            stuck: end - self.start,
            ..self
        }
    }
}
