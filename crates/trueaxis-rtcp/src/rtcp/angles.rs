//! The directions of the rotary axes: which angle errors there are, which the readings determine, and which
//! further reading determines the others.
//!
//! ```text
//!     tip(q) = tip₀(q) + Σ x_j v_j(q) + Σ ε_k (v_k(q) + ω_k × p(q))        docs/model.md eq. 195
//! ```
//!
//! An angle acts by the distance of the tip from its axis: where a ball or a tool has one height or one
//! length only, some angles do what a centre does. So they are unknowns beside the centres, never after them.

use super::centres::{Centres, SHIFTS, add, rotary_range, shift};
use super::rows::rows;
use super::study::RtcpStudy;
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorName};
use trueaxis_machine::twist::Reference;
use trueaxis_measure::measure::path::Placing;
use trueaxis_measure::measure::{Instrument, Motion, Reading, Readings};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{Observability, normal_matrix};
use trueaxis_measure::unknowns::term::Term;

/// How many poses are used to separate angles from each other and from the centres.
const POSES: usize = 48;
/// A linear axis without stated ends is varied by so much to both sides, mm.
const WAY_MM: f64 = 200.0;
/// A component of a turn that lies along the axis by more than this only moves its zero.
const ALONG: f64 = 0.9;
/// A further ball or a further tool differs by so much from those that were read, mm.
pub(super) const FURTHER_MM: f64 = 50.0;
/// Angles of each rotary axis of a further reading.
const STEPS: usize = 5;

/// The angle errors of a machine, and whether they shall be found.
#[derive(Debug, Clone, PartialEq)]
pub struct Angles {
    /// Location errors in rad, true − machine file; no two do the same, and none what a centre does.
    pub terms: Vec<Term>,
    /// They are unknowns beside the centres; else they count as the machine file states them.
    pub wanted: bool,
}

/// One angle error of a rotary axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleError {
    /// Its ISO 230-1 name.
    pub name: String,
    /// In the words of the shop.
    pub words: String,
    /// True value and its standard uncertainty, rad; `None` where it was not asked for or not observable.
    pub found_rad: Option<(f64, f64)>,
    /// The standard uncertainty by the stated noise that these readings give; `None`: not observable, rad.
    pub expected_u_rad: Option<f64>,
    /// What to read in addition, where it is not observable.
    pub further: Option<String>,
}

impl Angles {
    /// The directions of the rotary axes, from the bed outwards; after a head also that of the spindle.
    ///
    /// Each acts in a way that no place and no attitude of the workpiece, no centre and no angle before it does,
    /// if the readings are rich enough: tips of two lengths, anywhere in the travel.
    pub fn of(machine: &Machine, centres: &Centres) -> Self {
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let own = SHIFTS.into_iter().chain(TURNS).map(|c| shift(0, c));
        for index in own.chain(centres.terms.iter().map(|t| t.index)) {
            add(&mut basis, column(machine, index));
        }
        let mut terms = Vec::new();
        for index in candidates(machine, centres) {
            if add(&mut basis, column(machine, index)) {
                let body = machine.bodies()[index.body].name;
                let error = ErrorName { body, kind: index.kind, component: index.component };
                terms.extend(Term::location(machine, error));
            }
        }
        Self { terms, wanted: false }
    }

    /// What an angle is, in the words of the shop.
    pub fn words(machine: &Machine, centres: &Centres, term: &Term) -> String {
        let about = ["X", "Y", "Z"][term.index.component as usize % 3];
        let body = term.index.body;
        let name = machine.bodies()[body].name;
        let axis = |body: usize| machine.bodies()[body].axis.map(|a| machine.axes()[a].direction);
        let chain = if centres.table.contains(&body) { &centres.table } else { &centres.head };
        let before = match chain.iter().position(|b| *b == body) {
            Some(i) => chain[..i].last(),
            None => chain.last(),
        };
        let about_it = |b: &&usize| {
            axis(**b).is_some_and(|d| d[term.index.component as usize % 3].abs() > ALONG)
        };
        let zero = before
            .filter(about_it)
            .map(|b| format!(" (zero of the {} axis)", machine.bodies()[*b].name))
            .unwrap_or_default();
        match axis(body) {
            Some(_) => format!("{name} axis inclined about {about}{zero}"),
            None => format!("spindle inclined about {about}{zero}"),
        }
    }
}

const TURNS: [Component; 3] = [Component::A, Component::B, Component::C];

