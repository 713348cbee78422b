//! The strokes of the tool: what the records of the file add up to.

mod thread;

use crate::PostOptions;
use crate::strokes::Strokes;
use trueaxis_cl::{ClCircle, ClCycle, ClPath, ClPoint, ClTool, Word};
use trueaxis_geometry::frame::rotation;
use trueaxis_geometry::{Vec3, angle};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Coolant, Feed, FeedMode, SpindleDirection};
use trueaxis_writer::Thread;

/// Where the tool stands in the workpiece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stand {
    pub tip: Vec3,
    pub axis: Vec3,
}

/// How the tip gets there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Way {
    Line,
    /// About a centre, right-handed about a normal.
    Arc {
        center: Vec3,
        normal: Vec3,
        angle_rad: f64,
    },
}

/// One motion of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub to: Stand,
    pub way: Way,
    pub rapid: bool,
    /// mm/min; of no meaning in rapid.
    pub feed: f64,
    /// The line of the file.
    pub line: u32,
}

/// What happens before a stroke; a tool with the line of the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Event {
    Tool(ClTool, u32),
    Spindle(SpindleDirection, f64),
    Coolant(Coolant),
    Dwell(f64),
    Stop { optional: bool },
    Comment(String),
}

/// A drilling cycle at one point of the file, and the strokes that it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drilled {
    /// The first stroke of the way to it.
    pub begin: usize,
    /// The first stroke that begins over it.
    pub down: usize,
    /// The stroke back to the retract height.
    pub last: usize,
    /// The point and the tool axis.
    pub surface: Stand,
    pub cycle: ClCycle,
    /// mm/min.
    pub feed: f64,
    /// The thread that is tapped.
    pub thread: Option<Thread>,
}

/// Strokes, and events each before the stroke of a number.
#[derive(Debug, Clone, Default)]
pub(crate) struct Path {
    pub strokes: Strokes,
    pub events: Vec<(usize, Event)>,
    /// Which strokes are drilling cycles, in order.
    pub holes: Vec<Drilled>,
}

/// Nearer than this two places of a file are one.
pub(crate) const SAME_MM: f64 = 1e-6;

/// Tool axes nearer than this are the same.
const SAME_RAD: f64 = 1e-6;

/// How far above the last depth the rapid way back into a hole ends.
const BACK_MM: f64 = 0.5;

/// The depths of the pecks of a hole, its bottom the last.
fn pecks(cycle: &ClCycle) -> Vec<f64> {
    let mut depths = Vec::new();
    if let Some([first, further]) = cycle.pecks_mm {
        let mut depth = first;
        // A rest that the digits of the file leave is no peck.
        while depth < cycle.depth_mm - SAME_MM {
            depths.push(depth);
            depth += further;
        }
    }
    depths.push(cycle.depth_mm);
    depths
}

/// The great circle between two directions.
///
/// a(u) = (sin((1 − u)θ)·a₀ + sin(uθ)·a₁)/sin θ              docs/model.md eq. 120
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    from: Vec3,
    to: Vec3,
    theta: f64,
}

impl Turn {
    pub fn between(from: &Vec3, to: &Vec3) -> Self {
        Self { from: *from, to: *to, theta: angle(from, to) }
    }

    pub fn at(&self, u: f64) -> Vec3 {
        if self.theta < 1e-9 {
            return (self.from * (1.0 - u) + self.to * u).normalize();
        }
        let weighted =
            self.from * ((1.0 - u) * self.theta).sin() + self.to * (u * self.theta).sin();
        weighted.try_normalize(1e-12).unwrap_or(self.from)
    }
}

/// One place of a great circle.
pub(crate) fn between(from: &Vec3, to: &Vec3, u: f64) -> Vec3 {
    Turn::between(from, to).at(u)
}

impl Stroke {
    /// The place at u of the stroke that begins at `from`.
    pub fn at(&self, from: &Stand, u: f64) -> Stand {
        self.on(from, &Turn::between(&from.axis, &self.to.axis), u)
    }

