//! What each tool passes through while a program runs.

use std::collections::BTreeMap;
use trueaxis_cut::{Cut, Cutter, Sweep, ToolPose};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command};
use trueaxis_motion::{Batch, Job, Observer, SetUpTool};

/// Where in a program something happened.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Origin {
    /// Which file.
    pub program: u32,
    /// Its line.
    pub line: u32,
    /// When, from the start of the program, s.
    pub time_s: f64,
    /// The tool.
    pub tool: u32,
}

/// A place where the tool was.
#[derive(Debug, Clone, Copy)]
struct Stop {
    nominal: ToolPose,
    actual: ToolPose,
    command: Command,
    approach: Approach,
    program: u32,
    line: u32,
    time_s: f64,
}

/// The path of a program, tool after tool.
pub struct CutPath<'j> {
    job: &'j Job,
    /// The error of the tip where the zero was set, mm.
    zero_mm: Vec3,
    /// Of each tool stops, and the numbers of those that begin again after another tool.
    tools: BTreeMap<u32, Vec<Stop>>,
    begins: BTreeMap<u32, Vec<usize>>,
    last: Option<u32>,
}

impl<'j> CutPath<'j> {
    /// Of a program; what the tip was off where the zero was set is no deviation of the part.
    pub fn new(job: &'j Job, zero_mm: &Vec3) -> Self {
        Self { job, zero_mm: *zero_mm, tools: BTreeMap::new(), begins: BTreeMap::new(), last: None }
    }

    /// Moves the actual tools to where a machine of other errors has them: deviations of tip and axis by command and approach, for each of
    /// [`CutPath::machines`].
    pub(super) fn displace<'m, E, D>(
        &mut self,
        machines: &'m [Machine],
        deviations: impl Fn(&'m Machine) -> D,
    ) -> Result<(), E>
    where
        D: Fn(&Command, &Approach) -> Result<[Vec3; 2], E>,
    {
        for (stops, machine) in self.tools.values_mut().zip(machines) {
            let deviation = deviations(machine);
            for stop in stops {
                let [tip, axis] = deviation(&stop.command, &stop.approach)?;
                stop.actual = ToolPose {
                    tip_mm: stop.nominal.tip_mm + tip - self.zero_mm,
                    axis: (stop.nominal.axis + axis).normalize(),
                };
            }
        }
        Ok(())
    }

    /// How many steps there are.
    pub fn steps(&self) -> usize {
        let stops: usize = self.tools.values().map(Vec::len).sum();
        stops - self.begins.values().map(Vec::len).sum::<usize>()
    }

    /// The sweeps of the actual tools and of the nominal ones.
    ///
    /// # Errors
    /// In words: a tool whose shape is not known, or that is no cutter.
    pub fn sweeps(&self) -> Result<(Vec<Sweep>, Vec<Sweep>), String> {
        let (mut actual, mut nominal) = (Vec::new(), Vec::new());
        for (number, stops) in &self.tools {
            let cutter = cutter(*number, self.job.setup.tools.get(number))?;
            let pairs = || self.pairs(*number, stops);
            let swept = |steps: Vec<[ToolPose; 2]>| {
                Sweep::new(cutter, steps).map_err(|e| format!("tool {number}: {e}"))
            };
            actual.push(swept(pairs().map(|[a, b]| [a.actual, b.actual]).collect())?);
            nominal.push(swept(pairs().map(|[a, b]| [a.nominal, b.nominal]).collect())?);
        }
        Ok((actual, nominal))
    }

    /// Each step of a tool.
    fn pairs<'s>(&'s self, number: u32, stops: &'s [Stop]) -> impl Iterator<Item = [&'s Stop; 2]> {
        let begins = self.begins.get(&number).map_or(&[][..], Vec::as_slice);
        let whole = (1..stops.len()).filter(move |i| begins.binary_search(i).is_err());
        whole.map(move |i| [&stops[i - 1], &stops[i]])
    }

    /// The step of a cut.
    fn step(&self, cut: &Cut) -> Option<(u32, [&Stop; 2])> {
        let (number, stops) = self.tools.iter().nth(cut.sweep)?;
        let begins = self.begins.get(number).map_or(&[][..], Vec::as_slice);
        // Every beginning before it makes the number of a stop one larger than that of its step.
        let mut at = cut.step + 1;
        for begin in begins.iter().skip(1) {
            at += usize::from(*begin <= at);
        }
        Some((*number, [stops.get(at - 1)?, stops.get(at)?]))
    }

    /// The block that made a cut.
    pub fn origin(&self, cut: &Cut) -> Origin {
        let Some((tool, [a, b])) = self.step(cut) else { return Origin::default() };
        let time_s = a.time_s + (b.time_s - a.time_s) * cut.place;
        Origin { program: b.program, line: b.line, time_s, tool }
    }

    /// Where the axes were, and from which side they came.
    pub(super) fn place(&self, cut: &Cut) -> Option<(Command, Approach)> {
        let (_, [a, b]) = self.step(cut)?;
        let mut command = a.command;
        for (c, to) in command.iter_mut().zip(b.command) {
            *c += (to - *c) * cut.place;
        }
        Some((command, b.approach))
    }

    /// The machine with each tool, in the order of the sweeps.
    pub(super) fn machines(&self, mounted: &Machine) -> Vec<Machine> {
        let tip = |number: &u32| self.job.setup.tools.get(number).map(|tool| tool.tip_mm);
        let with = |number: &u32| match tip(number) {
            Some(tip) => mounted.clone().with_tip(tip),
            None => mounted.clone(),
        };
        self.tools.keys().map(with).collect()
    }
}

impl Observer for CutPath<'_> {
    fn path(&mut self, batch: &Batch<'_>) {
        // Before the first tool nothing is in the spindle that cuts.
        let is_empty = batch.tool == 0 && !self.job.setup.tools.contains_key(&0);
        if batch.nodes.is_empty() || is_empty {
            return;
        }
        let stops = self.tools.entry(batch.tool).or_default();
        if self.last != Some(batch.tool) {
            self.last = Some(batch.tool);
            self.begins.entry(batch.tool).or_default().push(stops.len());
        }
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let there = batch.deviation(i);
            let (tip, axis) = (there.nominal_tip.vector(), there.nominal_axis.vector());
            let actual = ToolPose {
                tip_mm: tip + there.tip_mm - self.zero_mm,
                axis: (axis + there.axis).normalize(),
            };
            stops.push(Stop {
                nominal: ToolPose { tip_mm: tip, axis },
                actual,
                command: node.command,
                approach: batch.approach(i),
                program: node.origin.program,
                line: node.origin.line,
                time_s: stamp.time_s,
            });
        }
    }
}

/// The cutter of a tool of the set-up.
fn cutter(number: u32, tool: Option<&SetUpTool>) -> Result<Cutter, String> {
    let tool = tool.ok_or_else(|| format!("tool {number}: the set-up file does not state it"))?;
    tool.cutter().map_err(|e| format!("tool {number}: {e}"))
}
