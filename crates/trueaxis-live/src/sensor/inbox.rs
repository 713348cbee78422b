//! Samples that a thread of their own receives: the loop takes what has come, and never waits.

use super::{Sample, Sensor, Sent};
use crate::clock::{Clock, RealClock};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

/// Samples that may wait; a loop that has stopped must not fill the memory.
const MOST: usize = 1000;

/// What a thread has received.
#[derive(Debug, Clone, PartialEq)]
pub struct Received {
    /// As it was sent.
    pub sent: Sent,
    /// How old it was when it came, s; none where no one says.
    pub age_s: Option<f64>,
}

/// The end of the thread.
#[derive(Debug, Clone)]
pub struct Delivery {
    sender: SyncSender<(f64, Received)>,
    clock: RealClock,
}

impl Delivery {
    /// Hands one on; `false` if the run is over. What comes while the box is full is lost: the next one says the same.
    pub fn put(&self, received: Received) -> bool {
        let sent = self.sender.try_send((self.clock.now_s(), received));
        !matches!(sent, Err(TrySendError::Disconnected(_)))
    }
}

/// The end of the loop.
#[derive(Debug)]
pub struct Inbox {
    sensor: usize,
    receiver: Receiver<(f64, Received)>,
    clock: RealClock,
}

impl Inbox {
    /// For one sensor of the plan.
    pub fn of(sensor: usize) -> (Self, Delivery) {
        let (sender, receiver) = sync_channel(MOST);
        let clock = RealClock::start();
        (Self { sensor, receiver, clock }, Delivery { sender, clock })
    }
}

impl Sensor for Inbox {
    fn poll(&mut self, now_s: f64) -> Vec<Sample> {
        // Ages are counted on the clock that never goes back, from the moment in which a sample came.
        let own_s = self.clock.now_s();
        let sample = |(came_s, received): (f64, Received)| Sample {
            sensor: self.sensor,
            sent: received.sent,
            taken_s: received.age_s.map(|age_s| now_s - (own_s - came_s) - age_s),
        };
        self.receiver.try_iter().map(sample).collect()
    }
}
