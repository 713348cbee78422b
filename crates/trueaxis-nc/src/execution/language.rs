//! What every run has, whatever the language of its program: where it is, what it reports, what it
//! hands out and where its limits lie.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::rc::Rc;

use trueaxis_input::{Diagnostics, Place};

use super::corners::Corners;
use super::radius::Active;
use super::{Follower, FollowingAxes, KnownPosition, Library, Modes, Outcome, Settings, mistakes};
use crate::moves::{
    Axis, AxisSet, Coordinates, Event, Frame, Move, MoveKind, Origin, Position, RotaryDirection,
    Step,
};
use crate::text::program::{Fault, Places, Program};

/// Errors that a run lists before it stops.
const MOST_ERRORS: usize = 100;

/// Warnings that a run lists, with the note that the rest is left out: more than anybody reads.
/// Hostile programs could fill the memory with warnings about ever new numbers.
const MOST_WARNINGS: usize = 1000;

/// What the next block is, after one was executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Next {
    /// The one that follows.
    Following,
    /// Wherever the program was sent.
    Jumped,
    /// None.
    Finished,
}

/// A language of NC programs in execution.
pub(crate) trait Language<'r> {
    /// A block taken apart; its room is used again.
    type Room: Default;

    /// What it shares with the others.
    fn core(&mut self) -> &mut Core<'r>;

    /// Executes what comes next: a block, some plain ones, or the end of a text.
    fn advance(&mut self, room: &mut Self::Room) -> Result<Next, Fault>;

    /// Continues after a block with an error.
    fn pass_over(&mut self, room: &Self::Room);

    /// Tells the frame if it has changed.
    fn emit_frame(&mut self);

    /// The present place in the program frame, with all turns of the rotary axes, mm and degrees.
    fn position(&self) -> Position;

    /// Counts from another place in the program frame.
    fn set_position(&mut self, place: Position);

    /// Reads the place in the program frame again where a step has changed what it depends on.
    #[inline]
    fn settle(&mut self) {
        if self.core().is_unread {
            self.read_place();
        }
    }

    #[doc(hidden)]
    fn read_place(&mut self) {
        let core = self.core();
        core.end_corner("the place after its block is read from the machine");
        core.stop_on_contour();
        self.emit_frame();
        let core = self.core();
        core.is_unread = false;
        if let Some(known) = core.follower.axes().map(FollowingAxes::place) {
            let place = core.contour_place(known).over(&self.position());
            self.set_position(place);
        }
        let place = self.position();
        self.core().contour_from(place);
    }

    /// Executes the program; `false` after an error or a stop on request.
    fn run(&mut self) -> bool {
        let mut room = Self::Room::default();
        self.emit_frame();
        while !self.core().settings.stop.is_requested() {
            self.settle();
            let next = self.advance(&mut room);
            if let Some(fault) = self.core().fault.take().filter(|_| next.is_ok())
                && !self.core().goes_on_after(fault)
            {
                return false;
            }
            match next {
                Ok(Next::Finished) => return true,
                Ok(Next::Following | Next::Jumped) => {}
                Err(fault) => {
                    if !self.core().goes_on_after(fault) {
                        return false;
                    }
                    self.pass_over(&room);
                }
            }
        }
        false
    }

    /// Executes the program to its end.
    fn outcome(&mut self) -> Outcome {
        let finished = self.run();
        let core = self.core();
        core.end_corner("no move follows it");
        core.end_contour();
        let programs = core.programs.iter().map(|p| p.file().to_owned()).collect();
        Outcome { problems: std::mem::take(&mut core.problems), finished, programs }
    }
}

/// So many bytes of a text before the present block are kept, and as many more until they are passed together.
const KEPT_BACK: usize = 2 << 20;

