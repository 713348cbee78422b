//! The chain of groups of commands, and sines, with these instructions.

use super::{EightPoses, FourPoses, has_avx2, has_avx512};
use crate::batch::chain::{self, Frames, Group, Walk};
use crate::lanes::Plain;

/// The walk through the chain; for a processor with AVX2, else the plain way.
pub(in crate::batch) fn chain_avx2(
    walk: Walk<'_>,
    stations: &mut [Frames],
    tool: &mut Frames,
) -> u32 {
    if !has_avx2() {
        return chain::by::<8, Plain<8>>(walk, stations, tool);
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { chain_with_avx2(walk, stations, tool) }
}

/// The same for a processor with AVX-512.
pub(in crate::batch) fn chain_avx512(
    walk: Walk<'_>,
    stations: &mut [Frames],
    tool: &mut Frames,
) -> u32 {
    if !has_avx512() {
        return chain::by::<8, Plain<8>>(walk, stations, tool);
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { chain_with_avx512(walk, stations, tool) }
}

#[target_feature(enable = "avx2,fma")]
fn chain_with_avx2(walk: Walk<'_>, stations: &mut [Frames], tool: &mut Frames) -> u32 {
    chain::by::<4, FourPoses>(walk, stations, tool)
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn chain_with_avx512(walk: Walk<'_>, stations: &mut [Frames], tool: &mut Frames) -> u32 {
    chain::by::<8, EightPoses>(walk, stations, tool)
}

/// Sines and cosines; for a processor with AVX2, else the plain way.
pub(in crate::batch) fn sines_avx2(angles: &Group, out: &mut [Group; 2]) {
    if !has_avx2() {
        return chain::sines_by::<8, Plain<8>>(angles, out);
    }
    // SAFETY: the processor has AVX2 and FMA; asked three lines above.
    unsafe { sines_with_avx2(angles, out) }
}

/// The same for a processor with AVX-512.
pub(in crate::batch) fn sines_avx512(angles: &Group, out: &mut [Group; 2]) {
    if !has_avx512() {
        return chain::sines_by::<8, Plain<8>>(angles, out);
    }
    // SAFETY: the processor has AVX2, FMA and AVX-512F; asked three lines above.
    unsafe { sines_with_avx512(angles, out) }
}

#[target_feature(enable = "avx2,fma")]
fn sines_with_avx2(angles: &Group, out: &mut [Group; 2]) {
    chain::sines_by::<4, FourPoses>(angles, out);
}

#[target_feature(enable = "avx2,fma,avx512f")]
fn sines_with_avx512(angles: &Group, out: &mut [Group; 2]) {
    chain::sines_by::<8, EightPoses>(angles, out);
}
