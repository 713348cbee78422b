//! Points and directions in a plane.

/// A point or a direction in a plane: along its first and its second axis, mm for points. Unit: mm
pub type Point = [f64; 2];

/// From `b` to `a`, mm.
pub fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// The point at a length from another one, in a direction, mm.
pub fn along(from: Point, direction: Point, length: f64) -> Point {
    [from[0] + length * direction[0], from[1] + length * direction[1]]
}

/// The scalar product.
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The part of the vector product that is perpendicular to the plane: positive if `b` is to the left of `a`.
pub fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The length, mm for points.
pub fn length(a: Point) -> f64 {
    a[0].hypot(a[1])
}
