//! Geometric least squares: Newton steps on the centre, from an algebraic start.
//!
//! With r = mean |pᵢ − c| eliminated, only the centre is unknown:
//!
//! ```text
//! ∇ = −Σ eᵢ uᵢ        H = Σ (uᵢ − ū)(uᵢ − ū)ᵀ + Σ eᵢ/dᵢ (I − uᵢuᵢᵀ)
//! ```
//!
//! d distance, u unit direction from the centre, e = d − r. Near the answer a step squares the
//! error, so a step of 1e-8 radii is the last one.

use super::{Cloud, Polar, circumscribed};

/// A deviation of this part of the radius counts as a circle; beyond it other minima may exist.
const ROUND: f64 = 0.2;

/// The centre; `None` if the points define none.
pub(super) fn center(cloud: &Cloud, polar: &mut Polar) -> Option<[f64; 2]> {
    let first = descend(cloud, polar, algebraic(cloud));
    if let Some((center, _)) = first {
        polar.about(cloud, center);
        if polar.max - polar.min <= ROUND * polar.max {
            return Some(center);
        }
    }
    let around = circumscribed::center(cloud);
    let mut best = first;
    for start in starts(cloud, around) {
        let Some(found) = descend(cloud, polar, start) else { continue };
        if best.is_none_or(|b| found.1 < b.1) {
            best = Some(found);
        }
    }
    best.map(|b| b.0)
}

/// The mean, the enclosing circle's centre, and a ring of others.
fn starts(cloud: &Cloud, around: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let size = cloud.size;
    let ring = (0..16).map(move |i| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_8;
        let reach = if i % 2 == 0 { 0.5 } else { 1.5 } * size;
        [around[0] + reach * angle.cos(), around[1] + reach * angle.sin()]
    });
    [[0.0, 0.0], around].into_iter().chain(ring)
}

/// Kåsa's circle: the deviation of x² + y² is linear in the centre.
fn algebraic(cloud: &Cloud) -> [f64; 2] {
    let [xx, xy, yy] = cloud.moments();
    let (mut sx, mut sy) = (0.0, 0.0);
    for (x, y) in cloud.x.iter().zip(&cloud.y) {
        let square = x * x + y * y;
        sx += x * square;
        sy += y * square;
    }
    let determinant = 2.0 * (xx * yy - xy * xy);
    let center = [(sx * yy - sy * xy) / determinant, (sy * xx - sx * xy) / determinant];
    if center.iter().all(|v| v.is_finite()) { center } else { [0.0, 0.0] }
}

/// The least-squares sum and its derivatives at one centre.
struct Normal {
    cost: f64,
    mean: f64,
    gradient: [f64; 2],
    /// Gauss–Newton part and full Hessian, each as xx, xy, yy.
    gauss: [f64; 3],
    full: [f64; 3],
}

impl Normal {
    fn at(cloud: &Cloud, polar: &mut Polar, center: [f64; 2]) -> Self {
        polar.about(cloud, center);
        let (n, mean) = (polar.len(), polar.mean());
        let (mut cost, mut g, mut u, mut uu) = (0.0, [0.0; 2], [0.0; 2], [0.0; 3]);
        let mut bend = [0.0; 3];
        for i in 0..n {
            let (d, x, y) = (polar.distance[i], polar.ux[i], polar.uy[i]);
            let e = d - mean;
            let curve = e / d.max(f64::MIN_POSITIVE.sqrt());
            cost += e * e;
            g = [g[0] - e * x, g[1] - e * y];
            u = [u[0] + x, u[1] + y];
            uu = [uu[0] + x * x, uu[1] + x * y, uu[2] + y * y];
            bend = [bend[0] + curve * y * y, bend[1] - curve * x * y, bend[2] + curve * x * x];
        }
        let count = n as f64;
        let gauss =
            [uu[0] - u[0] * u[0] / count, uu[1] - u[0] * u[1] / count, uu[2] - u[1] * u[1] / count];
        let full = [gauss[0] + bend[0], gauss[1] + bend[1], gauss[2] + bend[2]];
        Self { cost, mean, gradient: g, gauss, full }
    }

    /// The Newton step, damped; without curvature upwards the Gauss–Newton one.
    fn step(&self, damping: f64) -> Option<[f64; 2]> {
        let solve = |h: [f64; 3], damping: f64| {
            let (xx, xy, yy) = (h[0] + damping, h[1], h[2] + damping);
            let determinant = xx * yy - xy * xy;
            if xx + yy <= 0.0 || determinant <= 1e-24 * (xx + yy) * (xx + yy) {
                return None;
            }
            let [gx, gy] = self.gradient;
            Some([(xy * gy - yy * gx) / determinant, (xy * gx - xx * gy) / determinant])
        };
        solve(self.full, damping).or_else(|| solve(self.gauss, damping.max(1e-3)))
    }
}

/// Downhill from a start to a minimum: its centre and the sum of squares.
fn descend(cloud: &Cloud, polar: &mut Polar, start: [f64; 2]) -> Option<([f64; 2], f64)> {
    let mut center = start;
    let mut now = Normal::at(cloud, polar, center);
    let mut damping = 0.0;
    let unit = cloud.len() as f64;
    for _ in 0..300 {
        let step = now.step(damping * unit)?;
        let next = [center[0] + step[0], center[1] + step[1]];
        if step[0].hypot(step[1]) <= 1e-8 * now.mean && damping == 0.0 {
            return Some((next, now.cost));
        }
        let there = Normal::at(cloud, polar, next);
        if there.cost <= now.cost {
            (center, now) = (next, there);
            damping = if damping < 1e-4 { 0.0 } else { 0.1 * damping };
        } else {
            damping = (10.0 * damping).max(1e-3);
        }
        if !now.mean.is_finite() || now.mean > 1e9 * cloud.size {
            return None;
        }
        if damping > 1e15 {
            return Some((center, now.cost));
        }
    }
    None
}
