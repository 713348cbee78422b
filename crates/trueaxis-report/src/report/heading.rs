//! What stands above a report that is filed, and the lines on which it is signed.

use super::Table;

/// What stands above a report that is filed: whose it is, of what, when; and the lines on which it is signed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Heading {
    /// For the head of each page; may be empty.
    pub number: String,
    /// Names with their values.
    pub entries: Vec<(String, String)>,
    /// A table below them.
    pub table: Option<Table>,
    /// A picture at its right.
    pub logo: Option<Logo>,
    /// One line each: what the signature stands for.
    pub signatures: Vec<String>,
}

/// A picture in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Logo {
    /// The file.
    pub bytes: Vec<u8>,
    /// What it contains.
    pub kind: LogoKind,
}

/// The kind of a picture in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogoKind {
    /// Lines and areas.
    Svg,
    /// Pixels.
    Png,
    /// Pixels of a photograph.
    Jpeg,
}

impl LogoKind {
    /// The kind by the first and the last bytes of a file; none for any other, and for one that was cut off.
    ///
    /// ```
    /// use trueaxis_report::LogoKind;
    /// assert_eq!(LogoKind::of(b"\x89PNG\r\n\x1a\n... IEND\xaeB`\x82"), Some(LogoKind::Png));
    /// assert_eq!(LogoKind::of(b"<svg xmlns='http://www.w3.org/2000/svg'/>"), Some(LogoKind::Svg));
    /// assert_eq!(LogoKind::of(b"\x89PNG\r\n\x1a\n..."), None);
    /// assert_eq!(LogoKind::of(b"GIF89a"), None);
    /// ```
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let bytes = bytes.trim_ascii_end();
        if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            return bytes.ends_with(b"IEND\xaeB`\x82").then_some(Self::Png);
        }
        if bytes.starts_with(b"\xff\xd8\xff") {
            return bytes.ends_with(b"\xff\xd9").then_some(Self::Jpeg);
        }
        // Before the root stand a declaration and comments, if anything.
        let begin = String::from_utf8_lossy(bytes.get(..2000).unwrap_or(bytes));
        // A comment may follow the root.
        let is_closed = bytes.windows(6).any(|w| w == b"</svg>") || bytes.ends_with(b"/>");
        (begin.contains("<svg") && is_closed).then_some(Self::Svg)
    }

    /// As the web calls it.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Svg => "image/svg+xml",
            Self::Png => "image/png",
            Self::Jpeg => "image/jpeg",
        }
    }

    /// The ending of the name of such a file.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Jpeg => "jpg",
        }
    }
}
