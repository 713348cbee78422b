//! Vectors of lanes: one pose in each lane.
//!
//! Everything here is inlined into one function per instruction set.

use super::Lanes;

#[inline(always)]
pub(crate) fn splat3<const W: usize, L: Lanes<W>>(v: &[f64; 3]) -> [L; 3] {
    [L::splat(v[0]), L::splat(v[1]), L::splat(v[2])]
}

#[inline(always)]
pub(crate) fn splat33<const W: usize, L: Lanes<W>>(m: &[[f64; 3]; 3]) -> [[L; 3]; 3] {
    [splat3(&m[0]), splat3(&m[1]), splat3(&m[2])]
}

#[inline(always)]
pub(crate) fn sum<const W: usize, L: Lanes<W>>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn difference<const W: usize, L: Lanes<W>>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn dot<const W: usize, L: Lanes<W>>(a: &[L; 3], b: &[L; 3]) -> L {
    a[2].times_plus(b[2], a[1].times_plus(b[1], a[0] * b[0]))
}

#[inline(always)]
pub(crate) fn cross<const W: usize, L: Lanes<W>>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [
        a[1].times_minus(b[2], a[2] * b[1]),
        a[2].times_minus(b[0], a[0] * b[2]),
        a[0].times_minus(b[1], a[1] * b[0]),
    ]
}

#[inline(always)]
pub(crate) fn product<const W: usize, L: Lanes<W>>(m: &[[L; 3]; 3], u: &[L; 3]) -> [L; 3] {
    [dot(&m[0], u), dot(&m[1], u), dot(&m[2], u)]
}

/// `I cos φ + [n]× sin φ + n nᵀ (1 − cos φ)` (Rodrigues)
#[inline(always)]
pub(crate) fn rotation<const W: usize, L: Lanes<W>>(n: [L; 3], sin: L, cos: L) -> [[L; 3]; 3] {
    let versine = L::splat(1.0) - cos;
    let [x, y, z] = [n[0] * versine, n[1] * versine, n[2] * versine];
    let [sx, sy, sz] = [n[0] * sin, n[1] * sin, n[2] * sin];
    [
        [x.times_plus(n[0], cos), x * n[1] - sz, x.times_plus(n[2], sy)],
        [y.times_plus(n[0], sz), y.times_plus(n[1], cos), y * n[2] - sx],
        [z * n[0] - sy, z.times_plus(n[1], sx), z.times_plus(n[2], cos)],
    ]
}

#[inline(always)]
pub(crate) fn turn_pair_about<const W: usize, L: Lanes<W>>(
    v: &mut [L; 3],
    about: usize,
    sin: L,
    cos: L,
) {
    // Written out: an index known only at run time would put the vector into memory.
    match about {
        0 => (v[1], v[2]) = turned(v[1], v[2], sin, cos),
        1 => (v[2], v[0]) = turned(v[2], v[0], sin, cos),
        _ => (v[0], v[1]) = turned(v[0], v[1], sin, cos),
    }
}

#[inline(always)]
fn turned<const W: usize, L: Lanes<W>>(u: L, v: L, sin: L, cos: L) -> (L, L) {
    (sin.times_from(v, cos * u), sin.times_plus(u, cos * v))
}

#[inline(always)]
pub(crate) fn slide<const W: usize, L: Lanes<W>>(tip: &mut [L; 3], per_unit: &[L; 3], q: L) {
    tip[0] = q.times_plus(per_unit[0], tip[0]);
    tip[1] = q.times_plus(per_unit[1], tip[1]);
    tip[2] = q.times_plus(per_unit[2], tip[2]);
}

#[inline(always)]
pub(crate) fn slide_along<const W: usize, L: Lanes<W>>(
    tip: &mut [L; 3],
    along: usize,
    q: L,
    per_unit: L,
) {
    match along {
        0 => tip[0] = q.times_plus(per_unit, tip[0]),
        1 => tip[1] = q.times_plus(per_unit, tip[1]),
        _ => tip[2] = q.times_plus(per_unit, tip[2]),
    }
}
