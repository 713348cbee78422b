//! Computed words keep their expression, and the correction is added to it.

mod library;

use library::{Random, machine, with_lost_motion};
use trueaxis::compensate::program::{MARK, ProgramOptions, Rewritten, compensate_program};
use trueaxis::geometry::Vec3;
use trueaxis::input::{Diagnostics, Severity};
use trueaxis::machine::Machine;
use trueaxis::nc::moves::{Axis, Move, MoveKind, Step};
use trueaxis::nc::{Control, Library, Program, Settings, interpret};
use trueaxis::simulate::{SetUp, SetUpTool};

const CONTROLS: [Control; 4] =
    [Control::Sinumerik840d, Control::Fanuc, Control::LinuxCnc, Control::Heidenhain];

fn name(control: Control) -> &'static str {
    match control {
        Control::Fanuc | Control::Haas => "a.nc",
        Control::Sinumerik840d => "a.mpf",
        Control::Heidenhain => "a.h",
        Control::LinuxCnc => "a.ngc",
    }
}

/// Without lost motion: its reversals need points of their own.
fn mill() -> Machine {
    with_lost_motion(&machine("three-axis-mill"), 0.0)
}

fn with_set_up(
    machine: &Machine,
    text: &str,
    control: Control,
    setup: &SetUp,
) -> (Option<Rewritten>, Diagnostics) {
    let program = Program::new(name(control), text.as_bytes().to_vec(), control);
    compensate_program(machine, &program, setup, &ProgramOptions::default())
}

fn tried(machine: &Machine, text: &str, control: Control) -> (Option<Rewritten>, Diagnostics) {
    with_set_up(machine, text, control, &SetUp::default())
}

/// What was written, which is proved and not unrolled.
fn in_place(machine: &Machine, text: &str, control: Control) -> Rewritten {
    let (done, problems) = tried(machine, text, control);
    let Some(done) = done else { panic!("{text}\n{problems:?}") };
    assert!(done.is_proved(), "{text}\n{:?}", done.unproved);
    assert!(!problems.iter().any(|d| d.code == "unrolled"), "{text}\n{problems:?}");
    done
}

/// The new text without its mark.
fn written(done: &Rewritten) -> String {
    let text = String::from_utf8(done.text.to_vec()).unwrap();
    text.split_inclusive('\n').filter(|l| !l.contains(MARK)).collect()
}

struct Alone;

impl Library for Alone {
    fn text(&self, _: &str) -> Result<Vec<u8>, String> {
        Err("not there".to_owned())
    }
}

fn moves(text: &str, control: Control) -> Vec<Move> {
    let program = Program::new(name(control), text.as_bytes().to_vec(), control);
    let mut moves = Vec::new();
    let outcome = interpret(&program, &Alone, &Settings::default(), &mut |step| {
        if let Step::Move(m) = step {
            moves.push(m);
        }
    });
    assert!(outcome.finished, "{text}\n{:?}", outcome.problems);
    moves
}

/// A program with variables, and the same with numbers.
struct Twins {
    control: Control,
    random: Random,
    texts: [String; 2],
    /// In the unit of the program.
    place: [f64; 3],
    incremental: bool,
    /// mm in the unit of the program.
    unit: f64,
    /// How many variables were used.
    variable: usize,
}

/// The values of R1, #1, Q1 and of R2, #2, Q2.
const VALUES: [f64; 2] = [97.3, -11.25];

impl Twins {
    fn of(control: Control, seed: u64, inch: bool) -> Self {
        let unit = if inch { 25.4 } else { 1.0 };
        let place = [100.0 / unit, 100.0 / unit, -50.0 / unit];
        let mut twins = Self {
            control,
            random: Random(seed),
            texts: Default::default(),
            place,
            incremental: false,
            unit,
            variable: 0,
        };
        let [x, y, z] = place;
        let [a, b] = VALUES;
        twins.both(&match control {
            Control::Sinumerik840d => {
                let g = if inch { "G700" } else { "G710" };
                format!("N10 G54 G17 {g} G90 G94 F50\nR1={a} R2={b}\nG0 X{x} Y{y} Z{z}\nG1")
            }
            Control::Fanuc | Control::Haas => {
                let g = if inch { "G20" } else { "G21" };
                format!("%\nO1\n{g} G17 G90 G94 F50.\n#1={a}\n#2={b}\nG0 X{x:.6} Y{y:.6} Z{z:.6}\nG1")
            }
            Control::LinuxCnc => {
                let g = if inch { "G20" } else { "G21" };
                format!("{g} G17 G90 G94 F50\n#1={a}\n#2={b}\n#<a name>=#1\nG0 X{x} Y{y} Z{z}\nG1")
            }
            Control::Heidenhain => {
                let mm = if inch { "INCH" } else { "MM" };
                format!("0 BEGIN PGM A {mm}\n1 Q1 = +{a}\n2 FN 0: Q2 = {b}\n3 L X{x:+} Y{y:+} Z{z:+} R0 FMAX\n4 L F500")
            }
        });
        twins.both("\n");
        twins
    }

