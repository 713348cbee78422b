//! What the tools of a program take off the stock, and what they must not touch.
//!
//! ```text
//! SetUp { [stock], [part], tools } ──Machining::watch──> Observer
//!     nominal poses of each tool, no farther apart than the stock resolves ──trueaxis_cut::stock──> removed, by block
//!     rapid through material, shank in material, gouges of the part ──> issues
//! ```

use super::collide::{BodyModel, Mesh, Role};
use super::issues::{IssueKind, Log};
use super::setup::{SetUp, SetUpTool};
use super::{Batch, Densify, Observer};
use std::collections::BTreeMap;
use trueaxis_cut::stock::{Step, Stock, StockError, Taken};
use trueaxis_cut::{Cutter, ToolPose};
use trueaxis_geometry::frame::Point;
use trueaxis_geometry::{Vec3, angle};
use trueaxis_input::{Diagnostics, Place};
use trueaxis_machine::chain::Link;
use trueaxis_nc::moves::Origin;

/// What goes less deep is no contact: between two poses a cutter leaves walls that are rough by far less. Unit: mm.
const CONTACT_MM: f64 = 0.05;
/// Poses of one tool that are cut together.
const CHUNK: usize = 4096;
/// How issues call it.
const STOCK: &str = "stock";
/// Poses of a whole program: some minutes of work.
const MOST_POSES: usize = 50_000_000;
/// A cutter is no wider than so many times the diagonal of the stock.
const WIDEST: f64 = 10.0;
/// A tool is no longer than so many times that.
const LONGEST: f64 = 100.0;
/// Places of the lattice of a picture.
const MOST_PLACES: usize = 600_000;
/// Without a stated resolution the longest edge of the stock has so many lines.
const LINES: f64 = 200.0;
/// Thin tools make them closer, up to so many.
const MOST_LINES: f64 = 1000.0;
/// Not closer than this: paths are drawn to a tenth of it. Unit: mm.
const FINEST_MM: f64 = 0.05;
/// A cutter is so many times as wide as lines are apart, or could pass between them: the largest circle between the lines of a
/// square lattice has a diameter of √2 of its sides.
const LEAST_WIDTH: f64 = 1.5;
/// What can be done about a cutter that is not known.
const STATE_CUTTER: &str = "state diameter, corner_radius and, where it is another, the cutter of the tool in the set-up file";

/// A tool as the stock sees it.
struct Tool {
    name: String,
    cutter: Cutter,
    /// What does not cut: where it begins along the axis, and its shape.
    above: Vec<(f64, Cutter)>,
    /// From the tip to its farthest point.
    reach_mm: f64,
}

/// What the stock is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Question {
    /// Whether what does not cut is in it.
    Shank,
    /// Whether the cutter is in it in rapid.
    Rapid,
    /// What the cutter takes.
    Taken,
}

/// A pose on its way to the stock.
#[derive(Clone, Copy)]
struct Moment {
    origin: Origin,
    time_s: f64,
    /// How long the step to it takes.
    lasts_s: f64,
    is_rapid: bool,
}

/// What a block took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BlockUse {
    /// Volume, mm³.
    pub removed_mm3: f64,
    /// With feed in material, s.
    pub cutting_s: f64,
    /// With feed in the air, s.
    pub air_s: f64,
}

/// What became of the stock.
#[derive(Debug, Clone)]
pub struct Machined {
    /// What remains.
    pub stock: Stock,
    /// Its volume before the first cut, mm³.
    pub before_mm3: f64,
    /// What was cut from the part, mm³; none without a part in the set-up. Unit: mm³.
    pub gouged_mm3: Option<f64>,
    /// What remains beside the part, mm³; none without a part in the set-up. Unit: mm³.
    pub excess_mm3: Option<f64>,
    /// What every block took, in the order of programs and lines.
    pub blocks: Vec<(Origin, BlockUse)>,
}

