//! What the writer writes, the interpreter reads back.

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, Coolant, Event, Feed, FeedMode, Move, MoveKind, SpindleDirection};
use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};
use trueaxis_writer::{
    Block, Decimals, Heading, Target, Templates, TipWords, ToolCall, WriteError, Writer,
};

const CONTROLS: [Control; 4] =
    [Control::LinuxCnc, Control::Fanuc, Control::Sinumerik840d, Control::Heidenhain];

/// The steps of a text, which must have no errors and no unknown words.
fn read(text: &[u8], control: Control) -> Vec<Step> {
    let program = Program::new("written", text.to_vec(), control);
    let mut steps = Vec::new();
    let shown = String::from_utf8_lossy(text);
    let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |s| steps.push(s));
    assert!(outcome.finished, "{shown}");
    for problem in outcome.problems.iter() {
        assert_eq!(problem.code, "unknown-tool-length", "{problem}\n{shown}");
    }
    steps
}

fn moves(steps: &[Step]) -> Vec<Move> {
    let of = |s: &Step| if let Step::Move(m) = s { Some(*m) } else { None };
    steps.iter().filter_map(of).collect()
}

/// A place to which a move leads, by the machine's own axes or the tip with its axis.
#[derive(Debug, Clone)]
enum RotaryDirection {
    Rapid,
    PerMinute(f64),
    Inverse(f64),
}

#[derive(Debug, Clone)]
struct Wanted {
    target: Target,
    way: RotaryDirection,
}

fn value() -> impl Strategy<Value = f64> {
    prop_oneof![-2000.0..2000.0, Just(0.0), Just(100.0), -1e-3..1e-3, Just(-0.25)]
}

fn wanted() -> impl Strategy<Value = Wanted> {
    let way = prop_oneof![
        Just(RotaryDirection::Rapid),
        (0.01..20_000.0).prop_map(RotaryDirection::PerMinute),
        (0.01..5_000.0).prop_map(RotaryDirection::Inverse),
    ];
    (prop::collection::vec((0..5_usize, value()), 1..5), way).prop_map(|(axes, way)| {
        let names = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C];
        let target = axes.iter().fold(Target::default(), |t, (i, v)| t.at(names[*i], *v));
        Wanted { target, way }
    })
}

fn rounded(value: f64, decimals: u8) -> f64 {
    let scale = 10_f64.powi(i32::from(decimals));
    (value * scale).round_ties_even() / scale
}

fn allows(control: Control, way: &RotaryDirection) -> bool {
    !(control == Control::Heidenhain && matches!(way, RotaryDirection::Inverse(_)))
}

fn block(wanted: &Wanted) -> Block<'static> {
    let feed = |mode, value| Block::Line(wanted.target, Feed { mode, value });
    match wanted.way {
        RotaryDirection::Rapid => Block::Rapid(wanted.target),
        RotaryDirection::PerMinute(value) => feed(FeedMode::PerMinute, value),
        RotaryDirection::Inverse(value) => feed(FeedMode::InverseTime, value),
    }
}

