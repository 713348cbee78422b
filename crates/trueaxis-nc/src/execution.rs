//! What the three languages share while they execute a program.

pub(crate) mod arcs;
pub(crate) mod drilling;
pub(crate) mod frames;
mod language;
mod library;
pub(crate) mod mistakes;
mod modes;
mod stop;
pub(crate) mod values;

use std::collections::BTreeMap;

use trueaxis_input::Diagnostics;

use crate::moves::{Frame, Plane, Position};
pub(crate) use language::{Core, Language, Next};
pub use library::{Library, NoLibrary};
pub(crate) use modes::Modes;
pub use stop::Stop;

/// What the control is set to before the program begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Backward jumps and calls before the program counts as endless.
    pub most_jumps: u64,
    /// Calls within calls.
    pub deepest_call: usize,
    /// Go on behind a block with an error instead of stopping there, up to 100 errors.
    pub keep_going: bool,
    /// Execute blocks that begin with `/`.
    pub skipped_blocks_too: bool,
    /// Lengths are inches until the program says otherwise.
    pub inches: bool,
    /// X words are diameters until the program says otherwise (lathes).
    pub diameters: bool,
    /// I J K are coordinates of the centre until the program says otherwise.
    pub absolute_centers: bool,
    /// The plane until the program says otherwise.
    pub plane: Plane,
    /// Lengths of the tools by number.
    pub tools: BTreeMap<u32, Position>,
    /// Numbers of the tools that have names.
    pub tool_names: BTreeMap<String, u32>,
    /// The work offsets by number, from 1 for G54; where none is given it is zero.
    pub work_offsets: BTreeMap<u32, Frame>,
    /// Named read-only parameters of the machine, such as `_ini[axis_x]max_limit`, lower case.
    pub constants: BTreeMap<String, f64>,
    /// Tell each block and what it computes: [`Event::Block`](crate::Event::Block), [`Event::Computed`](crate::Event::Computed).
    pub tell_blocks: bool,
    /// Asked from outside, the execution ends before the next block.
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
            tool_names: BTreeMap::new(),
            work_offsets: BTreeMap::new(),
            constants: BTreeMap::new(),
            tell_blocks: false,
            stop: Stop::default(),
        }
    }
}

/// How the execution ended and what was found on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// All problems with their places.
    pub problems: Diagnostics,
    /// The program came to its end; `false` if an error, or somebody, stopped it.
    pub finished: bool,
    /// The programs by the number in [`Origin::program`](crate::moves::Origin::program).
    pub programs: Vec<String>,
}
