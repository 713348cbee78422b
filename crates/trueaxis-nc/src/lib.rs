//! NC programs of five controls, read without loss and executed to moves.
//!
//! ```text
//!     bytes ──text──> blocks ──rs274, sinumerik, heidenhain──> moves, events ──> Step by Step
//!                              └── execution: what the three languages share
//! ```
//!
//! # Overview
//!
//! 1. A [`Program`] is a text with its [`Control`]. The text is not changed: [`Program::print`]
//!    returns every byte, [`Program::check`] lists the errors of the text.
//! 2. [`interpret`] executes a program by the rules of its control, with [`Settings`] for the data of
//!    the control (tool lengths, work offsets) and a [`Library`] for subprograms.
//! 3. The result is a sequence of [`Step`]s: a [`Move`] with its target in the program frame (mm,
//!    degrees), or an [`Event`] such as a work offset, a tool change, a frame. The [`Outcome`]
//!    contains the problems, each with a code, a place, a message and a hint. The same mistake has
//!    the same code and message in every language.
//!
//! # A first program
//!
//! ```
//! use trueaxis_nc::{Control, NoLibrary, Program, Settings, Step, interpret};
//! let text = b"G20 G17 G90\nF10 G0 X0 Y0\nG3 X1 Y1 I0 J1\nM2\n".to_vec();
//! let program = Program::new("quarter.ngc", text, Control::LinuxCnc);
//! let mut moves = Vec::new();
//! let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |step| {
//!     if let Step::Move(m) = step {
//!         moves.push(m);
//!     }
//! });
//! assert!(!outcome.problems.has_errors());
//! assert_eq!(moves[1].target.0[..2], [25.4, 25.4]);
//! assert_eq!(moves[1].feed.value, 254.0);
//! ```
//!
//! The same path in the language of another control gives the same moves. A mistake is reported with
//! its place:
//!
//! ```
//! use trueaxis_nc::{Control, NoLibrary, Program, Settings, interpret};
//! let text = b"G1 F100 X=10/0\nM30\n".to_vec();
//! let program = Program::new("part.mpf", text, Control::Sinumerik840d);
//! let outcome = interpret(&program, &NoLibrary, &Settings::default(), &mut |_| ());
//! let problem = outcome.problems.iter().next().unwrap();
//! assert_eq!((problem.code, problem.place.line), ("division-by-zero", 1));
//! assert!(!outcome.finished);
//! ```
//!
//! `cargo run -p trueaxis-nc --example moves -- FILE` prints the moves of a program.
//!
//! # Further parts
//!
//! - [`moves`] defines moves and events, [`code`] and [`dialect`] the differences between the
//!   controls, [`lexer`] and [`program`] the text; [`sinumerik`] reads archives of a set-up.
//!
//! The crate has no model of the machine: axis positions and times are computed elsewhere. It opens
//! no file: subprograms are read through a [`Library`].

// On top of the list of the workspace, as this crate has no hits.
#![warn(clippy::redundant_closure_for_method_calls)]

mod execution;
mod heidenhain;
mod interpret;
mod rs274;
pub mod sinumerik;

pub use execution::leaves_motion_out;
pub use execution::{
    Follower, FollowingAxes, KnownPosition, Library, NoLibrary, Outcome, OwnCode, Settings, Stop,
};
pub use interpret::{interpret, interpret_on};
pub use trueaxis_blocks::{Control, Dialect, Program, code, dialect, lexer, program};

/// The text of programs.
mod text {
    pub(crate) use trueaxis_blocks::{lexer, program};
}
pub use trueaxis_moves as moves;
pub use trueaxis_moves::{Event, Move, MoveKind, Step};
