//! Sine, cosine and arc tangent of lanes.

use super::Lanes;
use super::vectors::splat3;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// Added to a number below 2⁵¹ it leaves the nearest whole number in the low bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts; the first two have 33 bits, so that their products with k stay exact.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    2.022_266_248_795_950_6e-21,
];

/// sin r = r + r³(S₀ + S₁r² + …) on ±π/4; the minimax coefficients of fdlibm's k_sin.c.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// cos r = 1 − r²/2 + r⁴(C₀ + C₁r² + …) on ±π/4; fdlibm's k_cos.c.
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// tan(π/8): below it the series of the arc tangent is as short as it is.
const TAN_PI_8: f64 = 0.414_213_562_373_095_05;

/// atan t = t − t·(A₀t² + A₁t⁴ + …) on ±7/16; the minimax coefficients of fdlibm's s_atan.c, even and odd ones.
const ARC_EVEN: [f64; 6] = [
    3.333_333_333_333_293e-1,
    1.428_571_427_250_346_6e-1,
    9.090_887_133_436_507e-2,
    6.661_073_137_387_531e-2,
    4.976_877_994_615_932e-2,
    1.628_582_011_536_578_2e-2,
];
const ARC_ODD: [f64; 5] = [
    -1.999_999_999_987_648_3e-1,
    -1.111_111_040_546_235_6e-1,
    -7.691_876_205_044_83e-2,
    -5.833_570_133_790_573_5e-2,
    -3.653_157_274_421_691_6e-2,
];

/// What π/2 has beyond its double.
const HALF_PI_REST: f64 = 6.123_233_995_736_766e-17;

/// Sine and cosine to about one unit in the last place of 1, for |x| up to 1e6.
#[inline(always)]
pub(crate) fn sine_cosine<const W: usize, L: Lanes<W>>(x: L) -> (L, L) {
    let turns = x.times_plus(L::splat(FRAC_2_PI), L::splat(ROUNDING));
    let k = turns - L::splat(ROUNDING);
    let [high, middle, low] = splat3(&HALF_PI);
    let r = k.times_from(low, k.times_from(middle, k.times_from(high, x)));
    let z = r * r;
    let sine = (r * z).times_plus(polynomial(&SINE, z), r);
    let start = z.times_from(L::splat(0.5), L::splat(1.0));
    let cosine = (z * z).times_plus(polynomial(&COSINE, z), start);
    L::quarter_turns(turns, sine, cosine)
}

#[inline(always)]
fn polynomial<const W: usize, L: Lanes<W>>(rising: &[f64; 6], x: L) -> L {
    let mut sum = L::splat(rising[5]);
    for i in [4, 3, 2, 1, 0] {
        sum = sum.times_plus(x, L::splat(rising[i]));
    }
    sum
}

/// The angle of the point (x, y) from the x axis, to 2 units in the last place; 0 at the origin, also at x = −0.
///
/// ```text
///     t = min/max of |x|, |y|;  beyond tan(π/8):  atan t = π/4 + atan((t − 1)/(t + 1))
/// ```
#[inline(always)]
pub(crate) fn arc_tangent<const W: usize, L: Lanes<W>>(y: L, x: L) -> L {
    let zero = L::splat(0.0);
    let (across, along) = (y.magnitude(), x.magnitude());
    let (large, small) = (across.larger(along), across.smaller(along));
    let limit = large * L::splat(TAN_PI_8);
    let over = small.where_above(limit, small - large, small);
    let under = small.where_above(limit, small + large, large);
    let (start, rest) = (
        small.where_above(limit, L::splat(FRAC_PI_4), zero),
        small.where_above(limit, L::splat(0.5 * HALF_PI_REST), zero),
    );
    let t = over / under.larger(L::splat(f64::MIN_POSITIVE));
    let z = t * t;
    let w = z * z;
    let mut odd = L::splat(ARC_ODD[4]);
    let mut even = L::splat(ARC_EVEN[5]);
    for i in [3, 2, 1, 0] {
        odd = odd.times_plus(w, L::splat(ARC_ODD[i]));
    }
    for i in [4, 3, 2, 1, 0] {
        even = even.times_plus(w, L::splat(ARC_EVEN[i]));
    }
    let series = z * odd.times_plus(z, even);
    let first = start + (t.times_from(series, t) + rest);
    let steep = L::splat(FRAC_PI_2) - (first - L::splat(HALF_PI_REST));
    let half = across.where_above(along, steep, first);
    let back = L::splat(PI) - (half - L::splat(2.0 * HALF_PI_REST));
    zero.where_above(x, back, half).signed_as(y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;

    /// How many doubles lie between two of the same sign.
    fn apart(a: f64, b: f64) -> u64 {
        a.abs().to_bits().abs_diff(b.abs().to_bits())
    }

    /// Against the arc tangent of the C library, which is off by less than one unit in the last place itself: every
    /// octant, magnitudes from 1e-300 to 1e300, and ratios near the ends of the pieces.
    #[test]
    fn law_the_arc_tangent_is_that_of_the_library() {
        let (mut state, mut most) = (7_u64, 0);
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let special = [0.0, 1.0, -1.0, 1e-300, 1e300, TAN_PI_8, 1.0 / TAN_PI_8, 1e-9];
        for i in 0..1_000_000_u32 {
            let mut one = |group: u32| match (i % 7, unit()) {
                (0, _) => special[(i / group % 8) as usize],
                (1, u) => 10_f64.powf(600.0 * u - 300.0),
                (_, u) => 2.0 * u - 1.0,
            };
            let (y, x) = (one(7), one(56));
            let found = arc_tangent(Plain([y, -y]), Plain([x, x])).0;
            let wanted = y.atan2(x);
            if y != 0.0 || x != 0.0 {
                most = most.max(apart(found[0], wanted));
                assert!(found[0].signum() == wanted.signum() && found[1] == -found[0]);
            }
        }
        assert!(most <= 2, "{most} units in the last place");
    }

    #[test]
    fn the_axes_are_exact() {
        let at = |y: f64, x: f64| arc_tangent(Plain([y]), Plain([x])).0[0];
        assert_eq!(at(0.0, 0.0), 0.0);
        assert_eq!(at(0.0, 2.0), 0.0);
        assert_eq!(at(0.0, -2.0), PI);
        assert_eq!(at(3.0, 0.0), FRAC_PI_2);
        assert_eq!(at(-3.0, 0.0), -FRAC_PI_2);
        assert_eq!(at(1.0, 1.0), FRAC_PI_4);
    }
}
