//! A control with an OPC UA server, on nodes in memory; `scripts/live-opcua` runs the same against a server of others.

mod rig;

use rig::root;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use trueaxis::files::disk;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis_live::clock::{Clock, VirtualClock};
use trueaxis_live::control::{Identity, LinkFault};
use trueaxis_live::datum::{Datum, DatumOrder};
use trueaxis_live::expect::expect;
use trueaxis_live::file::{ControlPlan, Plan, read_plan};
use trueaxis_live::governor::State;
use trueaxis_live::history::{Peaks, line};
use trueaxis_live::opcua::{Nodes, OpcUa, Said, Value};
use trueaxis_live::part::PartRecorder;
use trueaxis_live::run::{Cycle, Run, Wish};
use trueaxis_live::start::{compared, opcua_settings, sensors_of};
use trueaxis_live::status::live_state;
use trueaxis_live::store::MemoryStore;

const CONTROL: &str = r#"[control]
kind = "opc-ua"
endpoint = "opc.tcp://192.168.1.30:4840"
security = "sign-and-encrypt"
timeout = "500 ms"
positions_have_offset = true
identity = { kind = "Maker", series = "Server", version = "1.0" }
[control.nodes]
position = { X = "ns=2;s=X", Y = "ns=2;s=Y", Z = "ns=2;s=Z" }
offset = { X = "ns=2;s=oX", Y = "ns=2;s=oY" }
referenced = "ns=2;s=referenced"
inhibit = "ns=2;s=inhibit"
running = "ns=2;s=running"
mode = "ns=2;s=mode"
emergency = "ns=2;s=emergency"
heartbeat = "ns=2;s=beat"
tripped = "ns=2;s=tripped"
ask_hold = "ns=2;s=hold"
"#;

/// The example on OPC UA, with other lines.
fn plan_with(changes: &[(&str, &str)]) -> Result<Plan, Vec<String>> {
    let path = root().join("examples/08_live/gantry-mock.toml");
    let text = std::fs::read_to_string(&path).expect("the example");
    let (head, rest) = text.split_once("[control]").expect("a control");
    let (_, rest) = rest.split_once("[axis.X]").expect("axes");
    let (rest, _) = rest.split_once("# Eleven targets").expect("a mock");
    let proof =
        "commissioned = { wrote = \"10 um\", measured = \"9.9 um\", evidence = \"a test\" }\n";
    let rest = rest.replacen("[axis.Y]\n", &format!("[axis.Y]\n{proof}"), 1);
    let log =
        "source = { log = \"../03_predict/torque-arm-hall.csv\", start = \"200 min\", speed = 10 }";
    let rest = rest.replace(log, "source = { constant = \"30.5 degC\" }");
    let mut text = format!("{head}{CONTROL}[axis.X]\n{proof}{rest}");
    for (old, new) in changes {
        assert!(text.contains(old), "no `{old}` in\n{text}");
        text = text.replace(old, new);
    }
    let own = path.with_file_name("changed.toml");
    let (plan, problems) = read_plan(&disk().with_texts([(own.clone(), text)]), &own);
    let shown = || problems.iter().map(|d| format!("{}: {}", d.code, d.message)).collect();
    plan.ok_or_else(shown)
}

/// Nodes that a program moves and a PLC watches.
#[derive(Default)]
struct Memory {
    nodes: BTreeMap<String, Value>,
    refused: Option<String>,
    is_down: bool,
    written: Vec<Vec<(String, Value)>>,
    /// The offset is added to what is shown.
    shows_offset: bool,
}

impl Memory {
    fn number(&self, name: &str) -> f64 {
        match self.nodes.get(name) {
            Some(Value::Number(number)) => *number,
            _ => 0.0,
        }
    }

