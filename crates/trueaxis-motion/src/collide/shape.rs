//! Triangles of simple bodies: boxes, bodies of revolution, prisms.
//!
//! Round bodies become polygons *around* the true circle, at most [`ROUNDNESS_MM`] (or a 360-gon)
//! larger: a clearance is never stated too large.

use super::triangle::Triangle;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueaxis_geometry::Vec3;
use trueaxis_machine::models::Shape;

/// How far the corners of the polygon project beyond the circle, mm.
pub const ROUNDNESS_MM: f64 = 0.02;

/// The triangles of a shape; an STL file has to be read instead.
pub fn triangles_of(shape: &Shape) -> Option<Vec<Triangle>> {
    match shape {
        Shape::Stl { .. } => None,
        Shape::Box { size_mm } => Some(cuboid(*size_mm)),
        Shape::Cone { base_diameter_mm, top_diameter_mm, length_mm } => {
            let (base, top) = (0.5 * base_diameter_mm, 0.5 * top_diameter_mm);
            Some(revolve(&[[base, 0.0], [top, *length_mm]]))
        }
        Shape::Prism { outline_mm, length_mm } => Some(raise(outline_mm, *length_mm)),
    }
}

/// A centred box.
pub fn cuboid(size_mm: Vec3) -> Vec<Triangle> {
    let h = 0.5 * size_mm;
    let outline = [[-h.x, -h.y], [h.x, -h.y], [h.x, h.y], [-h.x, h.y]];
    let shifted = |t: Triangle| t.map(|c| Vec3::new(c.x, c.y, c.z - h.z));
    raise(&outline, size_mm.z).into_iter().map(shifted).collect()
}

/// Sides of a polygon about a circle of this radius.
fn sides(radius_mm: f64) -> usize {
    // r (1/cos(π/n) − 1) = roundness
    let angle = (radius_mm / (radius_mm + ROUNDNESS_MM)).acos();
    if angle > 0.0 { ((PI / angle).ceil() as usize).clamp(16, 360) } else { 360 }
}

/// The body that a profile of radius and height describes about z, closed with flat ends.
pub fn revolve(profile_mm: &[[f64; 2]]) -> Vec<Triangle> {
    let largest = profile_mm.iter().fold(0.0_f64, |m, p| m.max(p[0]));
    let n = sides(largest);
    let outwards = 1.0 / (PI / n as f64).cos();
    let point = |[radius, z]: [f64; 2], k: usize| {
        let (sin, cos) = (TAU * (k % n) as f64 / n as f64).sin_cos();
        Vec3::new(radius * outwards * cos, radius * outwards * sin, z)
    };
    let (Some(first), Some(last)) = (profile_mm.first(), profile_mm.last()) else {
        return Vec::new();
    };
    let mut triangles = Vec::with_capacity(2 * n * profile_mm.len());
    for k in 0..n {
        for ring in profile_mm.windows(2) {
            let [a, b] = [point(ring[0], k), point(ring[0], k + 1)];
            let [c, d] = [point(ring[1], k), point(ring[1], k + 1)];
            triangles.push([a, b, d]);
            triangles.push([a, d, c]);
        }
        let (bottom, top) = (Vec3::new(0.0, 0.0, first[1]), Vec3::new(0.0, 0.0, last[1]));
        triangles.push([bottom, point(*first, k + 1), point(*first, k)]);
        triangles.push([top, point(*last, k), point(*last, k + 1)]);
    }
    // A pointed end has no area there.
    triangles.retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    triangles
}

