//! A permutation of any number of strata whose entries are computed one by one.

/// Rounds of the network; three are enough for a permutation that no test of ours tells from a random one.
const ROUNDS: u64 = 4;

/// The stratum of a point: a permutation of 0..count that depends on `key`.
///
/// A Feistel network over the next power of four, walked on until it comes to a number below `count` (Black and
/// Rogaway 2002).
pub(super) fn permuted(index: u64, count: u64, key: u64) -> u64 {
    let half = (64 - (count - 1).leading_zeros()).div_ceil(2).max(1);
    let mask = (1u64 << half) - 1;
    let mut at = index;
    loop {
        let (mut left, mut right) = (at >> half, at & mask);
        for round in 0..ROUNDS {
            (left, right) =
                (right, left ^ (mixed(right ^ key.rotate_left(round as u32 * 16)) & mask));
        }
        at = (left << half) | right;
        if at < count {
            return at;
        }
    }
}

/// splitmix64 (Steele, Lea, Flood 2014).
fn mixed(z: u64) -> u64 {
    let z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::permuted;

    #[test]
    fn every_stratum_once_at_any_count() {
        for count in [1, 2, 3, 4, 5, 63, 64, 65, 1000] {
            let mut found: Vec<u64> = (0..count).map(|i| permuted(i, count, 42)).collect();
            assert!(count < 60 || found != (0..count).collect::<Vec<_>>());
            found.sort_unstable();
            assert_eq!(found, (0..count).collect::<Vec<_>>());
        }
    }

    /// Neighbours of one input are no neighbours of another: their correlation is that of independent ones.
    #[test]
    fn two_inputs_are_not_correlated() {
        let n = 10_000;
        let middle = (n - 1) as f64 / 2.0;
        let product =
            |i: u64| (permuted(i, n, 1) as f64 - middle) * (permuted(i, n, 2) as f64 - middle);
        let covariance = (0..n).map(product).sum::<f64>() / n as f64;
        let correlation = covariance * 12.0 / (n * n) as f64;
        assert!(correlation.abs() < 5.0 / (n as f64).sqrt(), "{correlation}");
    }
}
