//! House rules as one test: `cargo test -p tidy`. CONTRIBUTING.md says why.

pub mod arrows;
pub mod units;

/// The part of a source before its unit tests. Tests in a file of their own are declared above the code.
pub fn before_tests(text: &str) -> &str {
    let begins = |(at, _): &(usize, &str)| {
        let declared = text[*at..].lines().nth(1).unwrap_or_default();
        !(declared.starts_with("mod ") && declared.ends_with(';'))
    };
    text.match_indices("#[cfg(test)]").find(begins).map_or(text, |(at, _)| &text[..at])
}
