//! The words of a block with their values, and what lasts from block to block.

use super::cycles::CycleMemory;
use super::fanuc::dynamic_offset::DynamicOffset;
use super::fanuc::macros::ModalMacro;
use super::fanuc::transforms::Transforms;
use super::linuxcnc::polar::{self, PolarWord};
use super::linuxcnc::splines::SplineMemory;
use super::{Passage, Run};
use crate::execution::Settings;
use crate::execution::mistakes;
use crate::execution::values::LARGEST;
use crate::moves::{Axis, AxisSet, CompensationSide, Origin, PathControl, Position};
use crate::rs274::code::{Action, Motion};
use crate::text::program::{Fault, Item, Program};

/// What to do about a comment in a comment.
const LOOSE_END: &str =
    "a comment ends at its first `)`, and what follows is executed; take out the inner brackets";

/// One bit for each letter that names an axis.
const AXIS_BITS: u32 = {
    let (mut bits, mut index) = (0, 0);
    while index < Axis::ALL.len() {
        bits |= 1 << (b"XYZABCUVW"[index] - b'A');
        index += 1;
    }
    bits
};

/// What lasts from block to block.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    pub arc_absolute: bool,
    pub retract_to_r: bool,
    pub motion: Option<Motion>,
    /// The motion before drilling cycles.
    pub base: Motion,
    pub cycle: CycleMemory,
    /// G43.5: I J K of a line are a tool direction.
    pub vectors: bool,
    /// The G code of the tool length that is on, 49 if none is.
    pub length_code: f64,
    /// The number of that length: H.
    pub length_number: Option<u32>,
    /// How far the tool length has changed since an axis moved, and where (FANUC): added to an incremental word of the
    /// same block.
    pub length_due: Position,
    pub length_due_in: Origin,
    pub compensation: CompensationSide,
    pub path: PathControl,
    /// P of G64, mm.
    pub path_tolerance_mm: f64,
    pub transforms: Transforms,
    pub dynamic: DynamicOffset,
    pub spline: SplineMemory,
    /// Where G28 or G30 came through last.
    pub via: Option<Position>,
    /// G10 L50 is active: blocks are data until G11.
    pub data_input: bool,
    /// G66 and G66.1, the innermost last.
    pub macros: Vec<ModalMacro>,
    /// The block just executed moved: a modal macro is due.
    pub moved: bool,
    /// The place of the last probing move.
    pub skip: Position,
    /// The last M, N, D and O for #4113 …
    pub last: [f64; 4],
}

impl Modes {
    pub fn new(settings: &Settings, rapid_at_first: bool) -> Self {
        Self {
            arc_absolute: settings.absolute_centers,
            // FANUC begins with G98, LinuxCNC with G99.
            retract_to_r: !rapid_at_first,
            motion: rapid_at_first.then_some(Motion::Rapid),
            base: Motion::Rapid,
            cycle: CycleMemory::default(),
            vectors: false,
            length_code: 49.0,
            length_number: None,
            length_due: Position::default(),
            length_due_in: Origin::default(),
            compensation: CompensationSide::Off,
            path: PathControl::Continuous,
            path_tolerance_mm: 0.0,
            transforms: Transforms::default(),
            dynamic: DynamicOffset::default(),
            spline: SplineMemory::default(),
            via: None,
            data_input: false,
            macros: Vec::new(),
            moved: false,
            skip: Position::default(),
            last: [0.0; 4],
        }
    }
}

/// The words of one block with their values.
#[derive(Debug, Clone, Default)]
pub(super) struct Words {
    values: [f64; 26],
    places: [usize; 26],
    /// One bit for each letter.
    present: u32,
    used: u32,
    /// G and M codes in the order of execution.
    pub actions: Vec<(Action, usize)>,
    /// `@` and `^` of LinuxCNC.
    pub polar: [PolarWord; 2],
    /// `,C` or `,R` (`true`) with its size in the units of the program, and its place.
    pub corner: Option<(bool, f64, usize)>,
    /// The arguments of a macro call, in the order of the block.
    pub arguments: Vec<(u8, f64)>,
}

impl Words {
    pub fn clear(&mut self) {
        (self.present, self.used, self.polar) = (0, 0, [None; 2]);
        self.corner = None;
        self.actions.clear();
        self.arguments.clear();
    }

