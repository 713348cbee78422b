//! The maximum inscribed circle: all corners of a polyhedron that could be the answer.
//!
//! About a fixed reference centre with radius R, for a shift δ, exactly:
//!
//! ```text
//! |pᵢ − δ|² = R² + 2R (kᵢ − aᵢ·δ) + |δ|²      kᵢ = (dᵢ² − R²)/2R,  aᵢ = (pᵢ − c)/R
//! ```
//!
//! so the inscribed radius is largest where t + |δ|²/2R is, over the polyhedron t ≤ kᵢ − aᵢ·δ:
//! at one of its corners. The top corner (a linear programme in the plane) is nearly always the
//! answer. But two inner points opposite each other (an oval) make a ridge with a corner at each
//! end, so every corner with t ≥ t_best − D²/2R is visited, going along the edges; the corners
//! above a level are connected. D is the shift beyond which the half gap g between points leaves
//! no room for a circle of the radius found:
//!
//! ```text
//! D = ρ cos g − √(r² − ρ² sin² g)      r the radius found, ρ the farthest (or nearest) point
//! ```

use super::{Cloud, Polar, cross};

/// More corners than this and the exhaustive search is faster.
const MOST_CORNERS: usize = 48;

const SIN_60: f64 = 0.866_025_403_784_438_6;

/// The constraints t ≤ k − a·δ.
#[derive(Debug, Clone, Default)]
pub(super) struct Lift {
    k: Vec<f64>,
    ax: Vec<f64>,
    ay: Vec<f64>,
    radius: f64,
}

#[derive(Debug, Clone, Copy)]
struct Corner {
    contacts: [usize; 3],
    shift: [f64; 2],
    level: f64,
}

/// The centre, or `None` where the fast way cannot prove its answer.
pub(super) fn center(
    cloud: &Cloud,
    polar: &Polar,
    lift: &mut Lift,
    angles: &mut Vec<f64>,
) -> Option<[f64; 2]> {
    lift.fill(polar);
    let top = lift.top(first(polar)?)?;
    let reach = lift.reach(polar, lift.value(&top), angles)?;
    let slack = 0.5 * reach * reach / lift.radius;
    // Below the rounding of the distances all corners are one.
    let best =
        if slack <= 4.0 * f64::EPSILON * lift.radius { top } else { lift.visit(top, slack)? };
    let (center, contacts) = (cloud.circumcenter(best.contacts)?, best.contacts);
    let noise = 32.0 * f64::EPSILON * polar.max.max(cloud.size);
    let radius = cloud.distance(contacts[0], center);
    let nearest = (0..cloud.len()).map(|i| cloud.distance(i, center)).fold(radius, f64::min);
    (radius - nearest <= noise).then_some(center)
}

/// Three points around the centre.
fn first(polar: &Polar) -> Option<[usize; 3]> {
    // 90°, 210°, 330°; of four quarters the points may be exactly opposite each other.
    let thirds = [[0.0, 1.0], [-SIN_60, -0.5], [SIN_60, -0.5]].map(|to| polar.farthest_to(to));
    let [a, b, c, d] = polar.quarters();
    [thirds, [a, b, c], [b, c, d], [c, d, a], [d, a, b]]
        .into_iter()
        .find(|triple| enclosure(triple.map(|i| polar.direction(i))) > 1e-3)
}

