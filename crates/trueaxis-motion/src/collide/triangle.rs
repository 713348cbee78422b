//! How far two triangles are apart.

use trueaxis_geometry::Vec3;
use trueaxis_input::stl::has_area;

/// Three corners, counter-clockwise seen from outside.
pub type Triangle = [Vec3; 3];

/// The nearest points of two triangles; the same point twice where they meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Square of the distance, mm².
    pub squared_mm2: f64,
    /// The nearest point of the first.
    pub on_first: Vec3,
    /// The nearest point of the second.
    pub on_second: Vec3,
}

impl Gap {
    fn between(on_first: Vec3, on_second: Vec3) -> Self {
        Self { squared_mm2: (on_second - on_first).norm_squared(), on_first, on_second }
    }

    fn swapped(self) -> Self {
        Self { on_first: self.on_second, on_second: self.on_first, ..self }
    }
}

/// The distance of two triangles if it is below `√below_mm2`, 0 if they meet.
///
/// The nearest points lie on two edges, or on a corner and a face; whichever pair has both
/// triangles on its far sides is the answer (Larsen, Gottschalk, Lin and Manocha, "Fast proximity
/// queries with swept sphere volumes", 1999).
pub fn gap(first: &Triangle, second: &Triangle, below_mm2: f64) -> Option<Gap> {
    let of_second = Heights::over(first, second);
    if of_second.nearest_mm2() >= below_mm2 {
        return None;
    }
    let of_first = Heights::over(second, first);
    if of_first.nearest_mm2() >= below_mm2 {
        return None;
    }
    let (mut apart, edges) = match edge_gap(first, second) {
        Edges::Settled(gap) => return Some(gap).filter(|g| g.squared_mm2 < below_mm2),
        Edges::Open { apart, nearest } => (apart, nearest),
    };
    for (heights, plane, other, swap) in
        [(&of_second, first, second, false), (&of_first, second, first, true)]
    {
        if let Some(corner) = heights.one_sided {
            apart = true;
            if let Some(gap) = corner_over_face(plane, heights, corner, &other[corner]) {
                let gap = if swap { gap.swapped() } else { gap };
                return Some(gap).filter(|g| g.squared_mm2 < below_mm2);
            }
        }
    }
    if apart {
        return Some(edges).filter(|g| g.squared_mm2 < below_mm2);
    }
    Some(Gap { squared_mm2: 0.0, ..edges })
}

/// The corners of one triangle over the plane of another, in multiples of its normal's length.
struct Heights {
    normal: Vec3,
    normal_squared: f64,
    heights: [f64; 3],
    /// The nearest corner, if all three are strictly on one side.
    one_sided: Option<usize>,
}

impl Heights {
    fn over(plane: &Triangle, corners: &Triangle) -> Self {
        let normal = (plane[1] - plane[0]).cross(&(plane[2] - plane[0]));
        let heights = corners.map(|c| (c - plane[0]).dot(&normal));
        let same_side = heights.iter().all(|h| *h > 0.0) || heights.iter().all(|h| *h < 0.0);
        let one_sided = same_side.then(|| {
            let nearer =
                |a: usize, b: usize| if heights[b].abs() < heights[a].abs() { b } else { a };
            nearer(nearer(0, 1), 2)
        });
        Self { normal, normal_squared: normal.norm_squared(), heights, one_sided }
    }

    /// No point of the triangle is nearer to the plane than this.
    fn nearest_mm2(&self) -> f64 {
        self.one_sided.map_or(0.0, |i| self.heights[i] * self.heights[i] / self.normal_squared)
    }
}

enum Edges {
    /// The nearest points of the triangles.
    Settled(Gap),
    /// The nearest points of their edges, and whether some direction was seen to part them.
    Open { apart: bool, nearest: Gap },
}

