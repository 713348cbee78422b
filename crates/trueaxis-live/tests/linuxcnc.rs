//! LinuxCNC as a control, on pins that are not there: what each change of its state does to the offset. The whole LinuxCNC
//! runs in scripts/live-linuxcnc.

mod rig;

use rig::root;
use rig::trt::Trt;
use std::cell::RefCell;
use std::rc::Rc;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::Conditions;
use trueaxis_live::clock::{Clock, VirtualClock};
use trueaxis_live::file::{Plan, read_plan};
use trueaxis_live::governor::{Owned, Reason, State};
use trueaxis_live::linuxcnc::{Layout, LinuxCnc, Pins};
use trueaxis_live::pose::{Frame, PoseCorrection, World};
use trueaxis_live::run::{Cycle, Run, Wish};
use trueaxis_live::start::{linuxcnc_settings, sensors_of};
use trueaxis_live::status::is_lagging;
use trueaxis_live::store::MemoryStore;

/// Pins by name, and what trueaxis.hal makes of the offsets: gate, ramp, watchdog.
#[derive(Debug, Default)]
struct Bench {
    layout: Layout,
    numbers: Vec<f64>,
    bits: Vec<bool>,
    out: Vec<f64>,
    bits_out: Vec<bool>,
    /// Joints of the program, mm and deg, without the offset: C, A, X, Y, Z.
    program: Vec<f64>,
    clock: f64,
    beat: (bool, f64),
    lost: bool,
}

impl Bench {
    fn number(&mut self, name: &str) -> &mut f64 {
        let at = self.layout.numbers_in.iter().position(|n| n == name).expect("a pin");
        &mut self.numbers[at]
    }

    fn bit(&mut self, name: &str) -> &mut bool {
        let at = self.layout.bits_in.iter().position(|n| n == name).expect("a pin");
        &mut self.bits[at]
    }

    /// One servo cycle of 1 ms.
    fn tick(&mut self) {
        self.clock += 1.0;
        let beat = self.bits_out[0];
        if beat != self.beat.0 {
            self.beat = (beat, self.clock);
        }
        self.lost = self.bits_out[1] && (self.lost || self.clock - self.beat.1 > 100.0);
        if !self.bits_out[1] {
            self.beat.1 = self.clock;
        }
        let pass = !self.lost && self.bits_out[1] && !*self.bit("switching");
        let clock = self.clock;
        for (i, letter) in ["x", "y", "z", "a", "c"].into_iter().enumerate() {
            let to = if pass { self.out[i] } else { 0.0 };
            let most = if i < 3 { 5e-3 } else { 1e-3 };
            let now = *self.number(&format!("request-{letter}"));
            let now = now + (to - now).clamp(-most, most);
            *self.number(&format!("request-{letter}")) = now;
            *self.number(&format!("acting-{letter}")) = now;
        }
        *self.bit("tripped") = self.lost;
        *self.number("begin") = clock;
        *self.number("end") = clock;
        self.follow();
    }

    /// Joints and tip, by the kinematics of the control.
    fn follow(&mut self) {
        let tool = *self.number("tool-length");
        let trt = Trt { tilts_about_x: true, offset: [20.0, 10.0], tool };
        let [c, tilt, x, y, z] = self.program[..] else { panic!("five joints") };
        let turned = |deg: f64| deg.to_radians();
        let acting = ["x", "y", "z", "a", "c"].map(|l| *self.number(&format!("acting-{l}")));
        let joints = match *self.bit("tcp") {
            true => {
                let tip = trt.forward(Vec3::new(x, y, z), turned(tilt), turned(c));
                let to = tip + Vec3::new(acting[0], acting[1], acting[2]);
                trt.inverse(to, turned(tilt + acting[3]), turned(c + acting[4]))
            }
            false => Vec3::new(x + acting[0], y + acting[1], z + acting[2]),
        };
        let tip = trt.forward(Vec3::new(x, y, z), turned(tilt), turned(c));
        for (i, letter) in ["x", "y", "z"].into_iter().enumerate() {
            *self.number(&format!("joint-{letter}")) = joints[i];
            *self.number(&format!("tip-{letter}")) = tip[i];
        }
        *self.number("joint-a") = tilt + acting[3];
        *self.number("joint-c") = c + acting[4];
    }
}

#[derive(Clone)]
struct Shared(Rc<RefCell<Bench>>);

impl Pins for Shared {
    fn number(&self, at: usize) -> f64 {
        self.0.borrow().numbers[at]
    }
    fn bit(&self, at: usize) -> bool {
        self.0.borrow().bits[at]
    }
    fn set_number(&mut self, at: usize, value: f64) {
        self.0.borrow_mut().out[at] = value;
    }
    fn set_bit(&mut self, at: usize, value: bool) {
        self.0.borrow_mut().bits_out[at] = value;
    }
}

struct Rig {
    bench: Rc<RefCell<Bench>>,
    run: Run<'static>,
    clock: VirtualClock,
    last: Option<Cycle>,
    plan: Plan,
}