impl Machined {
    /// The bodies on the workpiece with the stock as it remains; a picture of it has so many places.
    pub fn bodies(&self, of: &[BodyModel]) -> Vec<BodyModel> {
        let remains = |body: &BodyModel| {
            let mesh = Mesh::new(self.stock.surface(MOST_PLACES))?;
            let name = format!("{} as it remains", body.name);
            Some(BodyModel { name, placement: Link::identity(), mesh, ..body.clone() })
        };
        let replaced = |body: &BodyModel| match body.role {
            Role::Stock => remains(body),
            _ => Some(body.clone()),
        };
        of.iter().filter_map(replaced).collect()
    }

    /// How far the three directions differ about their mean: what the resolution costs, mm³.
    pub fn spread_mm3(&self) -> f64 {
        let mean = self.stock.volume_mm3();
        self.stock.volumes_mm3().iter().map(|v| (v - mean).abs()).fold(0.0, f64::max)
    }

    /// All blocks together.
    pub fn total(&self) -> BlockUse {
        self.blocks.iter().fold(BlockUse::default(), |sum, (_, one)| BlockUse {
            removed_mm3: sum.removed_mm3 + one.removed_mm3,
            cutting_s: sum.cutting_s + one.cutting_s,
            air_s: sum.air_s + one.air_s,
        })
    }
}

/// Cuts the stock of a set-up along the nominal path of a program.
pub struct Machining {
    stock: Stock,
    before_mm3: f64,
    tools: BTreeMap<u32, Result<Tool, Unknown>>,
    spacing_mm: f64,
    /// Farther from its tip no tool is in the stock while its tip is near, mm.
    diagonal_mm: f64,
    /// What comes later does not count, s.
    end_s: f64,
    /// How many poses there were, and where they became too many.
    count: usize,
    ended_at: Option<Origin>,
    tool: u32,
    before: Option<(ToolPose, f64)>,
    poses: Vec<ToolPose>,
    moments: Vec<Moment>,
    /// What every block took, by program and line.
    blocks: BTreeMap<(u32, u32), BlockUse>,
    gouged_mm3: f64,
    /// Tools whose shape is not known, with the block where they come and the reason.
    unknown: BTreeMap<u32, (Origin, Unknown)>,
    log: Log,
}

/// Why it is not known what a tool cuts, and what to do.
type Unknown = (String, String);

impl Machining {
    /// The stock of a set-up.
    ///
    /// # Errors
    /// No stock, one that is not closed, a resolution that is none; in words, with what to do.
    pub fn watch(setup: &SetUp) -> Result<Self, (String, String)> {
        let body = |role: Role| setup.bodies.iter().find(|b| b.role == role);
        let stock = body(Role::Stock).ok_or_else(|| {
            let hint = "[stock] with box = { … }, cylinder, or stl = \"blank.stl\", in the workpiece frame";
            ("the set-up file states no stock".to_owned(), hint.to_owned())
        })?;
        let triangles = placed(stock);
        let known = setup.tools.iter().map(|(number, tool)| (*number, Tool::of(*number, tool)));
        let known: BTreeMap<u32, Result<Tool, String>> = known.collect();
        let widths = known.values().flatten().map(Tool::width_mm);
        let thinnest_mm = widths.fold(f64::INFINITY, f64::min);
        let usual = || usual(&triangles, thinnest_mm);
        let resolution_mm = setup.stock_resolution_mm.unwrap_or_else(usual);
        let refused = |name: &str, error: StockError| {
            let hint = "a closed mesh in mm, and a `resolution` of [stock] such as \"0.5 mm\"";
            (format!("{name}: {error}"), hint.to_owned())
        };
        let mut cut =
            Stock::of_mesh(&triangles, resolution_mm).map_err(|e| refused(&stock.name, e))?;
        if let Some(part) = body(Role::Part) {
            cut = cut.with_part(&placed(part)).map_err(|e| refused(&part.name, e))?;
        }
        let [low, high] = cut.corners_mm();
        let diagonal_mm = (high - low).norm();
        let fits = |tool: Result<Tool, String>| {
            let known = tool.and_then(|tool| tool.fits(diagonal_mm));
            known.map_err(|why| (why, STATE_CUTTER.to_owned()))?.seen_at(resolution_mm)
        };
        let tools = known.into_iter().map(|(number, tool)| (number, fits(tool)));
        Ok(Self {
            before_mm3: cut.volume_mm3(),
            stock: cut,
            tools: tools.collect(),
            spacing_mm: 0.6 * resolution_mm,
            diagonal_mm,
            end_s: f64::INFINITY,
            count: 0,
            ended_at: None,
            tool: 0,
            before: None,
            poses: Vec::new(),
            moments: Vec::new(),
            blocks: BTreeMap::new(),
            gouged_mm3: 0.0,
            unknown: BTreeMap::new(),
            log: Log::default(),
        })
    }

