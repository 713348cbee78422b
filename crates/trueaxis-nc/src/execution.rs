//! Execution of programs: the parts that the three languages share.

pub(crate) mod arcs;
pub(crate) mod corners;
pub(crate) mod drilling;
mod follower;
mod language;
mod library;
pub(crate) mod milling;
mod modes;
mod own_codes;
pub(crate) mod radius;
mod stop;
pub(crate) mod straight;
pub(crate) mod values;

use std::collections::BTreeMap;

pub(crate) use trueaxis_blocks::mistakes;
use trueaxis_input::Diagnostics;

use crate::moves::{Frame, Plane, Position};
pub(crate) use follower::Alone;
pub use follower::{Follower, FollowingAxes, KnownPosition};
pub(crate) use language::{Core, Language, Next};
pub use library::{Library, NoLibrary};
pub(crate) use modes::{Modes, check_feed};
pub use own_codes::OwnCode;
pub use stop::Stop;

/// The state of the control before the program begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Largest number of backward jumps and calls; more are an endless loop.
    pub most_jumps: u64,
    /// Largest depth of nested calls.
    pub deepest_call: usize,
    /// Whether the execution continues after a block with an error, up to 100 errors.
    pub keep_going: bool,
    /// Whether blocks that begin with `/` are executed.
    pub skipped_blocks_too: bool,
    /// Whether lengths are in inches until the program states the unit.
    pub inches: bool,
    /// Whether X words are diameters until the program states otherwise (lathes).
    pub diameters: bool,
    /// Whether I J K are coordinates of the centre until the program states otherwise.
    pub absolute_centers: bool,
    /// The plane until the program states another.
    pub plane: Plane,
    /// Tool lengths by tool number, along each axis, mm.
    pub tools: BTreeMap<u32, Position>,
    /// The length that tool-centre-point control takes for tools that are not listed, mm, where it is not 0.
    pub unlisted_length_mm: Option<f64>,
    /// Tool radii with their wear by tool number, mm; those that are not listed are not known.
    pub radii: BTreeMap<u32, f64>,
    /// Whether moves with radius compensation are those of the contour, not of the centre of the tool.
    pub on_contour: bool,
    /// Tool numbers by name.
    pub tool_names: BTreeMap<String, u32>,
    /// Work offsets by number, from 1 for G54; zero where none is given.
    pub work_offsets: BTreeMap<u32, Frame>,
    /// What codes and programs of the machine builder do, by their names in capital letters: `M200`, `G120`, `TOOLIN`.
    pub codes: BTreeMap<String, OwnCode>,
    /// Named read-only parameters of the machine, such as `_ini[axis_x]max_limit`, lower case.
    pub constants: BTreeMap<String, f64>,
    /// Whether each block and its computed values are reported: [`Event::Block`](crate::Event::Block), [`Event::Computed`](crate::Event::Computed).
    pub report_blocks: bool,
    /// On request through this flag, the execution ends before the next block.
    pub stop: Stop,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            most_jumps: 1_000_000,
            deepest_call: 64,
            keep_going: false,
            skipped_blocks_too: true,
            inches: false,
            diameters: false,
            absolute_centers: false,
            plane: Plane::Xy,
            tools: BTreeMap::new(),
            unlisted_length_mm: None,
            radii: BTreeMap::new(),
            on_contour: false,
            tool_names: BTreeMap::new(),
            work_offsets: BTreeMap::new(),
            codes: BTreeMap::new(),
            constants: BTreeMap::new(),
            report_blocks: false,
            stop: Stop::default(),
        }
    }
}

/// Whether a warning of this code means that motion is missing, or ends at another place than on the control.
pub fn leaves_motion_out(code: &str) -> bool {
    matches!(code, "not-applied" | "not-executed" | "cycle-not-executed" | "unknown-tool-radius")
}

/// The result of an execution.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// All problems with their places.
    pub problems: Diagnostics,
    /// Whether the program was executed to its end; `false` after an error or a stop on request.
    pub finished: bool,
    /// The names of the programs, by the number in [`Origin::program`](crate::moves::Origin::program).
    pub programs: Vec<String>,
}