    fn both(&mut self, text: &str) {
        self.texts.iter_mut().for_each(|t| t.push_str(text));
    }

    fn pick(&mut self, count: usize) -> usize {
        (self.random.unit() * count as f64) as usize % count
    }

    /// An expression near a value with what it comes to, and the assignment that it needs before.
    fn expression(&mut self, near: f64) -> (String, String, f64) {
        let [a, b] = VALUES;
        let round = |v: f64| (v * 1e5).round() / 1e5;
        let (plus_a, plus_b, plus_half) = (round(near - a), round(near + b), round(near - 0.5 * a));
        let form = self.pick(7);
        let values = [a + plus_a, -b + plus_b, a * 0.5 + plus_half, 45.0 + round(near - 45.0)];
        let value = match form {
            0 | 4 | 5 => values[0],
            1 => values[1],
            2 => values[2],
            3 => values[3],
            _ => round(near),
        };
        let rest = round(near - 45.0);
        self.variable += 1;
        let n = 10 + self.variable % 80;
        let (before, text) = match (self.control, form) {
            (Control::Sinumerik840d, 0) => (String::new(), format!("=R1+({plus_a})")),
            (Control::Sinumerik840d, 1) => (String::new(), format!("=-R2+({plus_b})")),
            (Control::Sinumerik840d, 2) => (String::new(), format!("= SIN(30)*R1+({plus_half})")),
            (Control::Sinumerik840d, 3) => (String::new(), format!("=ATAN2(R1,R1)+({rest})")),
            (Control::Sinumerik840d, 4) => (String::new(), format!("=((R1)+(({plus_a})))")),
            (Control::Sinumerik840d, 5) => (format!("R{n}=R1+({plus_a})"), format!("=R{n}")),
            (Control::Sinumerik840d, _) => (format!("R{n}={}", -value), format!("=-R{n}")),
            (Control::Heidenhain, 0) => (format!("Q{n} = +Q1 + ({plus_a:+})"), format!("+Q{n}")),
            (Control::Heidenhain, 1) => (format!("Q{n} = -Q2 + ({plus_b:+})"), format!("+Q{n}")),
            (Control::Heidenhain, 2) => {
                (format!("Q{n} = SIN 30 * Q1 + ({plus_half:+})"), format!("+Q{n}"))
            }
            (Control::Heidenhain, 3) => (format!("Q{n} = ATAN 1 + ({rest:+})"), format!("+Q{n}")),
            (Control::Heidenhain, 4 | 5) => {
                (format!("FN 1: QL{n} = +Q1 + {plus_a:+}"), format!("+QL{n}"))
            }
            (Control::Heidenhain, _) => (format!("FN 0: Q{n} = {}", -value), format!("-Q{n}")),
            (_, 0) => (String::new(), format!("[#1+[{plus_a:.5}]]")),
            (_, 1) => (String::new(), format!("-[#2-[{plus_b:.5}]]")),
            (_, 2) => (String::new(), format!("[SIN[30.]*#1+[{plus_half:.5}]]")),
            (_, 3) => (String::new(), format!("[ATAN[1.]/[1.]+[{rest:.5}]]")),
            (Control::LinuxCnc, 4) => (String::new(), format!("[#<a name>+[{plus_a:.5}]]")),
            (_, 4) => (String::new(), format!("[[#1]+[[{plus_a:.5}]]]")),
            (_, 5) => (format!("#1{n}=[#1+[{plus_a:.5}]]"), format!("#1{n}")),
            (_, _) => (format!("#1{n}={:.5}", -value), format!("-#1{n}")),
        };
        (before, text, value)
    }

    fn number(&self, value: f64) -> String {
        match self.control {
            Control::Heidenhain => format!("{value:+}"),
            Control::Fanuc | Control::Haas if value.fract() == 0.0 => format!("{value:.1}"),
            _ => format!("{value}"),
        }
    }