    /// The same up to a time of the program, s.
    #[must_use]
    pub fn until(self, end_s: f64) -> Self {
        Self { end_s, ..self }
    }

    /// Whether a path is drawn finely enough: by a tenth of what the stock resolves.
    pub fn follows(&self, densify: &Densify) -> bool {
        match *densify {
            Densify::Tolerance { chord_mm, .. }
            | Densify::Places { chord_mm, .. }
            | Densify::Tool { chord_mm, .. } => chord_mm <= 0.1 * self.stock.resolution_mm(),
            Densify::Off | Densify::Count { .. } => false,
        }
    }

    /// What became of the stock after the last pose, the issues, and the errors; `programs` are those of the run.
    pub fn finish(mut self, programs: &[String]) -> (Machined, Log, Diagnostics) {
        self.flush();
        let problems = self.problems(programs);
        let excess_mm3 = self.stock.excess_mm3();
        let origin = |(program, line): (u32, u32)| Origin { program, line };
        let machined = Machined {
            stock: self.stock,
            before_mm3: self.before_mm3,
            gouged_mm3: excess_mm3.map(|_| self.gouged_mm3),
            excess_mm3,
            blocks: self.blocks.into_iter().map(|(at, block)| (origin(at), block)).collect(),
        };
        (machined, self.log, problems)
    }

    /// Tools of unknown shape, and a stock that was not cut to the end.
    fn problems(&self, programs: &[String]) -> Diagnostics {
        let mut problems = Diagnostics::new();
        for (number, (origin, (why, hint))) in &self.unknown {
            let place = place_of(*origin, programs);
            let message = format!("tool {number} comes, and what it cuts is not known: {why}");
            problems.error("unknown-cutter", place, message, hint);
        }
        if let Some(origin) = self.ended_at {
            let place = place_of(origin, programs);
            let message = format!(
                "from this line on the stock was not cut: the tools pass through more than {MOST_POSES} places"
            );
            let hint = "check the units of tool lengths and offsets; a larger `resolution` of [stock] needs fewer places";
            problems.error("stock-not-cut", place, message, hint);
        }
        problems
    }

    /// Cuts by the poses that are still waiting.
    fn flush(&mut self) {
        let poses = std::mem::take(&mut self.poses);
        let moments = std::mem::take(&mut self.moments);
        let Some(Ok(tool)) = self.tools.get(&self.tool) else { return };
        let mut steps = Vec::with_capacity(2 * poses.len());
        let mut questions = Vec::with_capacity(2 * poses.len());
        for (pose, moment) in poses.iter().zip(&moments) {
            let mut ask = |question, cutter, pose: ToolPose| {
                let takes = question == Question::Taken;
                let inset_mm = if takes { 0.0 } else { CONTACT_MM };
                steps.push(Step { cutter, pose, inset_mm, takes });
                questions.push((question, *moment));
            };
            for (at_mm, body) in &tool.above {
                let tip_mm = pose.tip_mm + pose.axis * *at_mm;
                ask(Question::Shank, body, ToolPose { tip_mm, ..*pose });
            }
            if moment.is_rapid {
                ask(Question::Rapid, &tool.cutter, *pose);
            }
            ask(Question::Taken, &tool.cutter, *pose);
        }
        let found = self.stock.work(&steps);
        let name = tool.name.clone();
        for (taken, (question, moment)) in found.iter().zip(questions) {
            self.answer(question, &moment, taken, &name);
        }
    }

