//! The nominal Jacobian of W poses at a time; generic over the vector instructions, with the habits
//! of `kernel.rs`.

use super::FastForm;
use super::newton::Group;
use crate::batch::kernel::lanes_at;
use crate::batch::steps::{Joint, Step};
use crate::lanes::vectors::{
    cross, product, rotation, slide, slide_along, splat3, splat33, sum, turn_pair_about,
};
use crate::lanes::{Lanes, sine_cosine};

/// How the nominal tool moves per unit of the axes that compensate, and where it is.
pub(super) struct Columns<L> {
    /// Of the tip: three linear axes, two rotary ones.
    pub(super) tip: [[L; 3]; 5],
    /// Of the tool axis: the rotary ones.
    pub(super) axis: [[L; 3]; 2],
    /// The tip and the tool axis that are wanted.
    pub(super) wanted: [[L; 3]; 2],
}

/// The nominal Jacobian, carried from the tip to the workpiece.
#[inline(always)]
pub(super) fn columns<const W: usize, L: Lanes<W>>(
    fast: &FastForm,
    group: &Group<W>,
) -> Columns<L> {
    let zero = [L::splat(0.0); 3];
    let [tip, axis, ..] = &fast.plan.steps.start;
    let mut all = Columns { tip: [zero; 5], axis: [zero; 2], wanted: [splat3(tip), splat3(axis)] };
    for step in &fast.plan.steps.list {
        match step {
            Step::Error { .. } | Step::Motion { .. } => {}
            Step::Place { linear, shift_mm } => {
                rotate(&mut all, &splat33(linear));
                all.wanted[0] = sum(all.wanted[0], splat3(shift_mm));
            }
            Step::Shift { shift_mm } => all.wanted[0] = sum(all.wanted[0], splat3(shift_mm)),
            Step::Joint(Joint::SlideAlong { axis, along, per_unit }) => {
                let q = lanes_at::<W, L>(&group.positions[*axis], 0);
                slide_along(&mut all.wanted[0], *along, q, L::splat(*per_unit));
                let mut direction = [0.0; 3];
                direction[*along] = *per_unit;
                add_slide(&mut all, fast, *axis, &direction);
            }
            Step::Joint(Joint::Slide { axis, per_unit }) => {
                let q = lanes_at::<W, L>(&group.positions[*axis], 0);
                slide(&mut all.wanted[0], &splat3(per_unit), q);
                add_slide(&mut all, fast, *axis, per_unit);
            }
            Step::Joint(Joint::TurnAbout { axis, about, sense }) => {
                let (sin, cos) = sine_cosine(lanes_at::<W, L>(&group.positions[*axis], 0));
                let sin = sin * L::splat(*sense);
                for v in &mut all.tip {
                    turn_pair_about(v, *about, sin, cos);
                }
                for v in all.axis.iter_mut().chain(&mut all.wanted) {
                    turn_pair_about(v, *about, sin, cos);
                }
                let mut direction = [0.0; 3];
                direction[*about] = *sense;
                add_turn(&mut all, fast, *axis, &direction);
            }
            Step::Joint(Joint::Turn { axis, direction, sense }) => {
                let (sin, cos) = sine_cosine(lanes_at::<W, L>(&group.positions[*axis], 0));
                let sin = sin * L::splat(*sense);
                rotate(&mut all, &rotation(splat3(direction), sin, cos));
                add_turn(&mut all, fast, *axis, &direction.map(|d| d * sense));
            }
        }
    }
    all
}

#[inline(always)]
fn rotate<const W: usize, L: Lanes<W>>(all: &mut Columns<L>, m: &[[L; 3]; 3]) {
    for v in &mut all.tip {
        *v = product(m, v);
    }
    for v in all.axis.iter_mut().chain(&mut all.wanted) {
        *v = product(m, v);
    }
}

#[inline(always)]
fn add_slide<const W: usize, L: Lanes<W>>(
    all: &mut Columns<L>,
    fast: &FastForm,
    axis: usize,
    per_unit: &[f64; 3],
) {
    for (slot, &placing) in fast.placing.iter().enumerate() {
        if placing == axis {
            all.tip[slot] = splat3(per_unit);
        }
    }
}

#[inline(always)]
fn add_turn<const W: usize, L: Lanes<W>>(
    all: &mut Columns<L>,
    fast: &FastForm,
    axis: usize,
    per_unit: &[f64; 3],
) {
    let Some(turning) = &fast.turning else { return };
    for (slot, &turning) in turning.iter().enumerate() {
        if turning == axis {
            all.tip[3 + slot] = cross(splat3(per_unit), all.wanted[0]);
            all.axis[slot] = cross(splat3(per_unit), all.wanted[1]);
        }
    }
}