/// The profile of a cutter from the tip upwards: flat, with a corner radius, or a ball.
pub fn cutter_profile(radius_mm: f64, corner_radius_mm: f64, length_mm: f64) -> Vec<[f64; 2]> {
    const STEPS: usize = 8;
    let corner = corner_radius_mm.clamp(0.0, radius_mm).min(length_mm);
    if corner == 0.0 {
        return vec![[radius_mm, 0.0], [radius_mm, length_mm]];
    }
    let centre = [radius_mm - corner, corner];
    let step = FRAC_PI_2 / STEPS as f64;
    let around = corner / (0.5 * step).cos();
    let mut profile = vec![[centre[0], 0.0]];
    for k in 0..STEPS {
        let (sin, cos) = (-FRAC_PI_2 + (k as f64 + 0.5) * step).sin_cos();
        profile.push([centre[0] + around * cos, centre[1] + around * sin]);
    }
    profile.push([radius_mm, corner]);
    if length_mm > corner {
        profile.push([radius_mm, length_mm]);
    }
    profile
}

/// An outline raised along z.
pub fn raise(outline_mm: &[[f64; 2]], length_mm: f64) -> Vec<Triangle> {
    let mut outline = outline_mm.to_vec();
    let n = outline.len();
    let area: f64 = (0..n).map(|i| cross(outline[i], outline[(i + 1) % n])).sum();
    if area < 0.0 {
        outline.reverse();
    }
    let low = |i: usize| Vec3::new(outline[i][0], outline[i][1], 0.0);
    let high = |i: usize| Vec3::new(outline[i][0], outline[i][1], length_mm);
    let mut triangles = Vec::with_capacity(4 * n);
    for i in 0..n {
        let k = (i + 1) % n;
        triangles.push([low(i), low(k), high(k)]);
        triangles.push([low(i), high(k), high(i)]);
    }
    for [a, b, c] in cut_into_triangles(&outline) {
        triangles.push([low(a), low(c), low(b)]);
        triangles.push([high(a), high(b), high(c)]);
    }
    triangles
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Cuts ears off a counter-clockwise outline until none remains.
fn cut_into_triangles(outline: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let ear = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        let is_ear = |i: usize| {
            let [a, b, c] = ear(i).map(|k| outline[k]);
            let inside = |k: &usize| {
                let p = outline[*k];
                let apart = !ear(i).contains(k);
                apart && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
            };
            turn(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // Every simple outline has an ear; where rounding hides it, a flat corner goes first.
        let at = (0..n).find(|i| is_ear(*i)).unwrap_or(0);
        triangles.push(ear(at));
        left.remove(at);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume: the sum of the corners' triple products.
    fn volume(triangles: &[Triangle]) -> f64 {
        triangles.iter().map(|t| t[0].dot(&t[1].cross(&t[2]))).sum::<f64>() / 6.0
    }

    #[test]
    fn volumes_by_hand() {
        assert!((volume(&cuboid(Vec3::new(2.0, 3.0, 4.0))) - 24.0).abs() < 1e-12);
        let angle = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        assert!((volume(&raise(&angle, 10.0)) - 40.0).abs() < 1e-12);
        let mut clockwise = angle;
        clockwise.reverse();
        assert!((volume(&raise(&clockwise, 10.0)) - 40.0).abs() < 1e-12);
        // Around the circle: a little more than π r² h, by at most 2 · roundness / r.
        let cylinder = volume(&revolve(&[[10.0, 0.0], [10.0, 5.0]])) / (500.0 * PI);
        assert!((1.0..1.0 + 2.0 * ROUNDNESS_MM / 10.0).contains(&cylinder));
        let cone = volume(&revolve(&[[10.0, 0.0], [0.0, 6.0]])) / (200.0 * PI);
        assert!((1.0..1.0 + 2.0 * ROUNDNESS_MM / 10.0).contains(&cone));
    }

    #[test]
    fn a_ball_cutter_holds_its_ball() {
        let profile = cutter_profile(5.0, 5.0, 30.0);
        assert_eq!(profile.first(), Some(&[0.0, 0.0]));
        assert_eq!(profile.last(), Some(&[5.0, 30.0]));
        let radius = |p: &[f64; 2]| p[0].hypot(p[1] - 5.0);
        let round = &profile[1..profile.len() - 2];
        assert!(round.iter().all(|p| (5.0..5.05).contains(&radius(p))), "{profile:?}");
    }
}