    fn answer(&mut self, question: Question, moment: &Moment, taken: &Taken, tool: &str) {
        let at = (moment.origin, moment.time_s);
        let is_inside = taken.longest_mm > 0.0;
        match question {
            Question::Shank if is_inside => {
                let first = format!("shank of {tool}");
                let kind = IssueKind::Collision { first, second: STOCK.to_owned() };
                self.log.note_at(kind, at, 0.0, 0.0);
            }
            Question::Rapid if is_inside => {
                let first = tool.to_owned();
                let kind = IssueKind::RapidInStock { first, second: STOCK.to_owned() };
                self.log.note_at(kind, at, 0.0, 0.0);
            }
            Question::Shank | Question::Rapid => {}
            Question::Taken => {
                self.count(taken, moment);
                self.log.close(moment.time_s);
            }
        }
    }

    fn count(&mut self, taken: &Taken, moment: &Moment) {
        let Origin { program, line } = moment.origin;
        let block = self.blocks.entry((program, line)).or_default();
        block.removed_mm3 += taken.mean_mm3();
        if !moment.is_rapid {
            match taken.longest_mm > 0.0 {
                true => block.cutting_s += moment.lasts_s,
                false => block.air_s += moment.lasts_s,
            }
        }
        self.gouged_mm3 += taken.gouged_mm3.iter().sum::<f64>() / 3.0;
        if taken.gouge_mm > CONTACT_MM {
            let kind = IssueKind::Gouge { tool: self.tool };
            self.log.note_at(kind, (moment.origin, moment.time_s), taken.gouge_mm, 0.0);
        }
    }

    /// Poses from the last one to a new one, no farther apart than the stock resolves.
    fn go(&mut self, to: ToolPose, time_s: f64, origin: Origin, is_rapid: bool) {
        let Some((from, from_s)) = self.before.replace((to, time_s)) else { return };
        let reach_mm = match self.tools.get(&self.tool) {
            Some(Ok(tool)) if self.ended_at.is_none() => tool.reach_mm.min(self.diagonal_mm),
            _ => return,
        };
        if from_s >= self.end_s {
            return;
        }
        // What lies after the end is cut off.
        let (to, time_s) = match time_s > self.end_s {
            true => (from.towards(&to, (self.end_s - from_s) / (time_s - from_s)), self.end_s),
            false => (to, time_s),
        };
        let way_mm = (to.tip_mm - from.tip_mm).norm();
        let turned_mm = reach_mm * angle(&from.axis, &to.axis);
        let count = ((way_mm + turned_mm) / self.spacing_mm).ceil().max(1.0);
        if count > (MOST_POSES - self.count) as f64 {
            self.ended_at = Some(origin);
            return;
        }
        self.count += count as usize;
        let lasts_s = (time_s - from_s) / count;
        for k in 1..=count as usize {
            let part = k as f64 / count;
            self.poses.push(from.towards(&to, part));
            let time_s = from_s + (time_s - from_s) * part;
            self.moments.push(Moment { origin, time_s, lasts_s, is_rapid });
            if self.poses.len() >= CHUNK {
                self.flush();
            }
        }
    }

    /// Another tool comes; its path begins where it is then.
    fn change(&mut self, number: u32, origin: Origin) {
        self.flush();
        self.tool = number;
        self.before = None;
        match self.tools.get(&number) {
            Some(Ok(_)) => {}
            Some(Err(why)) => {
                self.unknown.entry(number).or_insert((origin, why.clone()));
            }
            // Without a tool nothing is in the spindle.
            None if number == 0 => {}
            None => {
                let why = ("the set-up file does not state it".to_owned(), STATE_CUTTER.to_owned());
                self.unknown.entry(number).or_insert((origin, why));
            }
        }
    }
}

impl Observer for Machining {
    fn path(&mut self, batch: &Batch<'_>) {
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            if batch.tool != self.tool {
                self.change(batch.tool, node.origin);
            }
            let there = batch.deviation(i);
            let (tip_mm, axis) = (there.nominal_tip.vector(), there.nominal_axis.vector());
            self.go(ToolPose { tip_mm, axis }, stamp.time_s, node.origin, node.is_rapid());
        }
    }
}

