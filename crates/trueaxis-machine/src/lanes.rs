//! W numbers side by side: what a kernel asks of a processor, and the plain version.

mod angles;
pub(crate) mod vectors;

pub(crate) use angles::{arc_tangent, sine_cosine};

use std::ops::{Add, Div, Mul, Sub};

/// W numbers of as many poses, side by side.
pub(crate) trait Lanes<const W: usize>:
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
    fn square_root(self) -> Self;
    fn magnitude(self) -> Self;
    /// The larger of two numbers.
    fn larger(self, other: Self) -> Self;
    /// The smaller of two numbers.
    fn smaller(self, other: Self) -> Self;
    /// The magnitude of this number with the sign of the other.
    fn signed_as(self, other: Self) -> Self;
    /// In each lane `then` where this number is above the limit, `otherwise` elsewhere, also for NaN.
    fn where_above(self, limit: Self, then: Self, otherwise: Self) -> Self;
}

/// Lanes for any processor; the loops are what the compiler turns into vector instructions.
#[derive(Clone, Copy)]
pub(crate) struct Plain<const W: usize>(pub [f64; W]);

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
    fn square_root(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.each(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.each(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        self.each(other, f64::copysign)
    }

    #[inline(always)]
    fn where_above(self, limit: Self, then: Self, otherwise: Self) -> Self {
        let choose = |i: usize| if self.0[i] > limit.0[i] { then.0[i] } else { otherwise.0[i] };
        Self(std::array::from_fn(choose))
    }
}
