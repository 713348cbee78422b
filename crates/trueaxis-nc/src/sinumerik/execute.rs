//! Executes the words of a block: modes, tool, spindle, frames, then the move.

use super::radius::AS_SWITCHED_ON;
use super::tables::{Angles, Code, ContourRule, Motion, Name, OrientationMode};
use super::words::Words;
use super::{Language, Next, Run, transform};
use crate::execution::radius::Behaviour;
use crate::execution::{Modes as CommonModes, Settings, mistakes};
use crate::moves::{
    Axis, CompensationSide, Cone, Coolant, Event, MoveKind, OrientationPath, PathControl, Position,
    SpindleDirection,
};
use crate::text::program::Fault;

/// What lasts from block to block.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    /// Feeds count in inches as well (G700).
    pub feed_inches: bool,
    pub motion: Motion,
    /// D.
    pub edge: u32,
    pub path: (PathControl, f64),
    pub angles: Angles,
    /// Group 51 as it was written last.
    pub turns: Option<OrientationMode>,
    /// The last reported mode; cones are reported move by move.
    pub cone: Option<OrientationMode>,
    /// Words of a cone that wait for a move.
    pub next_cone: Cone,
    /// The pole of polar coordinates, in the program frame.
    pub pole: Position,
    pub polar: (f64, f64),
    /// Where the last move on the path went at its end.
    pub tangent: Option<[f64; 3]>,
    /// RNDM and FRCM, mm and mm/min; 0 is none.
    pub corners: [f64; 2],
    /// How the contour is followed with radius compensation.
    pub behaviour: Behaviour,
    pub side: CompensationSide,
}

impl Modes {
    pub fn new(settings: &Settings) -> Self {
        Self {
            feed_inches: settings.inches,
            motion: Motion::Linear,
            edge: 1,
            path: (PathControl::ExactStop, 0.0),
            angles: Angles::Euler,
            turns: None,
            cone: None,
            next_cone: Cone::default(),
            pole: Position::default(),
            polar: (0.0, 0.0),
            tangent: None,
            corners: [0.0; 2],
            behaviour: AS_SWITCHED_ON,
            side: CompensationSide::Off,
        }
    }
}

