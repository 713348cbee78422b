//! Few unknowns from many equations: normal equations, fine where the columns are of one size.

/// Sums of a linear least-squares problem with `N` unknowns; rows are added one by one.
#[derive(Debug, Clone)]
pub struct LeastSquares<const N: usize> {
    normal: [[f64; N]; N],
    right: [f64; N],
    rows: usize,
}

impl<const N: usize> Default for LeastSquares<N> {
    fn default() -> Self {
        Self { normal: [[0.0; N]; N], right: [0.0; N], rows: 0 }
    }
}

impl<const N: usize> LeastSquares<N> {
    /// Adds Σ row·x = value.
    pub fn add(&mut self, row: &[f64; N], value: f64) {
        for i in 0..N {
            for k in 0..N {
                self.normal[i][k] += row[i] * row[k];
            }
            self.right[i] += row[i] * value;
        }
        self.rows += 1;
    }

    /// The variance of every unknown for rows of variance 1; 0 for unknowns that occur in no row.
    pub fn variances(&self) -> Option<[f64; N]> {
        let mut variances = [0.0; N];
        for (i, variance) in variances.iter_mut().enumerate() {
            if self.normal[i][i] == 0.0 {
                continue;
            }
            let mut unit = self.clone();
            unit.right = [0.0; N];
            unit.right[i] = 1.0;
            *variance = unit.solve()?[i].max(0.0);
        }
        Some(variances)
    }

    /// The solution; unknowns that occur in no row are 0. `None` if others cannot be separated.
    pub fn solve(&self) -> Option<[f64; N]> {
        let (mut a, mut b) = (self.normal, self.right);
        for (i, row) in a.iter_mut().enumerate() {
            if row[i] == 0.0 {
                row[i] = 1.0;
            }
        }
        let largest = (0..N).map(|i| a[i][i]).fold(0.0, f64::max);
        for i in 0..N {
            let pivot = (i..N).max_by(|x, y| a[*x][i].abs().total_cmp(&a[*y][i].abs()))?;
            a.swap(i, pivot);
            b.swap(i, pivot);
            if a[i][i].abs() <= 1e-12 * largest || self.rows == 0 {
                return None;
            }
            for k in i + 1..N {
                let factor = a[k][i] / a[i][i];
                let upper = a[i];
                for (value, above) in a[k].iter_mut().zip(upper).skip(i) {
                    *value -= factor * above;
                }
                b[k] -= factor * b[i];
            }
        }
        for i in (0..N).rev() {
            let known: f64 = (i + 1..N).map(|k| a[i][k] * b[k]).sum();
            b[i] = (b[i] - known) / a[i][i];
        }
        b.iter().all(|v| v.is_finite()).then_some(b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_three_points() {
        let mut fit = LeastSquares::<2>::default();
        for (x, y) in [(0.0, 0.0), (1.0, 1.0), (2.0, 5.0)] {
            fit.add(&[1.0, x], y);
        }
        // Slope (5 − 0)/2, mean 2 at x = 1.
        let [offset, slope] = fit.solve().unwrap();
        assert!((slope - 2.5).abs() < 1e-12 && (offset + 0.5).abs() < 1e-12);
        // 1/Σ(x − x̄)² = 1/2; 1/3 + x̄²/2 = 5/6
        let [of_offset, of_slope] = fit.variances().unwrap();
        assert!((of_slope - 0.5).abs() < 1e-12 && (of_offset - 5.0 / 6.0).abs() < 1e-12);
        let mut same = LeastSquares::<2>::default();
        same.add(&[1.0, 1.0], 1.0);
        assert_eq!(same.solve(), None);
    }
}