/// The part of a run that is the same in all languages.
pub(crate) struct Core<'r> {
    pub library: &'r dyn Library,
    pub settings: &'r Settings,
    pub(super) follower: &'r mut dyn Follower,
    pub(super) corners: Corners,
    pub(super) radius: Option<Box<Active>>,
    /// What is wrong with the contour, reported after its block.
    fault: Option<Fault>,
    /// Steps that are collected instead of made: those of a contour that a cycle follows later.
    collected: Option<Vec<Step>>,
    /// A program that the dictionary calls after this block.
    pub own_call: Option<(String, usize)>,
    /// The place in the program frame is to be read again.
    is_unread: bool,
    /// A plane is swivelled; the tip is followed.
    tilted: bool,
    tip_followed: bool,
    /// The main program, then the others in the order of their first call.
    pub programs: Vec<Rc<Program>>,
    /// Up to where the text of each was passed.
    passed: Vec<usize>,
    /// The programs of the library by the name they were asked for.
    loaded: HashMap<String, usize>,
    /// The program and line that are being executed.
    pub origin: Origin,
    /// Where the block begins that is being executed.
    pub start: usize,
    pub modes: Modes,
    /// Tool radii by number, mm.
    pub radii: BTreeMap<u32, f64>,
    /// Backward jumps and calls, and the points of the path before the first of them.
    jumps: u64,
    points_before: u64,
    /// The last reported frame.
    pub(super) reported_frame: Frame,
    problems: Diagnostics,
    errors: usize,
    /// Nothing can go on, whatever the settings say.
    stopped: bool,
    reported: HashSet<(&'static str, String)>,
}

impl<'r> Core<'r> {
    pub fn new(
        program: &Program,
        library: &'r dyn Library,
        settings: &'r Settings,
        follower: &'r mut dyn Follower,
    ) -> Self {
        Self {
            library,
            settings,
            follower,
            corners: Corners::default(),
            radius: None,
            fault: None,
            collected: None,
            own_call: None,
            is_unread: true,
            tilted: false,
            tip_followed: false,
            programs: vec![Rc::new(program.clone())],
            passed: Vec::new(),
            loaded: HashMap::new(),
            origin: Origin { program: 0, line: 1 },
            start: 0,
            modes: Modes::new(settings),
            radii: settings.radii.clone(),
            jumps: 0,
            points_before: 0,
            reported_frame: Frame::IDENTITY,
            problems: Diagnostics::new(),
            errors: 0,
            stopped: false,
            reported: HashSet::new(),
        }
    }

    /// The program that is being executed.
    #[inline]
    pub fn program(&self) -> &Rc<Program> {
        &self.programs[self.origin.program as usize]
    }

    /// A block of a program begins.
    #[inline(always)]
    pub fn begin(&mut self, program: usize, start: usize, line: u32) {
        let passed = self.passed.get(program).copied().unwrap_or(0);
        if start < passed || start - passed > 2 * KEPT_BACK {
            self.pass(program, start);
        }
        self.start = start;
        self.origin = Origin { program: program as u32, line };
    }

    /// What lies far before this block is not needed for now; after a jump back it counts from there.
    #[cold]
    fn pass(&mut self, program: usize, start: usize) {
        self.passed.resize(self.programs.len(), 0);
        let (text, passed) = (&self.programs[program], &mut self.passed[program]);
        let end = start.saturating_sub(KEPT_BACK);
        text.pass((*passed).min(end)..end);
        *passed = end;
    }

    #[inline]
    pub fn emit(&mut self, event: Event) {
        self.is_unread |= changes_place(&event);
        match event {
            Event::TiltedPlane(on) => self.tilted = on,
            Event::ToolCentre(on) => self.tip_followed = on,
            _ => {}
        }
        self.hand_out(Step::Event(event, self.origin));
    }

    #[inline]
    pub fn emit_move(&mut self, step: Move) {
        self.is_unread |= ends_elsewhere(&step) || self.turns_alone(step.named);
        self.hand_out(Step::Move(step));
    }

    /// Whether rotary axes turn alone, on a swivelled plane: the place in the plane is another one then.
    pub fn turns_alone(&self, named: AxisSet) -> bool {
        self.tilted && !self.tip_followed && named.has_rotary()
    }