/// A written move and what came back: the same place, kind and feed.
fn assert_same(wanted: &Wanted, place: &[f64; 9], came: &Move, text: &str) {
    for axis in Axis::ALL {
        let (a, b) = (place[axis as usize], came.target[axis]);
        assert!((a - b).abs() < 1e-9, "{axis}: {a} {b}\n{text}");
    }
    match wanted.way {
        RotaryDirection::Rapid => assert_eq!(came.kind, MoveKind::Rapid, "{text}"),
        RotaryDirection::PerMinute(f) => {
            assert_eq!((came.kind, came.feed.mode), (MoveKind::Linear, FeedMode::PerMinute));
            assert!((came.feed.value - rounded(f, 3)).abs() < 1e-9, "{text}");
        }
        RotaryDirection::Inverse(f) => {
            assert_eq!((came.kind, came.feed.mode), (MoveKind::Linear, FeedMode::InverseTime));
            assert!((came.feed.value - rounded(f, 3)).abs() < 1e-9, "{text}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// read ∘ write = id, to the least increment; moves that lead nowhere are left out.
    #[test]
    fn law_written_axis_moves_read_back(
        all in prop::collection::vec(wanted(), 1..20),
        index in 0..4_usize,
        tip in any::<bool>(),
    ) {
        let control = CONTROLS[index];
        let mut writer = Writer::new(control);
        writer.write(&Block::Start(&Heading::default())).unwrap();
        if tip {
            writer.write(&Block::TipOn(TipWords::Angles)).unwrap();
        }
        let mut now = [0.0_f64; 9];
        let mut expected = Vec::new();
        for (i, wanted) in all.iter().filter(|w| allows(control, &w.way)).enumerate() {
            // At the beginning nothing is known; a first move names where it goes, even to 0.
            let before = now;
            for axis in Axis::ALL.into_iter().filter(|a| wanted.target.named.contains(*a)) {
                let decimals = if axis.is_rotary() { 5 } else { 4 };
                now[axis as usize] = rounded(wanted.target.place[axis], decimals);
            }
            writer.write(&block(wanted)).unwrap();
            if i == 0 || now != before {
                expected.push((wanted.clone(), now));
            }
        }
        writer.write(&Block::End).unwrap();
        let text = writer.finish();
        let came = moves(&read(&text, control));
        let text = String::from_utf8_lossy(&text);
        // A first word to 0 may have come back too: it is a move to where the axes are.
        let mut place = [0.0; 9];
        let mut came = came.into_iter().filter(|m| {
            let moved = m.target.0.iter().zip(place).any(|(a, b): (&f64, f64)| (a - b).abs() > 1e-12);
            place = m.target.0;
            moved
        });
        let mut at = [0.0; 9];
        for (wanted, place) in expected {
            if place == at { continue; }
            at = place;
            let came = came.next();
            prop_assert!(came.is_some(), "{}", text);
            assert_same(&wanted, &place, &came.unwrap(), &text);
        }
        prop_assert_eq!(came.next(), None);
    }

    /// Tool axes as vectors come back with their seven decimals.
    #[test]
    fn law_written_vectors_read_back(
        all in prop::collection::vec(
            (value(), -1.0..1.0_f64, -1.0..1.0_f64, 0.05..1.0_f64), 1..20),
        index in 1..4_usize,
    ) {
        let control = CONTROLS[index];
        let mut writer = Writer::new(control);
        writer.write(&Block::Start(&Heading::default())).unwrap();
        writer.write(&Block::TipOn(TipWords::Vectors)).unwrap();
        let feed = Feed { mode: FeedMode::PerMinute, value: 700.0 };
        for (x, i, j, k) in &all {
            let target = Target::default().at(Axis::X, *x).along([*i, *j, *k]);
            writer.write(&Block::Line(target, feed)).unwrap();
        }
        writer.write(&Block::End).unwrap();
        let text = writer.finish();
        let came = moves(&read(&text, control));
        prop_assert_eq!(came.len(), all.len());
        for ((x, i, j, k), m) in all.iter().zip(&came) {
            prop_assert!((m.target[Axis::X] - rounded(*x, 4)).abs() < 1e-9);
            let direction = m.direction.unwrap();
            for (a, b) in direction.iter().zip([i, j, k]) {
                prop_assert!((a - rounded(*b, 7)).abs() < 1e-12);
            }
        }
    }

    /// Whatever people call things, the program stays readable.
    #[test]
    fn law_texts_of_people_do_no_harm(text in any::<String>(), index in 0..4_usize) {
        let control = CONTROLS[index];
        let mut writer = Writer::new(control);
        let comments = [text.as_str()];
        let heading = Heading { name: &text, comments: &comments, ..Heading::default() };
        writer.write(&Block::Start(&heading)).unwrap();
        let call = ToolCall { number: 3, text: &text, speed_per_minute: Some(1000.0), ..ToolCall::default() };
        writer.write(&Block::Tool(&call)).unwrap();
        writer.write(&Block::Comment(&text)).unwrap();
        writer.write(&Block::Message(&text)).unwrap();
        writer.write(&Block::Stop { optional: true, message: Some(&text) }).unwrap();
        writer.write(&Block::End).unwrap();
        let steps = read(&writer.finish(), control);
        prop_assert_eq!(moves(&steps).len(), 0);
        let stops = |s: &&Step| matches!(s, Step::Event(Event::Stop { optional: true }, _));
        prop_assert_eq!(steps.iter().filter(stops).count(), 1);
    }
}

#[test]
fn law_everything_else_reads_back() {
    for control in CONTROLS {
        let mut writer = Writer::new(control);
        let feed = Feed { mode: FeedMode::PerMinute, value: 250.0 };
        let near = Target::default().at(Axis::X, 1.0).at(Axis::Y, 2.0).at(Axis::Z, 3.0);
        let call = ToolCall {
            number: 4,
            text: "ball 6 mm",
            speed_per_minute: Some(12_000.0),
            ..ToolCall::default()
        };
        for block in [
            Block::Start(&Heading::default()),
            Block::Tool(&call),
            Block::Spindle(SpindleDirection::Clockwise, 12_000.0),
            Block::Coolant(Coolant::Flood),
            Block::Rapid(near),
            Block::Dwell(1.5),
            Block::Line(near.at(Axis::X, 5.0), feed),
            Block::Coolant(Coolant::Off),
            Block::Spindle(SpindleDirection::Stopped, 0.0),
            Block::Stop { optional: false, message: Some("measure") },
            Block::Rapid(Target::default().at(Axis::Z, -0.5).from_machine_zero()),
            Block::Line(near, feed),
            Block::End,
        ] {
            writer.write(&block).unwrap();
        }
        let text = writer.finish();
        let steps = read(&text, control);
        let text = String::from_utf8_lossy(&text);
        let event =
            |wanted: &Event| steps.iter().any(|s| matches!(s, Step::Event(e, _) if e == wanted));
        assert!(event(&Event::ToolChange(4)), "{text}");
        assert!(event(&Event::SpindleSpeed(12_000.0)), "{text}");
        assert!(event(&Event::Spindle(SpindleDirection::Clockwise)), "{text}");
        assert!(event(&Event::Spindle(SpindleDirection::Stopped)), "{text}");
        assert!(event(&Event::Coolant(Coolant::Flood)) && event(&Event::Coolant(Coolant::Off)));
        assert!(event(&Event::Stop { optional: false }) && event(&Event::End), "{text}");
        let moves = moves(&steps);
        let dwell = MoveKind::Dwell { seconds: 1.5 };
        assert!(moves.iter().any(|m| m.kind == dwell), "{text}");
        let last = moves.last().unwrap();
        assert_eq!(
            (last.target.0[..3].to_vec(), last.kind),
            (vec![1.0, 2.0, 3.0], MoveKind::Linear)
        );
    }
}

#[test]
fn what_a_control_cannot_say_is_an_error() {
    let feed = Feed { mode: FeedMode::InverseTime, value: 1.0 };
    let target = Target::default().at(Axis::X, 1.0);
    let mut heidenhain = Writer::new(Control::Heidenhain);
    assert!(heidenhain.write(&Block::Line(target, feed)).is_err());
    assert!(heidenhain.text().is_empty());
    let mut fanuc = Writer::new(Control::Fanuc);
    let machine = target.from_machine_zero();
    let fault = fanuc.write(&Block::Line(machine, feed)).unwrap_err();
    assert!(matches!(fault, WriteError::NotInDialect { control: "FANUC", .. }));
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(fanuc.write(&Block::Rapid(target.at(Axis::Y, bad))).is_err());
        assert!(fanuc.write(&Block::Line(target, Feed { value: bad, ..feed })).is_err());
    }
    assert!(fanuc.write(&Block::Line(target, Feed { value: 0.0, ..feed })).is_err());
    assert!(fanuc.write(&Block::Rapid(target.along([0.0; 3]))).is_err());
    assert!(fanuc.text().is_empty());
}

#[test]
fn templates_of_the_user_are_used() {
    let text = "{% block start %}(MY {{ name }}){% endblock %}\
                {% block tool %}M106 T{{ tool }}{% endblock %}\
                {% block tip_on %}G43.4 H{{ tool }}{% endblock %}\
                {% block tip_off %}G49{% endblock %}{% block end %}M30{% endblock %}";
    let templates = Templates::parse(text).unwrap();
    let mut writer = Writer::with(Control::Fanuc, Decimals::default(), templates);
    writer.write(&Block::Start(&Heading { name: "bangle 1", ..Heading::default() })).unwrap();
    let call = ToolCall { number: 12, ..ToolCall::default() };
    writer.write(&Block::Tool(&call)).unwrap();
    writer.write(&Block::End).unwrap();
    assert_eq!(writer.finish(), b"(MY BANGLE_1)\nM106 T12\nM30\n");
}
