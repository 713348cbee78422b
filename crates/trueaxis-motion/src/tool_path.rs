//! From axis positions to the tool: nominal and actual pose of every node, in batches.

use super::axis_path::{Fault, Node};
use super::clock::Stamp;
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{Approach, Command, MAX_AXES};
use trueaxis_machine::batch::{BatchError, Commands, CompiledMachine, DeviationTable};
use trueaxis_machine::errors::ErrorValues;
use trueaxis_machine::{Deviation, Machine};

/// A motion smaller than this has no direction, mm and rad: where an axis is at rest the kinematics of the
/// control round, and corrections of other axes reach it through squareness.
pub const STILL: f64 = 1e-7;

/// Nodes that are worked on together.
pub(super) const BATCH: usize = 4096;

/// A stretch of the path with its times and poses; columns of one length.
pub struct Batch<'a> {
    /// The machine with the tool in the spindle, at the temperatures of this stretch.
    pub machine: &'a Machine,
    /// The time of the program whose temperatures the machine has, s; 0 without a log.
    pub since_s: f64,
    /// The tool in the spindle, 0 before the first.
    pub tool: u32,
    /// The nodes.
    pub nodes: &'a [Node],
    /// When and how fast each is passed.
    pub stamps: &'a [Stamp],
    /// Nominal pose and deviation of each.
    pub poses: &'a DeviationTable,
    /// Each deviation of the tip along feed, normal and binormal, mm.
    pub along_path_mm: &'a [Vec3],
    /// The side from which each axis came. Unit: 1.
    pub approaches: [&'a [f64]; MAX_AXES],
}

impl Batch<'_> {
    /// Nominal pose and deviation of a node.
    pub fn deviation(&self, i: usize) -> Deviation {
        self.poses.at(i)
    }

    /// From which side the axes came to a node.
    pub fn approach(&self, i: usize) -> Approach {
        self.approaches.map(|column| column.get(i).copied().unwrap_or(0.0))
    }
}

/// Evaluates nodes on one machine with one tool; its memory does not grow with the path.
pub(super) struct ToolPath {
    machine: CompiledMachine,
    since_s: f64,
    axes: usize,
    positions: [Vec<f64>; MAX_AXES],
    approaches: [Vec<f64>; MAX_AXES],
    poses: DeviationTable,
    along_path_mm: Vec<Vec3>,
    command: Command,
    approach: Approach,
    tip: Option<Vec3>,
    tangent: Vec3,
}

impl ToolPath {
    pub fn new(machine: CompiledMachine, start: Command) -> Self {
        Self {
            axes: machine.machine().axes().len(),
            machine,
            since_s: 0.0,
            positions: Default::default(),
            approaches: Default::default(),
            poses: DeviationTable::zeros(0),
            along_path_mm: Vec::new(),
            command: start,
            approach: Approach::default(),
            tip: None,
            tangent: Vec3::x(),
        }
    }

    /// The same path goes on with another tool.
    pub fn change_tool(&mut self, machine: CompiledMachine) {
        self.machine = machine;
        self.tip = None;
    }

    /// The same path goes on with the same tool at the temperatures of a time.
    pub fn change_temperatures(&mut self, machine: CompiledMachine, since_s: f64) {
        (self.machine, self.since_s) = (machine, since_s);
    }

