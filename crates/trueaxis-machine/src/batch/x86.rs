//! Four and eight poses at a time with the vector instructions of x86-64.
//!
//! The lane types are private to this file, and its entries ask the processor first: no
//! instruction below is ever reached on a processor without it.

mod chain;
mod inverse;

use super::columns::DeviationColumns;
use super::compensated::{CommandColumns, CompensationError, CompensationJob, Effort, newton};
use super::drawn::{self, Drawn, Factors};
use super::lanes::PoseLanes;
use super::pieces::Row;
use super::{BatchError, InstructionSet, Job, kernel};
use crate::lanes::Lanes;
pub(super) use chain::*;
pub(super) use inverse::*;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

pub(super) fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

pub(super) fn has_avx512() -> bool {
    has_avx2() && is_x86_feature_detected!("avx512f")
}

pub(super) fn run_avx2(job: &Job<'_>, out: &mut DeviationColumns<'_>) -> Result<(), BatchError> {
    if !has_avx2() {
        return Err(BatchError::Unavailable(InstructionSet::Avx2));
    }
    // SAFETY: the processor has AVX2 and FMA; asked one line above.
    unsafe { with_avx2(job, out) }
}

pub(super) fn run_avx512(job: &Job<'_>, out: &mut DeviationColumns<'_>) -> Result<(), BatchError> {
    if !has_avx512() {
        return Err(BatchError::Unavailable(InstructionSet::Avx512));
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked one line above.
    unsafe { with_avx512(job, out) }
}

#[target_feature(enable = "avx2,fma")]
fn with_avx2(job: &Job<'_>, out: &mut DeviationColumns<'_>) -> Result<(), BatchError> {
    kernel::run::<4, FourPoses>(job, out)
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn with_avx512(job: &Job<'_>, out: &mut DeviationColumns<'_>) -> Result<(), BatchError> {
    kernel::run::<8, EightPoses>(job, out)
}

pub(super) fn compensate_avx2(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    if !has_avx2() {
        return Err(BatchError::Unavailable(InstructionSet::Avx2).into());
    }
    // SAFETY: the processor has AVX2 and FMA; asked one line above.
    unsafe { compensate_with_avx2(job, out) }
}

pub(super) fn compensate_avx512(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    if !has_avx512() {
        return Err(BatchError::Unavailable(InstructionSet::Avx512).into());
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked one line above.
    unsafe { compensate_with_avx512(job, out) }
}

#[target_feature(enable = "avx2,fma")]
fn compensate_with_avx2(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    newton::run::<4, FourPoses>(job, out)
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn compensate_with_avx512(
    job: &CompensationJob<'_>,
    out: &mut CommandColumns<'_>,
) -> Result<Effort, CompensationError> {
    newton::run::<8, EightPoses>(job, out)
}

/// Deviations of drawn machines and which of them are undecided; for a processor with AVX2, else all are.
pub(super) fn drawn_avx2(command: &Drawn, factors: &Factors, out: &mut [[f64; 8]; 6]) -> u32 {
    if !has_avx2() {
        return u32::MAX;
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { drawn_with_avx2(command, factors, out) }
}

/// The same for a processor with AVX-512.
pub(super) fn drawn_avx512(command: &Drawn, factors: &Factors, out: &mut [[f64; 8]; 6]) -> u32 {
    if !has_avx512() {
        return u32::MAX;
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { drawn_with_avx512(command, factors, out) }
}

#[target_feature(enable = "avx2,fma")]
fn drawn_with_avx2(command: &Drawn, factors: &Factors, out: &mut [[f64; 8]; 6]) -> u32 {
    drawn::by::<4, FourPoses>(command, factors, out)
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn drawn_with_avx512(command: &Drawn, factors: &Factors, out: &mut [[f64; 8]; 6]) -> u32 {
    drawn::by::<8, EightPoses>(command, factors, out)
}

/// Four poses; lives only inside the functions with AVX2.
#[derive(Clone, Copy)]
struct FourPoses(__m256d);

/// Eight poses; lives only inside the functions with AVX-512.
#[derive(Clone, Copy)]
struct EightPoses(__m512d);

/// An operator by one instruction.
macro_rules! operator {
    ($lanes:ident, $operator:ident, $method:ident, $instruction:ident) => {
        impl $operator for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: a value of this type exists only where the processor has the instruction.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

operator!(FourPoses, Add, add, _mm256_add_pd);
operator!(FourPoses, Sub, sub, _mm256_sub_pd);
operator!(FourPoses, Mul, mul, _mm256_mul_pd);
operator!(FourPoses, Div, div, _mm256_div_pd);
operator!(EightPoses, Add, add, _mm512_add_pd);
operator!(EightPoses, Sub, sub, _mm512_sub_pd);
operator!(EightPoses, Mul, mul, _mm512_mul_pd);
operator!(EightPoses, Div, div, _mm512_div_pd);

impl Lanes<4> for FourPoses {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn load(from: &[f64; 4]) -> Self {
        // SAFETY: called inside `…with_avx2` only; the reference points to four numbers.
        Self(unsafe { _mm256_loadu_pd(from.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 4]) {
        // SAFETY: called inside `…with_avx2` only; the reference points to room for four numbers.
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_fmadd_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn times_minus(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_fmsub_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn times_from(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_fnmadd_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn whole(self, largest: f64) -> (Self, [u32; 4]) {
        let mut rows = [0_u32; 4];
        // SAFETY: called inside `…with_avx2` only; the store has room for four 32-bit numbers.
        let whole = unsafe {
            // The maximum of NaN and a number is here the second: the number.
            let cut = _mm256_max_pd(self.0, _mm256_setzero_pd());
            let number = _mm256_cvttpd_epi32(_mm256_min_pd(cut, _mm256_set1_pd(largest)));
            _mm_storeu_si128(rows.as_mut_ptr().cast(), number);
            _mm256_cvtepi32_pd(number)
        };
        (Self(whole), rows)
    }

    #[inline(always)]
    fn outside(self, from: f64, to: f64) -> u32 {
        // SAFETY: called inside `…with_avx2` only.
        unsafe {
            let above = _mm256_cmp_pd::<_CMP_NGE_UQ>(self.0, _mm256_set1_pd(from));
            let below = _mm256_cmp_pd::<_CMP_NLE_UQ>(self.0, _mm256_set1_pd(to));
            _mm256_movemask_pd(_mm256_or_pd(above, below)).cast_unsigned()
        }
    }

    #[inline(always)]
    fn quarter_turns(turns: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: called inside `…with_avx2` only.
        unsafe {
            let k = _mm256_castpd_si256(turns.0);
            // The blend looks at the sign bit.
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(k));
            let two = _mm256_set1_epi64x(2);
            let next = _mm256_add_epi64(k, _mm256_set1_epi64x(1));
            // Bit 1 of k is the sign of the sine, bit 1 of k + 1 that of the cosine.
            let sine_sign = _mm256_slli_epi64::<62>(_mm256_and_si256(k, two));
            let cosine_sign = _mm256_slli_epi64::<62>(_mm256_and_si256(next, two));
            let sin = _mm256_blendv_pd(sine.0, cosine.0, odd);
            let cos = _mm256_blendv_pd(cosine.0, sine.0, odd);
            (
                Self(_mm256_xor_pd(sin, _mm256_castsi256_pd(sine_sign))),
                Self(_mm256_xor_pd(cos, _mm256_castsi256_pd(cosine_sign))),
            )
        }
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            let positive = _mm256_andnot_pd(sign, self.0);
            Self(_mm256_or_pd(positive, _mm256_and_pd(sign, other.0)))
        }
    }

    #[inline(always)]
    fn where_above(self, limit: Self, then: Self, otherwise: Self) -> Self {
        // SAFETY: called inside `…with_avx2` only.
        unsafe {
            let above = _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, limit.0);
            Self(_mm256_blendv_pd(otherwise.0, then.0, above))
        }
    }
}

impl PoseLanes<4> for FourPoses {
    #[inline(always)]
    fn errors(rows: &[Row], row: &[u32; 4], h: Self) -> [Self; 6] {
        let mut steps = [0.0; 4];
        h.store(&mut steps);
        // SAFETY: called inside `…with_avx2` only; each load stays within the 32 numbers of a row,
        // which is aligned to 64 bytes, and starts at a multiple of 16 or 32 bytes.
        unsafe {
            let (mut low, mut high) = ([_mm256_setzero_pd(); 4], [_mm_setzero_pd(); 4]);
            for i in 0..4 {
                // Errors 0..4 and 4..6 of this pose.
                let c = rows[row[i] as usize].0.as_ptr();
                let h = _mm256_set1_pd(steps[i]);
                let sum = _mm256_fmadd_pd(_mm256_load_pd(c), h, _mm256_load_pd(c.add(8)));
                let sum = _mm256_fmadd_pd(sum, h, _mm256_load_pd(c.add(16)));
                low[i] = _mm256_fmadd_pd(sum, h, _mm256_load_pd(c.add(24)));
                let h = _mm256_castpd256_pd128(h);
                let sum = _mm_fmadd_pd(_mm_load_pd(c.add(4)), h, _mm_load_pd(c.add(12)));
                let sum = _mm_fmadd_pd(sum, h, _mm_load_pd(c.add(20)));
                high[i] = _mm_fmadd_pd(sum, h, _mm_load_pd(c.add(28)));
            }
            // From one vector per pose to one per error.
            let [even, odd] =
                [_mm256_unpacklo_pd(low[0], low[1]), _mm256_unpackhi_pd(low[0], low[1])];
            let [even2, odd2] =
                [_mm256_unpacklo_pd(low[2], low[3]), _mm256_unpackhi_pd(low[2], low[3])];
            let first = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(high[0]), high[2]);
            let second = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(high[1]), high[3]);
            [
                Self(_mm256_permute2f128_pd::<0x20>(even, even2)),
                Self(_mm256_permute2f128_pd::<0x20>(odd, odd2)),
                Self(_mm256_permute2f128_pd::<0x31>(even, even2)),
                Self(_mm256_permute2f128_pd::<0x31>(odd, odd2)),
                Self(_mm256_unpacklo_pd(first, second)),
                Self(_mm256_unpackhi_pd(first, second)),
            ]
        }
    }
}

impl Lanes<8> for EightPoses {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn load(from: &[f64; 8]) -> Self {
        // SAFETY: called inside `…with_avx512` only; the reference points to eight numbers.
        Self(unsafe { _mm512_loadu_pd(from.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 8]) {
        // SAFETY: called inside `…with_avx512` only; the reference points to room for eight numbers.
        unsafe { _mm512_storeu_pd(to.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_fmadd_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn times_minus(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_fmsub_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn times_from(self, factor: Self, term: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_fnmadd_pd(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn whole(self, largest: f64) -> (Self, [u32; 8]) {
        let mut rows = [0_u32; 8];
        // SAFETY: called inside `…with_avx512` only; the store has room for eight 32-bit numbers.
        let whole = unsafe {
            // The maximum of NaN and a number is here the second: the number.
            let cut = _mm512_max_pd(self.0, _mm512_setzero_pd());
            let number = _mm512_cvttpd_epi32(_mm512_min_pd(cut, _mm512_set1_pd(largest)));
            _mm256_storeu_si256(rows.as_mut_ptr().cast(), number);
            _mm512_cvtepi32_pd(number)
        };
        (Self(whole), rows)
    }

    #[inline(always)]
    fn outside(self, from: f64, to: f64) -> u32 {
        // SAFETY: called inside `…with_avx512` only.
        unsafe {
            let above = _mm512_cmp_pd_mask::<_CMP_NGE_UQ>(self.0, _mm512_set1_pd(from));
            let below = _mm512_cmp_pd_mask::<_CMP_NLE_UQ>(self.0, _mm512_set1_pd(to));
            u32::from(above | below)
        }
    }

    #[inline(always)]
    fn quarter_turns(turns: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: called inside `…with_avx512` only.
        unsafe {
            let k = _mm512_castpd_si512(turns.0);
            let (one, two) = (_mm512_set1_epi64(1), _mm512_set1_epi64(2));
            let odd = _mm512_test_epi64_mask(k, one);
            // Bit 1 of k is the sign of the sine, bit 1 of k + 1 that of the cosine.
            let next = _mm512_add_epi64(k, one);
            let sine_sign = _mm512_slli_epi64::<62>(_mm512_and_si512(k, two));
            let cosine_sign = _mm512_slli_epi64::<62>(_mm512_and_si512(next, two));
            let sin = _mm512_castpd_si512(_mm512_mask_blend_pd(odd, sine.0, cosine.0));
            let cos = _mm512_castpd_si512(_mm512_mask_blend_pd(odd, cosine.0, sine.0));
            (
                Self(_mm512_castsi512_pd(_mm512_xor_si512(sin, sine_sign))),
                Self(_mm512_castsi512_pd(_mm512_xor_si512(cos, cosine_sign))),
            )
        }
    }

    #[inline(always)]
    fn square_root(self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_abs_pd(self.0) })
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        unsafe {
            let sign = _mm512_set1_epi64(i64::MIN);
            let positive = _mm512_castpd_si512(_mm512_abs_pd(self.0));
            let signed = _mm512_and_si512(sign, _mm512_castpd_si512(other.0));
            Self(_mm512_castsi512_pd(_mm512_or_si512(positive, signed)))
        }
    }

    #[inline(always)]
    fn where_above(self, limit: Self, then: Self, otherwise: Self) -> Self {
        // SAFETY: called inside `…with_avx512` only.
        unsafe {
            let above = _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, limit.0);
            Self(_mm512_mask_blend_pd(above, otherwise.0, then.0))
        }
    }
}

impl PoseLanes<8> for EightPoses {
    #[inline(always)]
    fn errors(rows: &[Row], row: &[u32; 8], h: Self) -> [Self; 6] {
        let mut steps = [0.0; 8];
        h.store(&mut steps);
        // SAFETY: called inside `…with_avx512` only; a row is four vectors, aligned to 64 bytes.
        unsafe {
            let mut pose = [_mm512_setzero_pd(); 8];
            for i in 0..8 {
                let c = rows[row[i] as usize].0.as_ptr();
                let h = _mm512_set1_pd(steps[i]);
                let sum = _mm512_fmadd_pd(_mm512_load_pd(c), h, _mm512_load_pd(c.add(8)));
                let sum = _mm512_fmadd_pd(sum, h, _mm512_load_pd(c.add(16)));
                pose[i] = _mm512_fmadd_pd(sum, h, _mm512_load_pd(c.add(24)));
            }
            // From one vector per pose to one per error. Pairs of poses first: errors 0 2 4 in
            // `even`, 1 3 5 in `odd`. Then 0x88 takes the even quarters of both vectors, 0xDD the
            // odd ones.
            let (mut even, mut odd) = ([pose[0]; 4], [pose[0]; 4]);
            for i in 0..4 {
                even[i] = _mm512_unpacklo_pd(pose[2 * i], pose[2 * i + 1]);
                odd[i] = _mm512_unpackhi_pd(pose[2 * i], pose[2 * i + 1]);
            }
            let mut errors = [Self(pose[0]); 6];
            for (i, v) in [even, odd].into_iter().enumerate() {
                let a = _mm512_shuffle_f64x2::<0x88>(v[0], v[1]);
                let b = _mm512_shuffle_f64x2::<0x88>(v[2], v[3]);
                let c = _mm512_shuffle_f64x2::<0xDD>(v[0], v[1]);
                let d = _mm512_shuffle_f64x2::<0xDD>(v[2], v[3]);
                errors[i] = Self(_mm512_shuffle_f64x2::<0x88>(a, b));
                errors[i + 2] = Self(_mm512_shuffle_f64x2::<0x88>(c, d));
                errors[i + 4] = Self(_mm512_shuffle_f64x2::<0xDD>(a, b));
            }
            errors
        }
    }
}