impl Run<'_> {
    /// Executes the gathered words.
    pub(super) fn perform(&mut self) -> Result<Next, Fault> {
        // Two boxes change places: the words themselves are large.
        let spare = self.spare.take().unwrap_or_default();
        let mut words = std::mem::replace(&mut self.words, spare);
        let result = self.perform_words(&mut words);
        self.spare = Some(words);
        result
    }

    fn perform_words(&mut self, words: &mut Words) -> Result<Next, Fault> {
        if words.codes.len() > 1 {
            words.codes.sort_by_key(|(code, _)| code.rank());
            check_groups(words)?;
        }
        let codes = std::mem::take(&mut words.codes);
        let early = codes.iter().take_while(|(c, _)| c.rank() <= 1).count();
        for (code, at) in &codes[..early] {
            self.act(*code, words, *at)?;
        }
        let dwells = codes.iter().any(|(c, _)| *c == Code::Dwell);
        if !dwells {
            self.feed_and_speed(words)?;
        }
        self.tool_words(words)?;
        if !words.m.is_empty() {
            self.m_functions(words)?;
        }
        let before = self.modes.motion;
        let (taken, machine) = self.later_codes(&codes[early..], words)?;
        let exact = codes.iter().any(|(c, _)| *c == Code::ExactOnce);
        let ends = words.m.iter().find(|(m, _)| matches!(m, 0 | 1 | 2 | 17 | 30)).copied();
        if let Some((_, at)) = words.numbered.first().filter(|_| !taken) {
            return Err(mistakes::unknown_axis(*at));
        }
        let first = codes.first().map_or(self.core.start, |(_, at)| *at);
        words.codes = codes;
        self.other_words(words);
        let mut moved = false;
        if !taken {
            moved = self.motion(words, machine, first)?;
        }
        if self.modes.motion == Motion::FreeTap {
            self.modes.motion = if before == Motion::FreeTap { Motion::Linear } else { before };
        }
        if exact {
            let (control, tolerance_mm) = self.modes.path;
            self.core.emit(Event::Path { control, tolerance_mm });
        }
        self.report_unused(words);
        if let Some((name, at)) = self.core.own_call.take() {
            return self.call(&name, Vec::new(), 1, at);
        }
        // What the called program moves does not call it again.
        let depth = self.stack.len();
        if moved && ends.is_none() && self.modal_call.as_ref().is_some_and(|c| depth <= c.depth) {
            return self.modal(first);
        }
        match ends {
            Some((m, _)) => self.end_function(m),
            None => Ok(Next::Following),
        }
    }

    /// Executes the codes after feed and tool: whether one took the words of the axes, and whether
    /// these count from the machine zero.
    fn later_codes(
        &mut self,
        codes: &[(Code, usize)],
        words: &mut Words,
    ) -> Result<(bool, bool), Fault> {
        let (mut taken, mut machine) = (false, false);
        for (code, at) in codes {
            match code {
                Code::Motion(motion) => self.modes.motion = *motion,
                Code::Machine => machine = true,
                _ => {
                    taken |= code.takes_axes();
                    self.act(*code, words, *at)?;
                }
            }
        }
        Ok((taken, machine))
    }

    /// The call that MCALL left for each block with a move.
    fn modal(&mut self, at: usize) -> Result<Next, Fault> {
        let Some(call) = self.modal_call.clone() else { return Ok(Next::Following) };
        self.call(&call.name, call.arguments, 1, at)
    }

    fn end_function(&mut self, m: u32) -> Result<Next, Fault> {
        match m {
            0 | 1 => {
                self.core.emit(Event::Stop { optional: m == 1 });
                Ok(Next::Following)
            }
            // M17, M2 and M30 end a subprogram alike.
            _ => self.return_from(1),
        }
    }

    fn feed_and_speed(&mut self, words: &mut Words) -> Result<(), Fault> {
        let feed = words.feed.take();
        if let Some((wrong, at)) = feed.filter(|(feed, _)| !(0.0..1e12).contains(feed)) {
            return Err(mistakes::negative_feed(wrong, at));
        }
        let unit_mm = if self.modes.feed_inches { 25.4 } else { 1.0 };
        self.core.modes.set_feed(feed.map(|(feed, _)| feed), unit_mm);
        self.core.set_speed(words.speed.take());
        Ok(())
    }

    fn m_functions(&mut self, words: &Words) -> Result<(), Fault> {
        for (m, at) in &words.m {
            match m {
                0 | 1 | 2 | 17 | 30 => {}
                3 => self.core.turn_spindle(SpindleDirection::Clockwise),
                4 => self.core.turn_spindle(SpindleDirection::CounterClockwise),
                5 => self.core.turn_spindle(SpindleDirection::Stopped),
                6 => self.change_tool(words.edge.map(|(edge, _)| edge), *at),
                7 => self.core.emit(Event::Coolant(Coolant::Mist)),
                8 => self.core.emit(Event::Coolant(Coolant::Flood)),
                9 => self.core.emit(Event::Coolant(Coolant::Off)),
                19 => self.core.emit(Event::SpindleOrient { angle_deg: 0.0 }),
                40..=45 => self.core.emit(Event::Note("a gear stage of the spindle")),
                70 => self.core.emit(Event::Note("M70 spindle as an axis")),
                _ => {
                    self.core.unknown_m_code(f64::from(*m), *at);
                }
            }
        }
        Ok(())
    }

    /// Named words that are no part of a move.
    fn other_words(&mut self, words: &mut Words) {
        if words.named.is_empty() {
            return;
        }
        if let Some((angle, ..)) = words.take(Name::SpindlePlace) {
            self.core.emit(Event::SpindleOrient { angle_deg: angle });
        }
        if let Some((tolerance, ..)) = words.take(Name::Tolerance) {
            let control = match self.modes.path.0 {
                PathControl::ExactStop => PathControl::Continuous,
                other => other,
            };
            self.report_path(control, tolerance * self.core.modes.unit_mm());
        }
        let mut noted = Vec::new();
        words.named.retain(|(name, ..)| match name {
            Name::Noted(text) => {
                noted.push(*text);
                false
            }
            _ => true,
        });
        for text in noted {
            self.core.emit(Event::Note(text));
        }
    }

    pub(super) fn report_path(&mut self, control: PathControl, tolerance_mm: f64) {
        self.modes.path = (control, tolerance_mm);
        self.core.emit(Event::Path { control, tolerance_mm });
    }

    fn act(&mut self, code: Code, words: &mut Words, at: usize) -> Result<(), Fault> {
        self.settle();
        match code {
            Code::Plane(plane) => {
                self.core.select_plane(plane);
                self.apply_length(at);
            }
            Code::Inches { inches, feed } => {
                self.core.modes.inches = inches;
                if feed {
                    self.modes.feed_inches = inches;
                }
            }
            Code::Incremental(incremental) => self.core.modes.incremental = incremental,
            Code::Diameter(diameter) => self.core.modes.diameter = diameter,
            Code::Feed(mode) => self.core.modes.change_feed_mode(mode),
            Code::SurfaceSpeed(on, mode) => {
                self.core.modes.change_feed_mode(mode);
                self.core.surface_speed(on);
            }
            Code::Offset(number) => self.select_offset(number, at)?,
            Code::Frame(word) => self.program_frame(word, words, at)?,
            Code::Shift { fine } => self.shift_frame(fine, words, at)?,
            Code::ToolCentre(on) => {
                self.core.tool_centre(on);
            }
            Code::AlongTool(on) => self.frame_along_tool(on, at)?,
            Code::Angles(angles) => self.modes.angles = angles,
            Code::Orientation(way) => self.turn_by(way),
            Code::Compensation(side) => self.compensation(side, at),
            Code::Contour(rule) => self.contour_rule(rule, at),
            Code::Path(control, with_distance) => {
                let distance = if with_distance { words.take(Name::Tolerance) } else { None };
                self.report_path(
                    control,
                    distance.map_or(0.0, |(d, ..)| d * self.core.modes.unit_mm()),
                );
            }
            Code::ExactOnce => {
                self.core.emit(Event::Path { control: PathControl::ExactStop, tolerance_mm: 0.0 });
            }
            Code::Dwell => self.dwell(words, at)?,
            Code::Pole(kind) => self.set_pole(kind, words),
            Code::Reference => self.reference(words, at),
            Code::Limits => self.core.emit(Event::Note("G25, G26 limits of the working area")),
            Code::Note(name) => self.core.emit(Event::Note(name)),
            Code::NotApplied(name) => {
                self.core.not_applied(name, at, "the following moves are computed without it");
            }
            Code::Motion(_) | Code::Machine | Code::Own => {}
        }
        Ok(())
    }

    fn select_offset(&mut self, number: u32, at: usize) -> Result<(), Fault> {
        if number > 0 && !self.chain.offsets.contains_key(&number) {
            let code = if number < 5 { 53 + number } else { 500 + number };
            self.core.unknown_offset(number, format_args!("G{code}"), at);
        }
        let frame = self.chain.offset(number);
        if !self.chain.change(|c| c.settable = frame) {
            return Err(mistakes::flat_frame(at));
        }
        self.chain.active = number;
        self.emit_offset();
        self.emit_frame();
        Ok(())
    }

    /// TRANS, AROT …: the frame of the block's words; without words the frame is gone.
    fn program_frame(
        &mut self,
        word: &'static str,
        words: &mut Words,
        at: usize,
    ) -> Result<(), Fault> {
        let additive = word.starts_with('A');
        let plain = word.trim_start_matches('A');
        let scaled = |axis: Axis, modes: &CommonModes| match plain {
            "TRANS" if axis.is_rotary() => 1.0,
            "TRANS" => modes.unit_mm(),
            _ => 1.0,
        };
        let mut entries = Vec::new();
        for axis in Axis::ALL {
            if words.axes.contains(axis) {
                let index = axis as usize;
                entries.push((axis, words.values[index] * scaled(axis, &self.core.modes)));
            }
        }
        let mut frame = transform::from_entries(plain, &entries, at)?;
        if let Some((angle, ..)) = words.take(Name::PlaneAngle) {
            frame = transform::turned(self.core.modes.plane.axes()[2], angle);
        }
        let kept = self.chain.change(|c| {
            c.programmable = if additive { c.programmable.after(&frame) } else { frame };
            if !additive {
                c.fine = Position::default();
            }
        });
        if !kept {
            return Err(mistakes::flat_frame(at));
        }
        self.emit_frame();
        Ok(())
    }

    /// G58 replaces the shift of the named axes, G59 its fine part.
    fn shift_frame(&mut self, fine: bool, words: &Words, at: usize) -> Result<(), Fault> {
        let unit = self.core.modes.unit_mm();
        let kept = self.chain.change(|c| {
            for axis in Axis::ALL {
                if words.axes.contains(axis) {
                    let scale = if axis.is_rotary() { 1.0 } else { unit };
                    let value = words.values[axis as usize] * scale;
                    if fine {
                        c.programmable.shift[axis] += value - c.fine[axis];
                        c.fine[axis] = value;
                    } else {
                        c.programmable.shift[axis] = value + c.fine[axis];
                    }
                }
            }
        });
        if !kept {
            return Err(mistakes::flat_frame(at));
        }
        self.emit_frame();
        Ok(())
    }

    fn dwell(&mut self, words: &mut Words, at: usize) -> Result<(), Fault> {
        let turns = words.speed.take().map(|turns| (turns, self.core.modes.speed));
        let seconds = match (words.feed.take(), turns) {
            (Some((seconds, _)), _) => seconds,
            (None, Some((turns, speed))) if speed > 0.0 => turns * 60.0 / speed,
            (None, Some(_)) => {
                let message =
                    "the dwell is stated in revolutions, but the spindle has no speed".to_owned();
                self.core.warn(
                    "dwell-without-speed",
                    "",
                    at,
                    message,
                    "write S in a previous block",
                );
                0.0
            }
            _ => -1.0,
        };
        if !(0.0..1e12).contains(&seconds) {
            return Err(mistakes::bad_dwell(at));
        }
        self.step(MoveKind::Dwell { seconds }, self.chain.position, words);
        Ok(())
    }

    /// G110, G111, G112: the pole of polar coordinates.
    fn set_pole(&mut self, kind: u8, words: &mut Words) {
        let base = match kind {
            0 => self.chain.position,
            1 => Position::default(),
            _ => self.modes.pole,
        };
        let mut pole = base;
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            if words.axes.contains(axis) {
                pole[axis] = base[axis] + words.values[axis as usize] * self.core.modes.scale(axis);
            }
        }
        if let Some((radius, ..)) = words.take(Name::PolarRadius) {
            let (angle, ..) = words.take(Name::PolarAngle).unwrap_or_default();
            let [first, second, _] = self.core.modes.plane.axes();
            let (sin, cos) = angle.to_radians().sin_cos();
            let radius = radius * self.core.modes.unit_mm();
            pole[first] = base[first] + radius * cos;
            pole[second] = base[second] + radius * sin;
        }
        self.modes.pole = pole;
    }

    fn turn_by(&mut self, way: OrientationMode) {
        self.modes.cone = None;
        self.modes.next_cone = Cone::default();
        let path = match way {
            OrientationMode::Axes | OrientationMode::Machine => OrientationPath::Axes,
            OrientationMode::Vector => OrientationPath::GreatCircle,
            // Without a word of group 51, ORIWKS means the great circle.
            OrientationMode::Workpiece => match self.modes.turns {
                Some(OrientationMode::Axes) => OrientationPath::Axes,
                _ => OrientationPath::GreatCircle,
            },
            _ => {
                self.modes.cone = Some(way);
                self.modes.turns = Some(way);
                return;
            }
        };
        if !matches!(way, OrientationMode::Machine | OrientationMode::Workpiece) {
            self.modes.turns = Some(way);
        }
        self.core.emit(Event::Orientation(path));
    }

    /// SAVE: the modes are back as they were at the call.
    pub(super) fn restore(&mut self, saved: (CommonModes, Modes)) {
        let now = std::mem::replace(&mut self.core.modes, saved.0);
        let own = std::mem::replace(&mut self.modes, saved.1);
        let modes = &mut self.core.modes;
        (modes.tool, modes.selected) = (now.tool, now.selected);
        (modes.speed, modes.turning) = (now.speed, now.turning);
        (self.modes.edge, self.modes.tangent) = (own.edge, own.tangent);
        if now.plane != self.core.modes.plane {
            self.core.emit(Event::Plane(self.core.modes.plane));
        }
        if own.path != self.modes.path {
            let (control, tolerance_mm) = self.modes.path;
            self.core.emit(Event::Path { control, tolerance_mm });
        }
        if now.tool_centre != self.core.modes.tool_centre {
            self.core.emit(Event::ToolCentre(self.core.modes.tool_centre));
        }
    }

    /// Warns of words that no code used.
    fn report_unused(&mut self, words: &Words) {
        let left = words.centers.iter().chain(&words.through).flatten().count();
        let at = self.core.start;
        if left > 0 {
            let message = "no code of this block uses I, J or K".to_owned();
            self.core.warn("unused-word", "IJK", at, message, "use them with circles and threads");
        }
        for (name, _, _, at) in &words.named {
            let message = format!("no code of this block uses the word {name:?}");
            let hint = "the word has no effect; further ones are not listed";
            self.core.warn("unused-word", format!("{name:?}"), *at, message, hint);
        }
    }
}