    /// As the NC computes it: SD43900 + SD43910 · (x − SD43920).
    fn acts(&self, axis: &str, at: f64) -> f64 {
        let [offset, slope, reference] =
            ["o", "s", "r"].map(|n| self.number(&format!("{n}{axis}")));
        offset + slope * (at - reference)
    }
}

#[derive(Clone, Default)]
struct Server(Rc<RefCell<Memory>>);

impl Server {
    fn of(shows_offset: bool) -> Self {
        let server = Self::default();
        {
            let mut memory = server.0.borrow_mut();
            memory.shows_offset = shows_offset;
            for name in ["X", "Y", "Z", "oX", "oY", "beat"] {
                memory.nodes.insert(name.to_owned(), Value::Number(0.0));
            }
            memory.nodes.insert("mode".to_owned(), Value::Number(2.0));
            for (name, flag) in [
                ("referenced", true),
                ("running", true),
                ("inhibit", false),
                ("emergency", false),
                ("tripped", false),
                ("hold", false),
            ] {
                memory.nodes.insert(name.to_owned(), Value::Flag(flag));
            }
        }
        server
    }

    fn set(&self, name: &str, value: Value) {
        self.0.borrow_mut().nodes.insert(name.to_owned(), value);
    }

    fn number(&self, name: &str) -> f64 {
        match self.0.borrow().nodes[name] {
            Value::Number(number) => number,
            Value::Flag(flag) => f64::from(u8::from(flag)),
        }
    }
}

impl Nodes for Server {
    fn read(&mut self, nodes: &[&str], _: f64) -> Result<Vec<Said<Value>>, LinkFault> {
        let memory = self.0.borrow();
        if memory.is_down {
            return Err(LinkFault::Down { reason: "the cable is pulled".to_owned() });
        }
        let one = |node: &&str| {
            let name = node.strip_prefix("ns=2;s=").unwrap_or(node);
            if memory.refused.as_deref() == Some(name) {
                return Err("BadUserAccessDenied".to_owned());
            }
            let value = memory.nodes.get(name).cloned().ok_or("BadNodeIdUnknown".to_owned())?;
            let axis = memory.nodes.contains_key(&format!("o{name}"));
            Ok(match value {
                Value::Number(at) if axis && memory.shows_offset => {
                    Value::Number(at + memory.acts(name, at))
                }
                value => value,
            })
        };
        Ok(nodes.iter().map(one).collect())
    }

    fn write(&mut self, nodes: &[(&str, Value)], _: f64) -> Result<Vec<Said<()>>, LinkFault> {
        let mut memory = self.0.borrow_mut();
        let mut said = Vec::new();
        let mut all = Vec::new();
        for (node, value) in nodes {
            let name = node.strip_prefix("ns=2;s=").unwrap_or(node).to_owned();
            if memory.refused.as_ref() == Some(&name) {
                said.push(Err("BadUserAccessDenied".to_owned()));
                continue;
            }
            memory.nodes.insert(name.clone(), value.clone());
            all.push((name, value.clone()));
            said.push(Ok(()));
        }
        memory.written.push(all);
        Ok(said)
    }

    fn server(&mut self, _: f64) -> Result<[String; 3], LinkFault> {
        Ok(["Maker", "Server", "1.0"].map(str::to_owned))
    }
}

struct Bench {
    plan: Plan,
    clock: VirtualClock,
    run: Run<'static>,
    last: Option<Cycle>,
}

impl Bench {
    fn new(plan: Plan, server: &Server) -> Self {
        let ControlPlan::OpcUa(opcua) = &plan.control else { panic!("OPC UA") };
        let mut control = OpcUa::new(server.clone(), opcua_settings(&plan, opcua));
        compared(&plan, opcua, &mut control, 0.0).unwrap_or_else(|e| panic!("{:?}", e.sorted()));
        let store = MemoryStore::default();
        let run = Run::new(&plan, None, Box::new(control), sensors_of(&plan), store);
        let clock = VirtualClock::default();
        Self { plan, clock, run, last: None }
    }