    /// The value of a word; it counts as used.
    pub fn take(&mut self, letter: u8) -> Option<f64> {
        let index = usize::from(letter - b'A');
        if self.present & (1 << index) == 0 {
            return None;
        }
        self.used |= 1 << index;
        Some(self.values[index])
    }

    /// Takes a word that is no axis here: nothing moves by it afterwards (X of a dwell).
    pub fn take_away(&mut self, letter: u8) -> Option<f64> {
        let value = self.take(letter);
        self.present &= !(1 << usize::from(letter - b'A'));
        value
    }

    /// The value of a word, without using it.
    pub fn look(&self, letter: u8) -> Option<f64> {
        let index = usize::from(letter - b'A');
        (self.present & (1 << index) != 0).then_some(self.values[index])
    }

    pub fn place(&self, letter: u8) -> usize {
        self.places[usize::from(letter - b'A')]
    }

    pub fn has_axis(&self) -> bool {
        self.present & AXIS_BITS != 0 || self.polar != [None; 2]
    }

    /// The axes that the block names.
    pub fn axes(&self) -> AxisSet {
        let bit = |letter: u8| (self.present >> (letter - b'A') & 1) as u16;
        let letters = b"XYZABCUVW".iter().enumerate();
        AxisSet(letters.fold(0, |set, (i, letter)| set | bit(*letter) << i))
    }

    pub fn put(&mut self, letter: u8, value: f64, offset: usize) -> Result<(), Fault> {
        let index = usize::from(letter - b'A');
        if self.present & (1 << index) != 0 {
            return Err(mistakes::repeated_word(char::from(letter), offset));
        }
        if value.abs() > LARGEST {
            return Err(mistakes::too_large(value, char::from(letter), offset));
        }
        self.present |= 1 << index;
        (self.values[index], self.places[index]) = (value, offset);
        Ok(())
    }

    /// The letters that nothing used, with their places.
    pub fn unused(&self) -> impl Iterator<Item = (u8, usize)> + '_ {
        let left = self.present & !self.used;
        (0..26_u8)
            .filter(move |i| left & (1 << i) != 0)
            .map(|i| (b'A' + i, self.places[i as usize]))
    }

    /// The words that belong to a noted code: none of the axes.
    pub fn take_parameters(&mut self) {
        for letter in *b"PQRLDEH" {
            self.take(letter);
        }
    }

    /// Every letter that is there, used or not, with its value; all count as used.
    pub fn take_all(&mut self) -> Vec<(u8, f64)> {
        self.used = self.present;
        (b'A'..=b'Z').filter_map(|l| self.look(l).map(|v| (l, v))).collect()
    }
}

