//! The angles of two rotary axes that point the tool in a wanted direction, without a series but those
//! of the last two arc tangents: the triangle of [`super::super::direction`] by its half angles.
//!
//! ```text
//!     c = a·u,  s = |a×u|,  cos(α/2) = √((1+c)/2),  sin(α/2) = s/(2 cos(α/2))      c ≥ 0; else the other way round
//!     p = sin((β+γ−α)/2)·sin((β−γ+α)/2),  m = sin((β+γ+α)/2)·sin((γ−β+α)/2)        p + m = sin α sin γ
//!     w = a c + t (m − p)/sin γ ± n 2√(pm)/sin γ                                   n = a×b/|a×b|,  t = n×a
//!     θ1 = atan2(μ n·u ∓ ρ t·u, μ t·u ± ρ n·u),   θ2 = atan2(w·(b×v), w·(v − b(b·v)))   docs/model.md eq. 338
//! ```
//!
//! μ and ρ are the parts of w along t and n. The four sines are sums of products of the half angle of α with
//! constants of the machine, so that they are exact to rounding also near the poles. Where one of them, or s,
//! is nearly zero, a branch ends: those directions are left to the scalar form.

use super::super::direction::DirectionSolver;
use crate::lanes::vectors::{cross, dot, splat3};
use crate::lanes::{Lanes, arc_tangent};

/// Nearer than this to a pole, or to where the branches meet, the scalar form decides.
const NEAR: f64 = 1e-9;

/// Two rotary axes, made ready.
#[derive(Debug, Clone)]
pub(crate) struct Aim {
    /// The axes, and the sense of each.
    pub axes: [usize; 2],
    senses: [f64; 2],
    a: [f64; 3],
    n: [f64; 3],
    t: [f64; 3],
    /// Sine and cosine of (β+γ)/2 and of (β−γ)/2.
    half_sum: [f64; 2],
    half_difference: [f64; 2],
    per_sine: f64,
    /// What a, t and n are along b×v, and along v − b(b·v).
    across: [f64; 3],
    along: [f64; 3],
}

/// The angles of both branches, positive as the commands are, not yet in (−π, π].
pub(crate) type Branches<L> = [[L; 2]; 2];

impl Aim {
    /// `None` unless exactly two axes aim.
    pub fn of(solver: &DirectionSolver) -> Option<Self> {
        let ([first, second], Some(pair)) = (&solver.turning[..], &solver.pair) else {
            return None;
        };
        let (a, b, v, n, t) = (pair.a, pair.b, pair.v, pair.n, pair.towards_b);
        let (across, along) = (b.cross(&v), v - b * b.dot(&v));
        let half = |angle: f64| {
            let (sin, cos) = (0.5 * angle).sin_cos();
            [sin, cos]
        };
        Some(Self {
            axes: [first.axis, second.axis],
            senses: [first.sense, second.sense],
            a: a.into(),
            n: n.into(),
            t: t.into(),
            half_sum: half(pair.beta + pair.gamma),
            half_difference: half(pair.beta - pair.gamma),
            per_sine: 1.0 / pair.gamma.sin(),
            across: [a, t, n].map(|x| x.dot(&across)),
            along: [a, t, n].map(|x| x.dot(&along)),
        })
    }

    /// Both branches for unit vectors, and the lanes that only the scalar form can decide.
    #[inline(always)]
    pub fn branches<const W: usize, L: Lanes<W>>(&self, u: [L; 3]) -> (Branches<L>, u32) {
        let (a, n, t) = (splat3(&self.a), splat3(&self.n), splat3(&self.t));
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let (c, off) = (dot(&a, &u), cross(a, u));
        let s = dot(&off, &off).square_root();
        let larger = half.times_plus(c.magnitude(), half).square_root();
        let smaller = s * half / larger;
        let cos = zero.where_above(c, smaller, larger);
        let sin = zero.where_above(c, larger, smaller);
        let (sum_sin, sum_cos) = (L::splat(self.half_sum[0]), L::splat(self.half_sum[1]));
        let difference_sin = L::splat(self.half_difference[0]);
        let difference_cos = L::splat(self.half_difference[1]);
        let beyond = [
            sum_sin.times_minus(cos, sum_cos * sin),
            difference_sin.times_plus(cos, difference_cos * sin),
            sum_sin.times_plus(cos, sum_cos * sin),
            difference_cos.times_minus(sin, difference_sin * cos),
        ];
        let least = beyond[0].smaller(beyond[1]).smaller(beyond[2].smaller(beyond[3])).smaller(s);
        // The largest of them is 1 and a little.
        let undecided = least.outside(NEAR, 2.0);
        let (up, down) = (beyond[0] * beyond[1], beyond[2] * beyond[3]);
        let per_sine = L::splat(self.per_sine);
        let m = (down - up) * per_sine;
        let r = (one + one) * (up * down).larger(zero).square_root() * per_sine;
        let (across, along) = (splat3(&self.across), splat3(&self.along));
        let level = [c.times_plus(across[0], m * across[1]), c.times_plus(along[0], m * along[1])];
        let (un, ut) = (dot(&u, &n), dot(&u, &t));
        let circle = Circle { m, level, across: across[2], along: along[2], un, ut };
        let one = self.branch(&circle, r);
        ([one, self.branch(&circle, zero - r)], undecided)
    }

    #[inline(always)]
    fn branch<const W: usize, L: Lanes<W>>(&self, at: &Circle<L>, r: L) -> [L; 2] {
        let first = arc_tangent(at.m * at.un - r * at.ut, at.m.times_plus(at.ut, r * at.un));
        let second =
            arc_tangent(r.times_plus(at.across, at.level[0]), r.times_plus(at.along, at.level[1]));
        [first * L::splat(self.senses[0]), second * L::splat(self.senses[1])]
    }
}

/// What both branches share.
struct Circle<L> {
    /// How far w is along t.
    m: L,
    /// What a and t give to w along b×v and v − b(b·v); n gives the rest.
    level: [L; 2],
    across: L,
    along: L,
    un: L,
    ut: L,
}