/// Two codes of one group cannot stand in one block.
fn check_groups(words: &Words) -> Result<(), Fault> {
    let group = |code: Code| match code {
        Code::Note(_) | Code::NotApplied(_) | Code::Machine | Code::ExactOnce | Code::Own => None,
        Code::Plane(_) => Some(1),
        Code::Inches { .. } => Some(2),
        Code::Incremental(_) => Some(3),
        Code::Diameter(_) => Some(4),
        Code::Feed(_) | Code::SurfaceSpeed(..) => Some(5),
        Code::Compensation(_) => Some(6),
        Code::Contour(ContourRule::OutsideOnArc | ContourRule::OutsideToMeeting) => Some(18),
        Code::Contour(ContourRule::Norm | ContourRule::Kont) => Some(19),
        Code::Contour(_) => Some(20),
        Code::Path(..) => Some(7),
        Code::Offset(_) => Some(8),
        Code::Frame(_) => Some(9),
        Code::Shift { .. } => Some(10),
        Code::ToolCentre(_) => Some(11),
        Code::AlongTool(_) => Some(17),
        Code::Angles(_) => Some(12),
        Code::Orientation(OrientationMode::Machine | OrientationMode::Workpiece) => Some(13),
        Code::Orientation(_) => Some(14),
        Code::Dwell | Code::Pole(_) | Code::Reference | Code::Limits => Some(15),
        Code::Motion(_) => Some(16),
    };
    mistakes::check_groups(&words.codes, group)
}