impl Tool {
    fn of(number: u32, tool: &SetUpTool) -> Result<Self, String> {
        let cutter = tool.cutter()?;
        let length_mm = -tool.tip_mm.z;
        let mut above = Vec::new();
        let mut at_mm = cutter.height_mm();
        // Cylinders above the one that cuts; without them the shank is as thick as the cutter.
        for segment in tool.shape.iter().skip(1) {
            let body = Cutter::flat(segment.diameter_mm, segment.length_mm);
            above.push((at_mm, body.map_err(|e| e.to_string())?));
            at_mm += segment.length_mm;
        }
        if tool.shape.is_empty() && length_mm > at_mm {
            let body = Cutter::flat(2.0 * cutter.widest_mm(), length_mm - at_mm);
            above.push((at_mm, body.map_err(|e| e.to_string())?));
        }
        let name = match tool.name.is_empty() {
            true => format!("tool {number}"),
            false => tool.name.clone(),
        };
        Ok(Self { name, cutter, above, reach_mm: length_mm.max(at_mm) })
    }
}

impl Tool {
    /// A tool many times as wide or as long as the stock is a slip of the unit; its way through the stock would have no end.
    fn fits(self, diagonal_mm: f64) -> Result<Self, String> {
        let width_mm = self.width_mm();
        if width_mm > WIDEST * diagonal_mm {
            return Err(format!(
                "it is {width_mm:.0} mm wide, and the stock measures {diagonal_mm:.0} mm across its corners"
            ));
        }
        if self.reach_mm > LONGEST * diagonal_mm {
            return Err(format!(
                "it is {:.0} mm long, and the stock measures {diagonal_mm:.0} mm across its corners",
                self.reach_mm
            ));
        }
        Ok(self)
    }

    fn width_mm(&self) -> f64 {
        2.0 * self.cutter.widest_mm()
    }

    /// A cutter that is thinner than the stock is fine would pass between its lines without a trace.
    fn seen_at(self, resolution_mm: f64) -> Result<Self, Unknown> {
        let width_mm = self.width_mm();
        let needed_mm = width_mm / LEAST_WIDTH;
        if resolution_mm <= needed_mm {
            return Ok(self);
        }
        let why = format!(
            "it is {width_mm} mm wide, and the stock is kept on lines {resolution_mm:.3} mm apart, between which it could pass"
        );
        let hint =
            format!("state `resolution = \"{:.3} mm\"` of [stock] or less", 0.999 * needed_mm);
        Err((why, hint))
    }
}

/// The triangles of a body in the workpiece frame.
fn placed(body: &BodyModel) -> Vec<[Vec3; 3]> {
    let at = |p: &Vec3| (body.placement * Point::from_vector(*p)).vector();
    body.mesh.triangles().iter().map(|t| [at(&t[0]), at(&t[1]), at(&t[2])]).collect()
}

fn place_of(origin: Origin, programs: &[String]) -> Place {
    let file = programs.get(origin.program as usize).cloned().unwrap_or_default();
    Place { file, line: origin.line as usize, column: 1 }
}

/// The edges of the box around triangles.
fn extent(triangles: &[[Vec3; 3]]) -> Vec3 {
    let corners = || triangles.iter().flatten();
    let low = corners().fold(Vec3::repeat(f64::MAX), |a, b| a.inf(b));
    corners().fold(Vec3::repeat(f64::MIN), |a, b| a.sup(b)) - low
}

/// The resolution where none is stated: as fine as the thinnest tool needs, if that can be kept.
fn usual(triangles: &[[Vec3; 3]], thinnest_mm: f64) -> f64 {
    let longest_mm = extent(triangles).max();
    let usual_mm = (longest_mm / LINES).max(0.1);
    usual_mm.min(thinnest_mm / LEAST_WIDTH).max(longest_mm / MOST_LINES).max(FINEST_MM)
}
