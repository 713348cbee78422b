//! Step by step through the program: what is commanded, what should be, what is written.

mod samples;

use super::ahead::{Ahead, Lead, Stretch};
use super::arcs::{self, Allowed, PathPlace};
use super::block::{Block, Held, Written};
use super::computed::{Computed, free_locals};
use super::correct::Corrector;
use super::found::{Found, Want};
use super::guard;
use super::length::Lengths;
use super::line_table::LineTable;
use super::number::{Grid, Of, Unit};
use super::ready::Ready;
use super::refuse::{again, cone, refusal};
use super::stand::{Cut, Sample, Stand};
use super::text::{Edits, Modes, Text};
use super::turns::Stop;
use super::words::Words;
use super::{ProgramOptions, residual_of_pieces, residual_share};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_motion::axis_path::{AxisPath, Fault};
use trueaxis_motion::{Densify, Node, SetUp};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{
    Arc, Axis, AxisSet, CompensationSide, Coordinates, Event, FeedMode, Move, MoveKind, Origin,
    Step,
};

const TO_MACHINE_ZERO: &str = "rapid to machine coordinates";
const FEED_TO_MACHINE: &str = "move with feed to machine coordinates";
const NO_CUT_BEGINS: &str = "rapid from which no cut begins";

/// A program on its way into another.
pub(super) struct Walk<'w> {
    options: &'w ProgramOptions,
    machine: &'w Machine,
    setup: &'w SetUp,
    corrector: Corrector,
    /// What the control commands by the program that is written.
    written: AxisPath<'w>,
    pub text: Text<'w>,
    pub found: Found,
    pub fault: Option<Fault>,
    /// The last block that was changed or could have been.
    last: Option<Origin>,
    /// The tool axis is programmed by vectors.
    vectors: bool,
    /// The line that first switched tool-centre-point control on.
    pub tip_followed: Option<u32>,
    /// The tool length that is on, and the tool.
    pub lengths: Lengths,
    /// The program adds a radius that is not 0 to its contour.
    pub radius_added: bool,
    /// What blocks compute.
    computed: Computed,
    /// Local parameters of Klartext that the program does not use.
    locals: std::sync::Arc<[u16]>,
    /// The feed that the next block has to state again.
    feed_again: Option<f64>,
    /// In mm and in inches.
    grids: [Grid; 2],
    /// Circles may stay circles.
    arcs: bool,
    /// A circle became lines, and the next one may rely on its G2 or G3.
    circle_gone: bool,
    /// Where the axes would stand at the end of the last block without rounding.
    exact: Command,
    /// The written program stands where nothing was corrected: the next block leads from there.
    approaching: bool,
    /// Used again block by block.
    edits: Edits,
    samples: Vec<Sample>,
    stops: Vec<Stop>,
    /// What was found ahead for the present stretch.
    ready: Ready,
    /// Where the move before ended by the program as it is, with what was commanded there; none after a change of the control.
    before: Option<(Command, Sample)>,
}

/// Where the axes go in a move of the program as it is.
#[derive(Debug, Clone, Copy)]
struct Way<'n> {
    begin: &'n Command,
    nodes: &'n [Node],
    /// The number of the first node in the stretch.
    first: usize,
}

/// Of what is written only the ends count; small turns keep the branch of the rotary axes.
const ENDS: Densify = Densify::Places {
    chord_mm: f64::INFINITY,
    angle_rad: std::f64::consts::PI / 180.0,
    spacing_mm: f64::INFINITY,
    least: 1,
};

