//! The language of SINUMERIK: its words, the parts of its blocks, and how blocks belong together.

pub mod codes;
pub mod reader;
pub mod structure;
