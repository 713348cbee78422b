//! Features on facets of an STL file.

use std::path::{Path, PathBuf};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Files, SourceText};
use trueaxis_part::part::Part;

type Facets = Vec<[[f64; 3]; 3]>;

/// A cuboid of 40 × 30 × 20 about the origin, normals outwards.
fn cuboid() -> Facets {
    let corner = |i: usize| [0, 1, 2].map(|k| [20.0, 15.0, 10.0][k] * [-1.0, 1.0][i >> k & 1]);
    let faces =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let of = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]].map(|t| t.map(corner));
    faces.into_iter().flat_map(of).collect()
}

fn stl(facets: &Facets, scale: f64) -> String {
    let mut text = "solid part\n".to_owned();
    for facet in facets {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in facet.map(|c| c.map(|v| v * scale)) {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid part\n"
}

fn read(mesh: &str, facets: &Facets, scale: f64) -> (Option<Part>, Diagnostics) {
    let text = format!(
        "name = \"p\"\n[feature.face]\nmesh = {{ stl = \"part.stl\"{mesh} }}\nspacing = \"2 mm\"\n\
         [[characteristic]]\nprofile = \"20 um\"\nof = \"face\"\n"
    );
    let files = Files::none().with_texts([(PathBuf::from("part.stl"), stl(facets, scale))]);
    let source = SourceText::from(&files, "p.toml", &text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    (part, source.finish())
}

fn places(mesh: &str, facets: &Facets, scale: f64) -> Vec<[Vec3; 2]> {
    let (part, problems) = read(mesh, facets, scale);
    let part = part
        .unwrap_or_else(|| panic!("{:?}", problems.iter().map(|p| &p.message).collect::<Vec<_>>()));
    part.features[0].points.iter().map(|p| [p.point_mm, p.normal]).collect()
}

/// The top by its normal, by a box and by both; in inches as in mm; wherever the file begins.
#[test]
fn law_a_region_is_the_facets_that_are_meant() {
    let body = cuboid();
    let top = places(", facing = \"0 0 1\"", &body, 1.0);
    assert!(top.len() > 200, "{}", top.len());
    for [at, normal] in &top {
        assert!((at.z - 10.0).abs() < 1e-12 && (normal - Vec3::z()).norm() < 1e-12);
        assert!(at.x.abs() < 20.0 && at.y.abs() < 15.0);
    }
    let by_box = places(", at = \"0 0 10 mm\", size = \"40 30 1 mm\"", &body, 1.0);
    assert_eq!(top, by_box);
    let inches =
        places(", unit = \"in\", facing = \"0 0 2\", within = \"5 deg\"", &body, 1.0 / 25.4);
    assert_eq!(inches.len(), top.len());
    // Equally near neighbours may come in another order.
    for [at, _] in &inches {
        assert!(top.iter().any(|[b, _]| (at - b).norm() < 1e-9), "{at}");
    }
    // Every direction that has a face: within 180° all of it.
    let all = places(", facing = \"0 0 1\", within = \"180 deg\"", &body, 1.0);
    assert_eq!(all.len(), places("", &body, 1.0).len());
    assert!(all.len() > 3 * top.len());
    // Points are at least the spacing apart, and none is farther from its neighbour than twice that.
    for (i, [at, _]) in top.iter().enumerate() {
        let others = top.iter().enumerate().filter(|(k, _)| *k != i);
        let nearest = others.map(|(_, [b, _])| (b - at).norm()).fold(f64::MAX, f64::min);
        assert!((2.0 - 1e-9..4.0).contains(&nearest), "{nearest}");
    }
}

#[test]
fn bad_meshes_are_refused_by_name() {
    let body = cuboid();
    let said = |mesh: &str, facets: &Facets| {
        let (part, problems) = read(mesh, facets, 1.0);
        let codes: Vec<&str> = problems.iter().map(|p| p.code).collect();
        (part.is_some() && !problems.has_errors(), codes.join(" "))
    };
    assert_eq!(said("", &body), (true, String::new()));
    let mut open = body.clone();
    open.pop();
    assert_eq!(said("", &open), (true, "open-surface".to_owned()));
    let inside_out: Facets = body.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    assert_eq!(said("", &inside_out), (false, "inside-out".to_owned()));
    for (mesh, code) in [
        (", at = \"0 0 90 mm\", size = \"1 1 1 mm\"", "no-points"),
        (", facing = \"1 1 1\", within = \"5 deg\"", "no-points"),
        (", at = \"0 0 9 mm\"", "contradiction"),
        (", within = \"5 deg\"", "contradiction"),
        (", facing = \"0 0 1\", within = \"0 deg\"", "bad-angle"),
        (", unit = \"kg\"", "unknown-unit"),
        (", scale = 2", "unknown-key"),
    ] {
        let (is_read, codes) = said(mesh, &body);
        assert!(!is_read && codes.contains(code), "{mesh}: {codes}");
    }
    let files = Files::none().with_texts([(PathBuf::from("part.stl"), "no stl".to_owned())]);
    let text = "name = \"p\"\n[feature.face]\nmesh = { stl = \"part.stl\" }\n[[characteristic]]\nprofile = \"20 um\"\nof = \"face\"\n";
    let source = SourceText::from(&files, "p.toml", text);
    assert!(source.read(|root| Part::read(root, Path::new(""))).is_none());
    assert!(source.finish().iter().any(|p| p.code == "truncated-stl"));
}