impl<'w> Walk<'w> {
    pub fn new(
        machine: &'w Machine,
        table: &'w LineTable<'w>,
        setup: &'w SetUp,
        options: &'w ProgramOptions,
    ) -> Result<Self, Fault> {
        let (source, control) = (table.source(), table.program().dialect().control);
        let corrector = corrector(machine, options, Origin::default())?;
        Ok(Self {
            options,
            machine,
            setup,
            corrector,
            written: AxisPath::new(machine, setup, ENDS, 0.01),
            text: Text::of(table, guard::comment(&options.mark, control), &setup.files),
            found: Found::of(machine),
            fault: None,
            last: None,
            vectors: false,
            tip_followed: None,
            lengths: Lengths::default(),
            radius_added: false,
            computed: Computed::of(control),
            locals: free_locals(source, control).into(),
            feed_again: None,
            grids: [Unit::Millimetre, Unit::Inch].map(|u| Grid::of(options.increments, u)),
            arcs: true,
            circle_gone: false,
            exact: Command::default(),
            approaching: true,
            edits: Edits::default(),
            samples: Vec::new(),
            stops: Vec::new(),
            ready: Ready::default(),
            before: None,
        })
    }

    /// Circles become lines.
    #[must_use]
    pub fn without_arcs(self) -> Self {
        Self { arcs: false, ..self }
    }

    /// The machine with the tool that is in it at the end.
    pub fn machine(&self) -> &Machine {
        self.corrector.machine()
    }

    /// Writes a stretch of the program.
    pub fn take(&mut self, stretch: &mut Stretch) {
        std::mem::swap(&mut self.ready, &mut stretch.ready);
        self.steps(stretch);
        // It is filled again.
        std::mem::swap(&mut self.ready, &mut stretch.ready);
    }

    fn steps(&mut self, Stretch { steps, nodes, words, .. }: &mut Stretch) {
        for ahead in steps {
            if self.fault.is_some() {
                return;
            }
            let done = match (&ahead.fault, &ahead.step) {
                (Some(fault), _) => Err(fault.clone()),
                (None, Step::Event(event, origin)) => self.event(&ahead.step, event, *origin),
                (None, Step::Move(m)) => {
                    let read = ahead.words.map(|k| &mut words[k]);
                    self.travel(m, (ahead, read), nodes)
                }
            };
            self.fault = done.err().or_else(|| self.written.faults.pop());
        }
    }

    fn event(&mut self, step: &Step, event: &Event, origin: Origin) -> Result<(), Fault> {
        self.written.take(step, &mut |_| {});
        if !matches!(event, Event::Block { .. } | Event::Computed { .. }) {
            self.before = None;
        }
        self.computed.follow(event, self.text.source(), origin.program == 0);
        match event {
            Event::ToolChange(number) => {
                if let Some(tool) = self.setup.tools.get(number) {
                    self.lengths.change_tool(*number);
                    let machine = self.machine.clone().with_tip(tool.tip_mm);
                    let next = corrector(&machine, self.options, origin)?;
                    self.corrector = next.with_history_of(&self.corrector);
                }
            }
            // What follows is another execution, also of the same line.
            Event::Block { text } => {
                self.last = None;
                if origin.program == 0 {
                    self.text.execute(text);
                }
            }
            Event::ToolCentre(on) => {
                self.vectors = false;
                self.tip_followed = self.tip_followed.or(on.then_some(origin.line));
            }
            Event::DynamicOffset(Some(_)) if !self.options.position_only => {
                return Err(Fault {
                    origin,
                    word: None,
                    code: "turning-dynamic-offset",
                    message: "the correction turns rotary axes, which must stand while G254 is on"
                        .to_owned(),
                    hint: "correct the place alone: --position-only",
                });
            }
            Event::Compensation { side, radius_mm } => {
                self.radius_added |= *side != CompensationSide::Off && *radius_mm != 0.0;
            }
            Event::ToolLength(length) => {
                self.lengths.switch_on(Vec3::new(length.0[0], length.0[1], length.0[2]));
            }
            _ => {}
        }
        Ok(())
    }