    fn pass(&mut self, time_s: f64) {
        let end_s = self.clock.now_s() + time_s;
        while self.clock.now_s() < end_s {
            let wish = Wish { run: true, confirmed: false };
            self.last = Some(self.run.cycle(&self.clock, wish));
            self.clock.wait_until(self.clock.now_s() + self.plan.period_s);
        }
    }

    fn shown(&self) -> String {
        let order = &self.last.as_ref().expect("a cycle").output.order;
        format!("{}: {}", order.state, order.reason)
    }
}

/// At X = 3500 mm with all at 30.5 °C: by hand 431 − 13.2 · 3.5 · 10.5 = −54.1, so +54 µm; in mm in the node. Whether the server shows
/// the offset in its positions does not matter where the plan says which.
#[test]
fn law_the_offset_of_the_paper_in_mm() {
    let mut found = Vec::new();
    for shows_offset in [true, false] {
        let server = Server::of(shows_offset);
        server.set("X", Value::Number(3500.0));
        server.set("Y", Value::Number(2300.0));
        let change = [(
            "positions_have_offset = true",
            if shows_offset {
                "positions_have_offset = true"
            } else {
                "positions_have_offset = false"
            },
        )];
        let mut bench = Bench::new(plan_with(&change).unwrap_or_else(|e| panic!("{e:?}")), &server);
        bench.pass(10.0);
        assert!(bench.shown().starts_with("Run"), "{}", bench.shown());
        assert!((server.number("oX") - 0.054).abs() < 0.0016, "{}", server.number("oX"));
        let programmed = bench.last.as_ref().and_then(|c| c.output.programmed).expect("a position");
        assert!((programmed[0] - 3500.0).abs() < 1e-9 && (programmed[1] - 2300.0).abs() < 1e-9);
        found.push((server.number("oX"), server.number("oY")));
        // Each write changes the heartbeat.
        let memory = server.0.borrow();
        let beats: Vec<_> = memory.written.iter().map(|all| all[0].1.clone()).collect();
        assert!(beats.windows(2).all(|w| w[0] != w[1]) && memory.written.len() > 100);
    }
    assert_eq!(found[0], found[1]);
}

#[test]
fn what_a_server_refuses_holds_and_is_named() {
    let server = Server::of(true);
    server.set("X", Value::Number(3500.0));
    let mut bench = Bench::new(plan_with(&[]).unwrap_or_else(|e| panic!("{e:?}")), &server);
    bench.pass(10.0);
    let before = server.number("oX");
    for (change, undo, says) in [
        (
            (|m: &mut Memory| m.refused = Some("mode".to_owned())) as fn(&mut Memory),
            (|m: &mut Memory| m.refused = None) as fn(&mut Memory),
            "ns=2;s=mode",
        ),
        (|m| m.is_down = true, |m| m.is_down = false, "the cable is pulled"),
        (
            |m| {
                m.nodes.insert("Y".to_owned(), Value::Number(f64::NAN));
            },
            |m| {
                m.nodes.insert("Y".to_owned(), Value::Number(0.0));
            },
            "is no number",
        ),
        (
            |m| {
                m.nodes.insert("emergency".to_owned(), Value::Flag(true));
            },
            |m| {
                m.nodes.insert("emergency".to_owned(), Value::Flag(false));
            },
            "emergency stop",
        ),
        (
            |m| {
                m.nodes.insert("mode".to_owned(), Value::Number(0.0));
            },
            |m| {
                m.nodes.insert("mode".to_owned(), Value::Number(2.0));
            },
            "mode of operation",
        ),
    ] {
        change(&mut server.0.borrow_mut());
        bench.pass(1.0);
        assert!(bench.shown().contains(says), "{says}: {}", bench.shown());
        assert_eq!(server.number("oX"), before);
        undo(&mut server.0.borrow_mut());
        bench.pass(3.0);
        assert!(bench.shown().starts_with("Run"), "{says}: {}", bench.shown());
    }
    // Y is refused, X was taken: the vector is read again, nothing beyond a step.
    server.0.borrow_mut().refused = Some("oY".to_owned());
    server.set("X", Value::Number(0.0));
    bench.pass(2.0);
    assert!(
        bench.shown().contains("ns=2;s=oY") || bench.shown().contains("refuses"),
        "{}",
        bench.shown()
    );
    server.0.borrow_mut().refused = None;
    bench.pass(10.0);
    assert_eq!(
        bench.last.as_ref().map(|c| c.output.order.state),
        Some(State::Run),
        "{}",
        bench.shown()
    );
    // Another source writes.
    server.set("oX", Value::Number(0.2));
    bench.pass(1.0);
    assert!(bench.shown().starts_with("Latched"), "{}", bench.shown());
    assert_eq!(server.number("oX"), 0.2);
}

