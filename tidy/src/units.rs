//! Public numbers name their unit: at the end of their name, or in a sentence of their doc comment.

/// How the name of a field ends that states its unit.
pub const SUFFIXES: [&str; 28] = [
    "mm", "um", "mm2", "um2", "mm3", "rad", "urad", "deg", "s", "min", "h", "k", "celsius",
    "percent", "w", "kw", "per_s", "per_min", "per_m", "per_k", "per_m_k", "per_mm", "per_mm_k",
    "per_h", "per_rad", "per_deg", "per_s2", "per_s3",
];

/// How the unit begins in the sentence `Unit: mm or rad.` of a doc comment.
pub const UNITS: [&str; 24] = [
    "1", "mm", "µm", "rad", "µrad", "deg", "s", "min", "h", "K", "°C", "%", "mm/s", "deg/s",
    "mm/min", "mm/s²", "mm/s³", "mm/mm", "mm/rad", "mm/h", "1/min", "1/K", "counts", "that of",
];

/// Fields of public structs that are numbers without a unit, each with its line, from 1.
pub fn without_unit(source: &str) -> Vec<(usize, String)> {
    let (mut found, mut document, mut is_public) = (Vec::new(), String::new(), false);
    for (i, line) in source.lines().enumerate() {
        let trimmed = line.trim_start();
        if let Some(comment) = trimmed.strip_prefix("///") {
            document = format!("{document}{comment}");
            continue;
        }
        if trimmed.starts_with("#[") {
            continue;
        }
        if line.starts_with(|c: char| c.is_alphabetic()) {
            is_public = line.starts_with("pub struct ");
        }
        let field = trimmed.strip_prefix("pub ").and_then(|f| f.split_once(": "));
        if let (true, Some((name, kind))) = (is_public, field)
            && is_number(kind.trim_end_matches(','))
            && !names_unit(name)
            && !states_unit(&document)
        {
            found.push((i + 1, name.to_owned()));
        }
        document.clear();
    }
    found
}

/// Whether a type is `f64`, or options, lists and arrays of it.
fn is_number(kind: &str) -> bool {
    let inner = kind.trim_start_matches(['&', '[']).trim_start_matches("'a ");
    let inner = inner.trim_start_matches("mut ");
    for wrapper in ["Option<", "Vec<"] {
        if let Some(rest) = inner.strip_prefix(wrapper) {
            return is_number(rest);
        }
    }
    match inner.strip_prefix("f64") {
        Some(rest) => rest.starts_with([';', ']', '>']) || rest.is_empty(),
        None => inner != kind && is_number(inner),
    }
}

/// A name that is nothing but a letter, such as the estimator s, is no unit.
fn names_unit(name: &str) -> bool {
    let ends = |suffix: &str| {
        name.strip_suffix(suffix).is_some_and(|before| before.ends_with('_'))
            || (name.len() > 1 && name == suffix)
    };
    SUFFIXES.iter().any(|suffix| ends(suffix))
}

fn states_unit(document: &str) -> bool {
    let Some((_, unit)) = document.split_once(" Unit: ") else { return false };
    let ends = |rest: &str| rest.starts_with([' ', ',', '.']);
    unit.ends_with('.') && UNITS.iter().any(|known| unit.strip_prefix(known).is_some_and(ends))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_without_a_unit_is_found() {
        let source = "\
/// A result.
pub struct Result {
    /// Its length.
    pub length: f64,
    /// Its length.
    pub length_mm: f64,
    /// The estimator of repeatability.
    pub s: Option<f64>,
    /// Its axis. Unit: 1.
    #[serde(rename = \"n\")]
    pub axis: [f64; 3],
    /// Its values.
    pub values: Option<Vec<[f64; 3]>>,
    /// Its turns. Unit: furlong.
    pub turns: &'a [f64],
    /// Its poses.
    pub poses: Vec<Pose>,
}
struct Inner {
    pub length: f64,
}
";
        let found = without_unit(source);
        let names: Vec<_> = found.iter().map(|(line, name)| (*line, name.as_str())).collect();
        assert_eq!(names, [(4, "length"), (8, "s"), (13, "values"), (15, "turns")]);
    }

    #[test]
    fn ends_of_names_are_whole_words() {
        assert!(names_unit("feed_mm_per_min") && names_unit("um") && names_unit("times_s"));
        assert!(!names_unit("rms") && !names_unit("s") && !names_unit("albumum"));
    }
}