    fn travel(
        &mut self,
        m: &Move,
        (ahead, read): (&Ahead, Option<&mut Words>),
        nodes: &[Node],
    ) -> Result<(), Fault> {
        let way = Way {
            begin: &ahead.begin,
            nodes: &nodes[ahead.nodes.clone()],
            first: ahead.nodes.start,
        };
        if self.found.other_length.is_none() && m.kind != MoveKind::Rapid {
            let mounted = self.corrector.machine();
            self.found.other_length =
                self.lengths.other(mounted, self.options.residual_mm, m.origin.line);
        }
        // Words of rotary axes take over from vectors.
        self.vectors = m.direction.is_some() || self.vectors && !m.named.has_rotary();
        let lead = (m.kind == MoveKind::Rapid).then_some(ahead.lead);
        let known = read.map(|read| {
            let modes = self.words(m.origin.line, read);
            (&*read, modes)
        });
        self.written_by(m, &way, known, lead)?;
        let incremental = known.is_some_and(|(_, modes)| modes.incremental);
        self.computed.moved(m, known.map(|(words, _)| words), incremental);
        Ok(())
    }

    /// The words of a line of the program, with the values of those that are computed.
    fn words(&mut self, line: u32, read: &mut Words) -> Modes {
        let modes = self.text.words(line, read);
        self.computed.evaluate(read, self.text.source(), modes.unit);
        modes
    }

    fn written_by(
        &mut self,
        m: &Move,
        way: &Way<'_>,
        words: Option<(&Words, Modes)>,
        lead: Option<Lead>,
    ) -> Result<(), Fault> {
        match why_left(m, way.nodes, words.map(|(words, _)| words), self.text.control()) {
            Some(why) => self.leave(m, way, words, why),
            None if lead.is_some_and(|lead| lead.axes == AxisSet::default()) => {
                self.leave(m, way, words, NO_CUT_BEGINS)
            }
            None if self.written.turns_on_cone() => Err(cone(m.origin)),
            None => self.rewrite(m, way, words, lead),
        }
    }

    fn leave(
        &mut self,
        m: &Move,
        way: &Way<'_>,
        words: Option<(&Words, Modes)>,
        why: &'static str,
    ) -> Result<(), Fault> {
        if !why.is_empty() {
            self.found.leave(why);
            self.approaching = true;
        }
        self.go_as_written(m, way.begin, words);
        if m.origin.program == 0 && m.origin.line > 0 && !self.text.keep(m.origin.line) {
            return Err(again(m.origin));
        }
        self.last = Some(m.origin);
        Ok(())
    }

    /// The written program makes the same move, which began at this command in the program as it is: axes that the block does
    /// not name stand where they were written, and increments count from there.
    fn go_as_written(&mut self, m: &Move, begin: &Command, words: Option<(&Words, Modes)>) {
        let mut same = *m;
        let places = |q: &Command| self.written.words_of(q, m.coordinates);
        let (now, was) = (places(self.written.command()), places(begin));
        // Words to reference points are places, and words of G53, but not those of SUPA and M91.
        let counts = matches!(self.text.control(), Control::Sinumerik840d | Control::Heidenhain);
        let is_place = |w: &Words| w.reference || w.machine.is_some() && !counts;
        let is_increment = |axis: Axis| {
            words.is_some_and(|(w, modes)| !is_place(w) && w.is_increment(axis, modes.incremental))
        };
        for axis in Axis::ALL {
            if m.named.contains(axis) && is_increment(axis) {
                same.target[axis] += now[axis] - was[axis];
            } else if !m.named.contains(axis) && m.coordinates == Coordinates::Program {
                same.target[axis] = now[axis];
            }
        }
        self.go(&same);
    }

    fn go(&mut self, m: &Move) {
        let from = *self.written.command();
        self.written.take(&Step::Move(*m), &mut |_| {});
        self.corrector.moved(&from, self.written.command());
    }

