//! First guesses of elements, without a start of their own (docs/model.md eq. 227).

use crate::surface::Frame;
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::{Mat3, Vec3};

/// Points that first guesses use.
const MOST_POINTS: usize = 400;

pub(crate) fn thinned(points: &[Vec3]) -> Vec<Vec3> {
    let n = points.len();
    match n <= MOST_POINTS {
        true => points.to_vec(),
        false => (0..MOST_POINTS).map(|k| points[k * n / MOST_POINTS]).collect(),
    }
}

/// Directions of the points about their mean, from the longest to the shortest, with their sums of squares.
pub(crate) fn principal(points: &[Vec3]) -> [(f64, Vec3); 3] {
    let mean = points.iter().sum::<Vec3>() / points.len() as f64;
    // By the singular values of the points, not of their products: thin clouds keep their digits.
    let matrix = DMatrix::from_fn(points.len(), 3, |i, k| points[i][k] - mean[k]);
    let r = matrix.qr().r();
    let mut square = Mat3::zeros();
    square.view_mut((0, 0), (r.nrows().min(3), 3)).copy_from(&r.rows(0, r.nrows().min(3)));
    let svd = square.svd(false, true);
    let vt = svd.v_t.unwrap_or(Mat3::identity());
    let mut all: [(f64, Vec3); 3] =
        std::array::from_fn(|k| (svd.singular_values[k].powi(2), vt.row(k).transpose()));
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all
}

/// The sphere with the smallest algebraic error: |p|² = 2 c·p + e.
pub(crate) fn sphere(points: &[Vec3]) -> Option<(Vec3, f64)> {
    let matrix =
        DMatrix::from_fn(points.len(), 4, |i, k| if k < 3 { 2.0 * points[i][k] } else { 1.0 });
    let right = DVector::from_iterator(points.len(), points.iter().map(Vec3::norm_squared));
    let v = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
    let centre = Vec3::new(v[0], v[1], v[2]);
    let square = v[3] + centre.norm_squared();
    (square > 0.0).then(|| (centre, square.sqrt()))
}

/// A guess of an axis: the frame about it, radius at its origin and half angle, and its algebraic error.
pub(crate) struct AxisGuess {
    pub frame: Frame,
    pub radius: f64,
    pub half_angle: f64,
    pub error: f64,
}

/// The best axes of cylinders or cones, from the best on.
pub(crate) fn axes(points: &[Vec3], cone: bool) -> Vec<AxisGuess> {
    let few = thinned(points);
    let own = principal(&few).map(|(_, direction)| direction);
    let mut guesses: Vec<AxisGuess> =
        own.into_iter().chain(hemisphere()).filter_map(|d| about(&few, &d, cone)).collect();
    guesses.sort_by(|a, b| a.error.total_cmp(&b.error));
    let mut kept: Vec<AxisGuess> = Vec::new();
    for guess in guesses {
        let z = guess.frame.direction();
        if kept.iter().all(|k| k.frame.direction().dot(&z).abs() < 0.95) {
            kept.push(guess);
        }
        if kept.len() == 6 {
            break;
        }
    }
    kept
}

/// Directions over a half sphere, by the golden angle.
fn hemisphere() -> impl Iterator<Item = Vec3> {
    const COUNT: u32 = 150;
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..COUNT).map(move |k| {
        let z = (f64::from(k) + 0.5) / f64::from(COUNT);
        let (sin, cos) = (golden * f64::from(k)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * cos, r * sin, z)
    })
}

/// x² + y² = 2 a x + 2 b y + e + f h + g h² about a direction; f = g = 0 for a cylinder.
fn about(points: &[Vec3], direction: &Vec3, cone: bool) -> Option<AxisGuess> {
    let frame = Frame::new(Vec3::zeros(), direction);
    let local: Vec<Vec3> = points.iter().map(|p| frame.local(p)).collect();
    let columns = if cone { 5 } else { 3 };
    let matrix = DMatrix::from_fn(local.len(), columns, |i, k| match k {
        0 => 2.0 * local[i].x,
        1 => 2.0 * local[i].y,
        2 => 1.0,
        3 => local[i].z,
        _ => local[i].z * local[i].z,
    });
    let right = DVector::from_iterator(local.len(), local.iter().map(|q| q.x * q.x + q.y * q.y));
    let v = matrix.clone().svd(true, true).solve(&right, 1e-9).ok()?;
    let radius = (v[2] + v[0] * v[0] + v[1] * v[1]).max(1e-6).sqrt();
    // R² + 2 R t h + t² h²
    let slope = if cone { (0.5 * v[3] / radius).clamp(-3.0, 3.0) } else { 0.0 };
    let centre = Vec3::new(v[0], v[1], 0.0);
    let errors = local.iter().map(|q| {
        let across = (q - centre).xy().norm();
        (across - radius - slope * q.z).powi(2) / (1.0 + slope * slope)
    });
    let error = errors.sum::<f64>();
    let frame = Frame { origin: frame.out_of(&centre), ..frame };
    error.is_finite().then(|| AxisGuess { frame, radius, half_angle: slope.atan(), error })
}
