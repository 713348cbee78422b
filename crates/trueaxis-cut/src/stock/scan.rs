//! From a closed mesh to the material of lines.

use super::line::Material;
use super::{Lines, StockError};
use trueaxis_geometry::Vec3;

/// The material of each line: where it is inside of an odd number of walls.
pub(super) fn scan(lines: &Lines, triangles: &[[Vec3; 3]]) -> Result<Vec<Material>, StockError> {
    let mut hits: Vec<Vec<f64>> = vec![Vec::new(); lines.count()];
    for triangle in triangles {
        hit(lines, triangle, &mut hits);
    }
    let mut material = Vec::with_capacity(hits.len());
    for (i, mut line) in hits.into_iter().enumerate() {
        if line.len() % 2 == 1 {
            return Err(StockError::Open(named(lines, i)));
        }
        line.sort_by(f64::total_cmp);
        let pairs = line.chunks_exact(2).map(|p| [p[0], p[1]]);
        // Stretches that touch are one.
        let mut merged: Material = Vec::new();
        for pair in pairs.filter(|p| p[1] > p[0]) {
            match merged.last_mut() {
                Some(last) if pair[0] <= last[1] => last[1] = last[1].max(pair[1]),
                _ => merged.push(pair),
            }
        }
        material.push(merged);
    }
    Ok(material)
}

/// The middle of a line in words.
fn named(lines: &Lines, i: usize) -> String {
    let at = lines.place(i);
    let [u, v] = lines.across.map(|axis| format!("{} {:.3}", ["X", "Y", "Z"][axis], at[axis]));
    format!("{u} {v} mm")
}

/// Where lines go through a triangle.
fn hit(lines: &Lines, triangle: &[Vec3; 3], hits: &mut [Vec<f64>]) {
    let [a, b] = lines.across;
    let flat = triangle.map(|p| [p[a], p[b]]);
    let bound = |k: usize, pick: fn(f64, f64) -> f64, start: f64| {
        flat.iter().fold(start, |sum, p| pick(sum, p[k]))
    };
    let range = |k: usize| {
        let cell = |at: f64| (at - lines.first_mm[k]) / lines.step_mm[k];
        let last = lines.counts[k] as f64;
        let from = cell(bound(k, f64::min, f64::MAX)).ceil().clamp(0.0, last);
        let to = (cell(bound(k, f64::max, f64::MIN)).floor() + 1.0).clamp(0.0, last);
        from as usize..to as usize
    };
    // The plane of the triangle as a height over the grid; one that stands upright is met by no line.
    let normal = (triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0]));
    if normal[lines.along] == 0.0 {
        return;
    }
    for j in range(1) {
        let v = lines.first_mm[1] + j as f64 * lines.step_mm[1];
        for i in range(0) {
            let u = lines.first_mm[0] + i as f64 * lines.step_mm[0];
            if !contains(&flat, [u, v]) {
                continue;
            }
            let from = triangle[0];
            let rise = normal[a] * (u - from[a]) + normal[b] * (v - from[b]);
            let height = from[lines.along] - rise / normal[lines.along];
            let ends = triangle.map(|p| p[lines.along]);
            let low = ends.iter().copied().fold(f64::MAX, f64::min);
            let high = ends.iter().copied().fold(f64::MIN, f64::max);
            hits[j * lines.counts[0] + i].push(height.clamp(low, high));
        }
    }
}

/// Whether a triangle contains a point, seen along the lines. Of two triangles with a common edge exactly one contains a point of it: the side of
/// an edge is asked of its ends in one order, whichever triangle asks.
fn contains(flat: &[[f64; 2]; 3], point: [f64; 2]) -> bool {
    let sides = [0, 1, 2].map(|k| left_of(flat[k], flat[(k + 1) % 3], point));
    sides[0] == sides[1] && sides[1] == sides[2]
}

fn left_of(from: [f64; 2], to: [f64; 2], point: [f64; 2]) -> bool {
    let is_turned = (from[0], from[1]) > (to[0], to[1]);
    let [p, q] = if is_turned { [to, from] } else { [from, to] };
    let cross = (q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0]);
    // A point on the edge, or above its upper end, counts as left of it.
    (cross >= 0.0) != is_turned
}
