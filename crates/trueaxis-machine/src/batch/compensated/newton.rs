//! W poses at a time to their compensated commands (docs/model.md eq. 163); generic over the vector instructions, with the
//! habits of `kernel.rs`.

use super::jacobian::{Columns, columns};
use super::{CommandColumns, CompensationError, CompensationJob, Effort, FastForm, one};
use crate::axis::MAX_AXES;
use crate::batch::Inputs;
use crate::batch::kernel::{State, poses};
use crate::batch::lanes::PoseLanes;
use crate::compensate::{FLAT, MET_MM, MET_RAD};
use crate::lanes::Lanes;
use crate::lanes::vectors::{cross, difference, dot, splat3, sum};

/// Evaluations of the chain after which a pose goes to the scalar path.
const MOST_EVALUATIONS: u32 = 8;

/// A last step that is not judged starts from here at most, mm and rad.
const CLOSE_MM: f64 = 1e-7;
const CLOSE_RAD: f64 = 1e-10;

/// One step: from the residual error to the motion of the axes.
struct Inverse<L> {
    /// Of the linear axes per mm of the tip.
    linear: [[L; 3]; 3],
    /// Of the rotary axes per rad of the tool axis.
    rotary: [[L; 3]; 2],
    /// How the tip moves per rad of the rotary axes.
    swung: [[L; 3]; 2],
}

/// W commands and approaches on their way.
pub(super) struct Group<const W: usize> {
    pub(super) positions: [[f64; W]; MAX_AXES],
    approaches: [[f64; W]; MAX_AXES],
}

/// Computes a job.
#[inline(always)]
pub(in crate::batch) fn run<const W: usize, L: PoseLanes<W>>(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    let mut effort = Effort::default();
    for at in (0..out.len()).step_by(W) {
        let count = W.min(out.len() - at);
        let full = u32::MAX >> (32 - count);
        let (settled, evaluations) = group::<W, L>(job, out, at, full);
        effort.evaluations += evaluations;
        let open = full & !settled;
        if open != 0 {
            effort = effort + by_scalar(job, out, at, open)?;
        }
    }
    Ok(effort)
}

/// The poses `at ..` whose bit is set, by the scalar path.
#[cold]
#[inline(never)]
fn by_scalar(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
    at: usize,
    open: u32,
) -> Result<Effort, CompensationError> {
    let mut lanes = (0..32).filter(|lane| open >> lane & 1 == 1);
    lanes.try_fold(Effort::default(), |effort, lane| {
        Ok(effort + one(job.compensator, job.inputs, out, [job.first, at + lane])?)
    })
}

/// The lanes that are compensated and written, and the evaluations of all of them.
#[inline(always)]
fn group<const W: usize, L: PoseLanes<W>>(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
    at: usize,
    full: u32,
) -> (u32, u64) {
    let fast = job.fast;
    let mut group = load::<W>(job, at, full.count_ones() as usize);
    let columns = columns::<W, L>(fast, &group);
    let (inverse, mut left_out) = inverse::<W, L>(fast, &columns);
    let (mut settled, mut evaluations) = (0, 0);
    let mut before = [L::splat(0.0); 2];
    for _ in 0..MOST_EVALUATIONS {
        let (state, outside) = poses::<W, L>(&fast.plan, &inputs_of(job, &group), 0);
        let (tip, axis) = missed(fast, &state, &columns.wanted);
        left_out |= outside;
        evaluations += u64::from((full & !settled & !left_out).count_ones());
        let now = [dot(&tip, &tip), dot(&axis, &axis)];
        let (far, farther) = not_met::<W, L>(fast, now, before);
        let met = full & !far & !settled & !left_out;
        if met != 0 {
            left_out |= beyond_travel::<W, L>(fast, &group);
            write(out, &group, at, met & !left_out, full);
            settled |= met & !left_out;
        }
        if (settled | left_out) & full == full {
            break;
        }
        step::<W, L>(fast, &inverse, tip, axis, &mut group);
        let met = full & !farther & !settled & !left_out;
        if met != 0 {
            left_out |= beyond_travel::<W, L>(fast, &group);
            write(out, &group, at, met & !left_out, full);
            settled |= met & !left_out;
        }
        if (settled | left_out) & full == full {
            break;
        }
        before = now;
    }
    (settled, evaluations)
}

