//! The correction of tip and tool axis together, in the frame in which the control adds offsets.
//!
//! ```text
//!     q programmed ──Compensator──> q_c, where the actual tool stands as the nominal one does at q
//!     Machine:    offset = q_c − q, axis by axis
//!     Workpiece:  rotary axes: q_c − q;   X Y Z: e_i · (tip(q_c) − tip(q)), nominal, in the workpiece
//!     e_i = tip(0 + 1 mm of axis i) − tip(0): X Y Z as the control names them with all rotary axes at 0
//! ```
//!
//! With tool-centre-point control a control adds its offset to the programmed tip and angles, and moves the linear axes
//! after that: so the second form is the same command q_c.

use serde::{Deserialize, Serialize};
use trueaxis::geometry::Vec3;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{Approach, AxisKind, Command, MAX_AXES};
use trueaxis::machine::compensate::{Compensator, Scope};
use trueaxis::machine::errors::ErrorValues;

/// What an offset is added to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Frame {
    /// The positions of the axes.
    #[default]
    Machine,
    /// Tip and angles of the program: tool-centre-point control is on.
    Workpiece,
}

/// A motion of so much does not yet tell from which side an axis comes. Unit: mm or rad.
const SIDE_BAND: f64 = 5e-4;

/// A rotary axis moves at most by so many times the deviation of the tool axis. With the 100 of a program, whose axes have
/// time, C would swing by degrees while the tool passes the pole; the tip is exact in both cases.
const MOST_SWING: f64 = 3.0;

/// X, Y and Z of a control in the workpiece, and the nominal machine that belongs to them.
#[derive(Debug, Clone)]
pub struct World {
    machine: Machine,
    exact: Box<ErrorValues>,
    /// The machine axis of X, Y and Z.
    linear: [usize; 3],
    /// The unit vectors of X, Y, Z in the workpiece.
    units: [Vec3; 3],
}

impl World {
    /// Of a machine with its tool.
    ///
    /// # Errors
    /// A machine without X, Y and Z square to each other.
    pub fn of(machine: &Machine) -> Result<Self, String> {
        let find = |letter| machine.axes().iter().position(|axis| axis.name.to_string() == letter);
        let (Some(x), Some(y), Some(z)) = (find("X"), find("Y"), find("Z")) else {
            return Err("the machine has not all of X, Y and Z".to_owned());
        };
        let exact = Box::new(ErrorValues::default());
        let mut world =
            Self { machine: machine.clone(), exact, linear: [x, y, z], units: [Vec3::zeros(); 3] };
        world.units = world.steps(&Command::default());
        for i in 0..3 {
            for j in 0..=i {
                let due = if i == j { 1.0 } else { 0.0 };
                if (world.units[i].dot(&world.units[j]) - due).abs() > 1e-9 {
                    return Err("X, Y and Z of the machine are not square to each other".to_owned());
                }
            }
        }
        Ok(world)
    }

    /// The nominal tip in the workpiece.
    pub fn tip(&self, command: &Command) -> Vec3 {
        self.machine.deviation(command, &self.exact).nominal_tip.vector()
    }

    /// How the tip moves in the workpiece per mm of X, Y and Z.
    fn steps(&self, command: &Command) -> [Vec3; 3] {
        let here = self.tip(command);
        self.linear.map(|axis| {
            let mut there = *command;
            there[axis] += 1.0;
            self.tip(&there) - here
        })
    }

    /// X, Y, Z of the nominal tip as the control counts them, but for its zero, mm.
    pub fn tip_xyz(&self, command: &Command) -> Vec3 {
        self.xyz(&self.tip(command))
    }

    fn xyz(&self, vector: &Vec3) -> Vec3 {
        Vec3::from_fn(|i, _| self.units[i].dot(vector))
    }

    /// The vector in the workpiece of X, Y and Z as the control names them.
    pub fn vector(&self, xyz: &Vec3) -> Vec3 {
        (0..3).map(|i| self.units[i] * xyz[i]).sum::<Vec3>()
    }

    /// From a command to the corrected one, as offsets of each axis in a frame.
    pub fn offset(&self, frame: Frame, from: &Command, to: &Command) -> Command {
        let mut by: Command = std::array::from_fn(|i| to[i] - from[i]);
        if frame == Frame::Workpiece {
            let tip = self.xyz(&(self.tip(to) - self.tip(from)));
            (0..3).for_each(|i| by[self.linear[i]] = tip[i]);
        }
        by
    }

