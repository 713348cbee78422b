//! W poses at a time through the steps of the chain; generic over the vector instructions.
//!
//! Everything here is inlined into one function per instruction set. Hence no closures and no
//! iterators over lanes: those would be compiled once without the instructions, and called.

use super::columns::DeviationColumns;
use super::lanes::PoseLanes;
use super::motion::{General, GeneralCurve, Motion};
use super::pieces::Knots;
use super::steps::{Joint, Step};
use super::{BatchError, Inputs, Job, Plan};
use crate::lanes::vectors::{
    difference, product, rotation, slide, slide_along, splat3, splat33, sum, turn_pair_about,
};
use crate::lanes::{Lanes, sine_cosine};

/// The tool on its way through the chain.
#[derive(Clone, Copy)]
pub(super) struct State<L> {
    pub(super) tip: [L; 3],
    pub(super) axis: [L; 3],
    pub(super) tip_deviation: [L; 3],
    pub(super) axis_deviation: [L; 3],
}

/// Six errors as a shift and a rotation less the identity.
struct Displacement<L> {
    shift: [L; 3],
    turn: [[L; 3]; 3],
}

/// Computes a job; the poses that the plan does not cover go to the scalar path.
#[inline(always)]
pub(super) fn run<const W: usize, L: PoseLanes<W>>(
    job: &Job<'_>,
    out: &mut DeviationColumns<'_>,
) -> Result<(), BatchError> {
    let length = out.len();
    let whole = length - length % W;
    for at in (0..whole).step_by(W) {
        let (state, outside) = poses::<W, L>(job.plan, job.inputs, job.first + at);
        put(&mut out.nominal_tip_mm, state.tip, at);
        put(&mut out.nominal_axis, state.axis, at);
        put(&mut out.tip_mm, state.tip_deviation, at);
        put(&mut out.axis, state.axis_deviation, at);
        if outside != 0 {
            by_scalar(job, out, at, outside)?;
        }
    }
    if whole == length {
        return Ok(());
    }
    last_poses::<W, L>(job, out, whole)
}

/// The poses that do not fill a group: the last one is repeated in the remaining lanes.
#[inline(always)]
fn last_poses<const W: usize, L: PoseLanes<W>>(
    job: &Job<'_>,
    out: &mut DeviationColumns<'_>,
    at: usize,
) -> Result<(), BatchError> {
    let length = out.len() - at;
    let first = job.first + at;
    let padded = |column: &[f64]| -> [f64; W] {
        std::array::from_fn(|i| column.get(first + i.min(length - 1)).copied().unwrap_or(0.0))
    };
    let positions = job.inputs.positions.map(padded);
    let approaches = job.inputs.approaches.map(padded);
    let inputs = Inputs {
        positions: positions.each_ref().map(<[f64; W]>::as_slice),
        approaches: approaches.each_ref().map(<[f64; W]>::as_slice),
    };
    let (state, outside) = poses::<W, L>(job.plan, &inputs, 0);
    let triples = [
        (&mut out.nominal_tip_mm, state.tip),
        (&mut out.nominal_axis, state.axis),
        (&mut out.tip_mm, state.tip_deviation),
        (&mut out.axis, state.axis_deviation),
    ];
    for (columns, vector) in triples {
        for (column, value) in columns.iter_mut().zip(vector) {
            let mut lanes = [0.0; W];
            value.store(&mut lanes);
            column[at..].copy_from_slice(&lanes[..length]);
        }
    }
    by_scalar(job, out, at, outside & ((1 << length) - 1))
}

#[inline(always)]
fn put<const W: usize, L: Lanes<W>>(columns: &mut [&mut [f64]; 3], vector: [L; 3], at: usize) {
    for (column, value) in columns.iter_mut().zip(vector) {
        if let Some(to) = column[at..].first_chunk_mut() {
            value.store(to);
        }
    }
}

