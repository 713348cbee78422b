//! The part cut at a feed by axes that do not follow their commands exactly.
//!
//! ```text
//! q(t) all around ──Servo::follow──> a(t), where the axes are        docs/model.md eq. 213
//! where the tip of a passes the tip of each tool position: there the part is cut        eq. 214
//! ```
//!
//! The tool is judged where it passes a place, not when it should: a delay of all axes alike moves the tool along its
//! path and changes nothing of the part.

use super::cutting::{Change, Cutting, Reference};
use super::judge::Judge;
use super::sensitivity::propagate;
use super::servo::Servo;
use super::{Error, Study};
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::{Machine, Target};
use trueaxis_motion::limits;
use trueaxis_part::CuttingCondition;
use trueaxis_part::testpiece::{TestPiece, ToolPosition};
use trueaxis_part::tolerance::Verdict;

/// Chords of the command deviate by less than this from the path, mm.
const SAGITTA_MM: f64 = 5e-6;
/// A path has at least so many nodes, and at most so many.
const NODES: (usize, usize) = (720, 40_000);
/// A tip that stays farther away than this has left its path, mm.
const FARTHEST_MM: f64 = 20.0;

/// The part at the feed of one cutting condition.
#[derive(Debug, Clone)]
pub struct ConditionResult {
    /// The condition.
    pub condition: CuttingCondition,
    /// The lowest and the highest speed of the tip that the axes allow, mm/s.
    pub speed_mm_per_s: [f64; 2],
    /// All indices, mm, in the order of the test piece.
    pub indices_mm: Vec<f64>,
    /// Their standard uncertainties, mm.
    pub u_mm: Vec<f64>,
    /// The part of u that comes from the servo alone, mm.
    pub u_servo_mm: Vec<f64>,
    /// The indices with the servo alone, on a machine without errors, mm.
    pub servo_alone_mm: Vec<f64>,
    /// Against the tolerances.
    pub verdict: Verdict,
}

/// The closed path of the axes around the piece, at many nodes.
pub(super) struct ClosedPath {
    nodes: Vec<Command>,
    closing: Command,
    /// Length of the way of the tip up to each node, mm.
    way_mm: Vec<f64>,
    /// Every so many-th node is a tool position.
    every: usize,
}

