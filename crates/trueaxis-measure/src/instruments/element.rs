//! Elements on which points lie: how far a point is from a plane, a line, a circle, a sphere or a cylinder whose
//! place, direction and radius are not known.
//!
//! ```text
//!     d = P − Q      h = n·d      ρ = d − h n      r = ρ/|ρ|
//!     plane     h                      sphere    |d| − R
//!     line      e₁·d, e₂·d             cylinder  |ρ| − R
//!     circle    |ρ| − R, h                                                     docs/model.md eq. 315
//! ```

use std::f64::consts::TAU;
use trueaxis_geometry::{Mat3, Vec3};

/// An element that is fixed on the table or the floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// A face: how far a point is from it.
    Plane,
    /// A straight edge: how far a point is from it in two directions across.
    Line,
    /// A circle in space: how far a point is from its radius and from its plane.
    Circle,
    /// A sphere, or a bar of one length about its joint.
    Sphere,
    /// A bore or a mandrel.
    Cylinder,
}

/// Two directions across a direction: of Z they are X and Y, of X they are Y and Z, of Y they are Z and X.
pub fn across(direction: Vec3) -> [Vec3; 2] {
    let largest = direction.iamax();
    let next = Vec3::ith((largest + 1) % 3, 1.0);
    let first = next - direction * next.dot(&direction);
    // Next to the largest component there is always a part across.
    let first = first.try_normalize(0.0).unwrap_or(next);
    [first, direction.cross(&first)]
}

impl Element {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Plane, Self::Line, Self::Circle, Self::Sphere, Self::Cylinder];

    /// The headings of its readings without unit.
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Self::Plane | Self::Sphere | Self::Cylinder => &["deviation"],
            Self::Circle => &["radial", "axial"],
            Self::Line => &["across_1", "across_2"],
        }
    }

    /// Whether it has a radius.
    pub fn is_round(self) -> bool {
        matches!(self, Self::Circle | Self::Sphere | Self::Cylinder)
    }

    /// How far a point is from the element; `d` from its reference point, `n` its direction, mm.
    pub fn distances_mm(self, d: Vec3, n: Vec3, radius_mm: f64) -> [f64; 3] {
        let h = n.dot(&d);
        let from_axis = (d - n * h).norm();
        match self {
            Self::Plane => [h, 0.0, 0.0],
            Self::Sphere => [d.norm() - radius_mm, 0.0, 0.0],
            Self::Cylinder => [from_axis - radius_mm, 0.0, 0.0],
            Self::Circle => [from_axis - radius_mm, h, 0.0],
            Self::Line => {
                let [first, second] = across(n);
                [first.dot(&d), second.dot(&d), 0.0]
            }
        }
    }

    /// How each distance grows with the place of the point: unit vectors.
    ///
    /// ```text
    ///     plane n      sphere d/|d|      cylinder r      circle r, n      line e₁, e₂   docs/model.md eq. 316
    /// ```
    pub fn normals(self, d: Vec3, n: Vec3) -> [Vec3; 3] {
        let nothing = Vec3::zeros();
        // At the centre or on the axis a distance has no direction; nothing is seen there.
        let unit = |v: Vec3| v.try_normalize(0.0).unwrap_or(nothing);
        let radial = unit(d - n * n.dot(&d));
        match self {
            Self::Plane => [n, nothing, nothing],
            Self::Sphere => [unit(d), nothing, nothing],
            Self::Cylinder => [radial, nothing, nothing],
            Self::Circle => [radial, n, nothing],
            Self::Line => {
                let [first, second] = across(n);
                [first, second, nothing]
            }
        }
    }

    /// Points on the element, from its reference point, evenly spread: over `length` along a line or a cylinder and
    /// over `length` by `width` of a plane; on a sphere over the half on the side of `n`, mm.
    pub fn points_mm(
        self,
        count: usize,
        n: Vec3,
        radius_mm: f64,
        [length_mm, width_mm]: [f64; 2],
    ) -> Vec<Vec3> {
        let [first, second] = across(n);
        let round = |angle: f64| first * angle.cos() + second * angle.sin();
        let share = |k: usize| (k as f64 + 0.5) / count as f64;
        // The fractions of the golden section fill an interval evenly whatever their number.
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let mixed = |k: usize| (0.5 + k as f64 * golden).fract();
        let even = |k: usize, of: usize| k as f64 / (of.max(2) - 1) as f64 - 0.5;
        let columns = (count as f64).sqrt().ceil() as usize;
        let rows = count.div_ceil(columns.max(1));
        let point = |k: usize| match self {
            Self::Plane => {
                first * (length_mm * even(k % columns, columns))
                    + second * (width_mm * even(k / columns, rows))
            }
            Self::Line => n * (length_mm * even(k, count)),
            Self::Circle => round(TAU * k as f64 / count as f64) * radius_mm,
            Self::Cylinder => {
                round(TAU * k as f64 / count as f64) * radius_mm
                    + n * (length_mm * (mixed(k) - 0.5))
            }
            Self::Sphere => {
                let height = share(k);
                let out = (1.0 - height * height).sqrt();
                (n * height + round(TAU * golden * k as f64) * out) * radius_mm
            }
        };
        (0..count).map(point).collect()
    }
}

