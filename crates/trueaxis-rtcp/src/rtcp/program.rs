//! NC programs for the readings: every pose of a set with a stop for the indicator.
//!
//! With RTCP on the tip stays on the ball while the rotary axes turn, as the readings ask for it; it
//! comes and goes along the tool. With
//! RTCP off the axes go where the table says; where the linear axes move between two poses, the tool
//! goes up to the end of Z first.

use super::study::{ReadingSet, Row, RtcpStudy, command_of};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_measure::measure::path::{Placing, leaves_travel};
use trueaxis_motion::{Batch, Observer, Options, SetUp, simulate};
use trueaxis_nc::moves::{Axis, Feed, FeedMode, Position};
use trueaxis_nc::{Control, Program};
use trueaxis_writer::{
    Block, Heading, Target, TipWords, ToolCall, WriteError, Writer, axis_coordinates,
};

/// Onto the ball and from pose to pose, mm/min (deg/min where only rotary axes move).
const FEED_PER_MINUTE: f64 = 500.0;
/// As high above the highest pose the tool goes where Z has no end, mm.
const LIFT_MM: f64 = 100.0;
/// From so far the tool comes to the ball, along itself, mm.
const CLEAR_MM: f64 = 30.0;
/// Shorter ways of the linear axes are no change of place, mm.
const SAME_MM: f64 = 1e-6;

/// The program of one set.
///
/// # Errors
/// Something that the control cannot write.
pub fn program(
    study: &RtcpStudy,
    set: &ReadingSet,
    control: Control,
) -> Result<Vec<u8>, WriteError> {
    let mut write = Written { writer: Writer::new(control), study, set, control };
    let about = format!(
        "{} of {}, {} poses, RTCP {}",
        set.name,
        study.machine.name(),
        poses(set).len(),
        if set.tcp { "on" } else { "off" }
    );
    let heading = Heading {
        name: &set.name,
        number: 1,
        comments: &[&about],
        machine_coordinates: !set.tcp,
        tolerance_mm: 0.001,
    };
    write.writer.write(&Block::Start(&heading))?;
    let call = ToolCall { number: 1, text: "indicator or probe", ..ToolCall::default() };
    write.writer.write(&Block::Tool(&call))?;
    let text = "INDICATOR AND BALL IN PLACE, ALL CLEAR";
    write.writer.write(&Block::Stop { optional: false, message: Some(text) })?;
    match set.tcp {
        true => write.held()?,
        false => write.standing()?,
    }
    write.writer.write(&Block::End)?;
    Ok(write.writer.finish())
}

/// The poses of a set in order; readings that follow each other at one pose are one stop.
fn poses(set: &ReadingSet) -> Vec<&Row> {
    let mut poses: Vec<&Row> = set.rows.iter().collect();
    poses.dedup_by(|a, b| a.command == b.command);
    poses
}

struct Written<'a> {
    writer: Writer,
    study: &'a RtcpStudy,
    set: &'a ReadingSet,
    control: Control,
}

