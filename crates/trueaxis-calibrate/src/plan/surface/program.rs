//! Touch after touch along the normals: poses, program, and what the machine would do with it.

use super::file::SurfaceStudy;
use crate::plan::program::{ProgramCheck, ProgramError, axis_target, probe_shape, run};
use crate::plan::touch::{SURFACE_LOG, Touch, TouchLog, declare};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_geometry::surface::SurfacePoint;
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::Target;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::chain::Link;
use trueaxis_machine::tcp::TipControl;
use trueaxis_measure::measure::path::leaves_travel;
use trueaxis_motion::collide::{BodyModel, Role};
use trueaxis_motion::{SetUp, SetUpTool};
use trueaxis_nc::moves::{Axis, Feed, FeedMode, Position};
use trueaxis_nc::{Control, Program};
use trueaxis_writer::{Block, Heading, ToolCall, Writer};

/// From touch to touch the probe goes straight if no rotary axis turns by more than this, rad.
const NEAR_RAD: f64 = 0.3;
/// … and the next point is not farther off than so many spacings.
const NEAR_SPACINGS: f64 = 3.0;
/// Where the travel is not stated the tool goes so far above the highest touch, mm.
const ABOVE_MM: f64 = 50.0;
/// No more points than these are named one by one.
const MOST_REPORTED: usize = 5;

/// A point with the axis positions to touch it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// What is touched.
    pub point: SurfacePoint,
    /// The clearance above it.
    pub above: Command,
    /// The stand-off before it.
    pub before: Command,
    /// Where the touch ends at the latest.
    pub beyond: Command,
}

/// The points that the machine can touch along their normals; the others are reported and left out.
///
/// A machine without rotary axes touches with the probe upright.
pub fn poses(
    study: &SurfaceStudy,
    points: &[SurfacePoint],
    problems: &mut Diagnostics,
) -> Vec<Pose> {
    let machine = &study.machine;
    let rotary = machine.axes().iter().any(|a| a.kind == AxisKind::Rotary);
    let Some(control) = TipControl::of(machine) else {
        let message = "the machine has fewer than three linear axes".to_owned();
        problems.error("cannot-follow", Place::whole(&study.file), message, "");
        return Vec::new();
    };
    let mut from = Command::default();
    let (mut found, mut left_out) = (Vec::new(), Vec::new());
    for point in points {
        let axis = if rotary { point.axis } else { Vec3::z() };
        let pose = pose(study, &control, point, axis, &from);
        match pose {
            Some(pose) => {
                from = pose.above;
                found.push(pose);
            }
            None => left_out.push(*point),
        }
    }
    for point in left_out.iter().take(MOST_REPORTED) {
        let p = point.point_mm;
        let message = format!(
            "({:.3}, {:.3}, {:.3}) cannot be touched along its normal within the travel",
            p.x, p.y, p.z
        );
        let line = point.line as usize;
        let place = Place { file: study.surface_file.clone(), line, column: usize::from(line > 0) };
        let hint = "the point is left out";
        problems.warn("unreachable-point", place, message, hint);
    }
    if left_out.len() > MOST_REPORTED || found.is_empty() {
        let message = format!("{} of {} points cannot be touched", left_out.len(), points.len());
        let hint = "does the workpiece of the machine file stand where it stands?";
        match found.is_empty() {
            true => problems.error("unreachable-point", Place::whole(&study.file), message, hint),
            false => problems.warn("unreachable-point", Place::whole(&study.file), message, hint),
        }
    }
    found
}

fn pose(
    study: &SurfaceStudy,
    control: &TipControl,
    point: &SurfacePoint,
    axis: Vec3,
    from: &Command,
) -> Option<Pose> {
    let at = |gap: f64| point.point_mm + point.normal * (study.ball_radius_mm + gap);
    let tip = at(study.stand_off_mm);
    let target = Target { tip: Point::new(tip.x, tip.y, tip.z), axis: Direction::of(axis)? };
    let solved = study.machine.solve(&target, from).ok()?;
    let place = |gap: f64, rotary: &Command| {
        let mut command = *rotary;
        let placed = control.place(at(gap), &mut command);
        let inside = placed && leaves_travel(&study.machine, &command).is_none();
        inside.then_some(command)
    };
    solved.solutions.iter().filter(|s| s.within_travel).find_map(|s| {
        Some(Pose {
            point: *point,
            above: place(study.clearance_mm, &s.command)?,
            before: place(study.stand_off_mm, &s.command)?,
            beyond: place(-study.beyond_mm, &s.command)?,
        })
    })
}

