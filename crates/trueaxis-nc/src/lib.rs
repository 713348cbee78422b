//! What was programmed?
//!
//! ```text
//!     bytes ──Lexer──> tokens ──Program::blocks──> words, expressions ──interpret──> moves, events
//!              Dialect: what the four controls write differently, as tables
//! ```
//!
//! A [`Program`] keeps its text as it is: [`Program::print`] gives every byte back. [`interpret`]
//! executes it by the rules of its [`Control`] and hands out [`Step`]s: moves with targets in the
//! program frame (mm, degrees), and events such as work offsets and tool changes. Whatever is not
//! understood is a diagnostic with code, place and hint.
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
//! It knows no machine: where the axes really go, and how fast, is asked elsewhere. It opens no
//! file: subprograms come through a [`Library`].

pub mod cl;
pub mod dialect;
mod execution;
mod heidenhain;
pub mod moves;
mod rs274;
pub mod sinumerik;
mod text;
pub mod writer;

pub use dialect::{Control, Dialect};
pub use execution::{Library, NoLibrary, Outcome, Settings, Stop, interpret};
pub use moves::{Event, Move, MoveKind, Step};
pub use rs274::code;
pub use text::program::Program;
pub use text::{lexer, program};