/// The poses `at ..` whose bit is set, by the scalar path.
#[cold]
#[inline(never)]
fn by_scalar(
    job: &Job<'_>,
    out: &mut DeviationColumns<'_>,
    at: usize,
    outside: u32,
) -> Result<(), BatchError> {
    let mut lanes = (0..32).filter(|lane| outside >> lane & 1 == 1);
    lanes.try_for_each(|lane| job.compiled.one(job.inputs, out, job.first, at + lane))
}

/// Poses `at .. at + W` and the lanes that the plan does not cover.
#[inline(always)]
pub(super) fn poses<const W: usize, L: PoseLanes<W>>(
    plan: &Plan,
    inputs: &Inputs<'_>,
    at: usize,
) -> (State<L>, u32) {
    let mut outside = 0;
    for (axis, range) in plan.ranges.iter().enumerate() {
        outside |= lanes_at::<W, L>(inputs.positions[axis], at).outside(range.from, range.to);
    }
    let [tip, axis, tip_deviation, axis_deviation] = &plan.steps.start;
    let mut state = State {
        tip: splat3(tip),
        axis: splat3(axis),
        tip_deviation: splat3(tip_deviation),
        axis_deviation: splat3(axis_deviation),
    };
    for step in &plan.steps.list {
        match step {
            Step::Error { shift_mm, turn } => {
                let by = Displacement { shift: splat3(shift_mm), turn: splat33(turn) };
                displace(&mut state, &by);
            }
            Step::Place { linear, shift_mm } => {
                rotate(&mut state, &splat33(linear));
                state.tip = sum(state.tip, splat3(shift_mm));
            }
            Step::Shift { shift_mm } => state.tip = sum(state.tip, splat3(shift_mm)),
            Step::Motion { motion, against } => {
                let motion = &plan.motions[*motion];
                let (errors, unknown) = errors_at::<W, L>(motion, inputs, at);
                outside |= unknown;
                move_by(&mut state, errors, motion.turns, *against);
            }
            Step::Joint(Joint::SlideAlong { axis, along, per_unit }) => {
                let q = lanes_at::<W, L>(inputs.positions[*axis], at);
                slide_along(&mut state.tip, *along, q, L::splat(*per_unit));
            }
            Step::Joint(Joint::Slide { axis, per_unit }) => {
                let q = lanes_at::<W, L>(inputs.positions[*axis], at);
                slide(&mut state.tip, &splat3(per_unit), q);
            }
            Step::Joint(Joint::TurnAbout { axis, about, sense }) => {
                let q = lanes_at::<W, L>(inputs.positions[*axis], at);
                let (sin, cos) = sine_cosine(q);
                turn_about(&mut state, *about, sin * L::splat(*sense), cos);
            }
            Step::Joint(Joint::Turn { axis, direction, sense }) => {
                let q = lanes_at::<W, L>(inputs.positions[*axis], at);
                let (sin, cos) = sine_cosine(q);
                let sin = sin * L::splat(*sense);
                rotate(&mut state, &rotation(splat3(direction), sin, cos));
            }
        }
    }
    (state, outside)
}

#[inline(always)]
pub(super) fn lanes_at<const W: usize, L: Lanes<W>>(column: &[f64], at: usize) -> L {
    match column[at..].first_chunk() {
        Some(lanes) => L::load(lanes),
        // Not reached: the lengths are checked before.
        None => L::splat(0.0),
    }
}

/// `v + m·u`
#[inline(always)]
pub(super) fn plus_product<const W: usize, L: Lanes<W>>(
    v: [L; 3],
    m: &[[L; 3]; 3],
    u: [L; 3],
) -> [L; 3] {
    [plus_dot(v[0], &m[0], &u), plus_dot(v[1], &m[1], &u), plus_dot(v[2], &m[2], &u)]
}

#[inline(always)]
fn plus_dot<const W: usize, L: Lanes<W>>(sum: L, a: &[L; 3], b: &[L; 3]) -> L {
    a[2].times_plus(b[2], a[1].times_plus(b[1], a[0].times_plus(b[0], sum)))
}