fn candidates(machine: &Machine, centres: &Centres) -> Vec<ErrorIndex> {
    let across = |body: &usize| {
        let axis = machine.bodies()[*body].axis.map(|a| machine.axes()[a].direction);
        let turns = move |c: &Component| axis.is_some_and(|d| d[*c as usize % 3].abs() > ALONG);
        let body = *body;
        TURNS.into_iter().filter(move |c| !turns(c)).map(move |c| shift(body, c))
    };
    let mut all: Vec<ErrorIndex> =
        centres.table.iter().chain(&centres.head).flat_map(across).collect();
    if !centres.head.is_empty() {
        let tool = machine.bodies().len() - 1;
        all.extend([Component::A, Component::B].map(|c| shift(tool, c)));
    }
    all.retain(|index| index.kind == ErrorKind::Location);
    all
}

/// What an error does to two tips, one longer than the other, over many poses, as one long vector.
fn column(machine: &Machine, index: ErrorIndex) -> DVector<f64> {
    let mut values = Vec::with_capacity(6 * POSES);
    let tips = [machine.tip_mm(), machine.tip_mm() - Vec3::z() * (2.0 * FURTHER_MM)];
    for k in 0..POSES {
        let frames = machine.error_frames(&pose(machine, k), Reference::Workpiece);
        let twist = frames.twist(index);
        for tip in tips {
            let link = frames.reference_from_tool();
            let at = link.linear() * tip + link.shift_mm();
            values.extend((twist.shift_mm + twist.turn_rad.cross(&at)).iter().copied());
        }
    }
    let column = DVector::from_vec(values);
    let length = column.norm();
    if length > 1e-9 { column / length } else { column }
}

/// All axes over their travel (Kronecker's sequence).
fn pose(machine: &Machine, k: usize) -> Command {
    const STEPS: [f64; 6] =
        [0.754_877_666, 0.569_840_291, 0.819_172_513, 0.671_043_606, 0.549_700_478, 0.450_340_838];
    let mut command = Command::default();
    for ((q, axis), step) in command.iter_mut().zip(machine.axes()).zip(STEPS) {
        let (from, to) = match (axis.kind, axis.travel) {
            (AxisKind::Rotary, travel) => rotary_range(travel),
            (AxisKind::Linear, Travel::Between(from, to)) => (from.max(-1e4), to.min(1e4)),
            _ => (-WAY_MM, WAY_MM),
        };
        *q = from + (to - from) * (step * (k as f64 + 0.5)).fract();
    }
    command
}

/// What the readings of a study say about its angles beside its centres, whether they are wanted or not.
pub(super) struct Outlook {
    /// One for each angle: the standard uncertainty by the noise, `None` where it is not observable, rad.
    pub u_rad: Vec<Option<f64>>,
    /// One for each angle that is not observable: what to read in addition.
    pub further: Vec<Option<String>>,
}

/// A reading that was not taken yet.
#[derive(Clone, Copy)]
struct Further {
    words: &'static str,
    /// Tool longer, ball along X and Z of the workpiece, mm.
    longer_mm: f64,
    ball_mm: [f64; 2],
}

const FURTHER: [Further; 4] = [
    Further {
        words: "both rotary axes turned together against the same ball",
        longer_mm: 0.0,
        ball_mm: [0.0, 0.0],
    },
    Further {
        words: "a second tool, 50 mm longer or shorter (`tip` of the set)",
        longer_mm: FURTHER_MM,
        ball_mm: [0.0, 0.0],
    },
    Further { words: "a second ball, 50 mm higher", longer_mm: 0.0, ball_mm: [0.0, FURTHER_MM] },
    Further {
        words: "a second ball, 50 mm farther from the rotary axis",
        longer_mm: 0.0,
        ball_mm: [FURTHER_MM, 0.0],
    },
];

