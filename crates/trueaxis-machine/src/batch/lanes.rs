//! Lanes that look up the error motions of a table.

use super::pieces::Row;
use crate::lanes::{Lanes, Plain};

/// W poses side by side.
pub(super) trait PoseLanes<const W: usize>: Lanes<W> {
    /// The six errors of each lane's row, `h` from where it is written about.
    fn errors(rows: &[Row], row: &[u32; W], h: Self) -> [Self; 6];
}

impl<const W: usize> PoseLanes<W> for Plain<W> {
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