    /// A move of some axes, in any order, each absolute or by an increment, computed or not.
    fn step(&mut self) {
        if self.control != Control::Heidenhain && self.pick(5) == 0 {
            self.incremental = !self.incremental;
            let g = if self.incremental { "G91\n" } else { "G90\n" };
            self.both(g);
        }
        let mut words: Vec<[String; 2]> = Vec::new();
        let first = self.pick(3);
        for axis in (0..=self.pick(3)).map(|k| (first + k) % 3) {
            if words.len() == 3 {
                break;
            }
            let [low, high] = [[40.0, 160.0], [40.0, 160.0], [-90.0, -20.0]][axis];
            let reach = 12.0 / self.unit;
            let to = self.place[axis] + self.random.within(reach);
            let to = to.clamp(low / self.unit, high / self.unit);
            let own = self.pick(4) == 0;
            let increment = match self.control {
                Control::Sinumerik840d | Control::Heidenhain if own => true,
                _ => self.incremental,
            };
            let wanted = if increment { to - self.place[axis] } else { to };
            let plain = (wanted * 1e4).round() / 1e4;
            let letter = ["X", "Y", "Z"][axis];
            let computed = (self.pick(3) > 0).then(|| self.expression(wanted));
            let value = computed.as_ref().map_or(plain, |(.., value)| *value);
            let number = self.number(value);
            let equals = if self.control == Control::Sinumerik840d { "=" } else { "" };
            let mut texts = [number.clone(), format!("{equals}{number}")];
            texts.swap(0, 1);
            let texts = match computed {
                Some((before, text, _)) => {
                    if !before.is_empty() {
                        self.both(&format!("{before}\n"));
                    }
                    [text, texts[0].clone()]
                }
                None => [texts[0].clone(), texts[0].clone()],
            };
            words.push(texts.map(|text| match self.control {
                Control::Sinumerik840d if own => {
                    format!("{letter}=IC({})", text.trim_start_matches(['=', ' ']))
                }
                Control::Heidenhain if own => format!("I{letter}{text}"),
                _ => format!("{letter}{text}"),
            }));
            self.place[axis] = if increment { self.place[axis] + value } else { value };
        }
        let klartext = if self.control == Control::Heidenhain { "L " } else { "" };
        for (k, text) in self.texts.iter_mut().enumerate() {
            let words: Vec<&str> = words.iter().map(|w| w[k].as_str()).collect();
            text.push_str(&format!("{klartext}{}\n", words.join(" ")));
        }
    }

    /// A quarter of a circle with computed ends and centre.
    fn arc(&mut self) {
        let r = 4.0 / self.unit;
        let [x, y, _] = self.place;
        let value = |twins: &mut Self, to: f64, at: f64| {
            let near = if twins.incremental { to - at } else { to };
            let (before, text, value) = twins.expression(near);
            if !before.is_empty() {
                twins.both(&format!("{before}\n"));
            }
            let equals = if twins.control == Control::Sinumerik840d { "=" } else { "" };
            let shown = format!("{equals}{}", twins.number(value));
            // Two words of a block would assign one variable.
            let reached = if twins.incremental { at + value } else { value };
            ([text, shown], reached)
        };
        let (ends_x, to_x) = value(self, x - r, x);
        let to_y = y + (x - to_x);
        let to_y = if self.incremental { to_y - y } else { to_y };
        let own = self.number(to_y);
        let equals = if self.control == Control::Sinumerik840d { "=" } else { "" };
        let [a, _] = VALUES;
        let centre = to_x - x;
        let round = (centre - a) * 1.0;
        let computed = match self.control {
            Control::Sinumerik840d => format!("=R1+({round})"),
            _ => format!("[#1+[{round}]]"),
        };
        let plain = format!("{equals}{}", self.number(a + round));
        let words = ends_x.iter().zip([computed, plain]);
        for (text, (x, i)) in self.texts.iter_mut().zip(words) {
            text.push_str(&format!("G3 X{x} Y{equals}{own} I{i}\nG1\n"));
        }
        self.place[0] = to_x;
        self.place[1] = if self.incremental { y + to_y } else { to_y };
    }

    /// A shift of X, computed and as a number: all places of the program are others after it.
    fn shift(&mut self) {
        let by = VALUES[0] - 97.0;
        self.place[0] -= by;
        let texts = match self.control {
            Control::Sinumerik840d => ["TRANS X=R1-97".to_owned(), format!("TRANS X={by}")],
            Control::Fanuc | Control::Haas => ["G52 X[#1-97.]".to_owned(), format!("G52 X{by}")],
            Control::LinuxCnc => ["G10 L2 P1 X[#1-97]".to_owned(), format!("G10 L2 P1 X{by}")],
            Control::Heidenhain => ["+Q9".to_owned(), format!("{by:+}")]
                .map(|x| format!("Q9 = Q1 - 97\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X{x}")),
        };
        for (text, shift) in self.texts.iter_mut().zip(texts) {
            text.push_str(&format!("{shift}\n"));
        }
    }

    /// Another tool of the same length.
    fn tool(&mut self) {
        self.both(match self.control {
            Control::Sinumerik840d => "T2 D1\nM6\nG1\n",
            Control::Heidenhain => "TOOL CALL 2 Z S1000\nL F500\n",
            Control::Fanuc | Control::Haas | Control::LinuxCnc => "T2 M6\nG1\n",
        });
    }

    fn end(mut self) -> [String; 2] {
        let end = match self.control {
            Control::Sinumerik840d | Control::LinuxCnc => "M30\n",
            Control::Fanuc | Control::Haas => "M30\n%\n",
            Control::Heidenhain => "L M30\nEND PGM A MM\n",
        };
        self.both(end);
        self.texts
    }
}

fn twins(control: Control, seed: u64, arcs: bool) -> [String; 2] {
    let mut twins = Twins::of(control, seed, seed % 3 == 2);
    for k in 0..20 {
        match k {
            5 if seed.is_multiple_of(2) => twins.shift(),
            11 if seed % 5 > 2 => twins.tool(),
            _ => {}
        }
        match arcs && k % 7 == 6 && control != Control::Heidenhain {
            true => twins.arc(),
            false => twins.step(),
        }
    }
    twins.end()
}