impl Written<'_> {
    fn target(&self, command: &Command, wanted: impl Fn(usize, AxisKind) -> bool) -> Target {
        let mut target = Target::default();
        for (i, axis) in self.study.machine.axes().iter().enumerate() {
            let letter = axis.name.letter();
            let found = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == letter);
            let Some(found) = found.filter(|_| wanted(i, axis.kind)) else { continue };
            let rotary = axis.kind == AxisKind::Rotary;
            target = target.at(found, if rotary { command[i].to_degrees() } else { command[i] });
        }
        target
    }

    fn stop(&mut self, i: usize, command: &Command) -> Result<(), WriteError> {
        let axes = self.study.machine.axes().iter().zip(command);
        let turned = axes.filter(|(a, _)| a.kind == AxisKind::Rotary);
        let angles: Vec<String> =
            turned.map(|(a, q)| format!("{} {:.3}", a.name, q.to_degrees() + 0.0)).collect();
        let text = format!("READ {}: {}", i + 1, angles.join(" "));
        self.writer.write(&Block::Stop { optional: false, message: Some(&text) })
    }

    /// RTCP on: the tip on the ball, the rotary axes turn.
    fn held(&mut self) -> Result<(), WriteError> {
        let feed = Feed { mode: FeedMode::PerMinute, value: FEED_PER_MINUTE };
        self.writer.write(&Block::TipOn(TipWords::Angles))?;
        let ball = self.set.instrument.reference_point_mm;
        let poses = poses(self.set);
        let above = |row: &&Row| Some((row.command, self.above(&row.command)?));
        let [from, to] = [poses.first().and_then(above), poses.last().and_then(above)];
        if let Some((command, above)) = from {
            self.writer.write(&Block::Line(self.at(above, &command), feed))?;
        }
        for (i, row) in poses.into_iter().enumerate() {
            self.writer.write(&Block::Line(self.at(ball, &row.command), feed))?;
            self.stop(i, &row.command)?;
        }
        if let Some((command, above)) = to {
            self.writer.write(&Block::Line(self.at(above, &command), feed))?;
        }
        self.writer.write(&Block::TipOff)
    }

    /// The tip at a place of the workpiece, with the rotary axes of a command.
    fn at(&self, place_mm: Vec3, command: &Command) -> Target {
        let target = self.target(command, |_, kind| kind == AxisKind::Rotary);
        target.at(Axis::X, place_mm.x).at(Axis::Y, place_mm.y).at(Axis::Z, place_mm.z)
    }

    /// Away from the ball along the tool; `None` where that leaves the travel.
    fn above(&self, command: &Command) -> Option<Vec3> {
        let placing = Placing::of(&self.study.machine, &self.set.instrument).ok()?;
        let place = placing.reference_point_mm + placing.tool_axis(command) * CLEAR_MM;
        let above = placing.place(place, command)?;
        leaves_travel(&self.study.machine, &above).is_none().then_some(place)
    }

    /// RTCP off: the axes as commanded.
    fn standing(&mut self) -> Result<(), WriteError> {
        let feed = Feed { mode: FeedMode::PerMinute, value: FEED_PER_MINUTE };
        let axes = self.study.machine.axes();
        let z = axes.iter().position(|a| a.kind == AxisKind::Linear && a.name.letter() == 'Z');
        let highest = self.set.rows.iter().filter_map(|r| Some(r.command[z?]));
        let top = match z.map(|z| axes[z].travel) {
            Some(Travel::Between(_, top)) => top,
            _ => highest.fold(f64::NEG_INFINITY, f64::max) + LIFT_MM,
        };
        let mut before: Option<Command> = None;
        for (i, row) in poses(self.set).into_iter().enumerate() {
            let moved = before.is_none_or(|b| self.moves(&b, &row.command));
            if let Some(z) = z.filter(|_| moved) {
                let mut up = row.command;
                up[z] = top;
                for wanted in [Way::Up, Way::Turn, Way::Over] {
                    let takes = |k: usize, kind: AxisKind| match wanted {
                        Way::Up => k == z,
                        Way::Turn => kind == AxisKind::Rotary,
                        Way::Over => kind == AxisKind::Linear && k != z,
                    };
                    let target = self.in_machine(&up, takes);
                    self.writer.write(&Block::Rapid(target))?;
                }
            }
            let target = self.in_machine(&row.command, |_, _| true);
            self.writer.write(&Block::Line(target, feed))?;
            self.stop(i, &row.command)?;
            before = Some(row.command);
        }
        let (Some(z), Some(last)) = (z, before) else { return Ok(()) };
        let mut up = last;
        up[z] = top;
        let target = self.in_machine(&up, |k, _| k == z);
        self.writer.write(&Block::Rapid(target))
    }

    fn in_machine(&self, command: &Command, wanted: impl Fn(usize, AxisKind) -> bool) -> Target {
        Target { coordinates: axis_coordinates(self.control), ..self.target(command, wanted) }
    }

    fn moves(&self, from: &Command, to: &Command) -> bool {
        let axes = self.study.machine.axes().iter().enumerate();
        let mut linear = axes.filter(|(_, a)| a.kind == AxisKind::Linear);
        linear.any(|(i, _)| (from[i] - to[i]).abs() > SAME_MM)
    }
}

/// The three ways to a new place.
#[derive(Clone, Copy)]
enum Way {
    Up,
    Turn,
    Over,
}

/// Sees where the machine stands at the ends of blocks.
struct Stands(Vec<Command>);

impl Observer for Stands {
    fn path(&mut self, batch: &Batch<'_>) {
        self.0.extend(batch.nodes.iter().filter(|n| n.last).map(|n| n.command));
    }
}

/// How far from its poses the nominal machine would stand with a program of [`program`], mm or rad:
/// what the decimals leave. Infinite if the program has errors.
pub fn off_poses(study: &RtcpStudy, set: &ReadingSet, text: &[u8], control: Control) -> f64 {
    // The program is read as by a control that is set for the machine file.
    let nominal = ReadingSet { set_for_mm: vec![0.0; study.centres.terms.len()], ..set.clone() };
    let mut start = Position::default();
    for axis in study.machine.axes() {
        let letter = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == axis.name.letter());
        if let (Some(letter), Travel::Between(from, to)) = (letter, axis.travel) {
            let scale = if axis.kind == AxisKind::Rotary { 1f64.to_degrees() } else { 1.0 };
            start[letter] = 0f64.clamp(from.min(to), to.max(from)) * scale;
        }
    }
    // Without work offsets: as `post` writes and proves its programs.
    let setup = SetUp { start: Some(start), ..SetUp::default() };
    let program = Program::new(&set.name, text.to_vec(), control);
    let mut stands = Stands(Vec::new());
    let run = {
        let mut observers: Vec<&mut dyn Observer> = vec![&mut stands];
        let machine = study.machine.clone().with_tip(set.instrument.tool_point_mm);
        simulate(&machine, &program, &setup, &Options::default(), &mut observers)
    };
    if run.problems.has_errors() {
        return f64::INFINITY;
    }
    let off = |row: &&Row| {
        let Some(wanted) = command_of(study, &nominal, &row.command) else { return f64::INFINITY };
        let distance =
            |c: &Command| c.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        stands.0.iter().map(distance).fold(f64::INFINITY, f64::min)
    };
    poses(set).iter().map(off).fold(0.0, f64::max)
}
