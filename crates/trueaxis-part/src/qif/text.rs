//! The draft as the text of a part file.

use super::characteristics::Limits;
use super::features::{Form, Opening};
use super::{Asked, Draft, Drafted, LeftOut};
use crate::part::Datum;
use trueaxis_geometry::Vec3;

const HEAD: &str = "\
# Coordinates are those of the model. They must be those of the workpiece frame of the program:
# `workpiece_at` of its set-up file lies at the zero of the model.
";
const DIAMETERS: &str = "\
# Diameters and widths are judged by least squares (GG), not between two points.
";

/// So many ids stand on a line.
const MOST_ON_A_LINE: usize = 20;

/// Whether unknown values are question marks, or stand-ins for a trial of the rules of the part file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Unknown {
    Marked,
    StoodIn,
}

/// A text that is being written.
pub(super) struct Writer {
    pub text: String,
    pub unknown: usize,
    style: Unknown,
    /// The line on which each feature and then each characteristic begins, from 1.
    pub feature_lines: Vec<usize>,
    pub characteristic_lines: Vec<usize>,
}

impl Writer {
    pub fn write(draft: &Draft, style: Unknown) -> Self {
        let mut writer = Self {
            text: String::new(),
            unknown: 0,
            style,
            feature_lines: Vec::new(),
            characteristic_lines: Vec::new(),
        };
        writer.head(draft);
        for feature in &draft.features {
            let line = writer.next_line();
            writer.feature_lines.push(line);
            writer.feature(feature);
        }
        for asked in &draft.characteristics {
            let line = writer.next_line();
            writer.characteristic_lines.push(line);
            writer.asked(draft, asked);
        }
        writer.foot(draft);
        writer
    }

    fn next_line(&self) -> usize {
        self.text.matches('\n').count() + 1
    }

    fn head(&mut self, draft: &Draft) {
        let [name, source] = [&draft.name, &draft.source].map(|t| quoted(t));
        self.text +=
            &format!("# Drafted from {}; read it before use.\n{HEAD}", comment(&draft.source));
        if draft.characteristics.iter().any(|a| matches!(a.limits, Limits::Size { .. })) {
            self.text += DIAMETERS;
        }
        self.text += &format!("name = {name}\nsource = {source}\n");
    }

    /// A value, or what stands for one.
    fn value(&mut self, known: Option<String>, stand_in: &str) -> String {
        match (known, self.style) {
            (Some(known), _) => quoted(&known),
            (None, Unknown::StoodIn) => quoted(stand_in),
            (None, Unknown::Marked) => {
                self.unknown += 1;
                "\"?\"".to_owned()
            }
        }
    }

    fn feature(&mut self, feature: &Drafted) {
        self.text += &format!("\n[feature.{}]", feature.name);
        self.text += &format!("  # {} {}\n", feature.kind, comment(&feature.id));
        if let Some(letter) = &feature.letter {
            self.text += &format!("datum = {}\n", quoted(letter));
        }
        let (key, value, openings) = self.form(&feature.form);
        let notes = match feature.notes.is_empty() {
            true => String::new(),
            false => format!("  # {}", comment(&feature.notes.join("; "))),
        };
        self.text += &format!("{key} = {{ {value} }}{notes}\n");
        if !openings.is_empty() {
            self.text += &format!("openings = [\n{}]\n", openings.concat());
        }
    }

    fn form(&mut self, form: &Form) -> (&'static str, String, Vec<String>) {
        match form {
            Form::Plane { at_mm, normal, along, size_mm, openings } => {
                let normal = self.value(normal.as_ref().map(unit_vector), "0 0 1");
                let along =
                    along.as_ref().map(|a| format!(", along = {}", quoted(&unit_vector(a))));
                let size = self.value(size_mm.map(|s| lengths(&s)), "10 10 mm");
                // A stand-in of the normal must not meet the direction of the edge.
                let along =
                    along.filter(|_| self.style == Unknown::Marked || normal != "\"0 0 1\"");
                let along = along.unwrap_or_default();
                let at = quoted(&lengths(at_mm.as_slice()));
                let value = format!("at = {at}, normal = {normal}{along}, size = {size}");
                // A rectangle that stands in for one may lie within an opening.
                let are_meant = self.style == Unknown::Marked || size_mm.is_some();
                let openings = openings.iter().filter(|_| are_meant);
                let openings = openings.filter_map(|o| self.opening(o)).collect();
                ("plane", value, openings)
            }
            Form::Cylinder { is_hole, at_mm, axis, diameter_mm, length_mm } => {
                let [at, axis] = [quoted(&lengths(at_mm.as_slice())), quoted(&unit_vector(axis))];
                let diameter = self.value(diameter_mm.map(|d| lengths(&[d])), "10 mm");
                let length = self.value(length_mm.map(|l| lengths(&[l])), "10 mm");
                let value =
                    format!("at = {at}, axis = {axis}, diameter = {diameter}, length = {length}");
                (if *is_hole { "hole" } else { "cylinder" }, value, Vec::new())
            }
            Form::Cone { is_hole, at_mm, axis, diameters_mm, length_mm } => {
                let [at, axis] = [quoted(&lengths(at_mm.as_slice())), quoted(&unit_vector(axis))];
                let diameters = self.value(diameters_mm.map(|d| lengths(&d)), "10 20 mm");
                let length = self.value(length_mm.map(|l| lengths(&[l])), "10 mm");
                let value =
                    format!("at = {at}, axis = {axis}, diameters = {diameters}, length = {length}");
                (if *is_hole { "conical_hole" } else { "cone" }, value, Vec::new())
            }
            Form::Slot { is_hole, at_mm, across, along, width_mm, size_mm } => {
                let [at, across] =
                    [quoted(&lengths(at_mm.as_slice())), quoted(&unit_vector(across))];
                let along =
                    along.as_ref().map(|a| format!(", along = {}", quoted(&unit_vector(a))));
                let width = self.value(width_mm.map(|w| lengths(&[w])), "10 mm");
                let size = self.value(size_mm.map(|s| lengths(&s)), "10 10 mm");
                let along = along.unwrap_or_default();
                let value =
                    format!("at = {at}, across = {across}{along}, width = {width}, size = {size}");
                (if *is_hole { "slot" } else { "tongue" }, value, Vec::new())
            }
            Form::Sphere { is_hole, at_mm, axis, diameter_mm, opening_rad } => {
                let at = quoted(&lengths(at_mm.as_slice()));
                let axis = self.value(axis.as_ref().map(unit_vector), "0 0 1");
                let diameter = self.value(diameter_mm.map(|d| lengths(&[d])), "10 mm");
                let opening = opening_rad.map(|o| format!("{} deg", rounded(o.to_degrees(), 6)));
                let opening = self.value(opening, "60 deg");
                let value =
                    format!("at = {at}, axis = {axis}, diameter = {diameter}, opening = {opening}");
                (if *is_hole { "hollow_sphere" } else { "sphere" }, value, Vec::new())
            }
        }
    }