/// Of R1, #1 and Q1 in the next run.
const OTHER: f64 = 101.9;

fn with_other_value(text: &str) -> String {
    let other = ["R1=", "#1=", "Q1 = +"].iter().fold(text.to_owned(), |text, assigns| {
        text.replace(&format!("{assigns}{}", VALUES[0]), &format!("{assigns}{OTHER}"))
    });
    assert_ne!(other, text);
    other
}

#[test]
fn law_variables_and_numbers_lead_to_the_same_places() {
    let machine = mill();
    let mut expressions = 0;
    for control in CONTROLS {
        for seed in 0..15 {
            let [variables, numbers] = twins(control, seed, true);
            let [a, b] = [&variables, &numbers].map(|text| in_place(&machine, text, control));
            let [is, same] = [&a, &b].map(|done| moves(&written(done), control));
            assert_eq!(is.len(), same.len());
            for (m, n) in is.iter().zip(&same) {
                for axis in Axis::ALL {
                    let off = (m.target[axis] - n.target[axis]).abs();
                    assert!(
                        off < 5e-9,
                        "{control:?} {seed} {axis} {off}: {m:?} {n:?}\n{variables}\n{}",
                        written(&a)
                    );
                }
                if let (MoveKind::Arc(p), MoveKind::Arc(q)) = (m.kind, n.kind) {
                    let off = (0..2).map(|k| (p.center_mm[k] - q.center_mm[k]).abs());
                    assert!(off.fold(0.0, f64::max) < 5e-9, "{control:?} {seed} {p:?} {q:?}");
                } else {
                    assert_eq!(m.kind, n.kind, "{control:?} {seed}");
                }
            }
            assert_eq!(a.found.words_added, b.found.words_added, "{control:?} {seed}");
            assert_eq!(b.found.expressions_corrected, 0);
            expressions += a.found.expressions_corrected;
        }
    }
    assert!(expressions > 400, "{expressions}");
}

/// With another value of a parameter the written program keeps its distance to the program as it was.
#[test]
fn law_only_the_correction_is_added() {
    let machine = mill();
    for control in CONTROLS {
        for seed in 100..115 {
            let [was, _] = twins(control, seed, false);
            let is = written(&in_place(&machine, &was, control));
            let [now, next] = [[was.clone(), is.clone()], [&was, &is].map(|t| with_other_value(t))]
                .map(|both| both.map(|text| moves(&text, control)));
            for k in 0..now[0].len() {
                for axis in Axis::ALL {
                    let [a, b] =
                        [&now, &next].map(|of| of[1][k].target[axis] - of[0][k].target[axis]);
                    let off = (a - b).abs();
                    assert!(off < 1e-8, "{control:?} {seed} {axis} {a} {b} at {k}\n{was}\n{is}");
                }
            }
        }
    }
}