impl ClosedPath {
    /// Of a test piece on a machine; the tool goes round once.
    pub fn of(machine: &Machine, piece: &dyn TestPiece, from: &Command) -> Result<Self, Error> {
        let count = piece.position_count();
        let positions = piece.tool_positions();
        let radius = positions.iter().map(|p| p.tip.vector().xy().norm()).fold(0.0_f64, f64::max);
        // r (1 − cos(π/n)) = sagitta
        let wanted = std::f64::consts::PI * (0.5 * radius / SAGITTA_MM).sqrt();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "40 000 at most"
        )]
        let wanted = (wanted.ceil() as usize).clamp(NODES.0, NODES.1);
        Self::with_nodes(machine, piece, from, wanted.div_ceil(count))
    }

    /// With so many nodes for each tool position.
    pub fn with_nodes(
        machine: &Machine,
        piece: &dyn TestPiece,
        from: &Command,
        every: usize,
    ) -> Result<Self, Error> {
        let fine = piece.finer_positions(every);
        let path: Vec<Target> = fine.iter().map(|p| Target { tip: p.tip, axis: p.axis }).collect();
        let mut nodes = machine.follow(&path, from).map_err(Error::Path)?;
        let closing = closing(machine, &nodes);
        nodes.extend(nodes.first().copied().map(|mut first| {
            (0..MAX_AXES).for_each(|i| first[i] += closing[i]);
            first
        }));
        let tips = fine.iter().chain(fine.first()).map(|p| p.tip.vector());
        let mut before = None;
        let mut way = 0.0;
        let way_mm = tips.map(|tip| {
            way += before.replace(tip).map_or(0.0, |b| (tip - b).norm());
            way
        });
        Ok(Self { way_mm: way_mm.collect(), nodes, closing, every })
    }

    /// When each node is reached, and the lowest and the highest speed of the tip.
    ///
    /// ```text
    /// v ≤ F        v |dq/ds| ≤ v_max        v² |d²q/ds²| ≤ a_max        |dv²/ds| |dq/ds| ≤ 2 a_max
    /// ```
    fn times(&self, machine: &Machine, feed_mm_per_s: f64) -> (Vec<f64>, [f64; 2]) {
        let limits = limits(machine);
        let last = self.nodes.len() - 1;
        let axes = machine.axes().len();
        // Of the middle of each piece, around.
        let slope = |piece: usize, i: usize| {
            let ds = self.way_mm[piece + 1] - self.way_mm[piece];
            (self.nodes[piece + 1][i] - self.nodes[piece][i]) / ds.max(1e-12)
        };
        let mut speed = vec![feed_mm_per_s; last];
        let mut push = vec![f64::INFINITY; last];
        for piece in 0..last {
            let next = (piece + 1) % last;
            let ds = 0.5 * (self.length(piece) + self.length(next));
            for i in 0..axes {
                let (here, there) = (slope(piece, i), slope(next, i));
                let most = here.abs().max(1e-12);
                speed[piece] = speed[piece].min(limits.velocity[i] / most);
                let bend = ((there - here) / ds.max(1e-12)).abs().max(1e-12);
                speed[piece] = speed[piece].min((limits.acceleration[i] / bend).sqrt());
                push[piece] = push[piece].min(limits.acceleration[i] / most);
            }
        }
        // No faster than the ramps allow, both ways around, twice.
        for k in 0..2 * last {
            let (before, here) = (k % last, (k + 1) % last);
            let ramp = 2.0 * push[before] * self.length(before);
            speed[here] = speed[here].min((speed[before].powi(2) + ramp).sqrt());
            let (after, here) = ((2 * last - k) % last, (2 * last - k - 1) % last);
            let ramp = 2.0 * push[here] * self.length(here);
            speed[here] = speed[here].min((speed[after].powi(2) + ramp).sqrt());
        }
        let mut now_s = 0.0;
        let mut times_s = vec![0.0];
        times_s.extend((0..last).map(|piece| {
            now_s += self.length(piece) / speed[piece];
            now_s
        }));
        let low = speed.iter().copied().fold(f64::INFINITY, f64::min);
        (times_s, [low, speed.iter().copied().fold(0.0, f64::max)])
    }

    fn length(&self, piece: usize) -> f64 {
        self.way_mm[piece + 1] - self.way_mm[piece]
    }

    /// Where the axes are when the tip passes each tool position.
    fn passings(
        &self,
        machine: &Machine,
        servo: &Servo,
        times_s: &[f64],
        positions: &[ToolPosition],
    ) -> Result<Vec<Command>, Error> {
        let actual = servo.follow(&self.nodes, times_s, &self.closing);
        let Some(control) = TipControl::of(machine) else { return Ok(Vec::new()) };
        let tips: Vec<_> = actual.iter().map(|a| control.tip_and_axis(a).0).collect();
        let last = self.nodes.len() - 1;
        let mut found = Vec::with_capacity(positions.len());
        for (position, ideal) in positions.iter().enumerate() {
            let tip = ideal.tip.vector();
            let distance = |piece: usize| {
                let way = tips[piece + 1] - tips[piece];
                let u =
                    ((tip - tips[piece]).dot(&way) / way.norm_squared().max(1e-18)).clamp(0.0, 1.0);
                ((tips[piece] + way * u - tip).norm(), u)
            };
            let of = |piece: usize| (distance(piece), piece);
            let nearest = (0..last).map(of).min_by(|a, b| a.0.0.total_cmp(&b.0.0));
            let ((by_mm, u), piece) = nearest.unwrap_or(((f64::INFINITY, 0.0), 0));
            if by_mm.is_nan() || by_mm > FARTHEST_MM {
                return Err(Error::Program { position, by_mm });
            }
            // The same turn as the command of this position.
            let near = &self.nodes[position * self.every];
            let (from, to) = (&actual[piece], &actual[piece + 1]);
            let command: Command = std::array::from_fn(|i| {
                let q = from[i] + (to[i] - from[i]) * u;
                match self.closing[i] {
                    0.0 => q,
                    turn => q - turn * ((q - near[i]) / turn).round(),
                }
            });
            found.push(command);
        }
        Ok(found)
    }
}

/// What an axis that goes round has more after a turn of the path.
fn closing(machine: &Machine, nodes: &[Command]) -> Command {
    let (Some(first), [.., before, last]) = (nodes.first(), nodes) else {
        return Command::default();
    };
    let mut closing = Command::default();
    for (i, axis) in machine.axes().iter().enumerate() {
        if axis.kind == AxisKind::Rotary {
            let on = 2.0 * last[i] - before[i] - first[i];
            closing[i] = (on / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        }
    }
    closing
}

/// The part at a feed of the tip.
struct Cut<'a> {
    machine: &'a Machine,
    piece: &'a dyn TestPiece,
    reference: &'a Reference,
    path: &'a ClosedPath,
    times_s: &'a [f64],
    positions: &'a [ToolPosition],
}

