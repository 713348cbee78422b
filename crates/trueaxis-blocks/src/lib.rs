//! The text of NC programs of five controls, without loss: tokens, blocks with their words, the tables of
//! the codes, and the wording of mistakes. What they do is executed by `trueaxis-nc`.
//!
//! ```
//! use trueaxis_blocks::{Control, Program};
//! let program = Program::new("part.ngc", b"G1 X10 F100\nG1 X\n".to_vec(), Control::LinuxCnc);
//! assert_eq!(program.check().iter().next().unwrap().place.line, 2);
//! ```

pub mod code;
mod common_codes;
pub mod dialect;
pub mod digits;
mod fanuc;
mod haas;
mod heidenhain;
pub mod klartext;
pub mod lexer;
mod linuxcnc;
pub mod mistakes;
mod parser;
pub mod program;
pub mod siemens;
mod sinumerik;

pub use dialect::{Control, Dialect};
pub use program::Program;
