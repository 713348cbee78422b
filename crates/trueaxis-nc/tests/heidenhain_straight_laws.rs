//! Laws of the shorter cut for lines with `L`: nothing that it executes differs from the general way.
//!
//! With reported blocks every block takes the general way, and the text is the same, byte for byte. So both
//! ways are compared step by step and problem by problem, places included.

use proptest::prelude::*;
use trueaxis_nc::moves::{Axis, AxisSet, Position};
use trueaxis_nc::{
    Control, Event, Follower, FollowingAxes, KnownPosition, NoLibrary, Outcome, Program, Settings,
    Step, interpret_on,
};

/// A machine that ends each move beside where it was sent, so that reading the place is seen.
struct Machine {
    is_there: bool,
    place: Position,
    steps: Vec<Step>,
}

impl Follower for Machine {
    fn take(&mut self, step: Step) {
        match &step {
            Step::Event(Event::Block { .. } | Event::Computed { .. }, _) => return,
            Step::Event(..) => {}
            Step::Move(m) => self.place = m.target,
        }
        self.steps.push(step);
    }

    fn axes(&self) -> Option<&dyn FollowingAxes> {
        self.is_there.then_some(self as &dyn FollowingAxes)
    }

    fn points(&self) -> u64 {
        self.steps.len() as u64
    }
}

impl FollowingAxes for Machine {
    fn place(&self) -> KnownPosition {
        let mut position = self.place;
        position[Axis::X] += 0.5;
        KnownPosition { position, axes: AxisSet(0b01_1111) }
    }

    fn positions(&self) -> KnownPosition {
        FollowingAxes::place(self)
    }

    fn retracted(&self) -> Option<KnownPosition> {
        None
    }
}

fn executed(text: &str, settings: &Settings, is_there: bool) -> (Vec<String>, Outcome) {
    let program = Program::new("p", text.as_bytes().to_vec(), Control::Heidenhain);
    let mut machine = Machine { is_there, place: Position::default(), steps: Vec::new() };
    let outcome = interpret_on(&program, &NoLibrary, settings, &mut machine);
    // As text 0 and −0 differ.
    (machine.steps.iter().map(|step| format!("{step:?}")).collect(), outcome)
}

/// Numbers as they are written, and some that are none.
fn number() -> impl Strategy<Value = String> {
    let plain = (0..2_000_000_u32, 0..6_usize)
        .prop_map(|(n, decimals)| format!("{:.decimals$}", f64::from(n) / 1e3));
    let long = ("[0-9]{0,10}", "[.,]", "[0-9]{0,10}").prop_map(|(a, p, b)| a + &p + &b);
    let odd = prop::sample::select(vec![
        "0",
        "00.0",
        "7.",
        ".5",
        "1,5",
        ",5",
        "5,",
        ".",
        "",
        "1.2.3",
        "1..2",
        "12345678",
        "99999999",
        "123456789",
        "1234567890123456789",
        "Q1",
        "QL2",
        "Q9",
        "nan",
        "1e3",
        "(1)",
    ]);
    prop_oneof![12 => plain, 2 => long, 2 => odd.prop_map(str::to_owned)]
}

fn sign() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        9 => Just("+"), 7 => Just("-"), 4 => Just(""), 1 => prop::sample::select(vec!["--", "+-", "+ ", "- "]),
    ]
}

fn blank() -> impl Strategy<Value = &'static str> {
    prop_oneof![16 => Just(" "), 2 => Just(""), 1 => Just("  "), 1 => Just("\t"), 1 => Just(" \t ")]
}

/// One word of a line, mostly of an axis.
fn word() -> impl Strategy<Value = String> {
    let axis = ("[XYZXYZABCUVWxyzc]", sign(), number()).prop_map(|(a, s, n)| a + s + &n);
    let other = ("(I[XYZABC]|NX|TY|PR|IPA|LEN|CCA|[FRSLMN]|F[UZ])", sign(), number())
        .prop_map(|(a, s, n)| a + s + &n);
    let feed = prop_oneof![(1..9000_u32).prop_map(|f| format!("F{f}")), Just("FMAX".to_owned())];
    let fixed = prop::sample::select(vec![
        "F0", "F-0", "F AUTO", "FAUTO", "F MAX", "fmax", "FMAXX", "FMAX5", "FZ0.1", "FU.2", "FQ1",
        "F 100", "R0", "r0", "R0.0", "R00", "R 0", "R+0", "R5", "RL", "RR", "R+", "R-", "M3",
        "M5 M9", "M91", "M89", "M99", "M94", "M126", "M127", "M128", "M129", "M130", "M136",
        "M137", "M2", "DR+", ";", "; X+1 ~", "~", "\"", "!", "€", "%", "/", "=", "_", "L", "X",
        "X + 1", "X+1X+2", "\u{b}",
    ]);
    prop_oneof![
        40 => axis, 8 => feed, 3 => Just("R0".to_owned()), 1 => other, 2 => fixed.prop_map(str::to_owned),
    ]
}