/// The program in machine coordinates, without tool-centre point.
///
/// # Errors
/// The control has no word for a touch, or a number is too large.
pub fn surface_program(
    study: &SurfaceStudy,
    poses: &[Pose],
    control: Control,
) -> Result<Vec<u8>, ProgramError> {
    written(study, poses, control, false)
}

/// The files that the program needs beside itself on the control.
pub fn surface_files(study: &SurfaceStudy, control: Control) -> Vec<(String, String)> {
    TouchLog { machine: &study.machine, control, is_stand_in: false }.files()
}

/// The program, or what stands in for it where it is read back.
fn written(
    study: &SurfaceStudy,
    poses: &[Pose],
    control: Control,
    is_stand_in: bool,
) -> Result<Vec<u8>, ProgramError> {
    let about = format!("{} points on {}", poses.len(), study.machine.name());
    let comments = [about.as_str()];
    let heading = Heading::of_measuring(&study.name, &comments);
    let log = TouchLog { machine: &study.machine, control, is_stand_in };
    let mut touches = Touches { study, control, log, writer: Writer::new(control), last: None };
    if let Some(text) = declare(control) {
        touches.writer.write(&Block::Text(text))?;
    }
    touches.writer.write(&Block::Start(&heading))?;
    let call = ToolCall { number: study.tool, text: "touch probe", ..ToolCall::default() };
    touches.writer.write(&Block::Tool(&call))?;
    touches.writer.write(&Block::Text(&SURFACE_LOG.open(control)))?;
    let text = "TOUCH PROBE IN THE SPINDLE, ALL CLEAR";
    touches.writer.write(&Block::Stop { optional: false, message: Some(text) })?;
    let high = high(study, poses);
    let order = order(study, poses.len());
    for (i, point) in order.iter().enumerate() {
        touches.touch(&poses[*point], high, [i + 1, point + 1])?;
    }
    touches.lift(high)?;
    touches.writer.write(&Block::Text(&SURFACE_LOG.close(control, order.len())))?;
    touches.writer.write(&Block::End)?;
    Ok(touches.writer.finish())
}

/// The points in the order of the hits, counted from 0: at the end the first one again, if that is wanted.
pub(super) fn order(study: &SurfaceStudy, points: usize) -> Vec<usize> {
    let again = study.touches_again && points > 1;
    (0..points).chain(again.then_some(0)).collect()
}

/// The axis that lifts the tool, and where it is clear of everything.
fn high(study: &SurfaceStudy, poses: &[Pose]) -> Option<(usize, f64)> {
    let axes = study.machine.axes();
    let z = axes.iter().position(|a| a.kind == AxisKind::Linear && a.name.letter() == 'Z')?;
    let highest = poses.iter().map(|p| p.above[z]).fold(f64::NEG_INFINITY, f64::max);
    match axes[z].travel {
        Travel::Between(_, top) => Some((z, top)),
        _ => Some((z, highest + ABOVE_MM)),
    }
}

/// A program in the making.
struct Touches<'a> {
    study: &'a SurfaceStudy,
    control: Control,
    log: TouchLog<'a>,
    writer: Writer,
    /// Where the tool stands, above the last point.
    last: Option<Pose>,
}