/// Which angles these readings determine, and which further reading would determine the others.
pub(super) fn outlook(study: &RtcpStudy) -> Outlook {
    let terms: Vec<Term> = study.centres.terms.iter().chain(&study.angles.terms).copied().collect();
    let (first, n) = (study.centres.terms.len(), terms.len());
    let instruments: Vec<Instrument> = study.sets.iter().map(|s| s.instrument.clone()).collect();
    let readings = rows(study, None).readings;
    let sight = |more: &[&Further]| {
        let (mut instruments, mut all) = (instruments.clone(), Readings::default());
        for i in 0..readings.len() {
            all.push(again(&readings, i));
        }
        for further in more {
            take(study, further, &mut instruments, &mut all);
        }
        let design = Design::new(&study.machine, terms.clone(), instruments);
        Observability::of(&normal_matrix(&design, &all, &[]))
    };
    let now = sight(&[]);
    let covariance = now.covariance();
    let u_rad = (first..n).map(|k| now.is_seen[k].then(|| covariance[(k, k)].sqrt())).collect();
    let mut further: Vec<Option<String>> = vec![None; n - first];
    let unknown = |k: usize| !now.is_seen[first + k];
    if (0..n - first).any(unknown) {
        let single: Vec<Observability> = FURTHER.iter().map(|f| sight(&[f])).collect();
        let whole = sight(&FURTHER.each_ref());
        for (k, words) in further.iter_mut().enumerate().filter(|(k, _)| unknown(*k)) {
            let alone = FURTHER.iter().zip(&single).find(|(_, s)| s.is_seen[first + k]);
            *words = Some(match (alone, whole.is_seen[first + k]) {
                (Some((f, _)), _) => f.words.to_owned(),
                (None, true) => {
                    let all: Vec<&str> = FURTHER.iter().map(|f| f.words).collect();
                    format!("all of: {}", all.join("; "))
                }
                (None, false) => "no further ball and no further tool determines it".to_owned(),
            });
        }
    }
    Outlook { u_rad, further }
}

/// Row i of readings as one reading.
fn again(readings: &Readings, i: usize) -> Reading {
    Reading {
        command: readings.commands[i],
        approach: readings.approaches[i],
        instrument: readings.instruments[i],
        direction: readings.directions[i],
        value: [0.0; 3],
        group: 0,
        time_s: 0.0,
        motion: Motion::default(),
        line: 0,
    }
}

/// Adds a reading over the travel of both rotary axes, as it would be taken beside the first set.
fn take(
    study: &RtcpStudy,
    further: &Further,
    instruments: &mut Vec<Instrument>,
    all: &mut Readings,
) {
    let Some(set) = study.sets.first() else { return };
    let mut instrument = set.instrument.clone();
    instrument.tool_point_mm.z -= further.longer_mm;
    instrument.reference_point_mm.x += further.ball_mm[0];
    instrument.reference_point_mm.z += further.ball_mm[1];
    let Ok(placing) = Placing::of(&study.machine, &instrument) else { return };
    let number = u32::try_from(instruments.len()).unwrap_or(u32::MAX);
    for rotary in turned(&study.machine) {
        let Some(command) = placing.place(instrument.reference_point_mm, &rotary) else { continue };
        for channel in 0..3 {
            all.push(Reading {
                command,
                approach: [0.0; 6],
                instrument: number,
                direction: Vec3::ith(channel, 1.0),
                value: [0.0; 3],
                group: 0,
                time_s: 0.0,
                motion: Motion::default(),
                line: 0,
            });
        }
    }
    instruments.push(instrument);
}

/// All combinations of a few angles of the rotary axes.
fn turned(machine: &Machine) -> Vec<Command> {
    let mut poses = vec![Command::default()];
    for (i, axis) in machine.axes().iter().enumerate() {
        if axis.kind != AxisKind::Rotary {
            continue;
        }
        let (from, to) = rotary_range(axis.travel);
        let at = |s: usize| from + (to - from) * s as f64 / (STEPS - 1) as f64;
        let mut next = Vec::with_capacity(poses.len() * STEPS);
        for pose in &poses {
            for s in 0..STEPS {
                let mut turned: Command = *pose;
                turned[i] = at(s);
                next.push(turned);
            }
        }
        poses = next;
    }
    poses
}

/// The angles with what was found of them.
pub(super) fn found(
    study: &RtcpStudy,
    outlook: Outlook,
    values: &[f64],
    covariance: &DMatrix<f64>,
    is_seen: &[bool],
) -> Vec<AngleError> {
    let Outlook { u_rad, further } = outlook;
    let each = |k: usize| {
        let term = &study.angles.terms[k];
        let found = study.angles.wanted && is_seen.get(k) == Some(&true);
        AngleError {
            name: term.error.to_string(),
            words: Angles::words(&study.machine, &study.centres, term),
            found_rad: found.then(|| (values[k], covariance[(k, k)].sqrt())),
            expected_u_rad: u_rad.get(k).copied().flatten(),
            further: further.get(k).cloned().flatten(),
        }
    };
    (0..study.angles.terms.len()).map(each).collect()
}