impl Cut<'_> {
    fn indices(&self, servo: &Servo, change: &Change<'_>) -> Result<Vec<f64>, Error> {
        self.judged(servo, &|judge| judge.once(change))
    }

    /// What a judge says of the part that is cut with this servo.
    fn judged<T>(
        &self,
        servo: &Servo,
        ask: &dyn Fn(&Judge<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let cutting = Cutting::new(self.machine, self.piece, self.reference)?;
        let cutting = match servo.is_exact() {
            // To the last bit the part without a servo.
            true => cutting,
            false => {
                let passings =
                    self.path.passings(self.machine, servo, self.times_s, self.positions)?;
                cutting.passed(&passings)?
            }
        };
        ask(&Judge { cutting: &cutting, piece: self.piece })
    }
}

/// The part in every cutting condition that states a feed; nothing without `[servo]`.
pub(super) fn conditions(study: &Study) -> Result<Vec<ConditionResult>, Error> {
    let Some(servo) = &study.servo else { return Ok(Vec::new()) };
    let (machine, piece) = (&study.machine, study.piece());
    let positions = piece.tool_positions();
    let still = Cutting::new(machine, piece, &study.reference)?;
    let path = ClosedPath::of(machine, piece, still.setting_command())?;
    let feeds = study.test_piece.conditions.iter().filter_map(|c| Some((c, c.feed_mm_per_min?)));
    let mut results = Vec::new();
    for (condition, feed_mm_per_min) in feeds {
        let (times_s, speed_mm_per_s) = path.times(machine, feed_mm_per_min / 60.0);
        let (times_s, positions, path) = (&times_s[..], &positions[..], &path);
        let cut = Cut { machine, piece, reference: &study.reference, path, times_s, positions };
        let as_stated = |errors: &ErrorValues, _: &_| *errors;
        let indices_mm = cut.indices(servo, &as_stated)?;
        let of_machine =
            cut.judged(servo, &|judge| propagate(machine, &|change| judge.once(change)))?;
        let mut squares = vec![0.0; indices_mm.len()];
        for quantity in servo.uncertain() {
            let ((above, up), (below, down)) =
                (servo.displaced(quantity, 1.0), servo.displaced(quantity, -1.0));
            let (above, below) =
                (cut.indices(&above, &as_stated)?, cut.indices(&below, &as_stated)?);
            // A value below its u can be moved up only: the step is then shorter than 2 u.
            for ((sum, a), b) in squares.iter_mut().zip(above).zip(below) {
                *sum += ((a - b) / (up - down)).powi(2);
            }
        }
        let machine_u = |i: usize| of_machine.get(i).copied().unwrap_or(0.0);
        let u_mm: Vec<f64> =
            squares.iter().enumerate().map(|(i, s)| s.sqrt().hypot(machine_u(i))).collect();
        let expanded = study.expanded_of(&u_mm);
        let verdict = study.judge(&indices_mm, expanded.as_deref()).map_err(Error::Evaluation)?;
        results.push(ConditionResult {
            condition: condition.clone(),
            speed_mm_per_s,
            servo_alone_mm: cut.indices(servo, &|_, _| ErrorValues::default())?,
            u_servo_mm: squares.into_iter().map(f64::sqrt).collect(),
            indices_mm,
            u_mm,
            verdict,
        });
    }
    Ok(results)
}

/// What a reader of the conditions should know.
pub(super) fn remarks(study: &Study, conditions: &[ConditionResult]) -> Vec<String> {
    let mut remarks = Vec::new();
    for result in conditions {
        let feed = result.condition.feed_mm_per_min.unwrap_or(0.0) / 60.0;
        let [low, _] = result.speed_mm_per_s;
        if low < 0.999 * feed {
            remarks.push(format!(
                "{}: the axes do not allow {:.1} m/min all around; the tip goes down to {:.1} m/min",
                result.condition.name,
                feed * 0.06,
                low * 0.06
            ));
        }
    }
    let Some(servo) = &study.servo else { return remarks };
    let positions = study.piece().tool_positions();
    let apart = positions.windows(2).map(|w| (w[1].tip - w[0].tip).norm()).fold(0.0, f64::max);
    for (axis, of) in study.machine.axes().iter().zip(&servo.0) {
        let slowest = conditions.iter().map(|c| c.speed_mm_per_s[0]).fold(f64::INFINITY, f64::min);
        let reach_mm = of.friction_time_s * slowest;
        if of.friction.value > 0.0 && reach_mm < apart {
            remarks.push(format!(
                "a reversal spike of {} is {reach_mm:.1} mm long, the tool positions are {apart:.1} mm apart: between \
                 them it is not seen; the test piece needs more positions",
                axis.name
            ));
        }
    }
    remarks
}
