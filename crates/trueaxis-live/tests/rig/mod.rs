//! A run on a mock with a virtual clock: sensors, control and journal that can be disturbed at any time.

// Each test program uses a part of this file.
#![allow(dead_code)]

pub mod broker;
pub mod trt;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use trueaxis::files::disk;
use trueaxis_live::clock::{Clock, VirtualClock};
use trueaxis_live::control::Identity;
use trueaxis_live::file::{Plan, read_plan};
use trueaxis_live::governor::{Earlier, State};
use trueaxis_live::mock::{FanucMock, MockWire};
use trueaxis_live::run::{Cycle, Run, Wish};
use trueaxis_live::sensor::{Sample, Sensor, Sent};
use trueaxis_live::start::{connect, mock_of};
use trueaxis_live::store::MemoryStore;

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The example with other lines: pairs of what stands in it and what shall.
pub fn plan_with(changes: &[(&str, &str)]) -> Result<Plan, Vec<String>> {
    let path = root().join("examples/08_live/gantry-mock.toml");
    let mut text = std::fs::read_to_string(&path).expect("the example");
    for (old, new) in changes {
        assert!(text.contains(old), "the example has no `{old}`");
        text = text.replace(old, new);
    }
    let own = path.with_file_name("changed.toml");
    let files = disk().with_texts([(own.clone(), text)]);
    let (plan, problems) = read_plan(&files, &own);
    let shown = || problems.iter().map(|d| format!("{}: {}", d.code, d.message)).collect();
    plan.ok_or_else(shown)
}

/// The example at the end of the travel, with other lines.
pub fn standing(changes: &[(&str, &str)]) -> Plan {
    let path = root().join("examples/08_live/gantry-mock.toml");
    let text = std::fs::read_to_string(path).expect("the example");
    let stops = text.split("stops = [").nth(1).expect("stops");
    let all: Vec<(&str, &str)> = [(stops, "[\"3500 mm\", \"2300 mm\", \"400 mm\"]]\n")]
        .into_iter()
        .chain(changes.iter().copied())
        .collect();
    plan_with(&all).unwrap_or_else(|e| panic!("{e:?}"))
}

/// What the sensors send: one sample a second each.
#[derive(Debug, Clone)]
pub struct Temperatures {
    /// °C, in the order of the plan: scale_x, scale_y, workpiece.
    pub celsius: Vec<f64>,
    /// Text that is sent instead.
    pub text: Vec<Option<String>>,
    /// Nothing is sent.
    pub silent: Vec<bool>,
    /// What is added to the time of a sample, s; not a number: it has none.
    pub shift_s: Vec<f64>,
}

struct TestSensor {
    sensor: usize,
    from: Rc<RefCell<Temperatures>>,
    next_s: f64,
}

impl Sensor for TestSensor {
    fn poll(&mut self, now_s: f64) -> Vec<Sample> {
        let from = self.from.borrow();
        if now_s < self.next_s || from.silent[self.sensor] {
            return Vec::new();
        }
        self.next_s = now_s + 1.0;
        let sent = match &from.text[self.sensor] {
            Some(text) => Sent::Text(text.clone()),
            None => Sent::number(from.celsius[self.sensor]),
        };
        let taken_s = Some(now_s + from.shift_s[self.sensor]).filter(|t| t.is_finite());
        vec![Sample { sensor: self.sensor, sent, taken_s }]
    }
}

/// A run on a mock.
pub struct Rig {
    pub plan: Plan,
    pub clock: VirtualClock,
    pub mock: Rc<RefCell<FanucMock>>,
    pub sensors: Rc<RefCell<Temperatures>>,
    pub store: MemoryStore,
    pub run: Run<'static>,
    pub identity: Identity,
    pub last: Option<Cycle>,
    pub wish: Wish,
    /// Changes of state: when, what.
    pub seen: Vec<(f64, String)>,
}

impl Rig {
    /// With the temperatures of Fig 9 and 10: 30.5, 31.2 and, for the workpiece, 30.5 °C.
    pub fn new(plan: Plan) -> Self {
        let mock = Rc::new(RefCell::new(mock_of(&plan).expect("a mock")));
        Self::on(plan, mock, VirtualClock::default(), Earlier::Nothing)
    }