    /// The same where the turn of the tool axis is known.
    pub fn on(&self, from: &Stand, turn: &Turn, u: f64) -> Stand {
        if u == 1.0 {
            return self.to;
        }
        let axis = turn.at(u);
        let straight = from.tip + (self.to.tip - from.tip) * u;
        let tip = match self.way {
            Way::Line => straight,
            Way::Arc { center, normal, angle_rad } => {
                // A spiral or helix takes its change of radius and height evenly.
                let turned = rotation(normal, angle_rad * u) * (from.tip - center) + center;
                let end = rotation(normal, angle_rad) * (from.tip - center) + center;
                turned + (self.to.tip - end) * u
            }
        };
        Stand { tip, axis }
    }
}

/// Everything modal while the records are read.
struct Builder<'b> {
    file: &'b str,
    options: &'b PostOptions,
    problems: &'b mut Diagnostics,
    path: Path,
    circle: Option<ClCircle>,
    cycle: Option<ClCycle>,
    speed: f64,
    /// What turns and flows by the words of the file, and whether a change of tool has stopped it since.
    spindle: (Option<SpindleDirection>, bool),
    coolant: (Option<Coolant>, bool),
    /// A thread was tapped since the last motion of another kind.
    tapped: bool,
    told_no_feed: bool,
    told_pitch: bool,
    /// What was refused of threads: once for each reason.
    refused: Vec<&'static str>,
    tools: usize,
}

impl Path {
    pub fn of(file: ClPath, options: &PostOptions, problems: &mut Diagnostics) -> Self {
        let name = file.name().to_owned();
        let mut builder = Builder {
            file: &name,
            options,
            problems,
            path: Self::default(),
            circle: None,
            cycle: None,
            speed: 0.0,
            spindle: (None, false),
            coolant: (None, false),
            tapped: false,
            told_no_feed: false,
            told_pitch: false,
            refused: Vec::new(),
            tools: 0,
        };
        builder.path.strokes.reserve(file.points());
        for (line, word) in file.into_words() {
            builder.take(&word, line);
        }
        builder.path
    }

    /// The place before a stroke; that of the stroke itself before the first.
    pub fn before(&self, stroke: usize) -> Stand {
        self.strokes.to(stroke.saturating_sub(1))
    }
}