/// A line with `L`, with its number and its end.
fn line() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        8 => (0..9999_u32).prop_map(|n| format!("{n} ")),
        4 => Just(String::new()),
        2 => prop::sample::select(vec!["12", " 7 ", "\t7\t", "007  ", "1 2 ", "/", "/ 5 ", "/3 ", "1.5 ", "-3 ", "N5 "])
            .prop_map(str::to_owned),
    ];
    let head = prop_oneof![
        24 => Just("L "), 1 => Just("l "), 1 => Just("L\t"), 1 => Just("L"), 1 => Just("LN "), 1 => Just(""),
    ];
    let words = proptest::collection::vec((word(), blank()), 0..8);
    (number, head, words).prop_map(|(number, head, words)| {
        words.into_iter().fold(number + head, |line, (word, blank)| line + &word + blank)
    })
}

/// Any other line.
fn other_line() -> impl Strategy<Value = String> {
    prop::sample::select(vec![
        "",
        " ",
        "; note",
        "* - part",
        "12",
        "RND R2",
        "5 RND R0.5 F50",
        "CHF 1",
        "7 CHF 300",
        "\tRND R1",
        "CC X+5 Y+0",
        "CC",
        "C X+10 Y+0 DR+",
        "CR X+3 Y+4 R+5 DR-",
        "CT X+7 Y+8",
        "LP PR+5 PA+30",
        "LN X+1 NX+0 NY+0 NZ+1 TX+0 TY+0 TZ+1",
        "APPR LT X+1 Y+1 LEN5 RL",
        "DEP LT LEN4",
        "TOOL CALL 1 Z S100 F200",
        "TOOL DEF 1 L+5 R+2",
        "BEGIN PGM a INCH",
        "BEGIN PGM a MM",
        "END PGM a MM",
        "L M3",
        "M126",
        "M127",
        "M128",
        "M136 F1",
        "M30",
        "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL VECTOR",
        "FUNCTION RESET TCPM",
        "PLANE SPATIAL SPA+0 SPB+0 SPC+30 STAY",
        "PLANE RESET STAY",
        "CYCL DEF 7.1 X+10",
        "CYCL DEF 10.1 ROT+30",
        "CYCL DEF 200 D ~\nQ200=2 ~\nQ201=-9 ~\nQ206=100",
        "CYCL CALL",
        "M89",
        "M99",
        "Q1 = 5",
        "Q1 = Q1 / 0",
        "L X+1 ~\n Y+2",
        "LBL 1",
        "LBL 0",
        "CALL LBL 1",
        "CALL LBL 1 REP 2",
        "FN 9: IF +Q1 EQU +5 GOTO LBL 2",
        "LBL 2",
        "X+5 R0",
        "C+90 FMAX",
        "L IX+1 F100",
        "L A+20 C-370 F9",
        "L X+1 RL F9",
        "L X+1 FU0.2",
        "L X+1 FZ.1",
        "APPR LN X+5 Y+5 LEN5",
        "APPR CT X+5 Y+5 CCA90 R+3",
        "LN X+1 TX+1 TY+0 TZ+1\nL A+5 FMAX\nL X+1 FMAX\nL M140 MB5",
        "L X+9 R0",
    ])
    .prop_map(str::to_owned)
}

fn ending() -> impl Strategy<Value = &'static str> {
    prop_oneof![12 => Just("\n"), 1 => Just("\r"), 1 => Just("\r\n"), 1 => Just("\n\n")]
}

fn program() -> impl Strategy<Value = String> {
    let begin = prop::sample::select(vec![
        "",
        "0 BEGIN PGM a MM\n",
        "BEGIN PGM a INCH\n",
        "TOOL DEF 0 R1\nTOOL CALL 0 Z F50\n",
    ]);
    let lines = (prop_oneof![9 => line(), 2 => other_line()], ending());
    let end = prop::sample::select(vec!["", "END PGM a MM\n", "L X+1", "L X+1 FMAX"]);
    (begin, any::<bool>(), proptest::collection::vec(lines, 0..40), end).prop_map(
        |(begin, crlf, lines, end)| {
            let text = lines
                .into_iter()
                .fold(begin.to_owned() + "L F1000\n", |text, (line, end)| text + &line + end)
                + end;
            if crlf { text.replace('\n', "\r\n") } else { text }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Klartext in every notation: the shorter cut for lines with `L` and the general way.
    #[test]
    fn law_lines_with_l_are_read_like_all_others(
        text in program(), keep_going in any::<bool>(), is_there in any::<bool>(), on_contour in any::<bool>(),
    ) {
        let short = Settings { most_jumps: 50, deepest_call: 8, keep_going, on_contour, ..Settings::default() };
        let general = Settings { report_blocks: true, ..short.clone() };
        let (steps, outcome) = executed(&text, &short, is_there);
        let (wanted, outcome_wanted) = executed(&text, &general, is_there);
        prop_assert_eq!(steps, wanted);
        prop_assert_eq!(outcome, outcome_wanted);
    }
}
