//! Groups of N poses, W at a time: the angles that aim the tool, and the linear axes that place its tip.

use crate::axis::MAX_AXES;
use crate::inverse::{Aim, ClosedForm};
use crate::lanes::Lanes;

#[inline(always)]
pub(super) fn aim_by<const W: usize, const N: usize, L: Lanes<W>>(
    aim: &Aim,
    axes: &[[f64; N]; 3],
    out: &mut [[f64; N]; 4],
) -> u64 {
    let mut undecided = 0;
    for at in (0..N).step_by(W) {
        let u = [lanes(&axes[0], at), lanes(&axes[1], at), lanes(&axes[2], at)];
        let ([one, other], bits) = aim.branches::<W, L>(u);
        undecided |= u64::from(bits) << at;
        put(&mut out[0], at, one[0]);
        put(&mut out[1], at, one[1]);
        put(&mut out[2], at, other[0]);
        put(&mut out[3], at, other[1]);
    }
    undecided
}

#[inline(always)]
pub(super) fn place_by<const W: usize, const N: usize, L: Lanes<W>>(
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    for at in (0..N).step_by(W) {
        let tip = [lanes(&tips[0], at), lanes(&tips[1], at), lanes(&tips[2], at)];
        let mut q = [L::splat(0.0); MAX_AXES];
        for axis in 0..MAX_AXES {
            q[axis] = lanes(&commands[axis], at);
        }
        let sines = form.sines(&q);
        let placed = form.place(tip, &q, &sines);
        for k in 0..3 {
            // −0 is 0.
            put(&mut commands[form.placing[k]], at, placed[k] + L::splat(0.0));
        }
    }
}

/// Tip and tool axis at commands: x y z each.
#[inline(always)]
pub(super) fn tool_by<const W: usize, const N: usize, L: Lanes<W>>(
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    for at in (0..N).step_by(W) {
        let mut q = [L::splat(0.0); MAX_AXES];
        for axis in 0..MAX_AXES {
            q[axis] = lanes(&commands[axis], at);
        }
        let [tip, axis] = form.tool(&q, &form.sines(&q));
        for k in 0..3 {
            put(&mut out[k], at, tip[k]);
            put(&mut out[3 + k], at, axis[k]);
        }
    }
}

#[inline(always)]
pub(super) fn lanes<const W: usize, const N: usize, L: Lanes<W>>(
    column: &[f64; N],
    at: usize,
) -> L {
    match column[at..].first_chunk() {
        Some(lanes) => L::load(lanes),
        // Not reached: N is a multiple of W.
        None => L::splat(f64::NAN),
    }
}

#[inline(always)]
pub(super) fn put<const W: usize, const N: usize, L: Lanes<W>>(
    column: &mut [f64; N],
    at: usize,
    value: L,
) {
    if let Some(to) = column[at..].first_chunk_mut() {
        value.store(to);
    }
}
