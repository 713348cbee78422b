//! STL files, binary or text.
//!
//! The format has no specification of its own; what is read here is what CAD systems write.
//! Binary: 80 bytes of heading, the number of facets (u32, little endian), then 50 bytes each:
//! normal and three corners as f32, and two bytes without meaning. Text: `solid`, `facet normal`,
//! `outer loop`, `vertex`. Normals are not used: the order of the corners gives the same.

use crate::{Diagnostics, Place};

/// The corners of a facet, counter-clockwise seen from outside.
pub type Facet = [[f64; 3]; 3];

/// Bytes before the first facet of a binary file.
pub const HEADING: usize = 84;
/// Bytes of a facet of a binary file.
pub const FACET: usize = 50;
/// No corner of a machine lies further out, mm: beyond it the squares of lengths lose their precision.
const LARGEST_MM: f64 = 1e9;
/// After this number of faults the rest of the file adds no information.
const MOST_FAULTS: usize = 20;
const HINT: &str = "export the body again as STL; binary is the safer form";

/// The facets of an STL file, in mm; faults are reported with their byte or line.
///
/// Facets without area are left out, with a note that counts them.
pub fn read_facets(
    file: &str,
    bytes: &[u8],
    unit_mm: f64,
    problems: &mut Diagnostics,
) -> Option<Vec<Facet>> {
    let mut reader = Reader { file, bytes, unit_mm, faults: Diagnostics::new(), count: 0 };
    let facets = if is_text(bytes) { reader.text() } else { reader.binary() };
    if reader.count == 0 && facets.is_empty() {
        reader.whole("empty-stl", "holds no facet".to_owned());
    }
    let sound = reader.count == 0;
    problems.append(reader.faults);
    if !sound {
        return None;
    }
    let all = facets.len();
    let facets: Vec<Facet> = facets.into_iter().filter(has_area).collect();
    if facets.is_empty() {
        let message = format!("none of its {all} facets has an area");
        problems.error("empty-stl", Place::whole(file), message, HINT);
        return None;
    }
    if facets.len() < all {
        let message =
            format!("{} of {all} facets have no area and are left out", all - facets.len());
        let hint = "usual where CAD systems triangulate; nothing to do";
        problems.note("degenerate-facets", Place::whole(file), message, hint);
    }
    Some(facets)
}

/// Whether this is the text form: binary files may begin with `solid`, too, but then their length
/// fits the number of facets or they hold bytes that no text has.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    if !start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        return false;
    }
    let fits =
        facet_count(bytes).is_some_and(|n| n.checked_mul(FACET) == Some(bytes.len() - HEADING));
    !fits && !bytes.iter().take(1024).any(|b| *b == 0)
}

fn facet_count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADING - 4..HEADING)?;
    let count = u32::from_le_bytes(count.try_into().ok()?);
    usize::try_from(count).ok()
}

struct Reader<'a> {
    file: &'a str,
    bytes: &'a [u8],
    unit_mm: f64,
    faults: Diagnostics,
    count: usize,
}