fn edge_gap(first: &Triangle, second: &Triangle) -> Edges {
    let mut apart = false;
    let mut nearest = Gap { squared_mm2: f64::INFINITY, ..Gap::between(first[0], second[0]) };
    for i in 0..3 {
        let edge = [first[i], first[(i + 1) % 3]];
        for j in 0..3 {
            let gap = segment_gap(edge, [second[j], second[(j + 1) % 3]]);
            if gap.squared_mm2 > nearest.squared_mm2 {
                continue;
            }
            nearest = gap;
            // Where the third corners lie along the connection: beyond it, the pair settles.
            let along = gap.on_second - gap.on_first;
            let of_first = (first[(i + 2) % 3] - gap.on_first).dot(&along);
            let of_second = (second[(j + 2) % 3] - gap.on_second).dot(&along);
            if of_first <= 0.0 && of_second >= 0.0 {
                return Edges::Settled(gap);
            }
            apart |= gap.squared_mm2 - of_first.max(0.0) + of_second.min(0.0) > 0.0;
        }
    }
    Edges::Open { apart, nearest }
}

/// A corner right over the face, if it is.
fn corner_over_face(face: &Triangle, h: &Heights, corner: usize, at: &Vec3) -> Option<Gap> {
    for k in 0..3 {
        let inwards = h.normal.cross(&(face[(k + 1) % 3] - face[k]));
        if (at - face[k]).dot(&inwards) <= 0.0 {
            return None;
        }
    }
    let foot = at - h.normal * (h.heights[corner] / h.normal_squared);
    Some(Gap::between(foot, *at))
}

/// The nearest points of two segments of some length (Ericson, Real-Time Collision Detection,
/// 5.1.9): the nearest points of the lines, brought back to the ends.
fn segment_gap([p, p_end]: [Vec3; 2], [q, q_end]: [Vec3; 2]) -> Gap {
    let (u, v, r) = (p_end - p, q_end - q, p - q);
    let (a, b, e) = (u.dot(&u), u.dot(&v), v.dot(&v));
    let (c, f) = (u.dot(&r), v.dot(&r));
    let parallel = a * e - b * b;
    let mut s = 0.0;
    if parallel > 1e-14 * a * e {
        s = ((b * f - c * e) / parallel).clamp(0.0, 1.0);
    }
    let t = ((b * s + f) / e).clamp(0.0, 1.0);
    // Once more from the other side: exact after a clamp, and corrects the loss of parallel lines.
    s = ((b * t - c) / a).clamp(0.0, 1.0);
    Gap::between(p + u * s, q + v * t)
}

/// Whether a triangle has an area at all, seen against its longest edge.
pub fn is_degenerate(t: &Triangle) -> bool {
    !has_area(&t.map(<[f64; 3]>::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3]) -> Triangle {
        corners.map(Vec3::from)
    }

    const FLOOR: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn distance(a: &Triangle, b: &Triangle) -> f64 {
        gap(a, b, f64::INFINITY).unwrap().squared_mm2.sqrt()
    }

    #[test]
    fn corner_over_face_and_through_it() {
        let floor = triangle(FLOOR);
        let tip = |z: f64| triangle([[1.0, 1.0, z], [1.0, 2.0, z + 5.0], [2.0, 1.0, z + 5.0]]);
        assert_eq!(distance(&floor, &tip(3.0)), 3.0);
        assert_eq!(distance(&tip(3.0), &floor), 3.0);
        assert_eq!(distance(&floor, &tip(-1.0)), 0.0);
    }

    #[test]
    fn edges_cross_at_a_distance() {
        let floor = triangle(FLOOR);
        // The edge x = −3, z = 2 … −2 runs past the edge x = 0: 3 mm to its side.
        let wall = triangle([[-3.0, 1.0, 2.0], [-3.0, 1.0, -2.0], [-9.0, 1.0, 0.0]]);
        assert_eq!(distance(&floor, &wall), 3.0);
        let below = gap(&floor, &wall, 8.9);
        assert_eq!(below, None);
    }

    #[test]
    fn coplanar_triangles() {
        let floor = triangle(FLOOR);
        let beside = triangle([[6.0, 0.0, 0.0], [8.0, 0.0, 0.0], [6.0, 4.0, 0.0]]);
        assert_eq!(distance(&floor, &beside), 2.0);
        let inside = triangle([[0.5, 0.5, 0.0], [1.0, 0.5, 0.0], [0.5, 1.0, 0.0]]);
        assert_eq!(distance(&floor, &inside), 0.0);
    }
}
