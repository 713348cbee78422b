//! What is kept of each node: one column for each figure.

use super::super::series::Quantity;
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Command, MAX_AXES};

/// It is reached in rapid.
pub(super) const RAPID: u8 = 1;
/// The axes wait until then.
pub(super) const WAITS: u8 = 2;

/// What is kept of a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub time_s: f64,
    pub command: Command,
    /// Nominal tip in the workpiece frame.
    pub tip_mm: [f64; 3],
    /// Deviation of the tip.
    pub off_um: [f32; 3],
    /// The same along feed, normal and binormal.
    pub along_um: [f32; 3],
    /// Length of the deviation of the tool axis.
    pub axis_urad: f32,
    /// Along the path, mm/s or deg/s.
    pub speed: f32,
    pub program: u32,
    pub line: u32,
    pub flags: u8,
    pub approach: [i8; MAX_AXES],
}

/// All nodes; the columns have one length.
#[derive(Debug, Clone, Default)]
pub(super) struct Columns {
    /// From mm and rad to what is shown, one for each axis.
    scale: Vec<f64>,
    pub time_s: Vec<f64>,
    /// Of the axes of the machine; the others are empty.
    command: [Vec<f64>; MAX_AXES],
    pub tip_mm: Vec<[f64; 3]>,
    pub off_um: Vec<[f32; 3]>,
    along_um: Vec<[f32; 3]>,
    axis_urad: Vec<f32>,
    pub speed: Vec<f32>,
    pub program: Vec<u32>,
    pub line: Vec<u32>,
    pub flags: Vec<u8>,
    pub approach: Vec<[i8; MAX_AXES]>,
}

impl Columns {
    pub fn of(machine: &Machine) -> Self {
        let scale = machine.axes().iter().map(|axis| match axis.kind {
            AxisKind::Linear => 1.0,
            AxisKind::Rotary => 180.0 / std::f64::consts::PI,
        });
        Self { scale: scale.collect(), ..Self::default() }
    }

    pub fn axes(&self) -> usize {
        self.scale.len()
    }

    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    pub fn push(&mut self, row: &Row) {
        self.time_s.push(row.time_s);
        let axes = self.axes();
        for (column, q) in self.command.iter_mut().zip(row.command).take(axes) {
            column.push(q);
        }
        self.tip_mm.push(row.tip_mm);
        self.off_um.push(row.off_um);
        self.along_um.push(row.along_um);
        self.axis_urad.push(row.axis_urad);
        self.speed.push(row.speed);
        self.program.push(row.program);
        self.line.push(row.line);
        self.flags.push(row.flags);
        self.approach.push(row.approach);
    }

    pub fn pop(&mut self) {
        self.truncate(self.len().saturating_sub(1));
    }

    fn truncate(&mut self, count: usize) {
        self.time_s.truncate(count);
        self.command.iter_mut().for_each(|column| column.truncate(count));
        self.tip_mm.truncate(count);
        self.off_um.truncate(count);
        self.along_um.truncate(count);
        self.axis_urad.truncate(count);
        self.speed.truncate(count);
        self.program.truncate(count);
        self.line.truncate(count);
        self.flags.truncate(count);
        self.approach.truncate(count);
    }

    /// Keeps the rows of these indices, which increase.
    pub fn keep(&mut self, indices: &[usize]) {
        fn pick<T: Copy>(column: &mut [T], indices: &[usize]) {
            indices.iter().enumerate().for_each(|(to, from)| column[to] = column[*from]);
        }
        let axes = self.axes();
        pick(&mut self.time_s, indices);
        self.command.iter_mut().take(axes).for_each(|column| pick(column, indices));
        pick(&mut self.tip_mm, indices);
        pick(&mut self.off_um, indices);
        pick(&mut self.along_um, indices);
        pick(&mut self.axis_urad, indices);
        pick(&mut self.speed, indices);
        pick(&mut self.program, indices);
        pick(&mut self.line, indices);
        pick(&mut self.flags, indices);
        pick(&mut self.approach, indices);
        self.truncate(indices.len());
    }

    pub fn command(&self, i: usize) -> Command {
        std::array::from_fn(|axis| self.command[axis].get(i).copied().unwrap_or(0.0))
    }

    /// Length of the deviation of the tip, µm.
    pub fn off(&self, i: usize) -> f32 {
        length(self.off_um[i])
    }

    /// The mean speed of an axis while it moves to a node, mm/s or rad/s; what takes no time has none.
    pub fn axis_speed(&self, axis: usize, i: usize) -> f64 {
        let Some(before) = i.checked_sub(1) else { return 0.0 };
        let took_s = self.time_s[i] - self.time_s[before];
        let move_by = self.command[axis][i] - self.command[axis][before];
        if took_s > 0.0 { move_by / took_s } else { 0.0 }
    }

    /// A quantity at a node, in the units of text output; the speed of an axis is that of its move to the node.
    pub fn value(&self, of: Quantity, i: usize) -> f32 {
        match of {
            Quantity::Position(axis) => (self.command[axis][i] * self.scale[axis]) as f32,
            Quantity::AxisSpeed(axis) => (self.axis_speed(axis, i) * self.scale[axis]) as f32,
            Quantity::PathSpeed => self.speed[i] * 60.0,
            Quantity::Tip => self.off(i),
            Quantity::Feed => self.along_um[i][0],
            Quantity::Normal => self.along_um[i][1],
            Quantity::Binormal => self.along_um[i][2],
            Quantity::ToolAxis => self.axis_urad[i],
        }
    }

    /// All quantities, in the order of [`Columns::column`].
    pub fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let axes = 0..self.axes();
        let all = [
            Quantity::PathSpeed,
            Quantity::Tip,
            Quantity::Feed,
            Quantity::Normal,
            Quantity::Binormal,
            Quantity::ToolAxis,
        ];
        let positions = axes.clone().map(Quantity::Position);
        positions.chain(axes.map(Quantity::AxisSpeed)).chain(all)
    }

    /// The number of a quantity.
    pub fn column(&self, of: Quantity) -> usize {
        let axes = self.axes();
        match of {
            Quantity::Position(axis) => axis,
            Quantity::AxisSpeed(axis) => axes + axis,
            Quantity::PathSpeed => 2 * axes,
            Quantity::Tip => 2 * axes + 1,
            Quantity::Feed => 2 * axes + 2,
            Quantity::Normal => 2 * axes + 3,
            Quantity::Binormal => 2 * axes + 4,
            Quantity::ToolAxis => 2 * axes + 5,
        }
    }
}

pub(super) fn length([x, y, z]: [f32; 3]) -> f32 {
    (x * x + y * y + z * z).sqrt()
}
