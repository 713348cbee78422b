//! The sequence of Sobol', any point of it at once.
//!
//! *Source:* S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput.
//! 30 (2008); `joe_kuo.txt` has their primitive polynomials and initial numbers `s a m₁ … mₛ`, from the second dimension on,
//! as `scipy.stats.qmc.Sobol` holds them (oracles/sobol.py).

/// Digits of a point, base 2.
pub(super) const BITS: usize = 52;

/// Dimensions of the table.
pub(super) const DIMENSIONS: usize = 512;

const TABLE: &str = include_str!("joe_kuo.txt");

/// The direction numbers of a dimension, from 0, as integers of [`BITS`] digits.
pub(super) fn directions(dimension: usize) -> [u64; BITS] {
    assert!(dimension < DIMENSIONS, "the table has {DIMENSIONS} dimensions");
    let top = |k: usize| 1u64 << (BITS - 1 - k);
    if dimension == 0 {
        return std::array::from_fn(top);
    }
    let row = TABLE.lines().nth(dimension - 1).unwrap_or_default();
    let numbers: Vec<u64> = row.split(' ').filter_map(|word| word.parse().ok()).collect();
    let (s, a, m) = (numbers[0] as usize, numbers[1], &numbers[2..]);
    let mut v = [0u64; BITS];
    for k in 0..BITS {
        v[k] = match k < s {
            true => m[k] * top(k),
            false => {
                (1..s).fold(v[k - s] ^ (v[k - s] >> s), |sum, j| match (a >> (s - 1 - j)) & 1 {
                    1 => sum ^ v[k - j],
                    _ => sum,
                })
            }
        };
    }
    v
}

/// Point `index` of the sequence in one dimension: in the order of Gray's code, as Joe and Kuo and scipy have it.
pub(super) fn point(directions: &[u64; BITS], index: u64) -> u64 {
    let mut gray = index ^ (index >> 1);
    let mut sum = 0;
    while gray != 0 {
        sum ^= directions[(gray.trailing_zeros() as usize).min(BITS - 1)];
        gray &= gray - 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points 5 and 1000 of `scipy.stats.qmc.Sobol(512, scramble=False)`: oracles/sobol.py.
    #[test]
    fn points_are_those_of_scipy() {
        let of = |dimension: usize, index: u64| {
            point(&directions(dimension), index) as f64 / (1u64 << BITS) as f64
        };
        let dimensions = [0, 1, 2, 100, 511];
        let five = [0.875, 0.875, 0.125, 0.125, 0.875];
        let thousand =
            [0.219_726_562_5, 0.096_679_687_5, 0.518_554_687_5, 0.768_554_687_5, 0.395_507_812_5];
        for (i, dimension) in dimensions.into_iter().enumerate() {
            assert_eq!(of(dimension, 5), five[i]);
            assert_eq!(of(dimension, 1000), thousand[i]);
        }
    }

    #[test]
    fn the_table_has_a_row_for_each_dimension() {
        assert_eq!(TABLE.lines().count(), DIMENSIONS - 1);
        for dimension in 0..DIMENSIONS {
            // Each direction number begins with its own digit.
            for (k, v) in directions(dimension).iter().enumerate() {
                assert_eq!((v >> (BITS - 1 - k)) & 1, 1, "{dimension} {k}");
                assert!(k == BITS - 1 || v.trailing_zeros() as usize >= BITS - 1 - k);
            }
        }
    }
}