    /// On a mock that is there already, with what the journal knows.
    pub fn on(
        plan: Plan,
        mock: Rc<RefCell<FanucMock>>,
        clock: VirtualClock,
        earlier: impl Into<Earlier>,
    ) -> Self {
        let fanuc = plan.control.fanuc().expect("a FANUC control");
        let wire = MockWire::new(&mock, &clock, fanuc.timeout_s);
        let connected = connect((&plan, fanuc), wire, clock.now_s());
        let (control, identity) = connected.unwrap_or_else(|e| panic!("{:?}", e.sorted()));
        let count = plan.sensors.len();
        let sensors = Rc::new(RefCell::new(Temperatures {
            celsius: vec![30.5, 31.2, 30.5],
            text: vec![None; count],
            silent: vec![false; count],
            shift_s: vec![0.0; count],
        }));
        let all = (0..count).map(|sensor| -> Box<dyn Sensor> {
            Box::new(TestSensor { sensor, from: Rc::clone(&sensors), next_s: 0.0 })
        });
        let (store, all) = (MemoryStore::default(), all.collect());
        let run = Run::new(&plan, earlier, Box::new(control), all, store.clone());
        let wish = Wish { run: true, confirmed: false };
        Self {
            plan,
            clock,
            mock,
            sensors,
            store,
            run,
            identity,
            last: None,
            wish,
            seen: Vec::new(),
        }
    }

    /// One period. Between two cycles no offset changes by more than the step of the plan, and none beyond its limit.
    pub fn cycle(&mut self) {
        let writes = self.mock.borrow().written().len();
        let cycle = self.run.cycle(&self.clock, self.wish);
        self.wish.confirmed = false;
        let order = &cycle.output.order;
        let shown = format!("{}: {}", order.state, order.reason);
        if self.seen.last().is_none_or(|(_, last)| *last != shown) {
            self.seen.push((cycle.input.now_s, shown));
        }
        let mock = self.mock.borrow();
        let written = mock.written().len() > writes;
        if let (true, Ok(seen)) = (written, &cycle.input.seen) {
            assert!(!seen.emergency && seen.homed && !seen.inhibited, "written in {seen:?}");
        }
        assert!(!written || cycle.input.seen.is_ok(), "written without a link");
        if let (Some(write), Ok(seen)) = (&order.write, &cycle.input.seen) {
            for ((new, old), axis) in write.iter().zip(&seen.offsets).zip(&self.plan.axes) {
                assert!((new - old).abs() <= axis.limits.step, "a step from {old} to {new}");
            }
        }
        drop(mock);
        self.last = Some(cycle);
        self.clock.wait_until(self.clock.now_s() + self.plan.period_s);
        self.mock.borrow_mut().advance(self.clock.now_s());
    }

    /// So long.
    pub fn pass(&mut self, time_s: f64) {
        let end_s = self.clock.now_s() + time_s - 1e-9;
        while self.clock.now_s() < end_s {
            self.cycle();
        }
    }

    /// Until the offsets have reached their target.
    pub fn settled(plan: Plan) -> Self {
        let mut rig = Self::new(plan);
        rig.pass(20.0);
        assert_eq!(rig.state(), State::Run, "{:?}", rig.seen);
        rig.seen.clear();
        rig
    }

    pub fn state(&self) -> State {
        self.last.as_ref().expect("a cycle").output.order.state
    }

    /// State and reason.
    pub fn shown(&self) -> String {
        let order = &self.last.as_ref().expect("a cycle").output.order;
        format!("{}: {}", order.state, order.reason)
    }

    /// The offsets that act, increments.
    pub fn acting(&self) -> Vec<i32> {
        self.mock.borrow().acting()
    }

    /// The number of writes so far.
    pub fn writes(&self) -> usize {
        self.mock.borrow().written().len()
    }

    /// What was seen since the rig settled, in words.
    pub fn story(&self) -> String {
        self.seen.iter().map(|(_, what)| what.clone()).collect::<Vec<_>>().join(" → ")
    }
}
