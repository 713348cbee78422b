//! STL files in and out.

use super::triangle::Triangle;
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_input::stl::{FACET, HEADING, read_facets};

/// The facets of an STL file, in mm; faults are reported with their byte or line.
///
/// Facets without area are left out, with a note that counts them.
pub fn read_stl(
    file: &str,
    bytes: &[u8],
    unit_mm: f64,
    problems: &mut Diagnostics,
) -> Option<Vec<Triangle>> {
    let facets = read_facets(file, bytes, unit_mm, problems)?;
    Some(facets.into_iter().map(|facet| facet.map(Vec3::from)).collect())
}

/// The binary form of these facets.
pub fn write_stl(heading: &str, facets: &[Triangle]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADING + FACET * facets.len());
    // A heading that begins with `solid` would make readers take it for the text form.
    let heading = format!("TrueAxis: {heading}");
    bytes.extend(heading.bytes().map(|b| if b.is_ascii_graphic() { b } else { b' ' }).take(80));
    bytes.resize(80, b' ');
    let count = u32::try_from(facets.len()).unwrap_or(u32::MAX);
    bytes.extend(count.to_le_bytes());
    for facet in facets.iter().take(count as usize) {
        let normal = (facet[1] - facet[0]).cross(&(facet[2] - facet[0]));
        let normal = normal.try_normalize(0.0).unwrap_or_default();
        for vector in [&normal, &facet[0], &facet[1], &facet[2]] {
            for value in vector.iter() {
                bytes.extend((*value as f32).to_le_bytes());
            }
        }
        bytes.extend([0, 0]);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collide::shape::cuboid;

    const TEXT: &str = "solid one\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   \
                        vertex 1 0 0\n   vertex 0 2e0 0\n  endloop\n endfacet\nendsolid one\n";

    fn read(bytes: &[u8]) -> (Option<Vec<Triangle>>, Vec<String>) {
        let mut problems = Diagnostics::new();
        let facets = read_stl("m.stl", bytes, 1.0, &mut problems);
        let said = problems.iter().map(|d| format!("{} {}", d.code, d.place)).collect();
        (facets, said)
    }

    #[test]
    fn both_forms_are_read() {
        let (facets, said) = read(TEXT.as_bytes());
        assert_eq!((facets.unwrap()[0][2].y, said.len()), (2.0, 0));
        let boxed = cuboid(Vec3::new(1.0, 2.0, 3.0));
        let mut bytes = write_stl("box", &boxed);
        assert_eq!(read(&bytes), (Some(boxed.clone()), vec![]));
        bytes[..6].copy_from_slice(b"solid "); // what some programs write into binary files
        assert_eq!(read(&bytes), (Some(boxed), vec![]));
    }

    #[test]
    fn faults_are_named_and_placed() {
        let said = |bytes: &[u8]| read(bytes).1.join(", ");
        assert_eq!(said(b""), "empty-stl m.stl");
        assert_eq!(said(b"solid x\nendsolid x"), "empty-stl m.stl");
        assert_eq!(said(&[7; 30]), "truncated-stl m.stl");
        assert_eq!(said(TEXT.replace("2e0", "nan").as_bytes()), "bad-corner m.stl:6:4");
        assert_eq!(said(TEXT.replace("2e0", "zwei").as_bytes()), "stl-syntax m.stl:6:13");
        assert_eq!(said(TEXT.replace("endloop", "").as_bytes()), "stl-syntax m.stl:8:2");
        assert_eq!(said(&TEXT.as_bytes()[..60]), "truncated-stl m.stl:5:2");
        assert_eq!(said(TEXT.replace("2e0", "0").as_bytes()), "empty-stl m.stl");
        let mut bytes = write_stl("box", &cuboid(Vec3::new(1.0, 2.0, 3.0)));
        bytes.push(0);
        assert_eq!(said(&bytes), "trailing-bytes m.stl");
        bytes.truncate(200);
        assert_eq!(said(&bytes), "truncated-stl m.stl");
        let mut bytes = write_stl("box", &cuboid(Vec3::new(1.0, 2.0, 3.0)));
        bytes[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(said(&bytes), "bad-corner m.stl");
        bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
        assert_eq!(said(&bytes), "truncated-stl m.stl");
    }
}