impl Reader<'_> {
    fn whole(&mut self, code: &'static str, message: String) {
        self.count += 1;
        self.faults.error(code, Place::whole(self.file), message, HINT);
    }

    fn binary(&mut self) -> Vec<Facet> {
        let length = self.bytes.len();
        let Some(count) = facet_count(self.bytes) else {
            let message = if length == 0 {
                "the file is empty".to_owned()
            } else {
                format!("{length} bytes are not an STL file: a binary one has at least {HEADING}")
            };
            let code = if length == 0 { "empty-stl" } else { "truncated-stl" };
            self.whole(code, message);
            return Vec::new();
        };
        let body = &self.bytes[HEADING..];
        let due = count.saturating_mul(FACET);
        if body.len() < due {
            let message = format!(
                "ends at byte {length}, within facet {} of the {count} that it announces at byte 80",
                body.len() / FACET + 1
            );
            self.whole("truncated-stl", message);
            return Vec::new();
        }
        if body.len() > due {
            let message =
                format!("{} bytes follow the {count} facets that it announces", body.len() - due);
            let hint = "they are not read; if facets are missing, export the body again";
            self.faults.warn("trailing-bytes", Place::whole(self.file), message, hint);
        }
        let mut facets = Vec::with_capacity(count);
        for (i, bytes) in body[..due].chunks_exact(FACET).enumerate() {
            let corner = |k: usize| {
                let value = |c: usize| {
                    let at = 12 + 12 * k + 4 * c;
                    let raw = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
                    f64::from(f32::from_le_bytes(raw)) * self.unit_mm
                };
                [value(0), value(1), value(2)]
            };
            let facet = [corner(0), corner(1), corner(2)];
            if facet.iter().all(is_plausible) {
                facets.push(facet);
                continue;
            }
            let at = HEADING + i * FACET;
            let message = format!("facet {} (byte {at}): {}", i + 1, fault_of(&facet));
            self.whole("bad-corner", message);
            if self.count >= MOST_FAULTS {
                break;
            }
        }
        facets
    }

    fn text(&mut self) -> Vec<Facet> {
        let mut words = Words { bytes: self.bytes, at: 0 };
        let mut facets = Vec::new();
        let mut ended = false;
        loop {
            let start = words.peek_at();
            if words.next_is("facet") {
                match self.facet(&mut words) {
                    Some(facet) => facets.push(facet),
                    None if self.count >= MOST_FAULTS => return facets,
                    None if words.at_end() => return facets,
                    // Once more at the next facet, so that all faults come at once.
                    None => words.skip_to_facet(),
                }
            } else if words.next_is("endsolid") {
                ended = true;
                words.skip_line();
            } else if words.next_is("solid") {
                ended = false;
                words.skip_line();
            } else if let Some(word) = words.next() {
                let message = format!("`{}` where `facet` or `endsolid` is expected", shown(word));
                self.fault(start, "stl-syntax", message);
                if self.count >= MOST_FAULTS {
                    return facets;
                }
                words.skip_to_facet();
            } else {
                if !ended {
                    let message = "ends without `endsolid`: facets may be missing".to_owned();
                    self.fault(start, "truncated-stl", message);
                }
                return facets;
            }
        }
    }

    fn facet(&mut self, words: &mut Words<'_>) -> Option<Facet> {
        self.due(words, "normal")?;
        for _ in 0..3 {
            words.next();
        }
        self.due(words, "outer")?;
        self.due(words, "loop")?;
        let mut facet = [[0.0; 3]; 3];
        for corner in &mut facet {
            let start = words.peek_at();
            self.due(words, "vertex")?;
            for value in &mut *corner {
                let at = words.peek_at();
                let word = words.next();
                let number = word.and_then(|w| std::str::from_utf8(w).ok()?.parse::<f64>().ok());
                let Some(number) = number else {
                    let found =
                        word.map_or("the end of the file".into(), |w| format!("`{}`", shown(w)));
                    self.fault(at, "stl-syntax", format!("expected a number here, found {found}"));
                    return None;
                };
                *value = number * self.unit_mm;
            }
            if !is_plausible(corner) {
                self.fault(start, "bad-corner", fault_of(&[*corner; 3]));
                return None;
            }
        }
        self.due(words, "endloop")?;
        self.due(words, "endfacet")?;
        Some(facet)
    }

    fn due(&mut self, words: &mut Words<'_>, word: &str) -> Option<()> {
        let at = words.peek_at();
        if words.next_is(word) {
            return Some(());
        }
        let found = words.next();
        let code = if found.is_none() { "truncated-stl" } else { "stl-syntax" };
        let found = found.map_or("the end of the file".into(), |w| format!("`{}`", shown(w)));
        self.fault(at, code, format!("expected `{word}` here, found {found}"));
        None
    }

    fn fault(&mut self, offset: usize, code: &'static str, message: String) {
        self.count += 1;
        let before = &self.bytes[..offset.min(self.bytes.len())];
        let line_start = before.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        let place = Place {
            file: self.file.to_owned(),
            line: before.iter().filter(|b| **b == b'\n').count() + 1,
            column: before.len() - line_start + 1,
        };
        self.faults.error(code, place, message, HINT);
    }
}

/// Whether it has an area at all, seen against its longest edge.
pub fn has_area(facet: &Facet) -> bool {
    let edge = |a: usize, b: usize| [0, 1, 2].map(|k: usize| facet[b][k] - facet[a][k]);
    let square = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>();
    let (u, v) = (edge(0, 1), edge(0, 2));
    let longest = square(u).max(square(v)).max(square(edge(1, 2)));
    let cross =
        [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    // A height below 1e-7 of the length is what a 32-bit coordinate cannot distinguish from zero.
    square(cross).sqrt() > 1e-7 * longest
}

fn is_plausible(corner: &[f64; 3]) -> bool {
    // A comparison with NaN is false.
    corner.iter().all(|v| v.abs() <= LARGEST_MM)
}

fn fault_of(facet: &Facet) -> String {
    let finite = facet.iter().all(|c| c.iter().all(|v| v.is_finite()));
    match finite {
        false => "a coordinate is not a finite number".to_owned(),
        true => format!("a coordinate is larger than {LARGEST_MM:e} mm"),
    }
}

fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(&word[..word.len().min(20)]).into_owned()
}

struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Words<'a> {
    fn peek_at(&mut self) -> usize {
        while self.bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
        self.at
    }

    fn at_end(&mut self) -> bool {
        self.peek_at() >= self.bytes.len()
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.peek_at();
        let rest = &self.bytes[start..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at = start + end;
        (end > 0).then(|| &rest[..end])
    }

    /// Takes the next word if it is this one, in any case.
    fn next_is(&mut self, word: &str) -> bool {
        let start = self.peek_at();
        let found = self.next().is_some_and(|w| w.eq_ignore_ascii_case(word.as_bytes()));
        if !found {
            self.at = start;
        }
        found
    }

    fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
    }

    /// To the next facet, or the end of the solid.
    fn skip_to_facet(&mut self) {
        loop {
            let start = self.peek_at();
            match self.next() {
                Some(w)
                    if [&b"facet"[..], b"endsolid"].iter().any(|k| w.eq_ignore_ascii_case(k)) =>
                {
                    self.at = start;
                    return;
                }
                Some(_) => {}
                None => return,
            }
        }
    }
}
