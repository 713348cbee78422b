//! What speaks against points: too little of the element, the same point twice, a single gross point (docs/model.md
//! eq. 239 and 240).

use crate::uncertainty::student_two_sided;
use crate::{Element, Fitted, profile, start};
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};
use trueaxis_geometry::Vec3;

/// A point is gross if chance makes one of all as large less often than this.
const BY_CHANCE: f64 = 0.01;

/// How much of an element has points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// Angle about the axis or in the plane of a circle without its largest gap; of a sphere that of the cone of
    /// directions with points.
    pub angle_rad: Option<f64>,
    /// Length along an axis in radii, width of the points of a plane over their length. Unit: 1.
    pub ratio: Option<f64>,
}

/// The point that does not belong to the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gross {
    /// Its index, from 0.
    pub index: usize,
    /// Its deviation from the least-squares element.
    pub deviation_mm: f64,
    /// Its deviation from the element of the others, in standard deviations of these. Unit: 1.
    pub size: f64,
    /// What chance reaches once in a hundred such sets of points. Unit: 1.
    pub limit: f64,
}

/// How much of the element the points cover.
pub fn cover(fitted: &Fitted, points_mm: &[Vec3]) -> Cover {
    let shape = fitted.shape();
    let none = Cover { angle_rad: None, ratio: None };
    match fitted.element {
        Element::Line => none,
        Element::Plane => {
            let middle = points_mm.iter().sum::<Vec3>() / points_mm.len() as f64;
            let [(_, x), (_, y), _] = start::principal(points_mm);
            let flat = points_mm.iter().map(|p| [(p - middle).dot(&x), (p - middle).dot(&y)]);
            let flat: Vec<[f64; 2]> = flat.collect();
            let ends =
                flat.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[0]), h.max(p[0])));
            let width = profile::narrowest(&flat).map_or(0.0, |s| s.width);
            Cover { ratio: Some(width / (ends.1 - ends.0)), ..none }
        }
        Element::Sphere => {
            let units = points_mm.iter().map(|p| (p - shape.point_mm).normalize());
            let units: Vec<Vec3> = units.collect();
            let towards = units.iter().sum::<Vec3>().try_normalize(1e-9).unwrap_or(Vec3::z());
            let widest = units.iter().map(|u| u.dot(&towards).clamp(-1.0, 1.0).acos());
            Cover { angle_rad: Some(2.0 * widest.fold(0.0, f64::max)), ..none }
        }
        Element::Circle | Element::Cylinder | Element::Cone => {
            let frame = crate::surface::Frame::new(shape.point_mm, &shape.direction);
            let local: Vec<Vec3> = points_mm.iter().map(|p| frame.local(p)).collect();
            let along = local.iter().map(|q| q.z);
            let ends = along.fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(z), h.max(z)));
            let is_circle = fitted.element == Element::Circle;
            let ratio = (!is_circle).then(|| (ends.1 - ends.0) / shape.radius_mm);
            Cover { angle_rad: Some(TAU - largest_gap(&local)), ratio }
        }
    }
}

/// The largest angle about z without a point.
fn largest_gap(local: &[Vec3]) -> f64 {
    let mut angles: Vec<f64> = local.iter().map(|q| q.y.atan2(q.x)).collect();
    angles.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else { return TAU };
    let around = first + TAU - last;
    angles.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max)
}

/// The point that deviates most from the element of the others, if that is more than chance.
///
/// # Source
/// Externally studentised residuals with the limit of Bonferroni: Cook and Weisberg 1982.
pub fn gross(fitted: &Fitted, points_mm: &[Vec3]) -> Option<Gross> {
    let reference = &fitted.references[0];
    let here = fitted.distances(reference, points_mm);
    let is_space_line = fitted.element == Element::Line && fitted.normal.is_none();
    let columns = fitted.slopes();
    let (n, degrees) = (points_mm.len(), fitted.degrees_of_freedom);
    let share = if is_space_line { 2 } else { 1 };
    if degrees < share + 2 {
        return None;
    }
    let matrix = DMatrix::from_fn(n, columns + 1, |i, c| match c == columns {
        true => 1.0,
        false => here.slopes[i][c],
    });
    let lever: Vec<f64> = match is_space_line {
        true => levers_along(fitted, points_mm),
        false => matrix.qr().q().row_iter().map(|row| row.norm_squared()).collect(),
    };
    let s = fitted.residual_deviation_mm;
    let deviations: Vec<f64> = points_mm.iter().map(|p| deviation(fitted, p)).collect();
    let others = (degrees - share) as f64;
    let size = |i: usize| {
        let square = deviations[i].powi(2) / (1.0 - lever[i]).max(1e-9);
        let rest = (s * s * degrees as f64 - square) / others;
        if rest > 0.0 { (square / rest).sqrt() } else { f64::INFINITY }
    };
    let rounding = s < 1e-12 * fitted.size_mm;
    let index = (0..n).max_by(|a, b| size(*a).total_cmp(&size(*b))).filter(|_| !rounding)?;
    let tail = BY_CHANCE / n as f64;
    let limit = match is_space_line {
        true => (others * (tail.powf(-2.0 / others) - 1.0)).sqrt(),
        false => student_two_sided(tail, degrees - share),
    };
    let size = size(index);
    (size > limit && size.is_finite()).then(|| Gross {
        index,
        deviation_mm: deviations[index],
        size,
        limit,
    })
}

/// Of a profile in its plane, of other elements as the element states it.
fn deviation(fitted: &Fitted, point: &Vec3) -> f64 {
    let shape = fitted.shape();
    match fitted.normal {
        Some(normal) => (point - shape.point_mm).dot(&shape.direction.cross(&normal)),
        None => shape.deviation_mm(point),
    }
}

fn levers_along(fitted: &Fitted, points_mm: &[Vec3]) -> Vec<f64> {
    let shape = fitted.shape();
    let along = points_mm.iter().map(|p| (p - shape.point_mm).dot(&shape.direction));
    let along: Vec<f64> = along.collect();
    let sum: f64 = along.iter().map(|z| z * z).sum();
    along.iter().map(|z| 1.0 / points_mm.len() as f64 + z * z / sum).collect()
}

/// Half a turn: less of a circle than this leaves its radius uncertain.
pub const SMALL_ARC_RAD: f64 = PI;