/// The lanes that are not met, and those that will not be met by one more step either.
///
/// A step reduces the residual error by the factor of the previous step; where that leads below the
/// limit, the step is made and not evaluated again. `now` and `before` are the squares of the residual
/// errors of tip and tool axis; `before` is zero at the first step, so that it is evaluated.
#[inline(always)]
fn not_met<const W: usize, L: PoseLanes<W>>(
    fast: &FastForm,
    now: [L; 2],
    before: [L; 2],
) -> (u32, u32) {
    let (mut far, mut farther) = (0, 0);
    let parts = if fast.turning.is_some() { 2 } else { 1 };
    for part in 0..parts {
        let (met, close) = [(MET_MM, CLOSE_MM), (MET_RAD, CLOSE_RAD)][part];
        let (met, close) = (met * met, close * close);
        let now_far = now[part].outside(0.0, met);
        // |now|·|now|/|before| > met, without the quotient.
        let excess = before[part].times_from(L::splat(met), now[part] * now[part]);
        far |= now_far;
        let slow = excess.outside(f64::NEG_INFINITY, 0.0) | now[part].outside(0.0, close);
        farther |= now_far & slow;
    }
    (far, farther)
}

/// The last pose is repeated in the remaining lanes.
#[inline(always)]
fn load<const W: usize>(job: &CompensationJob<'_>, at: usize, count: usize) -> Group<W> {
    let first = job.first + at;
    let mut group = Group { positions: [[0.0; W]; MAX_AXES], approaches: [[0.0; W]; MAX_AXES] };
    let inputs = job.inputs;
    for axis in 0..MAX_AXES {
        fill(&mut group.positions[axis], inputs.positions[axis], first, count);
        fill(&mut group.approaches[axis], inputs.approaches[axis], first, count);
    }
    group
}

#[inline(always)]
fn fill<const W: usize>(to: &mut [f64; W], column: &[f64], first: usize, count: usize) {
    if column.is_empty() {
        return;
    }
    match column[first..].first_chunk() {
        Some(chunk) => *to = *chunk,
        None => {
            for (i, slot) in to.iter_mut().enumerate() {
                *slot = column[first + i.min(count - 1)];
            }
        }
    }
}

#[inline(always)]
fn inputs_of<'a, const W: usize>(job: &CompensationJob<'_>, group: &'a Group<W>) -> Inputs<'a> {
    let mut inputs = Inputs { positions: [&[]; MAX_AXES], approaches: [&[]; MAX_AXES] };
    for axis in 0..MAX_AXES {
        inputs.positions[axis] = &group.positions[axis];
        if !job.inputs.approaches[axis].is_empty() {
            inputs.approaches[axis] = &group.approaches[axis];
        }
    }
    inputs
}

/// Reached minus wanted tip and tool axis.
#[inline(always)]
fn missed<const W: usize, L: Lanes<W>>(
    fast: &FastForm,
    state: &State<L>,
    wanted: &[[L; 3]; 2],
) -> ([L; 3], [L; 3]) {
    let mut tip = sum(difference(state.tip, wanted[0]), state.tip_deviation);
    if let Some((per_mm, fixed_mm)) = &fast.growth {
        let per_mm = L::splat(*per_mm);
        let from_fixed = difference(state.tip, splat3(&(*fixed_mm).into()));
        tip = [
            from_fixed[0].times_from(per_mm, tip[0]),
            from_fixed[1].times_from(per_mm, tip[1]),
            from_fixed[2].times_from(per_mm, tip[2]),
        ];
    }
    (tip, sum(difference(state.axis, wanted[1]), state.axis_deviation))
}

