//! A mock in memory, on a virtual clock.

use super::fanuc::FanucMock;
use crate::clock::{Clock, VirtualClock};
use crate::control::LinkFault;
use crate::focas::Wire;
use std::cell::RefCell;
use std::rc::Rc;

/// Frames go to the mock and back without a socket; time passes on the clock as it would.
#[derive(Debug, Clone)]
pub struct MockWire {
    mock: Rc<RefCell<FanucMock>>,
    clock: VirtualClock,
    timeout_s: f64,
    is_open: bool,
}

impl MockWire {
    /// To a mock.
    pub fn new(mock: &Rc<RefCell<FanucMock>>, clock: &VirtualClock, timeout_s: f64) -> Self {
        Self { mock: Rc::clone(mock), clock: clock.clone(), timeout_s, is_open: false }
    }

    fn silent(&mut self) -> LinkFault {
        self.is_open = false;
        self.clock.wait_until(self.clock.now_s() + self.timeout_s);
        let millis = crate::governor::increments_of(self.timeout_s * 1e3).unwrap_or(0);
        LinkFault::Silent { millis: u32::try_from(millis).unwrap_or(0) }
    }
}

impl Wire for MockWire {
    fn exchange(&mut self, frame: &[u8], _: f64) -> Result<Vec<u8>, LinkFault> {
        let faults = self.mock.borrow().faults.clone();
        if faults.cut {
            self.is_open = false;
            return Err(LinkFault::Down { reason: "the cable is pulled".to_owned() });
        }
        if faults.frozen {
            return Err(self.silent());
        }
        self.mock.borrow_mut().advance(self.clock.now_s());
        let answer = self.mock.borrow_mut().answer(frame);
        if faults.latency_s > self.timeout_s {
            // It was done, and its answer comes too late.
            return Err(self.silent());
        }
        self.clock.wait_until(self.clock.now_s() + faults.latency_s);
        self.is_open = answer.is_some();
        answer.ok_or_else(|| LinkFault::Down { reason: "the control has closed it".to_owned() })
    }

    fn is_open(&self) -> bool {
        self.is_open
    }

    fn reset(&mut self, _: f64) {
        self.is_open = false;
    }
}
