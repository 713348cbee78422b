//! The closed forms of the inverse, and the tool at commands, with these instructions.

use super::{EightPoses, FourPoses, has_avx2, has_avx512};
use crate::axis::MAX_AXES;
use crate::batch::groups;
use crate::inverse::{Aim, ClosedForm};
use crate::lanes::Plain;

/// Both branches of the angles that aim the tool; for a processor with AVX2, else undecided.
pub(in crate::batch) fn aim_avx2<const N: usize>(
    aim: &Aim,
    axes: &[[f64; N]; 3],
    out: &mut [[f64; N]; 4],
) -> u64 {
    if !has_avx2() {
        return u64::MAX;
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { aim_with_avx2(aim, axes, out) }
}

/// The same for a processor with AVX-512.
pub(in crate::batch) fn aim_avx512<const N: usize>(
    aim: &Aim,
    axes: &[[f64; N]; 3],
    out: &mut [[f64; N]; 4],
) -> u64 {
    if !has_avx512() {
        return u64::MAX;
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { aim_with_avx512(aim, axes, out) }
}

#[target_feature(enable = "avx2,fma")]
fn aim_with_avx2<const N: usize>(aim: &Aim, axes: &[[f64; N]; 3], out: &mut [[f64; N]; 4]) -> u64 {
    groups::aim_by::<4, N, FourPoses>(aim, axes, out)
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn aim_with_avx512<const N: usize>(
    aim: &Aim,
    axes: &[[f64; N]; 3],
    out: &mut [[f64; N]; 4],
) -> u64 {
    groups::aim_by::<8, N, EightPoses>(aim, axes, out)
}

/// The linear axes of commands; for a processor with AVX2, else the plain way.
pub(in crate::batch) fn place_avx2<const N: usize>(
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    if !has_avx2() {
        return groups::place_by::<4, N, Plain<4>>(form, tips, commands);
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { place_with_avx2(form, tips, commands) }
}

/// The same for a processor with AVX-512.
pub(in crate::batch) fn place_avx512<const N: usize>(
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    if !has_avx512() {
        return groups::place_by::<4, N, Plain<4>>(form, tips, commands);
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { place_with_avx512(form, tips, commands) }
}

#[target_feature(enable = "avx2,fma")]
fn place_with_avx2<const N: usize>(
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    groups::place_by::<4, N, FourPoses>(form, tips, commands);
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn place_with_avx512<const N: usize>(
    form: &ClosedForm,
    tips: &[[f64; N]; 3],
    commands: &mut [[f64; N]; MAX_AXES],
) {
    groups::place_by::<8, N, EightPoses>(form, tips, commands);
}

/// Tip and tool axis at commands; for a processor with AVX2, else the plain way.
pub(in crate::batch) fn tool_avx2<const N: usize>(
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    if !has_avx2() {
        return groups::tool_by::<4, N, Plain<4>>(form, commands, out);
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { tool_with_avx2(form, commands, out) }
}

/// The same for a processor with AVX-512.
pub(in crate::batch) fn tool_avx512<const N: usize>(
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    if !has_avx512() {
        return groups::tool_by::<4, N, Plain<4>>(form, commands, out);
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { tool_with_avx512(form, commands, out) }
}

#[target_feature(enable = "avx2,fma")]
fn tool_with_avx2<const N: usize>(
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    groups::tool_by::<4, N, FourPoses>(form, commands, out);
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn tool_with_avx512<const N: usize>(
    form: &ClosedForm,
    commands: &[[f64; N]; MAX_AXES],
    out: &mut [[f64; N]; 6],
) {
    groups::tool_by::<8, N, EightPoses>(form, commands, out);
}