/// The lines of a block in each control, and what they become on the mill.
const FORMS: [(Control, &str, &str); 4] = [
    (
        Control::Sinumerik840d,
        "G90 G94 F500\nR1=100 R2=-110 R3=2.5\nG0 X=R1 Y100 Z-50\nG1 X=R1+5\nX=-R2 Y=AC(((R1+20))) ; comment\n\
         X=SIN(30)*R1+70 Z-51\nG91 Y=R1/20\nG90 X=((R1+40))\nG2 X=R1+45 Y=AC(100+30) I=R3 J=R3\nM30\n",
        "G90 G94 F500\nR1=100 R2=-110 R3=2.5\nG0 X=R1+0.002 Y100.005 Z-50\nG1 X=(R1+5)+0.002\n\
         X=(-R2)+0.001 Y=AC(((R1+20))+0.006) ; comment\nX=(SIN(30)*R1+70)+0.001 Z-51\nG91 Y=R1/20\n\
         G90 X=((R1+40))+0.002\nG2 X=(R1+45)+0.002 Y=AC((100+30)+0.006) I=R3 J=R3\nM30\n",
    ),
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\n#2=-110.\nG0 X#1 Y100. Z-50.\nG1 X[#1+5.]\n\
         X-#2 Y[[#1+20.]] (comment)\nX[SIN[30.]*#1+70.] Y-#2\nG91 X[#1/10.]\nG90 X-[#2-30.] Z-51.\nM30\n%\n",
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\n#2=-110.\nG0 X[#1+0.002] Y100.005 Z-50.\nG1 X[[#1+5.]+0.002]\n\
         X-[#2-0.001] Y[[[#1+20.]]+0.006] (comment)\nX[[SIN[30.]*#1+70.]+0.002] Y-[#2-0.005]\nG91 X[#1/10.]\n\
         G90 X-[[#2-30.]-0.002] Z-51. Y[#5002+0.001]\nM30\n%\n",
    ),
    (
        Control::LinuxCnc,
        "G21 G90 G94 F500\n#1=100\n#<b>=-110\nG0 X#1 Y100 Z-50\nG1 X[#1+5]\nx-#<b> Y[[#1+20]] (comment)\n\
         Xsin[30] Y-#<b> ; com\nXATAN[100]/[1] Y-#<b>\nG91 X[#1/10]\nG90 X-[#<b>-30] Z-51\nM2\n",
        "G21 G90 G94 F500\n#1=100\n#<b>=-110\nG0 X[#1+0.002] Y100.005 Z-50\nG1 X[[#1+5]+0.002]\n\
         x-[#<b>-0.001] Y[[[#1+20]]+0.006] (comment)\nX[sin[30]-0.001] Y-[#<b>-0.005] ; com\n\
         X[ATAN[100]/[1]+0.000938698] Y-[#<b>-0.005]\nG91 X[#1/10]\nG90 X-[[#<b>-30]-0.002] Z-51 Y[#5421+0.001]\n\
         M2\n",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q1 = +100\n2 Q121 = -110\n3 QL499 = 0\n4 L X+Q1 Y+100 Z-50 R0 FMAX\n\
         5 L X-Q121 Y+Q1 F500 ; com\n6 L IX+Q1\n7 L IX-Q1 IY-Q1\n8 END PGM A MM\n",
        "0 BEGIN PGM A MM\n1 Q1 = +100\n2 Q121 = -110\n3 QL499 = 0\nFN 1: QL498 = +Q1 + +0.002\n\
         4 L X+QL498 Y+100.005 Z-50 R0 FMAX\nFN 1: QL498 = -Q121 + +0.002\nFN 1: QL497 = +Q1 + +0.005\n\
         5 L X+QL498 Y+QL497 F500 ; com\nFN 1: QL498 = +Q1 + +0.001\n6 L IX+QL498 IY+0.001 Z-50.001\n\
         FN 1: QL498 = -Q1 + +0.001\nFN 1: QL497 = -Q1 + -0.004\n7 L IX+QL498 IY+QL497 Z-50\n8 END PGM A MM\n",
    ),
];

/// Nothing but the sums is new, and each is listed with its line.
#[test]
fn expressions_stay_and_are_listed() {
    let machine = mill();
    for (control, was, is) in FORMS {
        let done = in_place(&machine, was, control);
        assert_eq!(written(&done), is, "{control:?}");
        let found = &done.found;
        assert_eq!(found.expressions.len() as u64, found.expressions_corrected, "{control:?}");
        for expression in &found.expressions {
            let line = was.lines().nth(expression.line as usize - 1).unwrap();
            assert!(line.contains(&expression.was), "{control:?} {line} {expression:?}");
            assert!(is.contains(&expression.is), "{control:?} {expression:?}");
        }
    }
}

/// LinuxCNC 2.9.0~pre1, `rs274 -g` with the written program of [`FORMS`]: STRAIGHT_TRAVERSE and STRAIGHT_FEED, to the printed
/// four decimals.
const BY_RS274: [[f64; 3]; 7] = [
    [100.002, 100.005, -50.0],
    [105.002, 100.005, -50.0],
    [110.001, 120.006, -50.0],
    [0.499, 110.005, -50.0],
    [89.428, 110.005, -50.0],
    [99.428, 110.005, -50.0],
    [140.002, 110.006, -51.0],
];

#[test]
fn oracle_linuxcnc_reads_sums_and_the_present_place() {
    let written = FORMS.iter().find(|(control, ..)| *control == Control::LinuxCnc).map(|f| f.2);
    let moves = moves(written.unwrap(), Control::LinuxCnc);
    assert_eq!(moves.len(), BY_RS274.len());
    for (m, place) in moves.iter().zip(BY_RS274) {
        for (is, printed) in m.target.0.iter().zip(place) {
            assert!((is - printed).abs() <= 0.5001e-4, "{m:?} {place:?}");
        }
    }
}

/// Blocks that are executed once, wherever they stand: in a branch, a loop of one round, a subprogram.
const ONCE: [(Control, &str, &str); 6] = [
    (
        Control::Sinumerik840d,
        "G90 G94 F500\nR1=100 R2=0\nG0 X100 Y100 Z-50\nIF R1>50\nG1 X=R1+8\nELSE\nG1 X=R1-8\nENDIF\n\
         WHILE R2<1\nG1 Y=R1+4\nR2=R2+1\nENDWHILE\nM30\n",
        "G1 X=(R1+8)+0.002\nELSE\nG1 X=R1-8\nENDIF\nWHILE R2<1\nG1 Y=(R1+4)+0.005\n",
    ),
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\n#2=0\nG0 X100. Y100. Z-50.\nIF[#1GT50.]GOTO10\nG1 X[#1-8.]\n\
         N10 G1 X[#1+8.]\nWHILE[#2LT1]DO1\nG1 Y[#1+4.]\n#2=#2+1\nEND1\nM98 P100\nM30\nO100\nG1 X[#1+2.]\nM99\n%\n",
        "G1 X[#1-8.]\nN10 G1 X[[#1+8.]+0.002]\nWHILE[#2LT1]DO1\nG1 Y[[#1+4.]+0.005]\n#2=#2+1\nEND1\nM98 P100\nM30\n\
         O100\nG1 X[[#1+2.]+0.001]\n",
    ),
    (
        Control::LinuxCnc,
        "G21 G90 G94 F500\n#1=100\n#2=0\no9 sub\nG1 X[#1+2]\no9 endsub\nG0 X100 Y100 Z-50\no1 if [#1 GT 50]\n\
         G1 X[#1+8]\no1 else\nG1 X[#1-8]\no1 endif\no2 while [#2 LT 1]\nG1 Y[#1+4]\n#2=[#2+1]\no2 endwhile\n\
         o9 call [100]\nM2\n",
        "o9 sub\nG1 X[[#1+2]+0.001]\no9 endsub\n",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q1 = +100\n2 Q2 = +108\n3 L X+100 Y+100 Z-50 R0 FMAX\n\
         4 FN 9: IF +Q1 EQU +100 GOTO LBL 1\n5 L X+Q1 F500\n6 LBL 1\n7 L X+Q2 F500\n8 CALL LBL 2\n9 L M30\n\
         10 LBL 2\n11 L Y+Q2\n12 LBL 0\n13 END PGM A MM\n",
        "5 L X+Q1 F500\n6 LBL 1\nFN 1: QL499 = +Q2 + +0.002\n7 L X+QL499 F500\n8 CALL LBL 2\n9 L M30\n10 LBL 2\n\
         FN 1: QL499 = +Q2 + +0.005\n11 L Y+QL499 IX-0.001\n",
    ),
    // Increments begin in the subprogram and end after it.
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=2.\nG0 X100. Y100. Z-50.\nM98 P100\nY4.\nG90 X110. Y[#1+105.]\nM30\nO100\n\
         G91 G1 X[#1+2.]\nM99\n%\n",
        "Y4. X-0.001\nG90 X110.002 Y[[#1+105.]+0.005]\n",
    ),
    // A block that may be skipped takes its calculation along.
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q2 = +108\n2 L X+100 Y+100 Z-50 R0 FMAX\n/3 L X+Q2 F500\n4 END PGM A MM\n",
        "/ FN 1: QL499 = +Q2 + +0.002\n/3 L X+QL499 F500\n",
    ),
];

#[test]
fn blocks_that_are_executed_once_keep_their_expressions() {
    let machine = mill();
    for (control, was, part) in ONCE {
        let is = written(&in_place(&machine, was, control));
        assert!(is.contains(part), "{control:?}\n{is}");
    }
}

/// Blocks that are executed again, or need more points than one, and computed radii.
const UNROLLED: [(Control, &str, &str); 12] = [
    (
        Control::Sinumerik840d,
        "G90 G94 F500\nR1=100 R2=0\nG0 X100 Y100 Z-50\nWHILE R2<2\nG1 X=R1+8*R2\nR2=R2+1\nENDWHILE\nM30\n",
        "executed again",
    ),
    (
        Control::LinuxCnc,
        "G21 G90 G94 F500\no9 sub\nG1 X[#1+2]\no9 endsub\nG0 X100 Y100 Z-50\no9 call [100]\no9 call [104]\nM2\n",
        "executed again",
    ),
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\nG0 X100. Y100. Z-50.\nM98 P100\nM98 P100\nM30\nO100\n#1=#1+2.\n\
         G1 X#1\nM99\n%\n",
        "executed again",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q1 = +100\n2 L X+100 Y+100 Z-50 R0 FMAX\n3 LBL 1\n4 L X+Q1 F500\n5 Q1 = +Q1 + 3\n\
         6 CALL LBL 1 REP 2\n7 END PGM A MM\n",
        "executed again",
    ),
    // Without variables, too: increments of a loop lead to another place in each round.
    (
        Control::LinuxCnc,
        "G21 G90 G94 F500\nG0 X100 Y100 Z-50\no1 repeat [3]\nG91 G1 Y0.2\no1 endrepeat\nG90\nM2\n",
        "executed again",
    ),
    (
        Control::Sinumerik840d,
        "G90 G94 F500\nR1=100\nG0 X=-R1 Y100 Z-50\nG1 X=R1+80\nM30\n",
        "further points",
    ),
    // The line begins where a computed word led.
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=-100.\nG0 X#1 Y100. Z-50.\nG1 X180.\nM30\n%\n",
        "further points",
    ),
    (
        Control::Sinumerik840d,
        "G90 G94 F500\nR1=20\nG0 X100 Y100 Z-50\nG2 X110 Y110 CR=R1/2\nM30\n",
        "further points",
    ),
    // The control allows five brackets in each other.
    (
        Control::Fanuc,
        "%\nO1\nG21 G90 G94 F500.\n#1=100.\nG0 X100. Y100. Z-50.\nG1 X[[[[[#1+5.]]]]]\nM30\n%\n",
        "as many brackets",
    ),
    // Under radius compensation #5002 may not be a place of the contour.
    (
        Control::Fanuc,
        "%\nO1\nG21 G17 G90 G94\n#1=100.\nG0 X90. Y90. Z-50.\nG41 D1 G1 X#1 Y#1 F500.\nY[#1+20.]\nX140.\nG40 X150. Y100.\nM30\n%\n",
        "without a word",
    ),
    // A cycle with computed words: its moves have numbers.
    (
        Control::Fanuc,
        "%\nO1\nG21 G17 G90 G94 F500.\n#1=100.\nG0 X90. Y90. Z-40.\nG81 X#1 Y#1 Z-52. R-49.\nX[#1+5.]\nG80\nM30\n%\n",
        "several moves",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q1 = +100\n2 L X+90 Y+100 Z-50 R0 FMAX\n3 CC X+Q1 Y+100\n4 C X+110 Y+100 DR+ F500\n\
         5 END PGM A MM\n",
        "further points",
    ),
];

