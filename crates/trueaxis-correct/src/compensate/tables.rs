//! Compensation tables of controls: compiled from one machine, read back, applied as the control does, and
//! the residual error.
//!
//! ```text
//!     Machine ──split──┬─ chain: known errors, joints ─┐
//!                      └─ rest ──lever──> tables, grid ─┴─> content ──write──> files ──read──> emulation ──> residual error
//! ```
//!
//! - `held`: what the control has in force already, which no file may go in the place of;
//! - [`known`]: which errors the control's own chain can hold, by [`joints`] or by functions of each link (`link`);
//! - `lever`: what every axis should add, and what of it is a function of one axis; `choose`: which of it helps;
//! - [`place`], [`grid`]: the fewest nodes below a bound of the loss; [`temperature`]: straight lines;
//! - `csv`, `fanuc`, `heidenhain`, `isg`, `linuxcnc`, `sinumerik`: files, their parsers, their interpolation;
//! - [`emulation`]: what a control with this [`content`] adds to a command;
//! - [`proof`](mod@proof): what the written files leave over the volume, of each error, of a test piece.
//!
//! docs/decisions/0014-what-a-control-holds.md

mod carrier_chain;
mod choose;
mod compile;
pub mod content;
pub mod control;
mod csv;
pub mod emulation;
mod fanuc;
mod fault;
pub mod grid;
mod grid_of;
mod heidenhain;
mod held;
mod isg;
pub mod joints;
mod joints_csv;
pub mod known;
mod lever;
mod link;
mod linuxcnc;
mod linuxcnc_kinematics;
mod nominal;
pub mod place;
pub mod proof;
mod sinumerik;
mod spread;
pub mod table;
mod temp_comp;
pub mod temperature;
mod tool_carrier;

pub use compile::compile;
pub use fault::TablesError;

use content::Content;
use content::Line;
use control::{Control, File};
use grid::Gridded;
use joints::Joints;
use known::MadeKnown;
use proof::{ErrorLoss, Left};
use table::Table;
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_machine::errors::ErrorName;

/// Which control the tables are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Plain CSV, every axis on every linear axis.
    Csv,
    /// `COMP_FILE`; with trims it is type 1, without type 0.
    LinuxCnc {
        /// Type 1.
        trims: bool,
    },
    /// `$AA_ENC_COMP` and `$AN_CEC`.
    Sinumerik,
    /// Pitch error compensation and the grid of 3-D error compensation.
    Fanuc,
    /// `.COM` and KinematicsComp.
    Heidenhain,
    /// `ISG_CSV` and leadscrew lists of rotary axes.
    Isg,
}

impl Target {
    /// The control.
    pub fn control(self) -> Box<dyn Control + Send + Sync> {
        match self {
            Self::Csv => Box::new(csv::Csv),
            Self::LinuxCnc { trims } => Box::new(linuxcnc::LinuxCnc { trims }),
            Self::Sinumerik => Box::new(sinumerik::Sinumerik { increment: 100.0 }),
            Self::Fanuc => Box::new(fanuc::Fanuc),
            Self::Heidenhain => Box::new(heidenhain::Heidenhain),
            Self::Isg => Box::new(isg::Isg),
        }
    }
}

/// What tables are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Order {
    /// For which control.
    pub target: Target,
    /// Where the other axes stand; without it in the middle of linear travels, rotary axes at 0.
    pub reference: Option<Command>,
    /// The most that the interpolation of one table may lose: mm of linear axes.
    pub bound_mm: f64,
    /// The same of rotary axes, rad.
    pub bound_rad: f64,
    /// Whether rotary centres and tilts go into the control's kinematic parameters, where it has them.
    pub kinematics: bool,
    /// A larger correction is refused: mm.
    pub limit_mm: f64,
    /// The same, rad.
    pub limit_rad: f64,
}

impl Order {
    /// 1 µm and 5 µrad lost at most; nothing above 1 mm and 1 mrad.
    pub fn of(target: Target) -> Self {
        let (bound_mm, bound_rad) = (1e-3, 5e-6);
        let (limit_mm, limit_rad) = (1.0, 1e-3);
        Self { target, reference: None, bound_mm, bound_rad, kinematics: true, limit_mm, limit_rad }
    }

    fn bound(&self, kind: AxisKind) -> f64 {
        match kind {
            AxisKind::Linear => self.bound_mm,
            AxisKind::Rotary => self.bound_rad,
        }
    }

    fn limit(&self, kind: AxisKind) -> f64 {
        match kind {
            AxisKind::Linear => self.limit_mm,
            AxisKind::Rotary => self.limit_rad,
        }
    }
}

/// A table that is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// The table.
    pub table: Table,
    /// The most that interpolation and rounding lose. Unit: mm or rad.
    pub loss: f64,
    /// The largest correction in it. Unit: mm or rad.
    pub largest: f64,
}

/// What is not written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// A table.
    Table {
        /// The axis that would be looked up.
        input: usize,
        /// The axis that would be moved.
        output: usize,
    },
    /// An error that the control's chain could know.
    Error(ErrorName),
}

/// Something that is not written, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// What.
    pub what: What,
    /// The largest correction. Unit: mm or rad.
    pub largest: f64,
    /// Why.
    pub reason: &'static str,
}

/// The tables of a control and what they do.
#[derive(Debug, Clone, PartialEq)]
pub struct Compiled {
    /// What was asked.
    pub order: Order,
    /// Where the other axes stood.
    pub reference: Command,
    /// What to load.
    pub files: Vec<File>,
    /// The tables in them.
    pub tables: Vec<Made>,
    /// The errors in them that the control's chain knows.
    pub known: Vec<MadeKnown>,
    /// Straight lines for the temperatures.
    pub lines: Vec<Line>,
    /// Where the control's chain has the rotary axes.
    pub joints: Option<Joints>,
    /// The grid in them.
    pub grid: Option<Gridded>,
    /// What was not written.
    pub left_out: Vec<LeftOut>,
    /// Over the volume, as the machine is.
    pub before: Left,
    /// The same with the tables as they were read back.
    pub after: Left,
    /// The same after the part zero was set with the tables in force, the axes standing at the reference.
    pub after_zero_set: Left,
    /// The convention check: the same if the control took every value with the other sign.
    pub wrong_sign: Left,
    /// Each error of the machine alone.
    pub errors: Vec<ErrorLoss>,
    /// What the control needs besides the files.
    pub advice: &'static [&'static str],
}

impl Compiled {
    /// What the control holds with these files.
    pub fn content(&self) -> Content {
        Content {
            tables: self.tables.iter().map(|t| t.table.clone()).collect(),
            known: self.known.iter().map(|k| k.known.clone()).collect(),
            lines: self.lines.clone(),
            joints: self.joints.clone(),
            grid: self.grid.as_ref().map(|g| g.grid.clone()),
        }
    }
}

/// A correction as people write it.
pub fn shown(axis: &Axis, value: f64) -> String {
    match axis.kind {
        AxisKind::Linear => format!("{:.2} µm", value * 1e3),
        AxisKind::Rotary => format!("{:.2} µrad", value * 1e6),
    }
}

fn shown_place(axis: &Axis, q: f64) -> String {
    match axis.kind {
        AxisKind::Linear => format!("{q:.3} mm"),
        AxisKind::Rotary => format!("{:.4} deg", q.to_degrees()),
    }
}
