//! W numbers side by side: what a kernel asks of a processor, and the plain version.

use super::pieces::Row;
use std::ops::{Add, Div, Mul, Sub};

/// Added to a number below 2⁵¹ it leaves the nearest whole number in the low bits.
pub(super) const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// W numbers of as many poses, side by side.
pub(super) trait Lanes<const W: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    fn load(from: &[f64; W]) -> Self;
    fn store(self, to: &mut [f64; W]);
    /// `self·factor + term`
    fn times_plus(self, factor: Self, term: Self) -> Self;
    /// `self·factor − term`
    fn times_minus(self, factor: Self, term: Self) -> Self;
    /// `term − self·factor`
    fn times_from(self, factor: Self, term: Self) -> Self;
    /// Cut to `0 ..= largest` (NaN to 0) and to a whole number, which is returned in both forms.
    fn whole(self, largest: f64) -> (Self, [u32; W]);
    /// One bit per lane that is not in `from ..= to`; NaN never is.
    fn outside(self, from: f64, to: f64) -> u32;
    /// Sine and cosine from those of the angle less k quarter turns; k in the low bits of `turns`.
    fn quarter_turns(turns: Self, sine: Self, cosine: Self) -> (Self, Self);
    /// The six errors of each lane's row, `h` from where it is written about.
    fn errors(rows: &[Row], row: &[u32; W], h: Self) -> [Self; 6];
}

/// Lanes for any processor; the loops are what the compiler turns into vector instructions.
#[derive(Clone, Copy)]
pub(super) struct Plain<const W: usize>([f64; W]);

impl<const W: usize> Plain<W> {
    #[inline(always)]
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl<const W: usize> Add for Plain<W> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.each(other, |a, b| a + b)
    }
}

impl<const W: usize> Sub for Plain<W> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.each(other, |a, b| a - b)
    }
}

impl<const W: usize> Mul for Plain<W> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.each(other, |a, b| a * b)
    }
}

impl<const W: usize> Div for Plain<W> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.each(other, |a, b| a / b)
    }
}

impl<const W: usize> Lanes<W> for Plain<W> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; W])
    }

    #[inline(always)]
    fn load(from: &[f64; W]) -> Self {
        Self(*from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; W]) {
        *to = self.0;
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        // Not mul_add: without the instruction that is a library call.
        self * factor + term
    }

    #[inline(always)]
    fn times_minus(self, factor: Self, term: Self) -> Self {
        self * factor - term
    }

    #[inline(always)]
    fn times_from(self, factor: Self, term: Self) -> Self {
        term - self * factor
    }

    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "limited to 0 and the number of rows before the cast"
    )]
    fn whole(self, largest: f64) -> (Self, [u32; W]) {
        let rows = self.0.map(|v| v.max(0.0).min(largest) as u32);
        (Self(rows.map(f64::from)), rows)
    }

    #[inline(always)]
    fn outside(self, from: f64, to: f64) -> u32 {
        (0..W).fold(0, |bits, i| bits | (u32::from(!(from..=to).contains(&self.0[i])) << i))
    }

    #[inline(always)]
    fn quarter_turns(turns: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let (mut sin, mut cos) = ([0.0; W], [0.0; W]);
        for i in 0..W {
            let k = turns.0[i].to_bits();
            let (s, c) = (sine.0[i].to_bits(), cosine.0[i].to_bits());
            let odd = 0_u64.wrapping_sub(k & 1);
            sin[i] = f64::from_bits(((s & !odd) | (c & odd)) ^ ((k & 2) << 62));
            cos[i] = f64::from_bits(((c & !odd) | (s & odd)) ^ ((k.wrapping_add(1) & 2) << 62));
        }
        (Self(sin), Self(cos))
    }

    #[inline(always)]
    fn errors(rows: &[Row], row: &[u32; W], h: Self) -> [Self; 6] {
        let mut errors = [[0.0; W]; 6];
        for i in 0..W {
            let [cubes, rest @ ..] = rows[row[i] as usize].0.as_chunks::<8>().0 else { continue };
            let mut sums = *cubes;
            for powers in rest {
                for (sum, c) in sums.iter_mut().zip(powers) {
                    *sum = *sum * h.0[i] + c;
                }
            }
            for (error, sum) in errors.iter_mut().zip(sums) {
                error[i] = sum;
            }
        }
        errors.map(Self)
    }
}
