//! Wall time and processor time of this thread.

use std::time::Instant;

use cpu_time::ThreadTime;

/// Times of a run, seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    /// Processor time.
    pub(crate) processor: f64,
    /// Wall time.
    pub(crate) wall: f64,
}

/// Started when it is made.
pub(crate) struct Clock {
    processor: ThreadTime,
    wall: Instant,
}

impl Clock {
    pub(crate) fn start() -> Self {
        Self {
            processor: ThreadTime::now(),
            wall: Instant::now(),
        }
    }

    /// Times since the start.
    pub(crate) fn read(&self) -> Times {
        Times {
            processor: self.processor.elapsed().as_secs_f64(),
            wall: self.wall.elapsed().as_secs_f64(),
        }
    }
}

/// The medians; none of none.
pub(crate) fn median(times: &[Times]) -> Option<Times> {
    let middle = |part: fn(&Times) -> f64| {
        let mut sorted: Vec<f64> = times.iter().map(part).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied()
    };
    Some(Times {
        processor: middle(|times| times.processor)?,
        wall: middle(|times| times.wall)?,
    })
}
