//! Points on a part of an STL surface.

use super::super::feature::MOST_POINTS;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::{Candidates, Facet, SurfacePoint, spread};
use trueaxis_input::stl::read_facets;
use trueaxis_input::{Diagnostics, Dimension, Place, Section};

/// `{ stl = "part.stl", unit = "mm", at = "0 0 0 mm", size = "60 40 20 mm", facing = "0 0 1", within = "30 deg" }`: the facets whose middle lies
/// in a box and whose normal is within an angle of a direction, sampled in a spacing.
pub(super) fn read_mesh(
    section: &Section<'_>,
    folder: &Path,
    spacing_mm: Option<f64>,
) -> Option<Vec<SurfacePoint>> {
    let file = section.require("stl", "the file: stl = \"part.stl\"").and_then(|i| i.text());
    let unit_mm = section.get("unit").map_or(Some(1.0), |item| {
        let quantity = format!("1 {}", item.text()?);
        let found = trueaxis_input::parse_quantity(&quantity, Dimension::Length).ok();
        if found.is_none() {
            item.error(
                "unknown-unit",
                format!("{quantity} is no length"),
                "unit = \"mm\" or \"in\"",
            );
        }
        found
    });
    let region = Region::read(section);
    let (file, unit_mm, region) = (file?, unit_mm?, region?);
    let path = folder.join(file);
    let mut problems = Diagnostics::new();
    let points = facets(section, &path, unit_mm, &mut problems).and_then(|facets| {
        let place = Place::whole(&path.display().to_string());
        if !is_closed(&facets) {
            let message =
                "the surface has gaps: which side is material is known by its facets alone";
            let hint = "points of facets that are turned over are measured from the wrong side";
            problems.note("open-surface", place.clone(), message.to_owned(), hint);
        } else if volume_mm3(&facets) < 0.0 {
            let message = "its facets are turned inside out".to_owned();
            problems.error(
                "inside-out",
                place.clone(),
                message,
                "export the body again, normals outwards",
            );
            return None;
        }
        let count = facets.len();
        let chosen: Vec<Facet> = facets.into_iter().filter(|f| region.contains(f)).collect();
        if chosen.is_empty() {
            let message = format!("none of its {count} facets lies in the region of the feature");
            let hint = "another `at`, `size`, `facing` or `within`; or another `unit`";
            problems.error("no-points", place, message, hint);
            return None;
        }
        let spacing_mm = spacing_mm.unwrap_or_else(|| 0.05 * extent_mm(&chosen));
        match spread(&Candidates::Facets(chosen), spacing_mm, MOST_POINTS) {
            Ok(points) => Some(points),
            Err(why) => {
                problems.error("too-many-points", place, why, "write a larger `spacing`");
                None
            }
        }
    });
    section.take_over(problems);
    points
}

fn facets(
    section: &Section<'_>,
    path: &Path,
    unit_mm: f64,
    problems: &mut Diagnostics,
) -> Option<Vec<Facet>> {
    let bytes = section.files().bytes(path, "an STL file", problems)?;
    let read = read_facets(&path.display().to_string(), &bytes, unit_mm, problems)?;
    Some(read.into_iter().map(|facet| facet.map(Vec3::from)).collect())
}

/// Which facets are meant.
struct Region {
    /// Middle and half of the edges of a box.
    within_box: Option<[Vec3; 2]>,
    /// A direction, and the cosine of the largest angle from it.
    facing: Option<(Vec3, f64)>,
}

impl Region {
    fn read(section: &Section<'_>) -> Option<Self> {
        let lengths = |key: &str| section.get(key).map(|i| i.lengths::<3>().map(Vec3::from));
        let within_box = match (lengths("at"), lengths("size")) {
            (None, None) => None,
            (Some(at), Some(size)) => Some([at?, 0.5 * size?]),
            _ => {
                let message = "a box has `at`, its middle, and `size`".to_owned();
                section.error("contradiction", message, "both of them, or none");
                return None;
            }
        };
        let facing = section.get("facing").map(|item| item.direction().map(Vec3::from));
        let within = section.get("within").map(|item| {
            let angle = item.quantity(Dimension::Angle)?;
            if !(angle > 0.0 && angle <= PI) {
                item.error(
                    "bad-angle",
                    "`within` must be from 0 to 180 deg".into(),
                    "within = \"30 deg\"",
                );
                return None;
            }
            Some(angle)
        });
        let facing = match (facing, within) {
            (None, None) => None,
            (Some(facing), within) => Some((facing?, within.unwrap_or(Some(PI / 6.0))?.cos())),
            (None, Some(_)) => {
                let message = "`within` is an angle from `facing`".to_owned();
                section.error("contradiction", message, "state `facing`, too");
                return None;
            }
        };
        Some(Self { within_box, facing })
    }

    fn contains(&self, facet: &Facet) -> bool {
        let middle = (facet[0] + facet[1] + facet[2]) / 3.0;
        let is_inside =
            |[at, half]: &[Vec3; 2]| (0..3).all(|k| (middle[k] - at[k]).abs() <= half[k]);
        let normal = (facet[1] - facet[0]).cross(&(facet[2] - facet[0]));
        let faces = |(direction, cos): &(Vec3, f64)| {
            normal.try_normalize(0.0).is_some_and(|n| n.dot(direction) >= cos - 1e-9)
        };
        self.within_box.as_ref().is_none_or(is_inside) && self.facing.as_ref().is_none_or(faces)
    }
}

/// Whether every edge has a neighbour on its other side.
fn is_closed(facets: &[Facet]) -> bool {
    let bits = |p: &Vec3| <[f64; 3]>::from(*p).map(|c| (c + 0.0).to_bits());
    let mut edges: BTreeMap<[[u64; 3]; 2], i64> = BTreeMap::new();
    for facet in facets {
        for k in 0..3 {
            let (a, b) = (bits(&facet[k]), bits(&facet[(k + 1) % 3]));
            let (edge, sense) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
            *edges.entry(edge).or_default() += sense;
        }
    }
    edges.values().all(|balance| *balance == 0)
}

fn volume_mm3(facets: &[Facet]) -> f64 {
    // About a corner, so that parts far from the origin keep their digits.
    let about = facets.first().map_or(Vec3::zeros(), |f| f[0]);
    let of = |f: &Facet| {
        let [a, b, c] = f.map(|p| p - about);
        a.dot(&b.cross(&c)) / 6.0
    };
    facets.iter().map(of).sum()
}

fn extent_mm(facets: &[Facet]) -> f64 {
    let points = || facets.iter().flatten();
    let low = points().fold(Vec3::repeat(f64::MAX), |a, b| a.inf(b));
    let high = points().fold(Vec3::repeat(f64::MIN), |a, b| a.sup(b));
    (high - low).amax().max(1e-3)
}
