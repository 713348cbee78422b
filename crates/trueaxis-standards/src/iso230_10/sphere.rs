//! The least-squares sphere through points.

use nalgebra::{Matrix4, Vector3, Vector4};

/// Centre and radius of the least-squares sphere (geometric distance), mm; `None` if the points determine none.
///
/// Started from the algebraic sphere |p|² = 2 c·p + k, then by Gauss and Newton.
pub fn least_squares(points: &[[f64; 3]]) -> Option<([f64; 3], f64)> {
    let count = points.len() as f64;
    let mean = points.iter().map(|p| Vector3::from(*p)).sum::<Vector3<f64>>() / count;
    let away: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p) - mean).collect();
    let size = away.iter().map(Vector3::norm).fold(0.0, f64::max);
    if points.len() < 4 || size <= 0.0 {
        return None;
    }
    let solve = |rows: &mut dyn Iterator<Item = (Vector4<f64>, f64)>| {
        let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for (row, value) in rows {
            normal += row * row.transpose();
            right += row * value;
        }
        let smallest = normal.symmetric_eigenvalues();
        if smallest.min() < 1e-9 * smallest.max() {
            return None;
        }
        normal.cholesky().map(|c| c.solve(&right))
    };
    let scaled = || away.iter().map(|p| p / size);
    let algebraic = solve(
        &mut scaled()
            .map(|p| (Vector4::new(2.0 * p.x, 2.0 * p.y, 2.0 * p.z, 1.0), p.norm_squared())),
    )?;
    let mut centre = algebraic.xyz();
    let mut radius = (algebraic.w + centre.norm_squared()).max(0.0).sqrt();
    for _ in 0..100 {
        let step = solve(&mut scaled().map(|p| {
            let from = p - centre;
            let distance = from.norm().max(1e-12);
            let towards = from / distance;
            (Vector4::new(towards.x, towards.y, towards.z, 1.0), distance - radius)
        }))?;
        centre += step.xyz();
        radius += step.w;
        if step.norm() < 1e-15 {
            break;
        }
    }
    let centre = mean + centre * size;
    let found = ([centre.x, centre.y, centre.z], radius * size);
    (found.1.is_finite() && found.0.iter().all(|c| c.is_finite())).then_some(found)
}