/// `d ← d + t + D·(p + d)`; a direction does not change with a shift.
#[inline(always)]
fn displace<const W: usize, L: Lanes<W>>(state: &mut State<L>, by: &Displacement<L>) {
    let tip = sum(state.tip, state.tip_deviation);
    let axis = sum(state.axis, state.axis_deviation);
    state.tip_deviation = plus_product(sum(state.tip_deviation, by.shift), &by.turn, tip);
    state.axis_deviation = plus_product(state.axis_deviation, &by.turn, axis);
}

/// Through the inverse: `d ← d − t + Dᵀ·(p + d − t)`.
#[inline(always)]
fn displace_back<const W: usize, L: Lanes<W>>(state: &mut State<L>, by: &Displacement<L>) {
    let [x, y, z] = by.turn;
    let back = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
    let deviation = difference(state.tip_deviation, by.shift);
    let axis = sum(state.axis, state.axis_deviation);
    state.tip_deviation = plus_product(deviation, &back, sum(state.tip, deviation));
    state.axis_deviation = plus_product(state.axis_deviation, &back, axis);
}

#[inline(always)]
fn move_by<const W: usize, L: Lanes<W>>(
    state: &mut State<L>,
    [x, y, z, a, b, c]: [L; 6],
    turns: bool,
    against: bool,
) {
    let shift = [x, y, z];
    match (turns, against) {
        (true, false) => displace(state, &Displacement { shift, turn: error_turn([a, b, c]) }),
        (true, true) => displace_back(state, &Displacement { shift, turn: error_turn([a, b, c]) }),
        (false, false) => state.tip_deviation = sum(state.tip_deviation, shift),
        (false, true) => state.tip_deviation = difference(state.tip_deviation, shift),
    }
}

/// `Rz(c)·Ry(b)·Rx(a) − I`, as [`crate::errors::SixErrors::rotation_minus_identity`], for small angles.
#[inline(always)]
pub(super) fn error_turn<const W: usize, L: Lanes<W>>(angles: [L; 3]) -> [[L; 3]; 3] {
    let (sa, va) = small_sine_versine(angles[0]);
    let (sb, vb) = small_sine_versine(angles[1]);
    let (sc, vc) = small_sine_versine(angles[2]);
    let one = L::splat(1.0);
    let (cb, cc) = (one - vb, one - vc);
    // sin a sin b and cos a sin b
    let (sasb, casb) = (sa * sb, va.times_from(sb, sb));
    [
        [
            less_one(vb, vc),
            sasb.times_minus(cc, va.times_from(sc, sc)),
            casb.times_plus(cc, sa * sc),
        ],
        [cb * sc, sasb.times_plus(sc, less_one(va, vc)), sa.times_from(cc, casb * sc)],
        [L::splat(0.0) - sb, sa * cb, less_one(va, vb)],
    ]
}

/// cos x cos y − 1 of two versines.
#[inline(always)]
fn less_one<const W: usize, L: Lanes<W>>(v: L, w: L) -> L {
    v.times_minus(w, v + w)
}

/// Sine and 1 − cosine up to [`super::LARGEST_TURN_RAD`].
#[inline(always)]
fn small_sine_versine<const W: usize, L: Lanes<W>>(a: L) -> (L, L) {
    let square = a * a;
    let series = square.times_plus(L::splat(1.0 / 120.0), L::splat(-1.0 / 6.0));
    let sine = (square * a).times_plus(series, a);
    let versine = square * square.times_plus(L::splat(-1.0 / 24.0), L::splat(0.5));
    (sine, versine)
}

/// Every vector by a rotation matrix.
#[inline(always)]
fn rotate<const W: usize, L: Lanes<W>>(state: &mut State<L>, m: &[[L; 3]; 3]) {
    state.tip = product(m, &state.tip);
    state.axis = product(m, &state.axis);
    state.tip_deviation = product(m, &state.tip_deviation);
    state.axis_deviation = product(m, &state.axis_deviation);
}