impl Touches<'_> {
    fn touch(
        &mut self,
        pose: &Pose,
        high: Option<(usize, f64)>,
        [hit, point]: [usize; 2],
    ) -> Result<(), ProgramError> {
        match self.last.filter(|last| self.is_near(last, pose)) {
            Some(_) => self.line(&pose.above)?,
            None => self.arrive(&pose.above, high)?,
        }
        self.line(&pose.before)?;
        let words = self.log.touch(&Touch {
            from: &pose.before,
            target: &pose.beyond,
            mm_per_min: self.study.touch_feed_mm_per_min,
            hit,
            pose: point,
        })?;
        self.writer.write(&Block::Text(&words))?;
        self.line(&pose.before)?;
        self.line(&pose.above)?;
        self.last = Some(*pose);
        Ok(())
    }

    fn is_near(&self, last: &Pose, next: &Pose) -> bool {
        let turned = self.study.machine.axes().iter().enumerate().all(|(i, axis)| {
            axis.kind == AxisKind::Linear || (last.above[i] - next.above[i]).abs() <= NEAR_RAD
        });
        let far = (last.point.point_mm - next.point.point_mm).norm();
        turned && far <= NEAR_SPACINGS * self.study.spacing_mm
    }

    /// High up, rotary axes, over the point, down.
    fn arrive(&mut self, above: &Command, high: Option<(usize, f64)>) -> Result<(), ProgramError> {
        let Some((z, top)) = high else { return self.rapid(above, |_| true) };
        self.lift(high)?;
        let axes = self.study.machine.axes();
        let rotary: Vec<bool> = axes.iter().map(|a| a.kind == AxisKind::Rotary).collect();
        let mut over = *above;
        over[z] = top;
        if rotary.contains(&true) {
            self.rapid(&over, |i| rotary[i])?;
        }
        self.rapid(&over, |i| i != z)?;
        self.rapid(above, |i| i == z)
    }

    fn lift(&mut self, high: Option<(usize, f64)>) -> Result<(), ProgramError> {
        let Some((z, top)) = high else { return Ok(()) };
        let mut up = Command::default();
        up[z] = top;
        self.rapid(&up, |i| i == z)
    }

    fn rapid(
        &mut self,
        command: &Command,
        named: impl Fn(usize) -> bool,
    ) -> Result<(), ProgramError> {
        let target = axis_target(&self.study.machine, self.control, command, named);
        Ok(self.writer.write(&Block::Rapid(target))?)
    }

    fn line(&mut self, command: &Command) -> Result<(), ProgramError> {
        let target = axis_target(&self.study.machine, self.control, command, |_| true);
        let feed = Feed { mode: FeedMode::PerMinute, value: self.study.feed_mm_per_min };
        Ok(self.writer.write(&Block::Line(target, feed))?)
    }
}

/// Runs the program on the machine with the probe, and the part if there is one.
///
/// The probe begins at the centre of its ball: that the ball touches is what it is for.
pub fn check_surface(
    study: &SurfaceStudy,
    poses: &[Pose],
    text: &[u8],
    control: Control,
) -> ProgramCheck {
    let shape = match study.shape.is_empty() {
        true => probe_shape(1.2 * study.ball_radius_mm, study.probe_length_mm),
        false => study.shape.clone(),
    };
    let tool = SetUpTool {
        name: "touch probe".to_owned(),
        tip_mm: Vec3::new(0.0, 0.0, -study.probe_length_mm),
        shape,
        ..SetUpTool::default()
    };
    let part = study.part.clone().map(|mesh| BodyModel {
        name: "part".to_owned(),
        node: Some(0),
        placement: Link::identity(),
        role: Role::Fixture,
        mesh,
    });
    let setup = SetUp {
        given: true,
        files: study.files.clone(),
        tools: [(study.tool, tool)].into_iter().collect(),
        bodies: part.into_iter().collect(),
        start: start(study, poses),
        ..SetUp::default()
    };
    // Words that no interpreter has are read back as the motions that stand for them.
    let stand_in = (control == Control::Heidenhain).then(|| written(study, poses, control, true));
    let text = stand_in.and_then(Result::ok).unwrap_or_else(|| text.to_vec());
    let program = Program::new(&study.name, text, control);
    run(&study.machine, &study.machine_path, &setup, &program, &[])
}

/// Where the machine stands before: high, all other axes at 0.
fn start(study: &SurfaceStudy, poses: &[Pose]) -> Option<Position> {
    let (z, top) = high(study, poses)?;
    let mut at = Position::default();
    for (i, axis) in study.machine.axes().iter().enumerate() {
        let letter = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == axis.name.letter());
        let (Some(letter), Travel::Between(from, to)) = (letter, axis.travel) else { continue };
        at[letter] = if i == z { top } else { 0f64.clamp(from.min(to), to.max(from)) };
        if axis.kind == AxisKind::Rotary {
            at[letter] = at[letter].to_degrees();
        }
    }
    at[Axis::Z] = top;
    Some(at)
}