    #[inline]
    fn hand_out(&mut self, step: Step) {
        if self.corners.are_off() {
            self.send(step);
        } else {
            self.step_at_corner(step);
        }
    }

    /// A step after the corners: to the contour if there is one, else to the machine.
    #[inline]
    pub(super) fn send(&mut self, step: Step) {
        if let Some(collected) = &mut self.collected {
            collected.push(step);
        } else if self.radius.is_none() {
            self.follower.take(step);
        } else {
            self.step_on_contour(step);
        }
    }

    /// From here on the steps are collected.
    pub fn collect(&mut self) {
        self.end_corner("a cycle begins");
        self.collected = Some(Vec::new());
    }

    /// How many steps are collected so far.
    pub fn collected(&self) -> usize {
        self.collected.as_ref().map_or(0, Vec::len)
    }

    /// The steps since [`Self::collect`], with the frame as it was before them.
    pub fn collected_since(&mut self, frame: Frame) -> Vec<Step> {
        self.end_corner("its contour ends");
        self.forget_corner();
        self.reported_frame = frame;
        self.collected.take().unwrap_or_default()
    }

    /// The frame that was reported last.
    pub fn frame_now(&self) -> Frame {
        self.reported_frame
    }

    /// Whether a fault is to be reported after its block.
    pub(super) fn has_fault(&self) -> bool {
        self.fault.is_some()
    }

    /// A fault that shows after the words that cause it.
    pub(super) fn hold_fault(&mut self, fault: Fault) {
        self.fault.get_or_insert(fault);
    }

    /// Where the axes are, if a machine follows the program; else as the frames of the program say.
    pub fn axis_positions(&self, by_frames: Position) -> Position {
        if self.corners.is_waiting() || self.radius.is_some() {
            // The machine has not made the last move yet.
            return by_frames;
        }
        self.follower.axes().map_or(by_frames, |axes| axes.positions().over(&by_frames))
    }

    /// The axes of the machine; all of programs without one.
    pub fn axes_of_machine(&self) -> AxisSet {
        let all = || Axis::ALL.into_iter().fold(AxisSet::default(), AxisSet::with);
        self.follower.axes().map_or_else(all, |axes| axes.positions().axes)
    }

    /// The place in the program frame is read again before the next move.
    pub fn read_again(&mut self) {
        self.is_unread = true;
    }

    /// Where the axes are once the tool has gone back along its axis to the end of the travel.
    pub fn retracted(&mut self) -> Option<KnownPosition> {
        self.stop_on_contour();
        self.follower.axes()?.retracted()
    }

    /// Tells the frame if it has changed, and whether it has.
    pub fn emit_frame(&mut self, frame: Frame) -> bool {
        let changed = frame != self.reported_frame;
        if changed {
            self.stop_on_contour();
            self.reported_frame = frame;
            self.emit(Event::Frame(frame));
        }
        changed
    }

    /// What a part of the block comes to, if anybody asks; without a value it only steers the execution.
    pub fn report_computed(&mut self, text: std::ops::Range<usize>, value: Option<f64>) {
        if self.settings.report_blocks {
            self.emit(Event::Computed { text, value });
        }
    }

    /// Reports a fault of the program that is being executed.
    pub fn report(&mut self, fault: Fault) {
        let place = self.place(fault.offset);
        self.problems.error(fault.code, place, fault.message, fault.hint);
        self.errors += 1;
    }

    /// Reports a fault; whether the run continues after its block.
    fn goes_on_after(&mut self, fault: Fault) -> bool {
        self.forget_corner();
        self.report(fault);
        self.settings.keep_going && !self.stopped && self.errors < MOST_ERRORS
    }

    /// A fault after which nothing can go on.
    pub fn for_good(&mut self, fault: Fault) -> Fault {
        self.stopped = true;
        fault
    }

    fn place(&self, offset: usize) -> Place {
        let program = self.program();
        let mut places = Places::new(program);
        if offset >= self.start {
            places = Places::beginning(program, self.start, self.origin.line);
        }
        places.of(offset)
    }