#[test]
fn the_others_are_unrolled_and_proved() {
    let machine = mill();
    for (control, text, why) in UNROLLED {
        let (done, problems) = tried(&machine, text, control);
        let Some(done) = done else { panic!("{text}\n{problems:?}") };
        assert!(done.is_proved(), "{text}\n{:?}", done.unproved);
        let note = problems.iter().find(|d| d.code == "unrolled");
        let Some(note) = note else { panic!("{text}\n{}", written(&done)) };
        assert!(note.message.contains(why), "{note}\n{text}");
        let is = written(&done);
        let left = ["=R1", "X#", "[#", "+Q1", "WHILE", "sub"].iter().find(|w| is.contains(**w));
        assert_eq!(left, None, "{is}");
    }
}

/// A set-up with a tool of 6 mm.
fn with_tool() -> SetUp {
    let tool = SetUpTool {
        name: "mill".to_owned(),
        tip_mm: Vec3::new(0.0, 0.0, -120.0),
        diameter_mm: Some(6.0),
        ..SetUpTool::default()
    };
    SetUp { given: true, tools: [(1, tool)].into(), ..SetUp::default() }
}

const CONTOURS: [(Control, &str, &str); 3] = [
    (
        Control::Sinumerik840d,
        "T1 D1\nM6\nG71 G17 G90 G94 F500\nR1=100\nG0 X90 Y90 Z-150\nG41 G1 X=R1 Y=R1\nY=R1+20 X=R1\n\
         X=R1+20 Y=R1+20\nG40 X130 Y=R1+30\nM30\n",
        "=(R1+20)+0.00",
    ),
    (
        Control::Fanuc,
        "%\nO1\nG21 G17 G90 G94\nT1 M6\n#1=100.\nG43 H1 G0 X90. Y90. Z-150.\nG41 D1 G1 X#1 Y#1 F500.\n\
         X#1 Y[#1+20.]\nX[#1+20.] Y[#1+20.]\nG40 X130. Y[#1+30.]\nM30\n%\n",
        "[[#1+20.]+0.00",
    ),
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F500\n2 Q1 = +100\n3 Q2 = +120\n4 L X+90 Y+90 Z-150 R0 FMAX\n\
         5 L X+Q1 Y+Q1 RL F500\n6 L Y+Q2\n7 L X+Q2\n8 L X+130 Y+130 R0\n9 END PGM A MM\n",
        "FN 1: QL499 = +Q2 + +0.00",
    ),
];

