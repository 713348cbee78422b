//! The page in the program.

include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// Type and bytes of a file of the page; `/` is `index.html`.
pub(crate) fn file(path: &str) -> Option<(&'static str, &'static [u8])> {
    let name = match path.trim_start_matches('/') {
        "" => "index.html",
        name => name,
    };
    PAGE.iter().find(|(n, ..)| *n == name).map(|(_, kind, bytes)| (*kind, *bytes))
}

/// Whether this program was built with the page.
pub(crate) fn is_there() -> bool {
    !PAGE.is_empty()
}