#[test]
fn another_control_and_missing_nodes_are_refused_at_the_start() {
    let refused = |server: &Server, changes: &[(&str, &str)]| -> String {
        let plan = plan_with(changes).unwrap_or_else(|e| panic!("{e:?}"));
        let ControlPlan::OpcUa(opcua) = &plan.control else { panic!("OPC UA") };
        let mut control = OpcUa::new(server.clone(), opcua_settings(&plan, opcua));
        let found = compared(&plan, opcua, &mut control, 0.0).expect_err("refused");
        assert!(server.0.borrow().written.is_empty(), "nothing is written");
        found.iter().map(|d| format!("{}: {}", d.code, d.message)).collect()
    };
    let server = Server::of(true);
    assert!(
        refused(&server, &[("version = \"1.0\"", "version = \"2.0\"")])
            .contains("live-other-control")
    );
    let unknown = refused(&server, &[("ns=2;s=inhibit", "ns=2;s=inhibited")]);
    assert!(
        unknown.contains("ns=2;s=inhibited") && unknown.contains("BadNodeIdUnknown"),
        "{unknown}"
    );
    // What the plan itself lacks.
    for (old, new, says) in [
        ("security = \"sign-and-encrypt\"\n", "", "security"),
        ("positions_have_offset = true\n", "", "positions_have_offset"),
        (
            "identity = { kind = \"Maker\", series = \"Server\", version = \"1.0\" }\n",
            "",
            "live-not-bound",
        ),
        ("emergency = \"ns=2;s=emergency\"\n", "", "emergency"),
        ("ns=2;s=mode", "mode", "live-node"),
        (", Z = \"ns=2;s=Z\"", "", "Z"),
        ("opc.tcp://", "http://", "bad-address"),
        ("security =", "user = \"u\"\nsecurity =", "password_file"),
    ] {
        let found = plan_with(&[(old, new)]).expect_err(says);
        assert!(found.iter().any(|f| f.contains(says)), "{says}: {found:?}");
    }
}

/// The plan of the temperatures alone, with a line along X.
fn lines(more: &[(&str, &str)]) -> Result<Plan, Vec<String>> {
    let line = "slope = { X = \"ns=2;s=sX\" }\nreference = { X = \"ns=2;s=rX\" }\nreferenced =";
    let mut changes = vec![("referenced =", line), ("part = \"whole\"", "part = \"thermal\"")];
    changes.extend(more);
    plan_with(&changes)
}

fn with_line(reference_mm: f64, shows_offset: bool) -> Server {
    let server = Server::of(shows_offset);
    server.set("sX", Value::Number(0.0));
    server.set("rX", Value::Number(reference_mm));
    server
}

