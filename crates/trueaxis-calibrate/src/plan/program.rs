//! The NC program of a path, and what the machine would do with it.
//!
//! ```text
//!     clear of everything ─ rotary axes and X, Y ─ above the first station ─ stations, each with a
//!     dwell, over an end to the next run ─ up ─ clear of everything
//! ```

mod check;

pub use check::{ProgramCheck, check};
pub(super) use check::{probe_shape, run};

use super::touch::{SURFACE_LOG, Touch, TouchLog, declare};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Dimension, Section};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::file::{read_direction, read_tool_shape};
use trueaxis_machine::models::ToolSegment;
use trueaxis_measure::measure::path::{Path, Placing, STAND_OFF_MM, before_station};
use trueaxis_measure::measure::{Campaign, Kind};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Axis, Feed, FeedMode, Position};
use trueaxis_writer::{Block, Heading, Target, ToolCall, WriteError, Writer, axis_coordinates};

/// How far a probe goes on beyond the nominal place of a hit, mm.
const OVERTRAVEL_MM: f64 = 1.0;
/// How fast a probe hits, mm/min.
const HIT_MM_PER_MIN: f64 = 100.0;

/// `[program]`: what stands there and how carefully it is approached.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramSettings {
    /// Diameter of the ball, mm.
    pub ball_diameter_mm: f64,
    /// Diameter of its stem, mm.
    pub stem_diameter_mm: f64,
    /// Length of the stem from the centre of the ball, mm.
    pub stem_length_mm: f64,
    /// From the ball towards its foot, a unit vector of the workpiece.
    pub stem: Vec3,
    /// The probe: its cylinders from the tool point upwards; empty: a slim one.
    pub probe: Vec<ToolSegment>,
    /// How far above the ball the tool comes and goes, mm.
    pub clearance_mm: f64,
    /// Between stations, mm/min (deg/min where only rotary axes move).
    pub feed_mm_per_min: f64,
    /// Whether the program stops for the operator before it begins.
    pub stops: bool,
}

impl Default for ProgramSettings {
    fn default() -> Self {
        Self {
            ball_diameter_mm: 25.0,
            stem_diameter_mm: 10.0,
            stem_length_mm: 50.0,
            stem: -Vec3::z(),
            probe: Vec::new(),
            clearance_mm: 30.0,
            feed_mm_per_min: 2000.0,
            stops: true,
        }
    }
}

pub(super) fn read_program_settings(section: &Section<'_>) -> Option<ProgramSettings> {
    let mut settings = ProgramSettings::default();
    let mut sound = true;
    let mut positive = |key: &str, dimension, value: &mut f64, scale: f64| {
        let Some(item) = section.get(key) else { return };
        match item.quantity(dimension) {
            Some(v) if v > 0.0 => *value = v * scale,
            Some(_) => {
                item.error("bad-size", format!("`{key}` must be more than 0"), "such as \"10 mm\"");
                sound = false;
            }
            None => sound = false,
        }
    };
    positive("ball_diameter", Dimension::Length, &mut settings.ball_diameter_mm, 1.0);
    positive("stem_diameter", Dimension::Length, &mut settings.stem_diameter_mm, 1.0);
    positive("stem_length", Dimension::Length, &mut settings.stem_length_mm, 1.0);
    positive("clearance", Dimension::Length, &mut settings.clearance_mm, 1.0);
    positive("feed", Dimension::Velocity, &mut settings.feed_mm_per_min, 60.0);
    if let Some(item) = section.get("stem") {
        settings.stem = read_direction(&item)?;
    }
    if let Some(item) = section.get("stop") {
        settings.stops = item.flag()?;
    }
    if section.get("shape").is_some() {
        settings.probe = read_tool_shape(section)?;
    }
    sound.then_some(settings)
}

/// Why a path has no program.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProgramError {
    /// The control has no word for it, or a number is too large.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Its probing cycles move X, Y and Z alone.
    #[error(
        "hits cannot be written for {0}: its probing cycles move X, Y and Z, and this machine touches by other axes; \
         choose another control, or take the table of poses"
    )]
    NoProbing(&'static str),
}