fn plan() -> Plan {
    let (plan, problems) =
        read_plan(&disk(), &root().join("examples/08_live/linuxcnc/xyzac-live.toml"));
    plan.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

impl Rig {
    fn new() -> Self {
        let plan = plan();
        let layout = linuxcnc_settings(&plan).layout();
        let mut bench = Bench {
            numbers: vec![0.0; layout.numbers_in.len()],
            bits: vec![false; layout.bits_in.len()],
            out: vec![0.0; layout.numbers_out.len()],
            bits_out: vec![false; layout.bits_out.len()],
            program: vec![0.0, 0.0, 40.0, 30.0, 60.0],
            layout,
            ..Bench::default()
        };
        for bit in [
            "enabled", "auto", "running", "tcp", "homed-x", "homed-y", "homed-z", "homed-a",
            "homed-c",
        ] {
            *bench.bit(bit) = true;
        }
        *bench.number("tool-length") = 50.0;
        let bench = Rc::new(RefCell::new(bench));
        Self::on(plan, bench, VirtualClock::default())
    }

    /// A run on a bench, as `run_session` starts it.
    fn on(plan: Plan, bench: Rc<RefCell<Bench>>, clock: VirtualClock) -> Self {
        let control = LinuxCnc::new(Shared(Rc::clone(&bench)), linuxcnc_settings(&plan));
        let last = control.held().to_vec();
        let owned = Owned { base: vec![0; last.len()], before: last.clone(), last };
        let (sensors, store) = (sensors_of(&plan), MemoryStore::default());
        let run = Run::new(&plan, Some(owned), Box::new(control), sensors, store);
        Self { bench, run, clock, last: None, plan }
    }

    fn cycles(&mut self, count: usize) -> &Cycle {
        for _ in 0..count {
            self.clock.wait_until(self.clock.now_s() + 1e-3);
            self.bench.borrow_mut().tick();
            self.last = Some(self.run.cycle(&self.clock, Wish { run: true, confirmed: false }));
        }
        self.last.as_ref().expect("a cycle")
    }

    fn state(&mut self, cycles: usize) -> (State, Reason) {
        let order = &self.cycles(cycles).output.order;
        (order.state, order.reason.clone())
    }

    /// The offset of X that acts, um.
    fn acting_um(&self) -> f64 {
        1e3 * *self.bench.borrow_mut().number("acting-x")
    }
}

/// The offset of X that brings the tool to its place (tests/pose.rs is its judge), um; a tool of such a length, the spindle at 32 °C.
fn due_um(length_mm: f64) -> f64 {
    let mut problems = Diagnostics::new();
    let at = Conditions::default().with_reading("spindle", 32.0);
    let machine = plan().machine.at(&at, &mut problems).expect("a warm machine");
    let machine = machine.with_tip(Vec3::new(0.0, 0.0, -length_mm));
    let command = [0.0, 0.0, 40.0, 30.0, 60.0, 0.0];
    let corrected = PoseCorrection::of(&machine, true).unwrap().corrected(&command).unwrap();
    1e3 * World::of(&machine).unwrap().offset(Frame::Workpiece, &command, &corrected)[2]
}

#[test]
fn the_offset_of_the_model_acts() {
    let mut rig = Rig::new();
    assert_eq!(rig.state(500), (State::Run, Reason::Follows));
    let due = due_um(50.0);
    assert!(due.abs() > 5.0 && (rig.acting_um() - due).abs() < 2e-3, "{} {due}", rig.acting_um());
}

#[test]
fn kinematics_that_change_take_the_offset_to_zero_and_it_comes_back() {
    let mut rig = Rig::new();
    rig.cycles(500);
    let before = rig.acting_um();
    *rig.bench.borrow_mut().bit("switching") = true;
    assert_eq!(rig.state(2), (State::Hold, Reason::Released));
    rig.cycles(100);
    assert_eq!(rig.acting_um(), 0.0);
    // In the axes of the machine the offset is another one.
    *rig.bench.borrow_mut().bit("tcp") = false;
    *rig.bench.borrow_mut().bit("switching") = false;
    assert_eq!(rig.state(300), (State::Run, Reason::Follows));
    *rig.bench.borrow_mut().bit("switching") = true;
    rig.cycles(100);
    *rig.bench.borrow_mut().bit("tcp") = true;
    *rig.bench.borrow_mut().bit("switching") = false;
    assert_eq!(rig.state(300), (State::Run, Reason::Follows));
    assert!((rig.acting_um() - before).abs() < 1e-3);
}

#[test]
fn a_run_that_was_killed_is_followed_by_one_without_a_step() {
    let mut rig = Rig::new();
    rig.cycles(500);
    let before = rig.acting_um();
    // Killed, and started again at once: the offset stands, and stays.
    let Rig { bench, run, clock, plan, .. } = rig;
    drop(run);
    let mut rig = Rig::on(plan.clone(), Rc::clone(&bench), clock.clone());
    for _ in 0..50 {
        rig.cycles(1);
        assert!((rig.acting_um() - before).abs() < 0.1, "{} against {before}", rig.acting_um());
    }
    // Killed, and started after the watchdog has let it go: it comes back by its slew.
    drop(rig);
    (0..400).for_each(|_| bench.borrow_mut().tick());
    assert_eq!(*bench.borrow_mut().number("acting-x"), 0.0);
    let mut rig = Rig::on(plan, bench, clock);
    let mut last = 0.0;
    for _ in 0..500 {
        rig.cycles(1);
        let now = rig.acting_um();
        assert!((now - last).abs() < 5.01, "{now} after {last}");
        last = now;
    }
    assert_eq!(rig.state(1), (State::Run, Reason::Follows));
    assert!((last - before).abs() < 0.1);
}

#[test]
fn the_state_of_the_control_decides() {
    let mut rig = Rig::new();
    rig.cycles(500);
    let before = rig.acting_um();
    for (bit, value, reason) in [
        ("enabled", false, Reason::Emergency),
        ("inhibit", true, Reason::Inhibited),
        ("auto", false, Reason::Mode),
    ] {
        let was = std::mem::replace(rig.bench.borrow_mut().bit(bit), value);
        assert_eq!(rig.state(20), (State::Hold, reason));
        assert!((rig.acting_um() - before).abs() < 1e-3, "{bit}: it stays");
        *rig.bench.borrow_mut().bit(bit) = was;
        assert_eq!(rig.state(20), (State::Run, Reason::Follows));
    }
    *rig.bench.borrow_mut().bit("homed-y") = false;
    assert_eq!(rig.state(5), (State::Hold, Reason::NotHomed));
    *rig.bench.borrow_mut().bit("homed-y") = true;
    assert_eq!(rig.state(5), (State::Latched, Reason::HomedAgain));
}

#[test]
fn another_tool_is_another_offset_without_a_fault() {
    let mut rig = Rig::new();
    rig.cycles(500);
    let before = rig.acting_um();
    *rig.bench.borrow_mut().number("tool-length") = 150.0;
    // The same joints: the tip of the program is now 100 mm lower, LinuxCNC counts it at once.
    assert_eq!(rig.state(500), (State::Run, Reason::Follows));
    let due = due_um(150.0);
    assert!(
        (due - before).abs() > 2.0 && (rig.acting_um() - due).abs() < 2e-3,
        "{} {due}",
        rig.acting_um()
    );
}

#[test]
fn a_pivot_that_is_elsewhere_is_noticed_and_a_servo_thread_that_ends() {
    let mut rig = Rig::new();
    rig.cycles(500);
    // A standing tip 20 um from that of the machine file.
    let Rig { bench, .. } = &rig;
    bench.borrow_mut().program[2] += 5.0;
    rig.cycles(50);
    let at = rig.bench.borrow().layout.numbers_in.iter().position(|n| n == "tip-z").unwrap();
    for _ in 0..150 {
        rig.clock.wait_until(rig.clock.now_s() + 1e-3);
        rig.bench.borrow_mut().tick();
        rig.bench.borrow_mut().numbers[at] += 0.02;
        rig.last = Some(rig.run.cycle(&rig.clock, Wish { run: true, confirmed: false }));
    }
    let order = &rig.last.as_ref().unwrap().output.order;
    assert_eq!(order.state, State::Hold);
    assert!(
        order.reason.to_string().contains("20.0 um otherwise than the machine file"),
        "{}",
        order.reason
    );

    let mut rig = Rig::new();
    rig.cycles(500);
    let mut last = None;
    for _ in 0..200 {
        rig.clock.wait_until(rig.clock.now_s() + 1e-3);
        last = Some(rig.run.cycle(&rig.clock, Wish { run: true, confirmed: false }));
    }
    let order = last.unwrap().output.order;
    assert_eq!(order.state, State::Hold);
    assert!(
        order.reason.to_string().contains("servo thread of LinuxCNC has stopped"),
        "{}",
        order.reason
    );
}

/// X moves by 0.1 mm a cycle: what is late is the rate of the target times two periods, and what is late by more than the plan
/// allows is an alarm.
#[test]
fn law_an_offset_is_late_by_its_rate_times_two_periods() {
    let mut rig = Rig::new();
    rig.cycles(500);
    let mut last = 0.0;
    for _ in 0..50 {
        rig.bench.borrow_mut().program[2] += 0.1;
        let output = &rig.cycles(1).output;
        let now = output.target.as_ref().unwrap().offsets[0];
        let lag = output.lag.as_ref().unwrap()[0];
        assert!(last == 0.0 || (lag - 2.0 * (now - last).abs()).abs() < 1e-6, "{lag} {now} {last}");
        last = now;
    }
    let cycle = rig.last.clone().unwrap();
    // EXX at 45 mm rises by 0.12 − 0.10 · 0.45 = 0.075 um/mm: 7.5 nm a cycle, 15 nm in two. The other errors add as much.
    let lag_nm = cycle.output.lag.as_ref().unwrap()[0];
    assert!((5.0..50.0).contains(&lag_nm), "{lag_nm}");
    let mut plan = rig.plan.clone();
    for (most_mm, alarm) in [(None, false), (Some(1e-6), true), (Some(1e-3), false)] {
        plan.axes[0].lag = most_mm;
        assert_eq!(is_lagging(&plan, &cycle), alarm, "{most_mm:?}");
    }
}