/// Every vector about x, y or z.
#[inline(always)]
fn turn_about<const W: usize, L: Lanes<W>>(state: &mut State<L>, about: usize, sin: L, cos: L) {
    turn_pair_about(&mut state.tip, about, sin, cos);
    turn_pair_about(&mut state.axis, about, sin, cos);
    turn_pair_about(&mut state.tip_deviation, about, sin, cos);
    turn_pair_about(&mut state.axis_deviation, about, sin, cos);
}

/// The six error motions, and the lanes with an approach that is neither −1, 0 nor 1.
#[inline(always)]
fn errors_at<const W: usize, L: PoseLanes<W>>(
    motion: &Motion,
    inputs: &Inputs<'_>,
    at: usize,
) -> ([L; 6], u32) {
    let q = lanes_at::<W, L>(inputs.positions[motion.axis], at);
    let (h, mut row) = match &motion.knots {
        Knots::Even { first, step, per_step, last_row } => {
            let number = (q - L::splat(*first)) * L::splat(*per_step);
            let (number, row) = number.whole(*last_row);
            (q - number.times_plus(L::splat(*step), L::splat(*first)), row)
        }
        Knots::Uneven(lookup) => uneven(lookup, q),
    };
    let (mut approach, mut unknown) = (L::splat(0.0), 0);
    if motion.has_reversal() {
        if !inputs.approaches[motion.axis].is_empty() {
            approach = lanes_at::<W, L>(inputs.approaches[motion.axis], at);
        }
        unknown = choose_rows(approach, motion.rows_per_approach, &mut row);
    }
    let mut errors = L::errors(&motion.rows, &row, h);
    for general in &motion.general {
        add_general(&mut errors, general, q, approach);
    }
    (errors, unknown)
}

/// The rows of each lane's approach; lanes whose approach has none.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a table has far fewer than 2^32 rows")]
fn choose_rows<const W: usize, L: Lanes<W>>(approach: L, rows: usize, row: &mut [u32; W]) -> u32 {
    let number = approach + L::splat(1.0);
    let (whole, sets) = number.whole(2.0);
    for (row, set) in row.iter_mut().zip(sets) {
        *row += set * rows as u32;
    }
    (number - whole).outside(0.0, 0.0)
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a table has far fewer than 2^32 rows")]
fn uneven<const W: usize, L: Lanes<W>>(lookup: &super::pieces::Lookup, q: L) -> (L, [u32; W]) {
    let (mut position, mut about, mut rows) = ([0.0; W], [0.0; W], [0; W]);
    q.store(&mut position);
    for i in 0..W {
        let row = lookup.row(position[i]);
        about[i] = lookup.about[row];
        rows[i] = row as u32;
    }
    (q - L::load(&about), rows)
}

#[inline(always)]
fn add_general<const W: usize, L: PoseLanes<W>>(
    errors: &mut [L; 6],
    general: &General,
    q: L,
    approach: L,
) {
    let mut value;
    match &general.curve {
        GeneralCurve::Polynomial { falling, origin, per_unit } => {
            let x = (q - L::splat(*origin)) * L::splat(*per_unit);
            value = L::splat(0.0);
            for c in falling {
                value = value.times_plus(x, L::splat(*c));
            }
        }
        GeneralCurve::Fourier { mean, terms } => {
            value = L::splat(*mean);
            for [order, cosine, sine] in terms {
                let (sin, cos) = sine_cosine(q * L::splat(*order));
                value = cos.times_plus(L::splat(*cosine), value);
                value = sin.times_plus(L::splat(*sine), value);
            }
        }
    }
    if general.is_reversal {
        value = value * (approach * L::splat(0.5));
    }
    for (k, error) in errors.iter_mut().enumerate() {
        if k == general.component {
            *error = *error + value;
        }
    }
}