    /// Corrects a move and writes it; of a rapid only the words of some axes. Without words it is of a subprogram.
    fn rewrite(
        &mut self,
        m: &Move,
        way: &Way<'_>,
        words: Option<(&Words, Modes)>,
        lead: Option<Lead>,
    ) -> Result<(), Fault> {
        let whole = matches!(m.kind, MoveKind::Rapid | MoveKind::Thread { .. });
        let samples = self.samples(m, way, whole)?;
        self.exact = samples[samples.len() - 1].command;
        let Some((words, modes)) = words else { return self.in_subprogram(m, &samples) };
        if self.last == Some(m.origin) {
            let message = "the block makes several moves, as a cycle or a chamfer does: they have \
                           no words of their own that could be corrected"
                .to_owned();
            let hint = "write the moves one by one; the postprocessor can";
            return Err(refusal(m.origin, "several-moves", message, hint));
        }
        self.last = Some(m.origin);
        let ends = match self.written.control() {
            Some(control) if !whole => self.cut(control).ends(&samples),
            _ => vec![samples.len() - 1],
        };
        let mut approaching = std::mem::take(&mut self.approaching);
        if approaching && lead.is_none() {
            approaching = self.is_elsewhere(&samples[0].command);
            self.found.begins_elsewhere.extend(approaching.then_some(m.origin.line));
        }
        let first_time = !self.text.was_executed(m.origin.line);
        let end_only = whole || approaching;
        let held = lead.map_or(Ok(None), |lead| self.held(m, way, &lead))?;
        let leads = self.found.leads_as_before(m.origin.line, &samples, end_only);
        if !first_time && self.computed.is_in_words(words) {
            return Err(again(m.origin));
        }
        self.found.led_elsewhere |= !first_time && !leads;
        let grid = self.grids[usize::from(modes.unit == Unit::Inch)];
        let says_circle = words.motion.is_some() || !self.circle_gone;
        let kept = self.kept_circle(m, &samples, words.motion.is_some());
        let ends = if kept { vec![samples.len() - 1] } else { ends };
        let locals = std::sync::Arc::clone(&self.locals);
        let mut block = Block {
            m,
            source: self.text.source(),
            words,
            incremental: modes.incremental,
            feed_unit: modes.feed_unit,
            control: self.text.control(),
            grid,
            only: lead.map(|lead| lead.axes),
            adds_beyond: lead.filter(|lead| lead.is_last).map(|_| residual_share(self.options)),
            arc: None,
            vectors: self.vectors,
            feed_again: self.feed_again.take(),
            resting: self.computed.of_block(words),
            locals: &locals,
            edits: std::mem::take(&mut self.edits),
            before: Vec::new(),
            expressions: Vec::new(),
            further: Vec::new(),
            added: Vec::new(),
            pieces: ends.len(),
        };
        if !kept && says_circle && block.has_arc_words() {
            block.arc = self.fitted(m, &samples, grid);
        }
        let ends = match block.arc {
            Some(_) => vec![samples.len() - 1],
            None => ends,
        };
        block.pieces = ends.len();
        self.circle_gone &= block.arc.is_none();
        let turns_deg = self.turns_deg(m, way);
        let (mut from, first_want) = (0, self.found.wants.len());
        for (piece, to) in ends.iter().enumerate() {
            let share = samples[*to].u - samples[from].u;
            let end = samples[*to].command;
            if kept {
                self.go_as_written(m, way.begin, Some((words, modes)));
            } else {
                let tip = samples[*to].believed.tip;
                let step = Written { piece, share, command: end, tip, held };
                let next = block.write(&self.written, &step, turns_deg)?;
                self.feed_again = next.feed_again.or(self.feed_again);
                self.go(&next.m);
                if lead.is_some() {
                    self.approaching = self.is_elsewhere(&end);
                    continue;
                }
                self.check_arrival(m, &end)?;
                self.found.undecided += u64::from(self.comes_otherwise(&samples[*to]));
            }
            let stands = samples[from..=*to].iter().map(|s| s.wanted);
            // A piece that needs no words of its own belongs to the line before.
            let piece = if kept { 0 } else { block.further.len() as u32 };
            let from_elsewhere = approaching && from == 0;
            // While an axis takes up its play at one place, the tool is nowhere else.
            let takes_up_play = samples[*to].turns && *to == from + 1;
            let end_only = whole || !first_time || from_elsewhere || takes_up_play;
            let want = Want::of(m.origin.line, piece, end_only);
            self.found.want(want, stands);
            from = *to;
        }
        let is_circle = matches!(m.kind, MoveKind::Arc(_) | MoveKind::SpatialArc(_));
        let is_line = is_circle && !kept && block.arc.is_none();
        self.found.note(&block, is_line, self.feed_again.is_some(), &samples);
        let (mut edits, before, further) = (block.edits, block.before, block.further);
        let unchanged = edits.is_empty() && further.is_empty();
        let line = m.origin.line;
        self.found.executed(line, first_want);
        let fits = match unchanged {
            true => self.text.keep(line),
            false => self.text.change(line, &mut edits, [&before, &further]),
        };
        edits.clear();
        (self.edits, self.samples) = (edits, samples);
        if fits { Ok(()) } else { Err(again(m.origin)) }
    }

