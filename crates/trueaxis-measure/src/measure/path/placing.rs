//! From places of the tool point on the workpiece to commands, whatever the machine.

use super::super::{Campaign, Instrument, Readings};
use super::touch::STAND_OFF_MM;
use crate::instruments::instrument::Sight;
use std::fmt;
use trueaxis_geometry::Vec3;
use trueaxis_input::Section;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, Travel};
use trueaxis_machine::errors::{BodyName, Component, ErrorKind, ErrorName};
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::twist::Reference;

/// More stations outside the travel are counted, not listed.
const MOST_REPORTED: usize = 3;

/// Puts the tool point of an instrument to a place while the rotary axes stand where they shall.
#[derive(Debug, Clone)]
pub struct Placing {
    control: TipControl,
    /// The ball or station, in the workpiece frame, mm.
    pub reference_point_mm: Vec3,
    /// How far the tool point stays from it: the length of a bar, radii of ball and stylus, mm.
    pub reach_mm: f64,
}

impl Placing {
    /// For an instrument on the workpiece; why not otherwise.
    ///
    /// # Errors
    /// An instrument on the floor, or a machine with fewer than three linear axes.
    pub fn of(machine: &Machine, instrument: &Instrument) -> Result<Self, &'static str> {
        if instrument.reference == Reference::Bed {
            return Err("the instrument stands on the floor: nothing on the workpiece is followed");
        }
        let machine = machine.clone().with_tip(instrument.tool_point_mm);
        let control =
            TipControl::of(&machine).ok_or("the machine has fewer than three linear axes")?;
        let reach_mm = if instrument.sight == Sight::Distance { instrument.length_mm } else { 0.0 };
        Ok(Self { control, reference_point_mm: instrument.reference_point_mm, reach_mm })
    }

    /// The same for a section of a campaign file.
    pub(crate) fn for_path(
        section: &Section<'_>,
        campaign: &Campaign,
        instrument: usize,
    ) -> Option<Self> {
        let placing = Self::of(&campaign.machine, &campaign.instruments[instrument]);
        let reported = |why: &str| {
            let hint = "kind = \"grid\", \"random\", \"targets\" or \"table\" name the axes";
            section.error("cannot-follow", format!("the tool cannot follow: {why}"), hint);
            // The other keys are of no use now.
            section.entries();
        };
        placing.map_err(reported).ok()
    }

    /// The command with the tool point at a place of the workpiece; `None` where the linear axes
    /// cannot bring it there.
    pub fn place(&self, point_mm: Vec3, rotary: &Command) -> Option<Command> {
        let mut command = *rotary;
        self.control.place(point_mm, &mut command).then_some(command)
    }

    /// With the tool point where the instrument reads its nominal value: on the ball, or a bar or
    /// the radii away from it in a direction of the workpiece.
    pub fn contact(&self, direction: Vec3, rotary: &Command) -> Option<Command> {
        self.place(self.reference_point_mm + direction * self.reach_mm, rotary)
    }

    /// Where the stylus goes before a hit: above the ball's height on that side, then next to it.
    pub fn beside(&self, side: Vec3, tool_axis: Vec3) -> [Vec3; 2] {
        let off = self.reach_mm + STAND_OFF_MM;
        let beside = self.reference_point_mm + side * off;
        let lift = (off - off * side.dot(&tool_axis)).max(0.0);
        [beside + tool_axis * lift, beside]
    }

    /// The tool axis on the workpiece, a unit vector.
    pub fn tool_axis(&self, rotary: &Command) -> Vec3 {
        self.control.tip_and_axis(rotary).1
    }

    /// The machine whose tip is the tool point.
    pub fn machine(&self) -> &Machine {
        self.control.machine()
    }
}

/// About which line of the workpiece an axis turns at a command: how a point moves per rad, and the
/// unit vector of the line.
pub fn turns_about(
    machine: &Machine,
    axis: usize,
    command: &Command,
    point_mm: Vec3,
) -> (Vec3, Vec3) {
    let frames = machine.error_frames(command, Reference::Workpiece);
    let axis = &machine.axes()[axis];
    let (mut moved, mut about) = (Vec3::zeros(), Vec3::zeros());
    for (component, share) in
        [Component::A, Component::B, Component::C].into_iter().zip(axis.direction.iter())
    {
        let name = ErrorName { body: axis.name, kind: ErrorKind::Location, component };
        let Some(index) = machine.error_index(name) else { continue };
        let twist = frames.twist(index);
        moved += (twist.shift_mm + twist.turn_rad.cross(&point_mm)) * *share;
        about += twist.turn_rad * *share;
    }
    (moved, about)
}

/// An axis beyond its travel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strayed {
    /// Its letter.
    pub axis: BodyName,
    /// Linear or rotary.
    pub kind: AxisKind,
    /// Where it would stand. Unit: mm or rad.
    pub position: f64,
    /// The ends of its travel, mm or rad.
    pub travel: (f64, f64),
}

impl fmt::Display for Strayed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (unit, by) = match self.kind {
            AxisKind::Linear => ("mm", 1.0),
            AxisKind::Rotary => ("deg", 1f64.to_degrees()),
        };
        let [q, from, to] = [self.position, self.travel.0, self.travel.1].map(|v| v * by);
        write!(f, "{} = {q:.3} {unit} is outside its travel {from:.3} … {to:.3} {unit}", self.axis)
    }
}

/// The first axis of a command that is beyond its travel.
pub fn leaves_travel(machine: &Machine, command: &Command) -> Option<Strayed> {
    machine.axes().iter().zip(command).find_map(|(axis, &q)| match axis.travel {
        Travel::Between(from, to) if !axis.travel.contains(q) => {
            Some(Strayed { axis: axis.name, kind: axis.kind, position: q, travel: (from, to) })
        }
        _ => None,
    })
}

/// Reports the stations that the machine cannot reach.
pub(crate) fn check_travel(
    section: &Section<'_>,
    name: &str,
    campaign: &Campaign,
    stations: &Readings,
) -> bool {
    let outside = stations.commands.iter().enumerate();
    let outside: Vec<(usize, Strayed)> = outside
        .filter_map(|(i, c)| leaves_travel(&campaign.machine, c).map(|strayed| (i, strayed)))
        .collect();
    for (i, strayed) in outside.iter().take(MOST_REPORTED) {
        let message = format!("path {name}, station {} of {}: {strayed}", i + 1, stations.len());
        let hint = "move the ball, shorten the path, or take another tool length";
        section.error("outside-travel", message, hint);
    }
    if outside.len() > MOST_REPORTED {
        let message = format!("path {name}: {} stations are outside in all", outside.len());
        section.error("outside-travel", message, "see above");
    }
    outside.is_empty()
}