/// By hand at 30.5 °C all over: a part of 13.2 µm/(m·K) has grown by 138.60 µm on each metre of X, a scale of 10.8 whose table is of 28.4 °C
/// by 22.68 µm since then: they part by 115.92 µm. That is the slope, whatever the reference is and whether the server shows the offset; no position is written for again.
#[test]
fn law_a_line_follows_the_position_by_itself() {
    for (reference_mm, shows_offset) in
        [(0.0, true), (3500.0, false), (1200.0, true), (-300.0, false)]
    {
        let server = with_line(reference_mm, shows_offset);
        let have = format!("positions_have_offset = {shows_offset}");
        let plan = lines(&[("positions_have_offset = true", have.as_str())]);
        let mut bench = Bench::new(plan.unwrap_or_else(|e| panic!("{e:?}")), &server);
        bench.pass(20.0);
        assert!(bench.shown().starts_with("Run"), "{}", bench.shown());
        let acts = |at: f64| server.0.borrow().acts("X", at);
        // A dead band of 1 µm at each end.
        assert!((server.number("sX") - 115.92e-6).abs() < 0.3e-6, "{}", server.number("sX"));
        for at in [0.0, 1000.0, 3500.0] {
            assert!((acts(at) - 115.92e-6 * at).abs() < 1e-3, "{at}: {}", acts(at));
        }
        let writes = server.0.borrow().written.len();
        for at in [3500.0, 0.0, 1750.0] {
            server.set("X", Value::Number(at));
            bench.pass(2.0);
            assert!(bench.shown().starts_with("Run"), "{}", bench.shown());
            let programmed =
                bench.last.as_ref().and_then(|c| c.output.programmed).expect("a position");
            assert!((programmed[0] - at).abs() < 1e-4, "{} at {at}", programmed[0]);
        }
        let memory = server.0.borrow();
        let late =
            memory.written[writes..].iter().flatten().any(|(name, _)| name == "oX" || name == "sX");
        assert!(!late, "the NC follows, nothing is written");
    }
}

/// Wherever the axis stands: no write moves it by more than the step, and it ends where it began.
#[test]
fn law_limits_hold_all_along_a_line() {
    let server = with_line(1200.0, true);
    let plan = lines(&[]).unwrap_or_else(|e| panic!("{e:?}"));
    let step_mm = f64::from(plan.axes[0].limits.step) * plan.axes[0].increment;
    let mut bench = Bench::new(plan, &server);
    bench.pass(20.0);
    let memory = server.0.borrow();
    let (mut offset, mut slope) = (0.0, 0.0);
    let mut most = 0.0_f64;
    for request in &memory.written {
        let before = (offset, slope);
        for (name, value) in request {
            match (name.as_str(), value) {
                ("sX", Value::Number(value)) => slope = *value,
                ("oX", Value::Number(value)) => offset = *value,
                _ => {}
            }
        }
        for at in [0.0, 700.0, 1200.0, 3500.0] {
            let moved = (offset - before.0) + (slope - before.1) * (at - 1200.0);
            most = most.max(moved.abs());
        }
    }
    assert!(most > 0.0 && most < step_mm + 1e-9, "{most}");
}

/// Another value of the reference is another correction everywhere: nothing is written over it.
#[test]
fn a_line_that_another_source_moves_latches() {
    let server = with_line(0.0, true);
    let mut bench = Bench::new(lines(&[]).unwrap_or_else(|e| panic!("{e:?}")), &server);
    bench.pass(20.0);
    server.set("rX", Value::Number(500.0));
    bench.pass(1.0);
    assert!(bench.shown().starts_with("Latched"), "{}", bench.shown());
    assert!((server.number("sX") - 115.92e-6).abs() < 0.3e-6);
}

#[test]
fn half_a_line_is_refused() {
    let half = [("reference = { X = \"ns=2;s=rX\" }\n", "")];
    let both = [("heartbeat =", "acting = { X = \"ns=2;s=aX\", Y = \"ns=2;s=aY\" }\nheartbeat =")];
    for changes in [&half, &both] {
        let found = lines(changes).expect_err("refused");
        assert!(found.iter().any(|f| f.contains("live-line")), "{found:?}");
    }
}