    /// Whether this is said about this subject for the first time.
    pub fn is_new(&mut self, code: &'static str, subject: impl ToString) -> bool {
        self.reported.len() < MOST_WARNINGS && self.reported.insert((code, subject.to_string()))
    }

    /// Warns once about each subject.
    pub fn warn(
        &mut self,
        code: &'static str,
        subject: impl ToString,
        at: usize,
        message: impl Into<String>,
        hint: &str,
    ) {
        if !self.is_new(code, subject) {
            return;
        }
        let place = self.place(at);
        if self.reported.len() < MOST_WARNINGS {
            self.problems.warn(code, place, message.into(), hint);
        } else {
            let message =
                format!("more than {MOST_WARNINGS} warnings; the remaining ones are not listed");
            self.problems.note(
                "too-many-problems",
                place,
                message,
                "correct the first ones; the others may follow from them",
            );
        }
    }

    /// Warns once that something known to the control has no effect here.
    pub fn not_applied(&mut self, subject: &str, at: usize, hint: &str) {
        self.warn("not-applied", subject, at, format!("{subject} is not applied"), hint);
    }

    /// The same for what would change the moves.
    pub fn left_out(&mut self, subject: &str, at: usize) {
        self.not_applied(subject, at, "the following moves are computed without it");
    }

    /// Counts a call or a jump backwards.
    pub fn count(&mut self, at: usize) -> Result<(), Fault> {
        /// A loop of more points counts as so many more rounds.
        const POINTS_OF_A_JUMP: u64 = 2;
        let points = self.follower.points();
        if self.jumps == 0 {
            self.points_before = points;
        }
        self.jumps += 1;
        let most = self.settings.most_jumps;
        let made = (points - self.points_before) / POINTS_OF_A_JUMP;
        if self.jumps.max(made) <= most {
            return Ok(());
        }
        Err(self.for_good(mistakes::endless_loop(most, POINTS_OF_A_JUMP * most, at)))
    }

    /// Looks whether one more call within the `depth` that are there goes too deep.
    pub fn check_depth(&mut self, depth: usize, at: usize) -> Result<(), Fault> {
        let deepest = self.settings.deepest_call;
        if depth <= deepest {
            return Ok(());
        }
        Err(self.for_good(mistakes::calls_too_deep(deepest, at)))
    }

    /// The number of a program of the library, which may have it under one of several names.
    pub fn load(
        &mut self,
        name: &str,
        names: impl IntoIterator<Item = String>,
        at: usize,
    ) -> Result<usize, Fault> {
        if let Some(number) = self.loaded.get(name) {
            return Ok(*number);
        }
        let mut why = "its name is empty".to_owned();
        for known in names {
            match self.library.content(&known) {
                Ok(text) => {
                    let control = self.programs[0].dialect().control;
                    let program = Program::of(&self.library.display(&known), text, control);
                    self.programs.push(Rc::new(program));
                    let number = self.programs.len() - 1;
                    self.loaded.insert(name.to_owned(), number);
                    return Ok(number);
                }
                Err(reason) => why = reason,
            }
        }
        Err(mistakes::missing_program(name, &why, at))
    }
}

/// Whether the same axis positions are another place in the program after an event.
pub(super) fn changes_place(event: &Event) -> bool {
    matches!(
        event,
        Event::Frame(_)
            | Event::ToolLength(_)
            | Event::ToolChange(_)
            | Event::ToolCentre(_)
            | Event::TiltedPlane(_)
            | Event::DynamicOffset(_)
    )
}

/// Whether only the machine knows where in the program a move ends.
#[inline]
fn ends_elsewhere(step: &Move) -> bool {
    step.coordinates == Coordinates::Machine
        || step.direction.is_some()
        || matches!(step.kind, MoveKind::Align { .. })
        || [Axis::A, Axis::B, Axis::C].iter().zip(step.rotary_directions).any(
            |(axis, direction)| {
                direction != RotaryDirection::AsWritten && step.named.contains(*axis)
            },
        )
}
