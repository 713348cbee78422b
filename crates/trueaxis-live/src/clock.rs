//! The clock of a run: real for the command, virtual for tests and forecasts.

use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// A clock that never goes back, s from the start of the run. Ages and periods are counted on it, never on the time of day.
pub trait Clock {
    /// Now, s.
    fn now_s(&self) -> f64;
    /// Waits until then; returns at once if it is past.
    fn wait_until(&self, time_s: f64);
}

/// The clock of the computer.
#[derive(Debug, Clone, Copy)]
pub struct RealClock(Instant);

impl RealClock {
    /// Starts at 0.
    pub fn start() -> Self {
        Self(Instant::now())
    }
}

impl Clock for RealClock {
    fn now_s(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }

    fn wait_until(&self, time_s: f64) {
        let left_s = time_s - self.now_s();
        if left_s > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(left_s.min(3600.0)));
        }
    }
}

/// A clock that goes on only where a test or a forecast says so; all clones are one clock.
///
/// ```
/// use trueaxis_live::clock::{Clock, VirtualClock};
/// let clock = VirtualClock::default();
/// clock.wait_until(1.5);
/// assert_eq!(clock.now_s(), 1.5);
/// ```
#[derive(Debug, Clone, Default)]
pub struct VirtualClock(Rc<Cell<f64>>);

impl Clock for VirtualClock {
    fn now_s(&self) -> f64 {
        self.0.get()
    }

    fn wait_until(&self, time_s: f64) {
        self.0.set(self.0.get().max(time_s));
    }
}

/// The date, seconds since 1970 (UTC): for readers of a journal. Nothing is calculated from it.
pub fn date_s() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs())
}

/// The date with its fractions, seconds since 1970 (UTC): for the age of what was dated by another clock.
pub fn date_now_s() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64())
}
