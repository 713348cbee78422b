//! One cycle of a run without its network: read, judge the sensors, model, govern, write.
//!
//! Target (issue 21): at most 50 µs on one core; a cycle of LinuxCNC at 1 kHz has 1000. Two plans: the gantry of Zhang et al. 2019
//! on its mock, and tip and tool axis of a five-axis table on pins that are not there.
//!
//! ```text
//!     cargo bench -p trueaxis-live --bench cycle
//! ```

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::path::Path;
use std::time::Instant;
use trueaxis::files::disk;
use trueaxis_live::clock::{Clock, VirtualClock};
use trueaxis_live::control::{Control, Identity, LinkFault, Seen, Sent};
use trueaxis_live::file::{Plan, read_plan};
use trueaxis_live::governor::State;
use trueaxis_live::pose::Frame;
use trueaxis_live::run::{Run, Wish};
use trueaxis_live::start::sensors_of;
use trueaxis_live::store::MemoryStore;

const CYCLES: u32 = 20_000;
const ROUNDS: usize = 7;

/// A control that moves along its travel and takes everything at once.
struct Moving {
    at: Vec<f64>,
    by: Vec<f64>,
    held: Vec<i32>,
    frame: Frame,
}

impl Control for Moving {
    fn identity(&mut self, _: f64) -> Result<Identity, LinkFault> {
        let reason = "not asked".to_owned();
        Err(LinkFault::Down { reason })
    }

    fn read(&mut self, _: f64) -> Result<Seen, LinkFault> {
        self.at.iter_mut().zip(&self.by).for_each(|(at, by)| *at += by);
        Ok(Seen {
            acting: Some(self.held.clone()),
            feed_mm_per_min: 1000.0,
            frame: self.frame,
            ..Seen::moving(self.at.clone(), self.held.clone())
        })
    }

    fn write(&mut self, sent: &Sent, _: f64) -> Result<(), LinkFault> {
        if let Some(offsets) = &sent.offsets {
            self.held.clone_from(offsets);
        }
        Ok(())
    }
}

fn plan(name: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/08_live").join(name);
    read_plan(&disk(), &path).0.expect("a plan")
}

/// µs of a cycle, the median of some rounds; `step` is the way of each axis in a cycle, mm or rad.
fn median_us(plan: &Plan, frame: Frame, (start, step): (f64, f64)) -> f64 {
    let axes = plan.machine.axes().len();
    let mut rounds: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let at = vec![start; axes];
            let by = (0..axes)
                .map(|i| step * (1.0 + 0.1 * f64::from(u32::try_from(i).unwrap_or(0))))
                .collect();
            let control = Moving { at, by, held: vec![0; plan.axes.len()], frame };
            let clock = VirtualClock::default();
            let mut run =
                Run::new(plan, None, Box::new(control), sensors_of(plan), MemoryStore::default());
            let wish = Wish { run: true, confirmed: false };
            let mut follows = 0;
            let began = Instant::now();
            for _ in 0..CYCLES {
                clock.wait_until(clock.now_s() + 1e-3);
                follows += u32::from(run.cycle(&clock, wish).output.order.state == State::Run);
            }
            let us = began.elapsed().as_secs_f64() * 1e6 / f64::from(CYCLES);
            assert!(follows > CYCLES / 2, "{follows} of {CYCLES} cycles run");
            us
        })
        .collect();
    rounds.sort_by(f64::total_cmp);
    rounds[ROUNDS / 2]
}

fn main() {
    println!("one cycle without its network, median of {ROUNDS} rounds of {CYCLES}");
    for (name, frame, way) in [
        ("gantry-mock.toml", Frame::Machine, (100.0, 0.001)),
        ("linuxcnc/xyzac-live.toml", Frame::Machine, (0.5, 1e-5)),
        ("linuxcnc/xyzac-live.toml", Frame::Workpiece, (0.5, 1e-5)),
    ] {
        let us = median_us(&plan(name), frame, way);
        let frame = if frame == Frame::Workpiece { "tip and angles" } else { "axes" };
        println!("  {name:26} {frame:15} {us:7.2} µs   limit 50 µs: {:.1} times below", 50.0 / us);
    }
}