impl Run<'_> {
    /// Evaluates the words of a block and sorts its codes into the order of execution.
    pub(super) fn gather(&mut self, passage: Passage<'_>, items: &[Item]) -> Result<(), Fault> {
        let mut words = std::mem::take(&mut self.words);
        words.clear();
        let result = self.gather_into(passage, items, &mut words);
        words.actions.sort_by_key(|(action, _)| action.rank());
        self.words = words;
        result
    }

    fn gather_into(
        &mut self,
        passage: Passage<'_>,
        items: &[Item],
        words: &mut Words,
    ) -> Result<(), Fault> {
        let gathering = self.gathering(passage, items);
        for item in items {
            if let Item::LooseEnd(at) = item {
                let message = "a `)` without its `(`: it is passed over";
                self.core.warn("loose-comment-end", 0, *at, message, LOOSE_END);
            }
            let Item::Word { letter, value, offset } = item else { continue };
            let value = self.value(passage, *value)?;
            match letter {
                _ if value.is_nan() => {}
                b'@' => polar::put(&mut words.polar[0], '@', value, *offset)?,
                b'^' => polar::put(&mut words.polar[1], '^', value, *offset)?,
                // Which spindle turns does not move the tool.
                b'$' => {}
                _ if gathering.is_argument(*letter) => {
                    words.arguments.push((*letter, value * self.argument_unit(*letter, *offset)));
                }
                b'c' | b'r' => words.corner = Some((*letter == b'r', value, *offset)),
                b'N' => self.modes.last[1] = value,
                b'G' if self.core.own_number('G', value, *offset) => {
                    words.actions.push((Action::NoteWhole("a code of the set-up file"), *offset));
                }
                b'M' if self.core.own_number('M', value, *offset) => {
                    words.actions.push((Action::Note("a code of the set-up file"), *offset));
                }
                b'G' => {
                    let action = self.g_code(passage.program, value, *offset)?;
                    words.actions.push((action, *offset));
                }
                b'M' => {
                    self.modes.last[0] = value;
                    let known = whole(value).and_then(|n| passage.program.dialect().m_code(n));
                    let Some(action) = known else {
                        self.core.unknown_m_code(value, *offset);
                        continue;
                    };
                    words.actions.push((action, *offset));
                }
                _ => words.put(*letter, value, *offset)?,
            }
        }
        // G80 beside another motion is that motion.
        let cancelled = Action::Motion(Motion::Cancelled);
        if words.actions.iter().any(|(a, _)| matches!(a, Action::Motion(_)) && *a != cancelled) {
            words.actions.retain(|(a, _)| *a != cancelled);
        }
        if self.is_fanuc() && !self.is_haas() {
            self.keep_last_codes(&mut words.actions);
        }
        check_groups(words)
    }

    /// Of two codes of one modal group the last holds on FANUC.
    ///
    /// # Source
    /// FANUC Series 16i operator's manual, "Preparatory function": of several G codes of one group in a block only the last
    /// is valid. Haas Automation, "Mill Operator's Manual": they are not allowed.
    fn keep_last_codes(&mut self, actions: &mut Vec<(Action, usize)>) {
        use Action as A;
        use Motion::{ArcClockwise, ArcCounterClockwise, Linear, Rapid, Thread};
        let moves = |m| matches!(m, Rapid | Linear | ArcClockwise | ArcCounterClockwise | Thread);
        let group = |a: A| match a {
            A::Motion(motion) if !moves(motion) => None,
            A::Motion(_) | A::Plane(_) | A::Incremental(_) | A::Inches(_) | A::Feed(_) => {
                Some(a.rank())
            }
            A::Compensation(_) | A::WorkOffset(_) | A::RetractToR(_) => Some(a.rank()),
            _ => None,
        };
        let mut index = 0;
        while let Some(&(action, at)) = actions.get(index) {
            let replaces = |a: A| a != action && group(a) == group(action);
            let known = group(action).is_some();
            if known && actions[index + 1..].iter().any(|(a, _)| replaces(*a)) {
                let message = "two codes of one group are in this block: the last one holds";
                let (line, hint) = (self.core.origin.line, "write the last one alone");
                self.core.warn("conflicting-codes", line, at, message, hint);
                actions.remove(index);
            } else {
                index += 1;
            }
        }
    }

    fn g_code(&mut self, program: &Program, value: f64, offset: usize) -> Result<Action, Fault> {
        whole(value * 10.0)
            .and_then(|tenths| program.dialect().g_code(tenths))
            .ok_or_else(|| mistakes::unknown_g_code(value, offset))
    }

    /// Reports what no code of the block used.
    pub(super) fn report_unused(&mut self) -> Result<(), Fault> {
        self.no_polar_words_left()?;
        let left: Vec<_> = self.words.unused().collect();
        for (letter, offset) in left {
            let name = char::from(letter);
            if letter == b'E' && self.extrudes() {
                self.core.emit(crate::moves::Event::Note("E, the extruder of a printer"));
                continue;
            }
            if letter == b'E' || letter == b'O' {
                if self.core.is_new("unknown-word", u32::from(letter)) {
                    return Err(mistakes::unknown_word(name, offset));
                }
                continue;
            }
            let message = format!("no code of this block uses the word {name}");
            let hint = "the word has no effect; further ones are not listed";
            self.core.warn("unused-word", u32::from(letter), offset, message, hint);
        }
        Ok(())
    }

    /// Whether E is the filament of a printer, an axis without motion of the tool: a word of G0 to G3 and G92.
    fn extrudes(&self) -> bool {
        let moves = |m: Motion| {
            use Motion::{ArcClockwise, ArcCounterClockwise, Linear, Rapid};
            matches!(m, Rapid | Linear | ArcClockwise | ArcCounterClockwise)
        };
        match &self.words.actions[..] {
            [] => self.modes.motion.is_some_and(moves),
            all => all.iter().all(|(a, _)| match a {
                Action::Motion(motion) => moves(*motion),
                other => matches!(other, Action::Shift | Action::Incremental(_)),
            }),
        }
    }

    /// A length word in mm.
    pub(super) fn length(&mut self, letter: u8) -> Option<f64> {
        let unit = self.core.modes.unit_mm();
        self.words.take(letter).map(|v| v * unit)
    }

    /// An axis word in mm or degrees.
    pub(super) fn axis_word(&mut self, axis: Axis) -> Option<f64> {
        let value = self.words.take(axis.letter())?;
        let scale = self.core.modes.scale(axis);
        Some(value * scale)
    }

    /// Where the axis words lead, by G90 or G91, in polar coordinates if they are on.
    pub(super) fn target(&mut self) -> Position {
        let polar = self.polar_place();
        let [a, b, _] = self.core.modes.plane.axes();
        let (mut target, incremental) = (self.frames.position, self.core.modes.incremental);
        if let Some(place) = polar {
            // Their words are used up.
            (target[a], target[b]) = (place[0], place[1]);
            let rest = Axis::ALL.into_iter().filter(|axis| *axis != a && *axis != b);
            return self.by_words(target, rest, incremental);
        }
        if self.modes.length_due != Position::default() {
            self.take_length_due(&mut target, incremental);
        }
        self.by_words(target, Axis::ALL, incremental)
    }

    /// A change of the tool length is part of an incremental word of its block; of one in a later block controls and
    /// their parameters decide.
    fn take_length_due(&mut self, target: &mut Position, incremental: bool) {
        let due = std::mem::take(&mut self.modes.length_due);
        let same_block = self.modes.length_due_in == self.core.origin;
        for axis in Axis::ALL.into_iter().filter(|axis| due[*axis] != 0.0) {
            if !self.words.axes().contains(axis) {
                self.modes.length_due[axis] = due[axis];
            } else if incremental && same_block {
                target[axis] += due[axis];
            } else if incremental {
                let (name, at) = (char::from(axis.letter()), self.core.start);
                let message = format!(
                    "{name} is incremental, and the tool length has changed in a block without {name}: it counts from where \
                     the axis stands; a control that has moved by the length, or moves by it now, is {:.4} mm apart",
                    due[axis]
                );
                let hint = "write the first move after G43, G44 or G49 with G90, or in their block";
                self.core.warn(
                    "incremental-after-length",
                    self.core.origin.line,
                    at,
                    message,
                    hint,
                );
            }
        }
    }

    /// The values of the axis words in the place of others, or added to them.
    pub(super) fn by_words(
        &mut self,
        mut values: Position,
        axes: impl IntoIterator<Item = Axis>,
        incremental: bool,
    ) -> Position {
        for axis in axes {
            if let Some(value) = self.axis_word(axis) {
                values[axis] = if incremental { values[axis] } else { 0.0 } + value;
            }
        }
        values
    }
}

/// A code number, allowing for what arithmetic does to it.
pub(super) fn whole(value: f64) -> Option<u16> {
    let near = value.round();
    ((value - near).abs() < 1e-3 && (0.0..65536.0).contains(&near)).then_some(near as u16)
}

/// Two codes of one group cannot stand in one block.
pub(super) fn check_groups(words: &Words) -> Result<(), Fault> {
    let group = |a: Action| match a {
        Action::Note(_)
        | Action::NoteWhole(_)
        | Action::NotApplied(_)
        | Action::NotAppliedAlone(_)
        | Action::ModalState(_)
        | Action::Kinematics(_)
        | Action::ModalMacroOff
        | Action::DataInputEnd
        | Action::Polar(_)
        | Action::Scale
        | Action::ScaleOff
        | Action::Mirror(_)
        | Action::RotationOff
        | Action::Coolant(_)
        | Action::ToolCentre(_)
        | Action::ArcAbsolute(_)
        | Action::CancelCycle
        | Action::Diameter(_)
        | Action::Orient => None,
        _ => Some(a.rank()),
    };
    mistakes::check_groups(&words.actions, group)
}