    /// The circle that keeps the residual on the corrected places; none at turning points.
    fn fitted(&self, m: &Move, samples: &[Sample], grid: Grid) -> Option<Arc> {
        let MoveKind::Arc(arc) = m.kind else { return None };
        let turns = samples.iter().any(|s| s.turns);
        if !self.arcs || turns || m.coordinates != Coordinates::Program {
            return None;
        }
        let now = self.written.command();
        let place = |(i, s): (usize, &Sample)| {
            let command = if i == 0 { now } else { &s.command };
            PathPlace { u: s.u, at: self.written.words_of(command, Coordinates::Program) }
        };
        let places: Vec<PathPlace> = samples.iter().enumerate().map(place).collect();
        let [residual_mm, residual_rad] = residual_share(self.options);
        let rounding = self.options.increments.map_or([0.0; 2], |i| [i.linear_mm, i.rotary_deg]);
        let allowed = Allowed {
            linear_mm: residual_mm + rounding[0],
            rotary_deg: residual_rad.to_degrees() + rounding[1],
        };
        arcs::fit(&arc, &places, allowed, |v| grid.round(v, Of::Linear))
    }

    fn cut<'c>(&self, control: &'c trueaxis_machine::tcp::TipControl) -> Cut<'c> {
        let [residual_mm, residual_rad] = residual_of_pieces(self.options);
        Cut { control, straight: self.written.straight(), residual_mm, residual_rad }
    }

    /// A circle that no correction touches stays one.
    fn kept_circle(&mut self, m: &Move, samples: &[Sample], says_circle: bool) -> bool {
        if !matches!(m.kind, MoveKind::Arc(_) | MoveKind::SpatialArc(_)) {
            self.circle_gone = false;
            return false;
        }
        let untouched = samples.iter().all(|s| {
            let [tip, axis] = s.wanted.from(&s.believed);
            tip < 1e-10 && axis < 1e-13
        });
        let kept = untouched && (says_circle || !self.circle_gone);
        self.circle_gone = !kept;
        kept
    }

    /// The degrees that a feed in deg/min counts along, where the tip stands still.
    fn turns_deg(&self, m: &Move, way: &Way<'_>) -> Option<f64> {
        if m.kind != MoveKind::Linear || m.feed.mode != FeedMode::PerMinute {
            return None;
        }
        let end = way.nodes.last().map_or(way.begin, |node| &node.command);
        let end = self.written.words_of(end, m.coordinates);
        let moved = end.minus(&self.written.words_of(way.begin, m.coordinates));
        let turned: f64 = way.nodes.iter().map(|n| n.length).sum();
        let stands = moved.0[..3].iter().all(|v| v.abs() <= 1e-9);
        (stands && turned > 0.0).then_some(turned)
    }

    /// A subprogram can be called from elsewhere: only one that needs no change is left alone.
    fn in_subprogram(&mut self, m: &Move, samples: &[Sample]) -> Result<(), Fault> {
        let untouched = samples.iter().all(|s| {
            let [tip, axis] = s.wanted.from(&s.believed);
            tip < 1e-10 && axis < 1e-13
        });
        if untouched {
            self.go_as_written(m, &samples[0].command, None);
            return Ok(());
        }
        let message =
            "the move stands in a subprogram, which may be called elsewhere too".to_owned();
        let hint = "put its blocks into the main program";
        Err(refusal(m.origin, "in-subprogram", message, hint))
    }

    /// Whether the written program is not at axis positions, within what may be missed on the way.
    fn is_elsewhere(&self, wanted: &Command) -> bool {
        let Some(control) = self.written.control() else { return true };
        let [tip, axis] =
            Stand::of(control, self.written.command()).from(&Stand::of(control, wanted));
        let [tip_mm, axis_rad] = self.options.limits_between();
        // NaN is elsewhere.
        !(tip <= tip_mm && axis <= axis_rad)
    }

    /// The control goes where the written words were meant to lead.
    fn check_arrival(&self, m: &Move, wanted: &Command) -> Result<(), Fault> {
        for (i, axis) in self.machine.axes().iter().enumerate() {
            let by = (self.written.command()[i] - wanted[i]).abs();
            let (allowed, unit, scale) = match axis.kind {
                AxisKind::Linear => (0.05, "mm", 1.0),
                AxisKind::Rotary => (2e-3, "deg", 1_f64.to_degrees()),
            };
            // NaN has not arrived.
            if by.is_nan() || by > allowed {
                let message = format!(
                    "with corrected words {} would end {:.6} {unit} from its place",
                    axis.name,
                    by * scale
                );
                let hint =
                    "near a pole, where a rotary axis rewinds, or with ACP/ACN: write its angles";
                return Err(refusal(m.origin, "other-place", message, hint));
            }
        }
        Ok(())
    }
}