    /// Poses and deviations of nodes; what the machine file does not determine goes to `faults`.
    pub fn evaluate<'a>(
        &'a mut self,
        tool: u32,
        nodes: &'a [Node],
        stamps: &'a [Stamp],
        faults: &mut Vec<Fault>,
    ) -> Batch<'a> {
        self.fill(nodes);
        if self.poses.len() != nodes.len() {
            self.poses = DeviationTable::zeros(nodes.len());
        }
        self.deviate(nodes, faults);
        self.split();
        let approaches = self.approaches.each_ref().map(Vec::as_slice);
        let along_path_mm = &self.along_path_mm;
        Batch {
            machine: self.machine.machine(),
            since_s: self.since_s,
            tool,
            nodes,
            stamps,
            poses: &self.poses,
            along_path_mm,
            approaches,
        }
    }

    fn fill(&mut self, nodes: &[Node]) {
        self.positions.iter_mut().chain(&mut self.approaches).for_each(Vec::clear);
        for node in nodes {
            for i in 0..self.axes {
                let by = node.command[i] - self.command[i];
                if by.abs() > STILL {
                    self.approach[i] = by.signum();
                }
                self.positions[i].push(node.command[i]);
                self.approaches[i].push(self.approach[i]);
            }
            self.command = node.command;
        }
    }

    /// Node by node where the batch stops: what is unknown stays without deviation.
    fn deviate(&mut self, nodes: &[Node], faults: &mut Vec<Fault>) {
        let mut from = 0;
        while from < nodes.len() {
            let positions: Vec<&[f64]> =
                self.positions[..self.axes].iter().map(|c| &c[from..]).collect();
            let approaches: Vec<&[f64]> =
                self.approaches[..self.axes].iter().map(|c| &c[from..]).collect();
            let commands = Commands::new(&positions).approached(&approaches);
            let mut rest = self.poses.columns().skip(from);
            let Err(error) = self.machine.deviations(&commands, &mut rest) else { return };
            let Some(index) = error.index() else { return };
            let node = &nodes[from + index];
            let machine = self.machine.machine();
            let inside = machine.nearest_in_travel(&node.command);
            let approach = std::array::from_fn(|a| {
                self.approaches[a].get(from + index).copied().unwrap_or(0.0)
            });
            // Beyond the travel, which is reported as an issue, the errors of its end hold on.
            let errors = machine.errors_at(&inside, &approach);
            if (errors.is_err() || inside == node.command) && faults.len() < 100 {
                faults.push(unknown(node, &error));
            }
            rest.set(index, &machine.deviation(&node.command, &errors.unwrap_or_default()));
            from += index + 1;
        }
    }

    /// Along the path, along the part of the tool axis across it, and across both.
    ///
    /// ```text
    ///     t = Δtip/|Δtip|     n = (a − t(t·a))/|…|     b = t × n           docs/model.md eq. 38
    /// ```
    fn split(&mut self) {
        self.along_path_mm.clear();
        for i in 0..self.poses.len() {
            let [tip, axis, d, _] = self.poses.vectors_at(i);
            if let Some(step) = self.tip.and_then(|before| (tip - before).try_normalize(1e-9)) {
                self.tangent = step;
            }
            self.tip = Some(tip);
            let [feed, normal, binormal] = path_frame(self.tangent, axis);
            self.along_path_mm.push(Vec3::new(d.dot(&feed), d.dot(&normal), d.dot(&binormal)));
        }
    }
}

/// Feed, normal and binormal of a path: the normal lies in the plane of feed and tool axis, on the
/// side of the spindle; where the tool moves along its own axis it is any direction across.
pub(super) fn path_frame(tangent: Vec3, axis: Vec3) -> [Vec3; 3] {
    let across = axis - tangent * tangent.dot(&axis);
    let normal = across.try_normalize(1e-9).unwrap_or_else(|| {
        let other = if tangent.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
        (other - tangent * tangent.dot(&other)).normalize()
    });
    [tangent, normal, tangent.cross(&normal)]
}

/// The errors at a command; where the machine file ends before it, those of the end of the travel,
/// or none.
pub(super) fn errors_near(
    machine: &Machine,
    command: &Command,
    approach: &Approach,
) -> ErrorValues {
    let inside = || machine.errors_at(&machine.nearest_in_travel(command), approach);
    machine.errors_at(command, approach).or_else(|_| inside()).unwrap_or_default()
}

fn unknown(node: &Node, error: &BatchError) -> Fault {
    Fault {
        origin: node.origin,
        word: None,
        code: "unknown-errors",
        message: match error {
            BatchError::Refused { source, .. } => {
                format!("the error tables of the machine end before this position: {source}")
            }
            other => other.to_string(),
        },
        hint: "cover the travel by the table, or say outside = \"clamp\" for it",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_frame_of_an_upright_tool() {
        let [t, n, b] = path_frame(Vec3::x(), Vec3::z());
        assert_eq!([t, n, b], [Vec3::x(), Vec3::z(), -Vec3::y()]);
        let [_, n, _] = path_frame(Vec3::z(), Vec3::z());
        assert_eq!(n, Vec3::x());
    }
}