/// The program of a path in machine coordinates, without tool-centre point.
///
/// # Errors
/// [`ProgramError`].
pub fn program(
    campaign: &Campaign,
    path: &Path,
    settings: &ProgramSettings,
    control: Control,
) -> Result<Vec<u8>, ProgramError> {
    written(campaign, path, settings, (control, false))
}

/// The files that a program needs beside itself on the control.
pub fn program_files(campaign: &Campaign, control: Control) -> Vec<(String, String)> {
    TouchLog { machine: &campaign.machine, control, is_stand_in: false }.files()
}

/// The program, or what stands in for it where it is read back.
fn written(
    campaign: &Campaign,
    path: &Path,
    settings: &ProgramSettings,
    (control, is_stand_in): (Control, bool),
) -> Result<Vec<u8>, ProgramError> {
    let Some(instrument) = path.stations.instruments.first().map(|i| *i as usize) else {
        return Ok(Vec::new());
    };
    let own = &campaign.instruments[instrument];
    let hits = own.kind == Kind::TouchProbeBall;
    let name = path.name.clone();
    let about =
        format!("{} on {}, {} stations", own.name, campaign.machine.name(), path.stations.len());
    let log = TouchLog { machine: &campaign.machine, control, is_stand_in };
    let mut write = Written {
        writer: Writer::new(control),
        log,
        touches: 0,
        campaign,
        control,
        settings,
        placing: Placing::of(&campaign.machine, own).ok().filter(|_| own.kind.holds_a_ball()),
        high: clear_height(campaign, path, settings),
        aside: aside(&campaign.machine),
        turned: None,
    };
    let comments = [about.as_str()];
    let heading = Heading::of_measuring(&name, &comments);
    if let Some(text) = hits.then(|| declare(control)).flatten() {
        write.writer.write(&Block::Text(text))?;
    }
    write.writer.write(&Block::Start(&heading))?;
    let call = ToolCall { number: 1, text: own.kind.name(), ..ToolCall::default() };
    write.writer.write(&Block::Tool(&call))?;
    if hits {
        write.writer.write(&Block::Text(&SURFACE_LOG.open(control)))?;
    }
    if settings.stops {
        let text = format!("{} IN THE SPINDLE, ALL CLEAR", own.kind.name().to_uppercase());
        write.writer.write(&Block::Stop { optional: false, message: Some(&text) })?;
    }
    match hits {
        true => {
            write.hits(path)?;
            write.writer.write(&Block::Text(&SURFACE_LOG.close(control, write.touches)))?;
        }
        false => write.stations(path)?,
    }
    write.writer.write(&Block::End)?;
    Ok(write.writer.finish())
}

/// The axis that lifts the tool highest, and where it is clear of everything.
fn clear_height(
    campaign: &Campaign,
    path: &Path,
    settings: &ProgramSettings,
) -> Option<(usize, f64)> {
    let axes = campaign.machine.axes();
    let z = axes.iter().position(|a| a.kind == AxisKind::Linear && a.name.letter() == 'Z')?;
    let highest = path.stations.commands.iter().map(|c| c[z]).fold(f64::NEG_INFINITY, f64::max);
    let above = highest + settings.clearance_mm.max(50.0);
    Some((
        z,
        match axes[z].travel {
            Travel::Between(_, top) => top,
            _ => above,
        },
    ))
}

/// Where the machine stands before: clear of everything, all other axes at 0.
fn start(campaign: &Campaign, path: &Path, settings: &ProgramSettings) -> Option<Position> {
    let (z, high) = clear_height(campaign, path, settings)?;
    let mut at = Position::default();
    for (i, axis) in campaign.machine.axes().iter().enumerate() {
        let letter = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == axis.name.letter());
        let (Some(letter), Travel::Between(from, to)) = (letter, axis.travel) else { continue };
        at[letter] = if i == z { high } else { 0f64.clamp(from.min(to), to.max(from)) };
        if axis.kind == AxisKind::Rotary {
            at[letter] = at[letter].to_degrees();
        }
    }
    at[Axis::Z] = high;
    Some(at)
}