/// Temperatures act in proportion to the position, so a line loses nothing on the day of a hall; and it is never late.
#[test]
fn law_a_forecast_with_lines_is_as_good_and_not_late() {
    let read = |plan: Result<Plan, Vec<String>>| plan.unwrap_or_else(|e| panic!("{e:?}"));
    let (with, without) =
        (read(lines(&[])), read(plan_with(&[("part = \"whole\"", "part = \"thermal\"")])));
    let file = root().join("examples/03_predict/torque-arm-hall.csv");
    let text = std::fs::read_to_string(&file).expect("the log");
    let mut problems = Diagnostics::new();
    let log = TemperatureLog::parse("hall.csv", &text, &mut problems).expect("a log");
    let [with, without] =
        [with, without].map(|plan| expect(&plan, &log, None).expect("a forecast"));
    let (line, point) = (&with.axes[0], &without.axes[0]);
    assert_eq!(line.before, point.before);
    assert!((line.after - point.after).abs() < 2.0, "{} and {}", line.after, point.after);
    assert_eq!(line.moving, Some(0.0));
    assert!(point.moving.expect("a velocity") > 0.1);
    assert_eq!(with.axes[1].moving, without.axes[1].moving);
}

const BOTH: (&str, &str) = (
    "slope = { X = \"ns=2;s=sX\" }\nreference = { X = \"ns=2;s=rX\" }",
    "slope = { X = \"ns=2;s=sX\", Y = \"ns=2;s=sY\" }\nreference = { Y = \"ns=2;s=rY\", X = \"ns=2;s=rX\" }",
);

/// Lines of both axes, an axis whose control counts the other way, a tenth of the increment, another period: by hand Y parts by
/// 13.2 · 10.5 − 8.6 · 1.2 = 128.28 µm/m (its table is of 29.3 °C), X by 115.92 as with its line alone.
#[test]
fn law_lines_do_not_depend_on_sense_increment_and_period() {
    let turned = (
        "[axis.Y]\ncommissioned = { wrote = \"10 um\", measured = \"9.9 um\"",
        "[axis.Y]\nsign = -1\ncommissioned = { wrote = \"10 um\", measured = \"-9.9 um\"",
    );
    let fine = ("increment = \"1 um\"", "increment = \"0.1 um\"");
    let slow = ("period = \"50 ms\"", "period = \"130 ms\"");
    for (changes, sign) in [
        (vec![BOTH], 1.0),
        (vec![BOTH, fine], 1.0),
        (vec![BOTH, slow], 1.0),
        (vec![BOTH, turned], -1.0),
    ] {
        let server = with_line(700.0, true);
        server.set("sY", Value::Number(0.0));
        server.set("rY", Value::Number(-50.0));
        let mut bench = Bench::new(lines(&changes).unwrap_or_else(|e| panic!("{e:?}")), &server);
        bench.pass(25.0);
        assert!(bench.shown().starts_with("Run"), "{}", bench.shown());
        let memory = server.0.borrow();
        for (at_x, at_y) in [(0.0, 0.0), (3500.0, 2300.0), (1000.0, 2000.0)] {
            let (x, y) = (memory.acts("X", at_x), memory.acts("Y", at_y));
            assert!((x - 115.92e-6 * at_x).abs() < 1e-3, "X {x} at {at_x}");
            assert!((sign * y - 128.28e-6 * at_y).abs() < 1e-3, "Y {y} at {at_y}, sense {sign}");
        }
    }
}