    /// How an offset of all axes at a command moves the tip: X, Y and Z in the workpiece, mm.
    pub fn moves_tip(&self, frame: Frame, at: &Command, by: &Command) -> Vec3 {
        match frame {
            Frame::Workpiece => Vec3::from_fn(|i, _| by[self.linear[i]]),
            Frame::Machine => {
                let there = std::array::from_fn(|i| at[i] + by[i]);
                self.xyz(&(self.tip(&there) - self.tip(at)))
            }
        }
    }

    /// The offset of the linear axes at a command that moves the tip so far in the workpiece, mm. Unit: mm or rad.
    pub fn moving_tip(&self, frame: Frame, at: &Command, xyz: &Vec3) -> Command {
        let mut by = Command::default();
        let moves = match frame {
            Frame::Workpiece => *xyz,
            Frame::Machine => {
                let vector = self.vector(xyz);
                let steps = trueaxis::geometry::Mat3::from_columns(&self.steps(at));
                // why: X, Y and Z are square to each other, also where rotary axes turn the workpiece.
                steps.try_inverse().expect("three directions") * vector
            }
        };
        (0..3).for_each(|i| by[self.linear[i]] = moves[i]);
        by
    }

    /// The machine axes of X, Y and Z.
    pub fn linear(&self) -> [usize; 3] {
        self.linear
    }

    /// The command of the program, from positions that contain an offset.
    pub fn without(&self, frame: Frame, positions: &Command, offset: &Command) -> Command {
        let mut command: Command = std::array::from_fn(|i| positions[i] - offset[i]);
        if frame == Frame::Machine {
            return command;
        }
        // The linear axes stand where the tip with its offset needs them; it is linear in them.
        self.linear.iter().for_each(|axis| command[*axis] = positions[*axis]);
        let by = (0..3).map(|i| self.units[i] * offset[self.linear[i]]).sum::<Vec3>();
        let missing = self.tip(positions) - by - self.tip(&command);
        let steps = trueaxis::geometry::Mat3::from_columns(&self.steps(&command));
        if let Some(back) = steps.try_inverse() {
            let motion = back * missing;
            (0..3).for_each(|i| command[self.linear[i]] += motion[i]);
        }
        command
    }
}

/// The corrected command of a machine, pose by pose.
#[derive(Debug, Clone)]
pub struct PoseCorrection {
    compensator: Compensator,
    side: Approach,
    turned: Option<Command>,
}

impl PoseCorrection {
    /// Of a machine at its temperatures; `turns` says whether its rotary axes can take a correction.
    ///
    /// # Errors
    /// A machine with fewer than three linear axes.
    pub fn of(machine: &Machine, turns: bool) -> Result<Self, String> {
        let scope = if turns { Scope::Pose } else { Scope::Position };
        let compensator = Compensator::of(machine, scope).map_err(|fault| fault.to_string())?;
        let compensator = compensator.swinging_at_most(MOST_SWING);
        Ok(Self { compensator, side: Approach::default(), turned: None })
    }

    /// The same with the history of another.
    #[must_use]
    pub fn with_history_of(mut self, other: Option<&Self>) -> Self {
        if let Some(other) = other {
            (self.side, self.turned) = (other.side, other.turned);
        }
        self
    }

    /// Follows the axes, to know from which side each has come.
    pub fn follow(&mut self, command: &Command) {
        let turned = self.turned.get_or_insert(*command);
        for i in 0..MAX_AXES {
            let by = command[i] - turned[i];
            if by.abs() > SIDE_BAND {
                (self.side[i], turned[i]) = (by.signum(), command[i]);
            }
        }
    }

    /// The command at which the actual tool stands as the nominal one does at `command`.
    ///
    /// # Errors
    /// What the compensator says.
    pub fn corrected(&self, command: &Command) -> Result<Command, String> {
        let done = self.compensator.at(command, &self.side).map_err(|fault| fault.to_string())?;
        Ok(done.command)
    }
}

/// Whether all rotary axes of a machine are among some axes: only then the tool axis can be corrected.
pub fn turns(machine: &Machine, live: impl Fn(usize) -> bool) -> bool {
    let rotary = machine.axes().iter().enumerate().filter(|(_, a)| a.kind == AxisKind::Rotary);
    rotary.map(|(i, _)| i).all(live)
}