/// The rigid motion that takes measured points nearest to nominal ones: turn and shift, `p ≈ R q + t`.
///
/// ```text
///     H = Σ (q − q̄)(p − p̄)ᵀ = U S Vᵀ      R = V diag(1, 1, |V Uᵀ|) Uᵀ      t = p̄ − R q̄     docs/model.md eq. 318
/// ```
///
/// *Source:* Arun, Huang, Blostein 1987; the determinant: Umeyama 1991. `None` where all points lie on a line, so that
/// a turn about it is not seen.
pub fn nearest_motion(measured: &[Vec3], nominal: &[Vec3]) -> Option<(Mat3, Vec3)> {
    let mean = |points: &[Vec3]| points.iter().sum::<Vec3>() / points.len().max(1) as f64;
    let (q, p) = (mean(measured), mean(nominal));
    let spread: Mat3 =
        measured.iter().zip(nominal).map(|(a, b)| (a - q) * (b - p).transpose()).sum();
    let parts = spread.svd(true, true);
    let (u, v) = (parts.u?, parts.v_t?.transpose());
    let mut sizes: [f64; 3] = parts.singular_values.into();
    sizes.sort_by(|a, b| b.total_cmp(a));
    if sizes[1] <= 1e-9 * sizes[0] || sizes[0] <= 0.0 {
        return None;
    }
    // The least direction may be mirrored: that of a plane of points has the size 0.
    let least =
        (0..3).min_by(|a, b| parts.singular_values[*a].total_cmp(&parts.singular_values[*b]))?;
    let mut flip = Vec3::repeat(1.0);
    flip[least] = (v * u.transpose()).determinant().signum();
    let turn = v * Mat3::from_diagonal(&flip) * u.transpose();
    Some((turn, p - turn * q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_as_far_as_a_drawing_says() {
        // (3 4 12): 13 from the origin, 5 from the axis Z, 12 above its plane.
        let d = Vec3::new(3.0, 4.0, 12.0);
        let of = |element: Element| element.distances_mm(d, Vec3::z(), 1.0);
        assert_eq!(of(Element::Plane), [12.0, 0.0, 0.0]);
        assert_eq!(of(Element::Line), [3.0, 4.0, 0.0]);
        assert_eq!(of(Element::Circle), [4.0, 12.0, 0.0]);
        assert_eq!(of(Element::Sphere), [12.0, 0.0, 0.0]);
        assert_eq!(of(Element::Cylinder), [4.0, 0.0, 0.0]);
    }

    #[test]
    fn directions_across_follow_one_another() {
        assert_eq!(across(Vec3::z()), [Vec3::x(), Vec3::y()]);
        assert_eq!(across(Vec3::x()), [Vec3::y(), Vec3::z()]);
        assert_eq!(across(Vec3::y()), [Vec3::z(), Vec3::x()]);
    }

    #[test]
    fn law_points_lie_on_their_element_and_their_normals_are_slopes() {
        let n = Vec3::new(0.3, -0.5, 0.8).normalize();
        for element in Element::ALL {
            for d in element.points_mm(17, n, 40.0, [100.0, 60.0]) {
                let at = |d: Vec3| element.distances_mm(d, n, 40.0);
                assert!(at(d).iter().all(|v| v.abs() < 1e-12), "{element:?}");
                let beside = d + Vec3::new(0.7, 1.1, -0.4);
                for (c, normal) in element.normals(beside, n).iter().enumerate() {
                    for i in 0..3 {
                        let step = Vec3::ith(i, 1e-5);
                        let slope = (at(beside + step)[c] - at(beside - step)[c]) / 2e-5;
                        assert!((slope - normal[i]).abs() < 1e-8, "{element:?} {c} {i}");
                    }
                }
            }
        }
    }

    #[test]
    fn law_points_of_a_cylinder_and_a_sphere_fill_them_evenly() {
        // Fractions of the golden section leave no gap larger than 2/n, and go all the way round.
        let (count, n) = (34, Vec3::new(0.3, -0.5, 0.8).normalize());
        for (element, from, to) in [(Element::Cylinder, -50.0, 50.0), (Element::Sphere, 0.0, 40.0)]
        {
            let points = element.points_mm(count, n, 40.0, [100.0, 60.0]);
            let mut heights: Vec<f64> = points.iter().map(|p| n.dot(p)).collect();
            heights.extend([from, to]);
            heights.sort_by(f64::total_cmp);
            assert_eq!((heights[0], heights[count + 1]), (from, to), "{element:?}");
            let gaps = heights.windows(2).map(|pair| pair[1] - pair[0]);
            assert!(gaps.fold(0.0, f64::max) <= 2.0 / count as f64 * (to - from), "{element:?}");
            let aside: Vec3 = points.iter().map(|p| p - n * n.dot(p)).sum();
            assert!(aside.norm() / (count as f64) < 0.05 * 40.0, "{element:?}: {aside}");
        }
    }

    #[test]
    fn law_a_frame_is_found_from_its_points() {
        let axis = nalgebra::Rotation3::from_euler_angles(0.7, -1.9, 2.6);
        let shift = Vec3::new(1200.0, -340.0, 55.0);
        for element in [Element::Plane, Element::Circle, Element::Sphere, Element::Cylinder] {
            let nominal = element.points_mm(9, Vec3::y(), 40.0, [100.0, 60.0]);
            let measured: Vec<Vec3> =
                nominal.iter().map(|p| axis.inverse() * (p - shift)).collect();
            let (turn, by) = nearest_motion(&measured, &nominal).expect("not on a line");
            assert!((turn - axis.matrix()).norm() < 1e-12 && (by - shift).norm() < 1e-9);
        }
        let line = Element::Line.points_mm(9, Vec3::y(), 0.0, [100.0, 60.0]);
        assert!(nearest_motion(&line, &line).is_none());
    }
}