/// A zero that lacked 50 µm in X takes 50 µm off all along the line, and leaves its slope.
#[test]
fn law_a_zero_shifts_a_line_and_does_not_turn_it() {
    let server = with_line(1200.0, true);
    let mut bench = Bench::new(lines(&[]).unwrap_or_else(|e| panic!("{e:?}")), &server);
    bench.pass(20.0);
    let before = [0.0, 1750.0, 3500.0].map(|at| server.0.borrow().acts("X", at));
    bench.run.ask_datum(DatumOrder::Set(Datum { missing: vec![0.05, 0.0] }));
    bench.pass(20.0);
    assert!(bench.shown().starts_with("Run"), "{}", bench.shown());
    for (before, at) in before.iter().zip([0.0, 1750.0, 3500.0]) {
        let after = server.0.borrow().acts("X", at);
        assert!((before - after - 0.05).abs() < 1.1e-3, "{before} {after} at {at}");
    }
    // Touched with the whole line acting nothing is missing, wherever the axis stands.
    bench.run.ask_datum(DatumOrder::Clear);
    bench.pass(20.0);
    for at in [0.0, 2222.0] {
        server.set("X", Value::Number(at));
        bench.pass(3.0);
        bench.run.ask_datum(DatumOrder::Take);
        bench.pass(0.2);
        let missing = bench.run.correction().datum().expect("a zero").missing[0];
        assert!(missing.abs() < 1.1e-3, "{missing} at {at}");
        bench.run.ask_datum(DatumOrder::Clear);
        bench.pass(1.0);
    }
}

/// Status, history and record of a part speak of the place where the tool is: what is wanted there is the same with a line and without
/// one, though the table of the machine is bent; what acts is what the NC adds there, and the rest is what the line leaves.
#[test]
fn law_what_is_shown_of_a_line_is_that_of_the_place() {
    let at = 1750.0;
    let shown = |plan: Result<Plan, Vec<String>>, server: &Server| -> [f64; 6] {
        server.set("X", Value::Number(at));
        let mut bench = Bench::new(plan.unwrap_or_else(|e| panic!("{e:?}")), server);
        bench.pass(20.0);
        let (plan, cycle) = (&bench.plan, bench.last.as_ref().expect("a cycle"));
        let (correction, counts) = (bench.run.correction(), bench.run.counts());
        let state = live_state(plan, &identity(), cycle, correction, counts);
        let (mut peaks, mut part) = (Peaks::default(), PartRecorder::default());
        peaks.add(plan, cycle, correction);
        let kept = line(&state, &mut peaks);
        let kept: Vec<f64> =
            kept.split(',').skip(4).map(|v| v.parse().expect("a number")).collect();
        part.add(plan, cycle, (correction, false));
        let row = part.end().expect("a row");
        // Seven columns, then the positions of X, Y and Z.
        let row: Vec<f64> = row.split(',').skip(10).map(|v| v.parse().expect("a number")).collect();
        let axis = &state.axes[0];
        [
            axis.target.expect("a target"),
            axis.offset.expect("an offset"),
            -kept[0],
            kept[1],
            row[0],
            row[2],
        ]
    };
    let bent = [("part = \"thermal\"", "part = \"whole\"")];
    let server = with_line(1200.0, true);
    let [target, offset, before, left, acted, off] = shown(lines(&bent), &server);
    let [wanted, ..] = shown(plan_with(&[]), &Server::of(true));
    let acts = 1e3 * server.0.borrow().acts("X", at);
    assert!((target - wanted).abs() < 1e-3, "{target} {wanted}");
    assert!((before - wanted).abs() < 6e-3, "{before} {wanted}");
    assert!((offset - acts).abs() < 1e-2 && (acted - acts).abs() < 6e-3, "{offset} {acted} {acts}");
    assert!((left - (acts - wanted)).abs() < 1.1e-2 && (off - left).abs() < 1.1e-2, "{left} {off}");
    // The table is bent by more than the dead band.
    assert!(left.abs() > 1.5, "{left}");
}

fn identity() -> Identity {
    let [kind, series, version] = ["Maker", "Server", "1.0"].map(str::to_owned);
    Identity { kind, series, version, axes: Vec::new(), decimals: Vec::new() }
}