#[inline(always)]
fn scaled<const W: usize, L: Lanes<W>>(v: [L; 3], by: L) -> [L; 3] {
    [v[0] * by, v[1] * by, v[2] * by]
}

/// The inverse of the columns, and the lanes where the scalar path shall judge.
#[inline(always)]
fn inverse<const W: usize, L: Lanes<W>>(
    fast: &FastForm,
    columns: &Columns<L>,
) -> (Inverse<L>, u32) {
    let one = L::splat(1.0);
    let [d1, d2, d3, t1, t2] = columns.tip;
    let normals = [cross(d2, d3), cross(d3, d1), cross(d1, d2)];
    let volume = dot(&d1, &normals[0]);
    let mut left_out = !volume.outside(-FLAT, FLAT);
    let per_volume = one / volume;
    let linear = [
        scaled(normals[0], per_volume),
        scaled(normals[1], per_volume),
        scaled(normals[2], per_volume),
    ];
    let mut rotary = [[L::splat(0.0); 3]; 2];
    if fast.turning.is_some() {
        // The two columns span the plane across the tool axis: (CᵀC)⁻¹Cᵀ.
        let [c1, c2] = columns.axis;
        let (a, b, c) = (dot(&c1, &c1), dot(&c1, &c2), dot(&c2, &c2));
        let determinant = a.times_minus(c, b * b);
        // σ₁² ≤ a + c, so that σ₂² ≥ determinant/(a + c).
        let room = (a + c).times_from(L::splat(fast.weakest_square), determinant);
        left_out |= room.outside(0.0, f64::INFINITY);
        let per_determinant = one / determinant;
        rotary = [
            scaled(difference(scaled(c1, c), scaled(c2, b)), per_determinant),
            scaled(difference(scaled(c2, a), scaled(c1, b)), per_determinant),
        ];
    }
    (Inverse { linear, rotary, swung: [t1, t2] }, left_out)
}

/// Moves the axes: the rotary ones for the tool axis, the linear ones for the tip.
#[inline(always)]
fn step<const W: usize, L: Lanes<W>>(
    fast: &FastForm,
    inverse: &Inverse<L>,
    tip: [L; 3],
    axis: [L; 3],
    group: &mut Group<W>,
) {
    let mut missing = tip;
    if let Some(turning) = &fast.turning {
        for (slot, &turning) in turning.iter().enumerate() {
            let by = dot(&inverse.rotary[slot], &axis);
            missing = difference(missing, scaled(inverse.swung[slot], by));
            move_back(&mut group.positions[turning], by);
        }
    }
    for slot in 0..3 {
        move_back(&mut group.positions[fast.placing[slot]], dot(&inverse.linear[slot], &missing));
    }
}

#[inline(always)]
fn move_back<const W: usize, L: Lanes<W>>(position: &mut [f64; W], by: L) {
    (L::load(position) - by).store(position);
}

/// The lanes with an axis beyond its travel.
#[inline(always)]
fn beyond_travel<const W: usize, L: Lanes<W>>(fast: &FastForm, group: &Group<W>) -> u32 {
    let mut beyond = 0;
    for (position, (from, to)) in group.positions.iter().zip(&fast.travel) {
        beyond |= L::load(position).outside(*from, *to);
    }
    beyond
}

/// Writes the lanes of a mask; a pose depends on its own command only, so each as soon as it is met.
#[inline(always)]
fn write<const W: usize>(
    out: &mut CommandColumns<'_>,
    group: &Group<W>,
    at: usize,
    lanes: u32,
    full: u32,
) {
    for (column, position) in out.each().iter_mut().zip(&group.positions) {
        match column[at..].first_chunk_mut() {
            Some(to) if lanes == full => *to = *position,
            _ => {
                for lane in 0..W {
                    if lanes >> lane & 1 == 1 {
                        column[at + lane] = position[lane];
                    }
                }
            }
        }
    }
}
