//! The tool at one command of eight machines, whose errors are drawn within their uncertainties: a machine in each lane.
//!
//! ```text
//!     error k of a station = stated + Σ uₖ·z        z: how many standard uncertainties each quantity of a machine is off
//!     d ← d + t + D·(p + d)                         through each station, as in `kernel`; docs/model.md eq. 335
//! ```

use super::groups::{lanes, put};
use super::kernel::{error_turn, plus_product};
use super::{InstructionSet, LARGEST_TURN_RAD};
use crate::lanes::vectors::{difference, product, splat3, splat33, sum};
use crate::lanes::{Lanes, Plain};

/// Machines that are drawn together.
pub const DRAWN: usize = 8;

/// The factors of each quantity, one for each machine. Unit: 1.
pub type Factors = [[f64; DRAWN]];

/// A command with what is known of the errors there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawn {
    /// From the tool to the workpiece.
    pub stations: Vec<Drawable>,
    /// What one standard uncertainty of a quantity adds, mm or rad; in the order of stations and their errors.
    pub effects: Vec<(usize, f64)>,
    /// The growth of the workpiece, mm, and what a quantity adds to it.
    pub workpiece_mm: [f64; 3],
    pub grown_mm: Vec<(usize, [f64; 3])>,
}

/// Where six errors act.
#[derive(Debug, Clone)]
pub(crate) struct Drawable {
    /// The nominal tool there.
    pub tip_mm: [f64; 3],
    pub axis: [f64; 3],
    /// Its errors are passed in the inverse direction.
    pub is_back: bool,
    /// A squareness tilts only this motion, mm.
    pub tilted_mm: Option<[f64; 3]>,
    /// From here to the next one, where that turns.
    pub onward: Option<[[f64; 3]; 3]>,
    /// The errors as stated, mm and rad.
    pub stated: [f64; 6],
    /// Where the effects on each error end.
    pub ends: [usize; 6],
}

impl Drawn {
    /// Tip, mm, and axis of each machine less those of the nominal one. Lanes whose bit is set are undecided: the scalar form has to
    /// compute them.
    pub fn deviations(
        &self,
        set: InstructionSet,
        factors: &Factors,
        out: &mut [[f64; DRAWN]; 6],
    ) -> u32 {
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => super::x86::drawn_avx512(self, factors, out),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => super::x86::drawn_avx2(self, factors, out),
            _ => by::<4, Plain<4>>(self, factors, out),
        }
    }
}

/// W machines at a time.
#[inline(always)]
pub(super) fn by<const W: usize, L: Lanes<W>>(
    drawn: &Drawn,
    factors: &Factors,
    out: &mut [[f64; DRAWN]; 6],
) -> u32 {
    let mut undecided = 0;
    for at in (0..DRAWN).step_by(W) {
        let (mut tip, mut axis) = ([L::splat(0.0); 3], [L::splat(0.0); 3]);
        let (mut outside, mut from) = (0, 0);
        for station in &drawn.stations {
            let mut six = splat6(&station.stated);
            for (error, end) in six.iter_mut().zip(station.ends) {
                for (quantity, u) in &drawn.effects[from..end] {
                    *error =
                        factor::<W, L>(factors, *quantity, at).times_plus(L::splat(*u), *error);
                }
                from = end;
            }
            for angle in &six[3..] {
                outside |= angle.outside(-LARGEST_TURN_RAD, LARGEST_TURN_RAD);
            }
            (tip, axis) = acted(station, six, tip, axis);
            if let Some(onward) = &station.onward {
                let onward = splat33(onward);
                (tip, axis) = (product(&onward, &tip), product(&onward, &axis));
            }
        }
        let mut grown = splat3(&drawn.workpiece_mm);
        for (quantity, by_mm) in &drawn.grown_mm {
            let z = factor::<W, L>(factors, *quantity, at);
            let by_mm: [L; 3] = splat3(by_mm);
            grown = [
                z.times_plus(by_mm[0], grown[0]),
                z.times_plus(by_mm[1], grown[1]),
                z.times_plus(by_mm[2], grown[2]),
            ];
        }
        tip = difference(tip, grown);
        for k in 0..3 {
            put(&mut out[k], at, tip[k]);
            put(&mut out[3 + k], at, axis[k]);
        }
        undecided |= outside << at;
    }
    undecided
}

/// Through the errors of a station.
#[inline(always)]
fn acted<const W: usize, L: Lanes<W>>(
    station: &Drawable,
    six: [L; 6],
    tip: [L; 3],
    axis: [L; 3],
) -> ([L; 3], [L; 3]) {
    let shift = [six[0], six[1], six[2]];
    let turn = error_turn([six[3], six[4], six[5]]);
    if let Some(motion) = &station.tilted_mm {
        let shift = plus_product(shift, &turn, splat3(motion));
        let tip = if station.is_back { difference(tip, shift) } else { sum(tip, shift) };
        return (tip, axis);
    }
    let actual_axis = sum(splat3(&station.axis), axis);
    if station.is_back {
        let [x, y, z] = turn;
        let back = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        let tip = difference(tip, shift);
        let actual = sum(splat3(&station.tip_mm), tip);
        return (plus_product(tip, &back, actual), plus_product(axis, &back, actual_axis));
    }
    let actual = sum(splat3(&station.tip_mm), tip);
    (plus_product(sum(tip, shift), &turn, actual), plus_product(axis, &turn, actual_axis))
}

#[inline(always)]
fn splat6<const W: usize, L: Lanes<W>>(six: &[f64; 6]) -> [L; 6] {
    let [x, y, z, a, b, c] = *six;
    [L::splat(x), L::splat(y), L::splat(z), L::splat(a), L::splat(b), L::splat(c)]
}

#[inline(always)]
fn factor<const W: usize, L: Lanes<W>>(factors: &Factors, quantity: usize, at: usize) -> L {
    match factors.get(quantity) {
        Some(column) => lanes(column, at),
        // A quantity without a factor keeps its value.
        None => L::splat(0.0),
    }
}