    /// The line of an opening; a trial has none where its size is not known.
    fn opening(&mut self, opening: &Opening) -> Option<String> {
        let (at_mm, shape, note) = match opening {
            Opening::Round { at_mm, diameter_mm } => {
                (at_mm, format!("diameter = {}", quoted(&lengths(&[*diameter_mm]))), "")
            }
            Opening::Rectangle { at_mm, size_mm } => {
                (at_mm, format!("size = {}", quoted(&lengths(size_mm))), "")
            }
            Opening::Unknown { .. } if self.style == Unknown::StoodIn => return None,
            Opening::Unknown { at_mm, note } => {
                (at_mm, format!("size = {}", self.value(None, "")), note.as_str())
            }
        };
        let note = if note.is_empty() { String::new() } else { format!("  # {}", comment(note)) };
        let at = quoted(&lengths(at_mm.as_slice()));
        Some(format!("    {{ at = {at}, {shape} }},{note}\n"))
    }

    fn asked(&mut self, draft: &Draft, asked: &Asked) {
        self.text += &format!("\n[[characteristic]]  # {}\n", comment(&asked.id));
        if let Some(name) = &asked.name {
            self.text += &format!("name = {}\n", quoted(name));
        }
        let value = match asked.limits {
            Limits::Zone { tolerance_mm } => quoted(&tolerance(tolerance_mm)),
            Limits::Size { low_mm, high_mm, .. } => {
                format!("[{}, {}]", quoted(&tolerance(low_mm)), quoted(&tolerance(high_mm)))
            }
        };
        let note = asked.note.as_ref().map(|n| format!("  # {}", comment(n))).unwrap_or_default();
        self.text += &format!("{} = {value}{note}\n", asked.kind.key());
        self.text += &format!("of = {}\n", quoted(&draft.features[asked.of].name));
        if !asked.datums.is_empty() {
            let label = |d: &Datum| {
                let all: Vec<&str> =
                    d.features.iter().map(|f| draft.features[*f].label()).collect();
                all.join("-")
            };
            let labels: Vec<String> = asked.datums.iter().map(label).collect();
            self.text += &format!("datum = {}\n", quoted(&labels.join("|")));
        }
    }

    fn foot(&mut self, draft: &Draft) {
        if draft.left_out.is_empty() || self.style == Unknown::StoodIn {
            return;
        }
        self.text += "\n# Left out:\n";
        let mut rest = draft.left_out.iter().peekable();
        while let Some(left) = rest.next() {
            let mut ids = vec![left.id.as_str()];
            // Neighbours of one kind and one reason stand on one line.
            let is_same = |next: &&LeftOut| next.what == left.what && next.reason == left.reason;
            while ids.len() < MOST_ON_A_LINE {
                let Some(next) = rest.next_if(is_same) else { break };
                ids.push(&next.id);
            }
            let line = format!("{} {}: {}", left.what, ids.join(", "), left.reason);
            self.text += &format!("# {}\n", comment(&line));
        }
    }
}

/// A number with at most so many decimals, without zeros at its end and without a negative zero.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// mm to 1 nm.
pub(super) fn millimetres(value: f64) -> String {
    rounded(value, 6)
}

/// `"1 2 3 mm"`.
fn lengths(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|v| millimetres(*v)).collect();
    format!("{} mm", words.join(" "))
}

/// Tolerances below 1 mm in µm.
fn tolerance(value_mm: f64) -> String {
    match value_mm.abs() < 1.0 {
        true => format!("{} um", rounded(1e3 * value_mm, 3)),
        false => format!("{} mm", millimetres(value_mm)),
    }
}

/// Directions need more digits than places: 1e-6 rad would be another direction.
pub(super) fn unit_vector(direction: &Vec3) -> String {
    let words: Vec<String> = direction.iter().map(|c| rounded(*c, 10)).collect();
    words.join(" ")
}

/// A text of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            c if c.is_control() => quoted.push(' '),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// A comment on one line.
fn comment(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A key of TOML without quotes from a name.
pub(super) fn key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let key: String =
        name.trim().chars().take(60).map(|c| if is_bare(c) { c } else { '_' }).collect();
    // A name of signs alone says nothing.
    if key.chars().any(|c| c.is_ascii_alphanumeric()) { key } else { String::new() }
}
