//! The reader of product definitions reads what results state of the part.

#[path = "qif/every.rs"]
mod every;

use every::{every, found, housing, odd};
use std::path::Path;
use trueaxis_input::{Diagnostics, SourceText};
use trueaxis_part::part::{Characteristic, Datum, Geometry, Kind, Limits, Part};
use trueaxis_part::qif::draft;
use trueaxis_part::qif::results::results;

/// What a draft says of a part that was written as results: the reader of product definitions reads its nominal half.
fn drafted(part: &Part) -> (Part, Vec<(String, String)>) {
    let document = results(part, &found(part), "a program 1.0").unwrap();
    let mut problems = Diagnostics::new();
    let draft = draft("results.qif", &document, &mut problems);
    let draft = draft.unwrap_or_else(|| panic!("{problems:?}"));
    assert!(!problems.iter().any(|p| p.code != "left-out"), "{problems:?}");
    // A slot of QIF does not say where along its depth it lies; a person writes the size.
    let slots = part.features.iter().filter_map(|f| match f.geometry {
        Geometry::Slot { size_mm: [length, depth], .. } => Some((&f.name, length, depth)),
        _ => None,
    });
    let mut text = draft.text();
    for (name, length, depth) in slots {
        let Some(at) = text.find(&format!("[feature.{name}]")) else { continue };
        let size = format!("size = \"{length} {depth} mm\"");
        text.replace_range(at.., &text[at..].replacen("size = \"?\"", &size, 1));
    }
    assert!(!text.contains('?'), "{text}");
    let source = SourceText::new("draft.toml", &text);
    let read = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    let left = draft.left_out().iter().map(|l| (l.what.clone(), l.reason.clone())).collect();
    (read.unwrap_or_else(|| panic!("{problems:?}\n{text}")), left)
}

/// The reader knows no tori, tables and programs, no zone from the zero that was set, no common and no projected zone, no straightness of lines
/// of what has no axis.
fn is_known(part: &Part, asked: &Characteristic) -> bool {
    use Geometry::{Cone, Cylinder, Plane, Slot, Sphere};
    let is_shape = |f: &usize| {
        let shape = &part.features[*f].geometry;
        matches!(shape, Plane { .. } | Cylinder { .. } | Cone { .. } | Sphere { .. } | Slot { .. })
    };
    let has_axis =
        matches!(part.features[asked.features[0]].geometry, Cylinder { .. } | Cone { .. });
    let is_pattern = asked.features.len() > 1;
    asked.features.iter().chain(asked.datums.iter().flat_map(|d| &d.features)).all(is_shape)
        && !(asked.kind.is_located() && asked.datums.is_empty())
        && !(asked.kind == Kind::Position && is_pattern)
        && asked.projected_mm.is_none()
        && (asked.kind != Kind::LineStraightness || has_axis)
}

/// Numbers of a shape are those of the other one.
fn assert_same_shape(one: &Geometry, other: &Geometry, name: &str) {
    let numbers = |g: &Geometry| -> (Vec<f64>, Vec<f64>) {
        match *g {
            Geometry::Plane { at_mm, normal, along, size_mm } => (
                [at_mm.as_slice(), &size_mm].concat(),
                [normal.as_slice(), along.as_slice()].concat(),
            ),
            Geometry::Cylinder { at_mm, axis, radius_mm, length_mm, is_hole } => (
                [at_mm.as_slice(), &[radius_mm, length_mm, f64::from(u8::from(is_hole))]].concat(),
                axis.as_slice().to_vec(),
            ),
            // From its narrow end, as in QIF.
            Geometry::Cone { at_mm, axis, radii_mm: [a, b], length_mm, is_hole } => {
                let (at, axis) =
                    if a <= b { (at_mm, axis) } else { (at_mm + axis * length_mm, -axis) };
                let rest = [a.min(b), a.max(b), length_mm, f64::from(u8::from(is_hole))];
                ([at.as_slice(), &rest].concat(), axis.as_slice().to_vec())
            }
            Geometry::Sphere { at_mm, axis, radius_mm, opening_rad, is_hole } => (
                [at_mm.as_slice(), &[radius_mm, opening_rad, f64::from(u8::from(is_hole))]]
                    .concat(),
                axis.as_slice().to_vec(),
            ),
            Geometry::Slot { at_mm, across, along, size_mm, width_mm, is_hole } => (
                [at_mm.as_slice(), &size_mm, &[width_mm, f64::from(u8::from(is_hole))]].concat(),
                [across.as_slice(), along.as_slice()].concat(),
            ),
            _ => panic!("{name} is no shape of a draft"),
        }
    };
    let ((places, directions), (places_2, directions_2)) = (numbers(one), numbers(other));
    let far = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len(), "{name}");
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    // A draft rounds places to 1 nm.
    assert!(far(&places, &places_2) < 1e-6, "{name}: {one:?} {other:?}");
    assert!(far(&directions, &directions_2) < 1e-9, "{name}: {one:?} {other:?}");
}

#[test]
fn law_the_reader_of_product_definitions_reads_the_nominal_half() {
    for part in [housing(), every()] {
        let (read, left) = drafted(&part);
        assert_eq!(read.name, part.name);
        let names = |p: &Part, of: &[usize]| -> Vec<String> {
            of.iter().map(|f| p.features[*f].name.trim_end_matches("_2").to_owned()).collect()
        };
        let mut count = 0;
        for asked in part.characteristics.iter().filter(|a| is_known(&part, a)) {
            for feature in &asked.features {
                let own = &part.features[*feature];
                let name = match asked.features.len() {
                    1 => asked.name.clone(),
                    _ => format!("{} of {}", asked.name, own.name),
                };
                let twin = read.characteristics.iter().find(|c| c.name == name);
                let twin = twin.unwrap_or_else(|| panic!("{name} is left out: {left:?}"));
                assert_eq!((twin.kind, &twin.datums.len()), (asked.kind, &asked.datums.len()));
                let all = |of: &[Datum]| {
                    of.iter().flat_map(|d| d.features.clone()).collect::<Vec<usize>>()
                };
                assert_eq!(names(&read, &all(&twin.datums)), names(&part, &all(&asked.datums)));
                let limits = |l: &Limits| match *l {
                    Limits::Zone { tolerance_mm } => [tolerance_mm; 2],
                    Limits::Size { low_mm, high_mm } => [low_mm, high_mm],
                };
                let (a, b) = (limits(&twin.limits), limits(&asked.limits));
                assert!((a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-9, "{name}: {a:?} {b:?}");
                let other = &read.features[twin.features[0]];
                assert_same_shape(&own.geometry, &other.geometry, &own.name);
                // A datum without a letter has its name as one.
                let is_datum = |p: &Part, f: &usize| {
                    p.characteristics
                        .iter()
                        .any(|c| c.datums.iter().any(|d| d.features.contains(f)))
                };
                let letter = own.letter.as_ref().or(is_datum(&part, feature).then_some(&own.name));
                let is_asked = is_datum(&read, &twin.features[0]);
                assert_eq!(other.letter.as_ref(), letter.filter(|_| is_asked), "{}", own.name);
                count += 1;
            }
        }
        assert_eq!(read.characteristics.len(), count, "{left:?}");
    }
}

/// Names that no part file could have as they are do not keep a draft from being read.
#[test]
fn odd_names_are_drafted() {
    let (read, left) = drafted(&odd());
    assert_eq!((read.characteristics.len(), left.len()), (4, 0), "{left:?}");
}