/// Why a block stays as it is, whatever the machine does.
fn why_left(
    m: &Move,
    nodes: &[Node],
    words: Option<&Words>,
    control: Control,
) -> Option<&'static str> {
    match (m.kind, m.coordinates) {
        (MoveKind::Dwell { .. }, _) => Some(""),
        (MoveKind::Align { .. }, _) => Some("the tool turns onto a swivelled plane"),
        (MoveKind::Probe, _) => Some("probing"),
        (MoveKind::RigidTap { .. }, _) => Some("rigid tapping"),
        // Nothing moves.
        _ if nodes.is_empty() => Some(""),
        (MoveKind::Rapid, Coordinates::Machine) => Some(TO_MACHINE_ZERO),
        // FANUC's G53 comes as a place of the program frame.
        (MoveKind::Rapid, _) if words.is_some_and(|w| w.machine.is_some()) => Some(TO_MACHINE_ZERO),
        // A block more would have to say G53 or SUPA again; M91 of Klartext is corrected.
        _ if control != Control::Heidenhain
            && (m.coordinates == Coordinates::Machine
                || words.is_some_and(|w| w.machine.is_some())) =>
        {
            Some(FEED_TO_MACHINE)
        }
        (MoveKind::Rapid, _) if words.is_some_and(|w| w.reference) => {
            Some("move to a reference point")
        }
        _ if words.is_some_and(|w| w.retracts && w.axes.iter().all(Option::is_none)) => {
            Some("retraction along the tool axis")
        }
        _ => None,
    }
}

fn corrector(
    machine: &Machine,
    options: &ProgramOptions,
    origin: Origin,
) -> Result<Corrector, Fault> {
    let made = Corrector::of(machine, options.position_only, options.limit, options.increments);
    made.map_err(|fault| {
        let hint = "a machine with three linear axes is needed";
        refusal(origin, "not-correctable", fault.to_string(), hint)
    })
}