impl Builder<'_> {
    fn take(&mut self, word: &Word, line: u32) {
        let event = match word {
            Word::Goto(point) => return self.point(point, line),
            Word::Circle(circle) => {
                self.circle = Some(*circle);
                return;
            }
            Word::Cycle(cycle) => {
                self.cycle = Some(*cycle);
                return;
            }
            Word::CycleOff => {
                self.cycle = None;
                return;
            }
            Word::Tool(tool) => {
                self.change_tool(tool, line);
                Event::Tool(*tool, line)
            }
            Word::Spindle(turning, speed) => {
                self.speed = speed.unwrap_or(self.speed);
                self.spindle = (Some(*turning), false);
                Event::Spindle(*turning, self.speed)
            }
            Word::Coolant(coolant) => {
                self.coolant = (Some(*coolant), false);
                Event::Coolant(*coolant)
            }
            Word::Delay(seconds) => Event::Dwell(*seconds),
            Word::Stop { optional } => Event::Stop { optional: *optional },
            Word::Insert(text) => Event::Comment(text.clone()),
            _ => return,
        };
        self.path.events.push((self.path.strokes.len(), event));
    }

    /// A change of tool stops spindle and coolant (RS274/NGC, 3.6.3; usual on all controls): where the file does not
    /// say them again before the next motion, they are written again.
    fn change_tool(&mut self, tool: &ClTool, line: u32) {
        self.tools += 1;
        self.spindle.1 = self.spindle.0.is_some_and(|turning| turning != SpindleDirection::Stopped);
        self.coolant.1 = self.coolant.0.is_some_and(|coolant| coolant != Coolant::Off);
        // Places of the tip do not depend on the length.
        if self.tools == 2 && self.options.tip_words.is_none() {
            let message = "the file has more than one tool: all are taken to be as long as the \
                           machine's";
            let hint = "post each tool by itself with --tool-length";
            self.problems.warn("one-tool-length", self.place(line), message.into(), hint);
        }
        let has_offsets = self.options.control != Control::Heidenhain;
        if let Some(offset) = tool.offset.filter(|n| *n != tool.number && !has_offsets) {
            let message =
                format!("the length offset {offset} of the tool is read, but not applied");
            let hint = "the control keeps the length under the number of the tool";
            self.problems.warn("not-applied", self.place(line), message, hint);
        }
    }

    /// Before a motion: what a change of tool has stopped.
    fn start_again(&mut self) {
        let at = self.path.strokes.len();
        if let (Some(turning), true) = self.spindle {
            self.path.events.push((at, Event::Spindle(turning, self.speed)));
        }
        if let (Some(coolant), true) = self.coolant {
            self.path.events.push((at, Event::Coolant(coolant)));
        }
        (self.spindle.1, self.coolant.1) = (false, false);
    }

    fn place(&self, line: u32) -> Place {
        Place { file: self.file.to_owned(), line: line as usize, column: 1 }
    }

    fn point(&mut self, point: &ClPoint, line: u32) {
        let (tip, axis) = (Vec3::from(point.tip_mm), Vec3::from(point.axis));
        let circle = self.circle.take();
        self.after_tapping();
        self.start_again();
        if let Some(cycle) = self.cycle {
            return self.hole(tip, axis, &cycle, point, line);
        }
        let to = Stand { tip, axis };
        let Some(feed) = self.feed(point.rapid, point.feed, line) else { return };
        let from = self.path.strokes.last_to();
        let way = match (circle, from) {
            (Some(circle), Some(from)) => match arc(&circle, &from, &to) {
                Some(arc) => arc,
                None => return self.off_circle(&circle, [&from, &to], line),
            },
            _ => Way::Line,
        };
        self.push(Stroke { to, way, rapid: point.rapid, feed, line });
    }

    fn off_circle(&mut self, circle: &ClCircle, [from, to]: [&Stand; 2], line: u32) {
        let [from_mm, to_mm] = [from, to].map(|stand| stand.tip.into());
        let message = match (circle.turn_rad, circle.turn_rad(&from_mm, &to_mm)) {
            (Some(stated), Err(is)) if circle.leads(&from_mm, &to_mm) => format!(
                "ANGLE of the circle is {:.4} deg, and counter-clockwise about its normal it is {:.4} deg to this point",
                stated.to_degrees(),
                is.to_degrees()
            ),
            _ => format!(
                "the circle does not lead here: its axis is {:.4} mm from the point before and {:.4} mm from this one",
                circle.radius_mm(&from_mm),
                circle.radius_mm(&to_mm)
            ),
        };
        let hint = "check CIRCLE and the points before and after it";
        self.problems.error("bad-circle", self.place(line), message, hint);
    }

    /// A drilling cycle: over the hole at the retract height, rapid down to the clearance, down with
    /// feed, at once or by pecks, and up in rapid; a reamer leaves the hole with feed.
    fn hole(&mut self, tip: Vec3, axis: Vec3, cycle: &ClCycle, point: &ClPoint, line: u32) {
        let thread = cycle.tap.map(|tap| self.thread((cycle, &tap), point, line));
        let feed = match thread {
            Some(None) => return,
            Some(Some(thread)) => Some(thread.pitch_mm * thread.speed_per_minute),
            None => self.feed(false, cycle.feed.or(point.feed), line),
        };
        let (Some(feed), thread) = (feed, thread.flatten()) else { return };
        let at = |height: f64| Stand { tip: tip + axis * height, axis };
        let cycle = &ClCycle { retract_mm: self.retract_mm(&at(0.0), cycle), ..*cycle };
        let way = Way::Line;
        let begin = self.path.strokes.len();
        let over = self.over_hole(&at(cycle.retract_mm), line);
        let rapid = Stroke { to: over, way, rapid: true, feed: 0.0, line };
        if (over.tip - at(cycle.clearance_mm).tip).norm() > SAME_MM {
            self.push(rapid);
        }
        // Where the retract height is the clearance, the tool arrives there.
        let arrived = (over.tip - at(cycle.clearance_mm).tip).norm() > SAME_MM;
        let down = self.path.strokes.len() + usize::from(!arrived);
        self.push(Stroke { to: at(cycle.clearance_mm), ..rapid });
        for depth in pecks(cycle) {
            self.push(Stroke { to: at(-depth), way, rapid: false, feed, line });
            if depth < cycle.depth_mm {
                self.push(Stroke { to: at(cycle.clearance_mm), ..rapid });
                let above = (BACK_MM - depth).min(cycle.clearance_mm);
                self.push(Stroke { to: at(above), ..rapid });
            }
        }
        if cycle.dwell_s > 0.0 {
            self.path.events.push((self.path.strokes.len(), Event::Dwell(cycle.dwell_s)));
        }
        if cycle.feeds_out {
            self.push(Stroke { to: at(cycle.clearance_mm), way, rapid: false, feed, line });
        }
        let last = self.path.strokes.len();
        self.push(Stroke { to: at(cycle.retract_mm), ..rapid });
        let (surface, cycle) = (Stand { tip, axis }, *cycle);
        self.path.holes.push(Drilled { begin, down, last, surface, cycle, feed, thread });
    }

    /// The retract height of a hole; with RTRCTO,AUTO where the tool comes from, if that is higher.
    fn retract_mm(&self, surface: &Stand, cycle: &ClCycle) -> f64 {
        let from = self
            .path
            .strokes
            .last_to()
            .filter(|from| cycle.to_begin && angle(&from.axis, &surface.axis) <= SAME_RAD);
        let height = from.map(|from| (from.tip - surface.tip).dot(&surface.axis));
        height.map_or(cycle.retract_mm, |height| height.max(cycle.retract_mm))
    }

    /// Where the tool comes to stand over a hole: at its retract height, or higher where it comes
    /// from higher up; from lower down it rises before it crosses.
    fn over_hole(&mut self, retracted: &Stand, line: u32) -> Stand {
        let Some(from) = self.path.strokes.last_to() else { return *retracted };
        if angle(&from.axis, &retracted.axis) > SAME_RAD {
            return *retracted;
        }
        let higher = (from.tip - retracted.tip).dot(&retracted.axis);
        let beside = from.tip - retracted.tip - retracted.axis * higher;
        if higher < -SAME_MM && beside.norm() > SAME_MM {
            let to = Stand { tip: from.tip - retracted.axis * higher, ..from };
            self.push(Stroke { to, way: Way::Line, rapid: true, feed: 0.0, line });
        }
        Stand { tip: retracted.tip + retracted.axis * higher.max(0.0), ..*retracted }
    }

    fn push(&mut self, stroke: Stroke) {
        self.path.strokes.push(&stroke);
    }

    /// In mm/min; `None` where the file has none, which is reported once.
    fn feed(&mut self, rapid: bool, feed: Option<Feed>, line: u32) -> Option<f64> {
        if rapid {
            return Some(0.0);
        }
        let value = match feed {
            Some(Feed { mode: FeedMode::PerRevolution, value }) => Some(value * self.speed),
            Some(feed) => Some(feed.value),
            None => self.options.usual_feed_mm_per_min,
        };
        let value = value.filter(|v| *v > 0.0);
        if value.is_none() && !self.told_no_feed {
            self.told_no_feed = true;
            let message = match feed {
                None => "the tool moves before any FEDRAT",
                Some(_) => "a feed per revolution, but the spindle has no speed",
            };
            let hint = "write FEDRAT (and SPINDL) in the file, or give --feed";
            self.problems.error("no-feed", self.place(line), message.to_owned(), hint);
        }
        value
    }
}

/// The arc that ends at a point; none where the circle does not lead there.
fn arc(circle: &ClCircle, from: &Stand, to: &Stand) -> Option<Way> {
    let (center, normal) = (Vec3::from(circle.center_mm), Vec3::from(circle.normal));
    let flat = |p: Vec3| {
        let arm = p - center;
        arm - normal * normal.dot(&arm)
    };
    if flat(from.tip).norm() < 1e-6 || !circle.leads(&from.tip.into(), &to.tip.into()) {
        return None;
    }
    let angle_rad = circle.turn_rad(&from.tip.into(), &to.tip.into()).ok()?;
    Some(Way::Arc { center, normal, angle_rad })
}