/// A program in the making.
struct Written<'a> {
    writer: Writer,
    log: TouchLog<'a>,
    /// Touches so far.
    touches: usize,
    campaign: &'a Campaign,
    control: Control,
    settings: &'a ProgramSettings,
    placing: Option<Placing>,
    high: Option<(usize, f64)>,
    /// The axis that takes the tool out of the way of what swings, and where to.
    aside: Option<(usize, f64)>,
    /// Where the rotary axes stood last.
    turned: Option<Vec<f64>>,
}

/// The longest linear axis across the lift, and the end of its travel.
fn aside(machine: &Machine) -> Option<(usize, f64)> {
    let ends = machine.axes().iter().enumerate().filter_map(|(i, axis)| match axis.travel {
        Travel::Between(from, to) if axis.kind == AxisKind::Linear && axis.name.letter() != 'Z' => {
            Some((i, to - from, to))
        }
        _ => None,
    });
    ends.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _, to)| (i, to))
}

impl Written<'_> {
    /// Every station at rest or through all of them at the feed of the path.
    fn stations(&mut self, path: &Path) -> Result<(), ProgramError> {
        let commands = &path.stations.commands;
        let (Some(first), Some(last)) = (commands.first(), commands.last()) else {
            return Ok(());
        };
        let feed = path.feed_mm_per_s.map_or(self.settings.feed_mm_per_min, |f| f * 60.0);
        let standing = path.feed_mm_per_s.is_none();
        let overrun = if standing { path.overrun } else { 0.0 };
        let machine = &self.campaign.machine;
        let before = |i| before_station(machine, &path.stations, i, overrun);
        self.arrive(&before(0).unwrap_or(*first))?;
        for (i, command) in commands.iter().enumerate() {
            if let Some(beyond) = before(i) {
                self.line(&beyond, feed)?;
            }
            self.line(command, feed)?;
            if standing && path.dwell_s > 0.0 {
                self.writer.write(&Block::Dwell(path.dwell_s))?;
            }
        }
        self.leave(last)
    }

    /// Every pose from above; every hit from its side.
    fn hits(&mut self, path: &Path) -> Result<(), ProgramError> {
        let Some(placing) = self.placing.clone() else { return Ok(()) };
        let stations = &path.stations;
        let ball = placing.reference_point_mm;
        let mut pose = None;
        for i in 0..stations.len() {
            let (command, side) = (&stations.commands[i], stations.directions[i]);
            let up = placing.tool_axis(command);
            if pose != Some(stations.groups[i]) {
                if i > 0 {
                    self.leave(&stations.commands[i - 1])?;
                }
                self.arrive(command)?;
                pose = Some(stations.groups[i]);
            }
            // Over the ball, to its side, down, hit, and back the same way.
            let [above, beside] = placing.beside(side, up);
            let feed = self.settings.feed_mm_per_min;
            self.to(&placing, above, command, feed)?;
            self.to(&placing, beside, command, feed)?;
            let beyond = ball + side * (placing.reach_mm - OVERTRAVEL_MM);
            let ends = placing.place(beside, command).zip(placing.place(beyond, command));
            if let Some((from, target)) = ends {
                self.hit([&from, &target], stations.groups[i] as usize + 1)?;
            }
            self.to(&placing, beside, command, feed)?;
            self.to(&placing, above, command, feed)?;
        }
        match stations.commands.last() {
            Some(last) => self.leave(last),
            None => Ok(()),
        }
    }

    fn to(
        &mut self,
        placing: &Placing,
        point_mm: Vec3,
        rotary: &Command,
        feed: f64,
    ) -> Result<(), ProgramError> {
        match placing.place(point_mm, rotary) {
            Some(command) => self.line(&command, feed),
            None => Ok(()),
        }
    }

    /// High up, aside while the rotary axes swing, over the station, down to above it.
    fn arrive(&mut self, station: &Command) -> Result<(), ProgramError> {
        let above = self.above(station);
        let axes = self.campaign.machine.axes().iter().enumerate();
        let rotary: Vec<usize> =
            axes.filter(|(_, a)| a.kind == AxisKind::Rotary).map(|(i, _)| i).collect();
        let turned: Vec<f64> = rotary.iter().map(|i| above[*i]).collect();
        if let Some((z, high)) = self.high {
            let mut up = above;
            up[z] = high;
            self.rapid_axes(&up, |i| i == z)?;
            if let Some((axis, end)) = self.aside.filter(|_| self.turned.as_ref() != Some(&turned))
            {
                let mut clear = up;
                clear[axis] = end;
                self.rapid_axes(&clear, |i| i == axis)?;
                self.rapid_axes(&clear, |i| rotary.contains(&i))?;
            }
            self.rapid_axes(&up, |_| true)?;
        }
        self.turned = Some(turned);
        self.rapid_axes(&above, |_| true)
    }

    fn leave(&mut self, station: &Command) -> Result<(), ProgramError> {
        let mut above = self.above(station);
        self.line(&above, self.settings.feed_mm_per_min)?;
        if let Some((z, high)) = self.high {
            above[z] = high;
            self.rapid_axes(&above, |i| i == z)?;
        }
        Ok(())
    }

    /// Along the tool axis away from the ball; the station itself where that leaves the travel.
    fn above(&self, station: &Command) -> Command {
        let Some(placing) = &self.placing else { return *station };
        let up = placing.tool_axis(station);
        let over =
            placing.reference_point_mm + up * (placing.reach_mm + self.settings.clearance_mm);
        let inside = |c: &Command| {
            trueaxis_measure::measure::path::leaves_travel(&self.campaign.machine, c).is_none()
        };
        let above = placing.place(over, station).filter(inside);
        let near = placing.reference_point_mm + up * (placing.reach_mm + 2.0 * STAND_OFF_MM);
        above.or_else(|| placing.place(near, station).filter(inside)).unwrap_or(*station)
    }

    fn target(&self, command: &Command, named: impl Fn(usize) -> bool) -> Target {
        axis_target(&self.campaign.machine, self.control, command, named)
    }

    fn rapid_axes(
        &mut self,
        command: &Command,
        named: impl Fn(usize) -> bool,
    ) -> Result<(), ProgramError> {
        let target = self.target(command, named);
        Ok(self.writer.write(&Block::Rapid(target))?)
    }

    fn line(&mut self, command: &Command, feed: f64) -> Result<(), ProgramError> {
        let target = self.target(command, |_| true);
        let feed = Feed { mode: FeedMode::PerMinute, value: feed };
        Ok(self.writer.write(&Block::Line(target, feed))?)
    }

    /// Towards a place until the probe triggers.
    fn hit(&mut self, [from, target]: [&Command; 2], pose: usize) -> Result<(), ProgramError> {
        self.touches += 1;
        let hit = self.touches;
        let touch = Touch { from, target, mm_per_min: HIT_MM_PER_MIN, hit, pose };
        let text = self.log.touch(&touch)?;
        Ok(self.writer.write(&Block::Text(&text))?)
    }
}

/// Axis positions as the words of a block; only the named axes.
pub(super) fn axis_target(
    machine: &Machine,
    control: Control,
    command: &Command,
    named: impl Fn(usize) -> bool,
) -> Target {
    let mut target = Target::default();
    for (i, axis) in machine.axes().iter().enumerate().filter(|(i, _)| named(*i)) {
        let rotary = axis.kind == AxisKind::Rotary;
        let letter = axis.name.letter();
        let found = Axis::ALL.into_iter().find(|a| char::from(a.letter()) == letter);
        let Some(found) = found else { continue };
        target = target.at(found, if rotary { command[i].to_degrees() } else { command[i] });
    }
    target.coordinates = axis_coordinates(control);
    target
}
