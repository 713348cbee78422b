//! House rules as one test: `cargo test -p tidy`. CONTRIBUTING.md says why.

pub mod arrows;
