//! The text of a program: tokens, blocks and what they mean, without loss.

pub mod lexer;
mod parser;
pub mod program;