/// Positive if the origin is inside the triangle.
fn enclosure([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let turns = [cross(a, b), cross(b, c), cross(c, a)];
    let low = turns.iter().copied().fold(f64::INFINITY, f64::min);
    let high = turns.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    low.max(-high)
}

impl Lift {
    fn fill(&mut self, polar: &Polar) {
        let radius = polar.max;
        self.radius = radius;
        self.k.clear();
        self.ax.clear();
        self.ay.clear();
        let twice = 0.5 / radius;
        self.k.extend(polar.distance.iter().map(|d| (d - radius) * (d + radius) * twice));
        let along = |u: &[f64], out: &mut Vec<f64>| {
            out.extend(u.iter().zip(&polar.distance).map(|(u, d)| u * d / radius));
        };
        along(&polar.ux, &mut self.ax);
        along(&polar.uy, &mut self.ay);
    }

    fn a(&self, i: usize) -> [f64; 2] {
        [self.ax[i], self.ay[i]]
    }

    fn height(&self, i: usize, shift: [f64; 2]) -> f64 {
        self.k[i] - self.ax[i] * shift[0] - self.ay[i] * shift[1]
    }

    fn value(&self, corner: &Corner) -> f64 {
        let [x, y] = corner.shift;
        corner.level + 0.5 * (x * x + y * y) / self.radius
    }

    fn corner(&self, contacts: [usize; 3]) -> Option<Corner> {
        let [a, b, c] = contacts.map(|i| self.a(i));
        let [ka, kb, kc] = contacts.map(|i| self.k[i]);
        let (p, q) = ([a[0] - b[0], a[1] - b[1]], [a[0] - c[0], a[1] - c[1]]);
        let determinant = cross(p, q);
        if determinant.abs() < 1e-12 {
            return None;
        }
        let (e, f) = (ka - kb, ka - kc);
        let shift = [(e * q[1] - p[1] * f) / determinant, (p[0] * f - e * q[0]) / determinant];
        Some(Corner { contacts, shift, level: self.height(contacts[0], shift) })
    }

    /// The highest corner: a point below the level enters, the pair that still encloses stays.
    fn top(&self, start: [usize; 3]) -> Option<Corner> {
        // A gain below this is the rounding of the distances; following it ends in slivers.
        let noise = 16.0 * f64::EPSILON * self.radius;
        let mut contacts = start;
        for _ in 0..20 + 4 * self.k.len() {
            let corner = self.corner(contacts)?;
            let (lowest, height) = self.lowest(corner.shift);
            if height >= corner.level - noise || contacts.contains(&lowest) {
                return Some(corner);
            }
            contacts = self.exchange(contacts, lowest)?;
        }
        None
    }

    fn lowest(&self, shift: [f64; 2]) -> (usize, f64) {
        let n = self.k.len();
        let (ks, xs, ys) = (&self.k[..n], &self.ax[..n], &self.ay[..n]);
        let mut best = (0, f64::INFINITY);
        for i in 0..n {
            let height = ks[i] - xs[i] * shift[0] - ys[i] * shift[1];
            if height < best.1 {
                best = (i, height);
            }
        }
        best
    }

    /// The pair whose cone holds the direction opposite to the new point.
    fn exchange(&self, [a, b, c]: [usize; 3], new: usize) -> Option<[usize; 3]> {
        let opposite = self.a(new).map(|v| -v);
        let share = |p: usize, q: usize| {
            let (u, v) = (self.a(p), self.a(q));
            let determinant = cross(u, v);
            (cross(opposite, v) / determinant).min(cross(u, opposite) / determinant)
        };
        [(a, b), (b, c), (c, a)]
            .into_iter()
            .map(|(p, q)| ([p, q, new], share(p, q)))
            .filter(|(_, share)| *share >= -1e-9)
            .max_by(|x, y| x.1.total_cmp(&y.1))
            .map(|(contacts, _)| contacts)
    }

    /// The largest shift at which a circle as large as the one found could still fit.
    fn reach(&self, polar: &Polar, value: f64, angles: &mut Vec<f64>) -> Option<f64> {
        let gap = polar.half_gap(angles);
        let square = self.radius * (self.radius + 2.0 * value);
        let room = |q: f64| square - (q * gap.sin) * (q * gap.sin);
        let (near, far) = (polar.min, polar.max);
        if room(far) <= 0.0 {
            return None;
        }
        // Some point, nearest or farthest, is at most a half gap off the way; centres between
        // the points are at most `far` away, and up to there the bound must hold for both.
        if [near, far].iter().any(|&q| q * gap.cos + room(q).max(0.0).sqrt() < far) {
            return None;
        }
        let reach = |q: f64| q * gap.cos - room(q).max(0.0).sqrt();
        Some(reach(near).max(reach(far)).max(0.0))
    }

    /// The best of all corners at most `slack` lower than the best.
    fn visit(&self, top: Corner, slack: f64) -> Option<Corner> {
        let mut corners = [top; MOST_CORNERS];
        let (mut count, mut done) = (1, 0);
        let mut best = top;
        while done < count {
            let corner = corners[done];
            done += 1;
            for dropped in 0..3 {
                let Some(next) = self.along(&corner, dropped) else { continue };
                if next.level < self.value(&best) - slack
                    || corners[..count].iter().any(|c| same(c.contacts, next.contacts))
                {
                    continue;
                }
                if count == MOST_CORNERS {
                    return None;
                }
                corners[count] = next;
                count += 1;
                if self.value(&next) > self.value(&best) {
                    best = next;
                }
            }
        }
        Some(best)
    }

    /// The other end of the edge that leaves a corner by giving up one contact.
    fn along(&self, corner: &Corner, dropped: usize) -> Option<Corner> {
        let (p, q, left) = (
            corner.contacts[(dropped + 1) % 3],
            corner.contacts[(dropped + 2) % 3],
            corner.contacts[dropped],
        );
        let (ap, aq, al) = (self.a(p), self.a(q), self.a(left));
        let mut edge = [-(ap[1] - aq[1]), ap[0] - aq[0]];
        if (ap[0] - al[0]) * edge[0] + (ap[1] - al[1]) * edge[1] < 0.0 {
            edge = edge.map(|v| -v);
        }
        let falling = ap[0] * edge[0] + ap[1] * edge[1];
        let mut hit = (usize::MAX, f64::INFINITY);
        for j in 0..self.k.len() {
            let rate = falling - self.ax[j] * edge[0] - self.ay[j] * edge[1];
            if rate >= 0.0 || j == p || j == q || j == left {
                continue;
            }
            let step = (self.height(j, corner.shift) - corner.level).max(0.0) / -rate;
            if step < hit.1 {
                hit = (j, step);
            }
        }
        if hit.0 == usize::MAX { None } else { self.corner([p, q, hit.0]) }
    }
}

fn same(a: [usize; 3], b: [usize; 3]) -> bool {
    a.iter().all(|i| b.contains(i))
}