#[test]
fn radius_compensation_stays_with_computed_words() {
    let machine = mill();
    for (control, text, part) in CONTOURS {
        let (done, problems) = with_set_up(&machine, text, control, &with_tool());
        let Some(done) = done else { panic!("{text}\n{problems:?}") };
        assert!(done.is_proved(), "{text}\n{:?}", done.unproved);
        assert!(problems.iter().any(|d| d.code == "radius-compensation-kept"), "{problems:?}");
        assert!(written(&done).contains(part), "{problems:?}\n{}", written(&done));
    }
}

/// Rotary axes and directions of the tool, without and with tool-centre-point control.
const FIVE_AXES: [(Control, &str, &[&str]); 2] = [
    (
        Control::Heidenhain,
        "0 BEGIN PGM A MM\n1 Q121 = +12.5\n2 Q122 = -30\n3 L X+100 Y+100 Z+50 B+10 C-25 R0 FMAX\n\
         4 L B+Q121 C+Q122 F500\n5 L IB+Q121 C-Q122\n6 M128\n\
         7 L X-26.8 Y+34.8 Z+195.9 B+21 C+10\n7 L X-20 Y+Q122 Z+195.9 B+Q121 C+10 F5000\n8 L IX+Q121 IB-0.5\n9 M129\n10 END PGM A MM\n",
        &["FN 1: QL499 = +Q121 + -0.0041\n", "4 L B+QL499 C+QL498 F500\n"],
    ),
    (
        Control::Sinumerik840d,
        "G17 G710 G90 G94 F500\nR1=0.1 R2=12\nG0 X100 Y100 Z150 B5 C0\nTRAORI\nORIWKS\nG1 X12 Y1 Z120 A3=0.1 B3=0 C3=1\n\
         X=R2+1 Y1 Z120 A3=R1+0.001 B3=R1/1000 C3=SIN(90)\nX=R2+2 Y1 Z120 A3=R1+0.002 B3=R1/500 C3=1\nTRAFOOF\nM30\n",
        &["X=(R2+1)+0.01 ", " A3=(R1+0.001)-0.0000", " C3=(SIN(90))+0.0000"],
    ),
];

