//! What a program asks of spindle and magazine, against what the machine has.

use crate::axis_path::Fault;
use crate::place;
use std::collections::BTreeSet;
use trueaxis_input::Diagnostics;
use trueaxis_machine::equipment::Equipment;
use trueaxis_nc::moves::{Event, Origin, Step};
use trueaxis_nc::{Control, Program};

/// Kept of each kind; a program that goes on like this says nothing new.
const MOST: usize = 20;

/// The codes of what the machine does not have.
const CODES: [&str; 3] = ["spindle-speed", "no-magazine-place", "magazine-full"];

/// Whether a warning of this code means that the machine cannot do it.
pub(crate) fn is_beyond_equipment(code: &str) -> bool {
    CODES.contains(&code)
}

/// Watches the events of a program.
#[derive(Debug)]
pub(crate) struct EquipmentWatch {
    equipment: Equipment,
    /// The number after T is the number of a place of the magazine.
    tools_are_places: bool,
    /// S is a surface speed, m/min.
    surface_speed: bool,
    speed_per_minute: f64,
    tools: BTreeSet<u32>,
    seen: BTreeSet<(&'static str, u32, u32)>,
    faults: Vec<Fault>,
}

impl EquipmentWatch {
    /// Nothing was seen yet.
    pub fn new(equipment: &Equipment, control: Control) -> Self {
        Self {
            equipment: *equipment,
            // Without tool management; SINUMERIK, HEIDENHAIN and LinuxCNC find the place in their tool tables.
            tools_are_places: matches!(control, Control::Fanuc | Control::Haas),
            surface_speed: false,
            speed_per_minute: 0.0,
            tools: BTreeSet::new(),
            seen: BTreeSet::new(),
            faults: Vec::new(),
        }
    }

    /// The next step of the program.
    pub fn see(&mut self, step: &Step) {
        let Step::Event(event, origin) = step else { return };
        match event {
            Event::Note(name) if name.starts_with("G96 ") => self.surface_speed = true,
            Event::Note(name) if name.starts_with("G97 ") => self.surface_speed = false,
            Event::SpindleSpeed(per_minute) => self.see_speed(*per_minute, *origin),
            Event::ToolChange(tool) => self.see_tool(*tool, *origin),
            _ => {}
        }
    }

    fn see_speed(&mut self, per_minute: f64, origin: Origin) {
        if self.surface_speed || per_minute == self.speed_per_minute {
            return;
        }
        self.speed_per_minute = per_minute;
        let Some(limit) = self.equipment.speed_limit_passed(per_minute) else { return };
        let side = if per_minute.abs() > limit { "at most" } else { "at least" };
        let message = format!(
            "S {per_minute} 1/min: the spindle of this machine turns with {side} {limit:.0} 1/min"
        );
        let hint = "change S, or max_speed and min_speed in [spindle] of the machine file";
        self.note("spindle-speed", Some(b'S'), origin, message, hint);
    }

    fn see_tool(&mut self, tool: u32, origin: Origin) {
        let Some(places) = self.equipment.magazine_places else { return };
        if tool == 0 {
            return;
        }
        if self.tools_are_places && tool > places {
            let message = format!("tool {tool}: the magazine has {places} places");
            let hint = "the number after T is that of a place; change it, or [magazine] of the machine file";
            self.note("no-magazine-place", Some(b'T'), origin, message, hint);
        }
        if self.tools.insert(tool) && self.tools.len() == places as usize + 1 {
            let used = self.tools.len();
            let message = format!(
                "tool {tool}: with it the program uses {used} tools, the magazine has {places} places"
            );
            let hint = "someone has to change tools by hand, or the program has to be divided";
            self.note("magazine-full", Some(b'T'), origin, message, hint);
        }
    }

    fn note(
        &mut self,
        code: &'static str,
        word: Option<u8>,
        origin: Origin,
        message: String,
        hint: &'static str,
    ) {
        let is_new = self.seen.insert((code, origin.program, origin.line));
        if is_new && self.seen.iter().filter(|(known, ..)| *known == code).count() <= MOST {
            self.faults.push(Fault { origin, word, code, message, hint });
        }
    }

    /// What was found, as warnings with their places.
    pub fn tell_in(self, program: &Program, programs: &[String], problems: &mut Diagnostics) {
        for fault in self.faults {
            let place = place(program, programs, &fault);
            problems.warn(fault.code, place, fault.message, fault.hint);
        }
    }
}