#[test]
fn rotary_axes_and_directions_are_corrected_in_place() {
    let machine = with_lost_motion(&machine("head-table"), 0.0);
    for (control, text, parts) in FIVE_AXES {
        let is = written(&in_place(&machine, text, control));
        for part in parts {
            assert!(is.contains(part), "{part}\n{is}");
        }
    }
}

/// Whatever is computed: the program is compensated, or the hint does not lead back to another refusal.
#[test]
fn no_hint_leads_to_another_refusal() {
    let words = [
        (
            Control::Sinumerik840d,
            "X=R1 Y=R1 DIV 3\nX=110 MOD 7+R1\nX=ABS(-R1)+TRUNC(5.5)\nX=R[1]+ROUND(R1/7)\nX = R1 ;c",
        ),
        (
            Control::Sinumerik840d,
            "DEF REAL DEEP=-51\nZ=DEEP X=MINVAL(R1,150)\nCYCLE81(0,-45,2,-52)\nX=R1 RND=1\nY120\nX130",
        ),
        (Control::Sinumerik840d, "G111 X=R1 Y0\nAP=30 RP=R1\n"),
        (Control::Sinumerik840d, "MIRROR X0\nX=-R1\n"),
        (Control::Sinumerik840d, "TRANS X=R1-90\nX100\nY101\nF=R1*3\nX=IC(1)\n"),
        (
            Control::LinuxCnc,
            "X[#1 MOD 7 + 100] Y[#1**0.5+100]\nX#<_x> Y#5421\nX[EXISTS[#<_x>]+100]\n",
        ),
        (Control::LinuxCnc, "G10 L2 P1 X[#1/10]\nX100\nY#1\nX + [#1] Y --#1\n"),
        (Control::LinuxCnc, "G81 X#1 Y[#1+2] Z-52 R-49\nX[#1+5]\nG80\nG1 X#1(c)Y#1;d\n"),
        (Control::Fanuc, "G68 X#1 Y#1 R30.\nX[#1+5.] Y#1\nG69\nG51 X#1 Y#1 P2000\nX[#1+5.]\nG50\n"),
        (
            Control::Fanuc,
            "G81 X#1 Z-52. R-49.\nX[#1+5.]\nG80\nG28 X#1\nX#1 F#1\nG52 X#1\nX1.\nG52 X0\n",
        ),
        (Control::Fanuc, "X#100\nX[ROUND[#1/7.]+100.]\nX##9 Y#[9]\nX#1#101=5.\n"),
        (Control::Heidenhain, "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+Q1\nL X+5 FQ1\nL IX+1\n"),
        (Control::Heidenhain, "CC X+Q1 Y+90\nLP PR+10 PA+Q1\nL X+Q1 Y+QL1 ~\n Z-51\n"),
        (Control::Heidenhain, "L X+Q1\nRND R2\nL Y+120\nL X--Q1\nFN 0: Q1 = +102\nL XQ1\n"),
    ];
    let machine = mill();
    for (control, lines) in words {
        let start = match control {
            Control::Sinumerik840d => "G90 G94 F500\nR1=100\nG0 X100 Y100 Z-50\nG1\n",
            Control::Heidenhain => {
                "0 BEGIN PGM A MM\nQ1 = +100\nQL1 = 101\nL X+100 Y+100 Z-50 R0 F500\n"
            }
            _ => "%\nO1\nG21 G90 G94 F500.\n#1=100.\n#9=1\nG0 X100. Y100. Z-50.\nG1\n",
        };
        let start =
            if control == Control::LinuxCnc { start.replace("O1\n", "") } else { start.to_owned() };
        let end = match control {
            Control::Heidenhain => "L M30\nEND PGM A MM\n",
            _ => "M30\n",
        };
        let text = format!("{start}{lines}\n{end}");
        let (done, problems) = tried(&machine, &text, control);
        for problem in problems.iter().filter(|d| d.severity == Severity::Error) {
            assert!(!problem.hint.contains("--flat"), "{problem}");
            assert_ne!(problem.code, "computed-coordinate", "{problem}\n{text}");
        }
        if let Some(done) = done {
            assert!(done.is_proved(), "{text}\n{}\n{:?}", written(&done), done.unproved);
        }
    }
}
