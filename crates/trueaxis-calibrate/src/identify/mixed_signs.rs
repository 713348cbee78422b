//! Whether part of the rows of an instrument was written with the opposite sign.
//!
//! ```text
//!     min Σ |s_i d_i − m_i − J_i x|²,  s_i = ±1                                            docs/model.md eq. 309
//!     x = N⁺ Σ J_iᵀ (s_i d_i − m_i),   s_i = sign(d_i·(m_i + J_i x))
//! ```
//!
//! m what the errors that are stated do. The two steps alternate from several starts; each lowers the sum. What is found is only a change to look at: its residual
//! decides, as for the other conventions.

use nalgebra::{DMatrix, DVector};
use std::ops::Range;
use trueaxis_measure::instruments::instrument::Sight;
use trueaxis_measure::measure::Readings;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::Observability;

/// The steps end after a few: there are finitely many signs, and the sum only falls.
const MOST_STEPS: usize = 50;
/// With fewer rows of either sign it is a matter of single rows.
const FEWEST: usize = 3;

/// What is needed of the rows: Jᵀ/u in columns, deviations by the noise, the columns of each row.
struct Rows {
    columns: DMatrix<f64>,
    read: DVector<f64>,
    /// What the machine file explains of it.
    stated: DVector<f64>,
    of: Vec<Range<usize>>,
    sight: Observability,
    /// The rows of the instrument.
    mine: Vec<usize>,
}

/// The rows of an instrument that would fit the others with the opposite sign; empty if there are none, or if the numbers
/// have no sign. One number alone may have either sign: of such instruments only a change at one row is looked for.
pub(super) fn mixed_rows(
    design: &Design,
    sample: &Readings,
    deviations: &[[f64; 3]],
    instrument: usize,
) -> Vec<usize> {
    let own = &design.instruments[instrument];
    if own.kind.triggers() || own.sight == Sight::Distance {
        return Vec::new();
    }
    let Some(rows) = Rows::of(design, sample, deviations, instrument) else { return Vec::new() };
    let block = rows.best_block();
    let starts = match own.sight.channels() {
        3 => vec![vec![1.0; sample.len()], rows.principal(), block],
        _ => return rows.fewer(&block),
    };
    let tried = starts.into_iter().map(|signs| rows.settled(signs));
    let best = tried.min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or(Vec::new(), |(signs, _)| rows.fewer(&signs))
}

impl Rows {
    fn of(
        design: &Design,
        sample: &Readings,
        deviations: &[[f64; 3]],
        instrument: usize,
    ) -> Option<Self> {
        let (mut read, mut stated, mut of) = (Vec::new(), Vec::new(), Vec::new());
        let zero = vec![0.0; design.unknowns()];
        for (i, deviation) in deviations.iter().enumerate() {
            let own = &design.instruments[sample.instruments[i] as usize];
            let (start, model) = (read.len(), design.read(sample, i, &zero).ok()?);
            for c in 0..own.sight.channels() {
                read.push(deviation[c] / own.noise[c]);
                stated.push((model[c] - sample.values[i][c] + deviation[c]) / own.noise[c]);
            }
            of.push(start..read.len());
        }
        let columns = design.columns(sample, 0..sample.len());
        let mine: Vec<usize> =
            (0..sample.len()).filter(|i| sample.instruments[*i] as usize == instrument).collect();
        if mine.len() < 2 * FEWEST || read.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let sight = Observability::of(&(&columns * columns.transpose()));
        let [read, stated] = [read, stated].map(DVector::from_vec);
        Some(Self { columns, read, stated, of, sight, mine })
    }

    /// J_iᵀ d_i of a row.
    fn pull(&self, i: usize) -> DVector<f64> {
        let range = self.of[i].clone();
        self.columns.columns(range.start, range.len()) * self.read.rows(range.start, range.len())
    }

    /// d_i·m_i of a row.
    fn agreement(&self, i: usize) -> f64 {
        self.of[i].clone().map(|k| self.read[k] * self.stated[k]).sum()
    }

    /// Σ J_iᵀ (s_i d_i − m_i), and Σ |s_i d_i − m_i|².
    fn sums(&self, signs: &[f64]) -> (DVector<f64>, f64) {
        let mut gradient = -(&self.columns * &self.stated);
        let mut square = self.read.norm_squared() + self.stated.norm_squared();
        for (i, s) in signs.iter().enumerate() {
            gradient += self.pull(i) * *s;
            square -= 2.0 * s * self.agreement(i);
        }
        (gradient, square)
    }

    /// x of these signs, and the sum of squares.
    fn solved(&self, signs: &[f64]) -> (DVector<f64>, f64) {
        let (gradient, square) = self.sums(signs);
        let x = self.sight.solve(&gradient);
        let left = square - gradient.dot(&x);
        (x, left)
    }

    /// The steps until no sign changes.
    fn settled(&self, mut signs: Vec<f64>) -> (Vec<f64>, f64) {
        let (mut x, mut square) = self.solved(&signs);
        for _ in 0..MOST_STEPS {
            let mut next = signs.clone();
            for i in &self.mine {
                let along = self.agreement(*i) + self.pull(*i).dot(&x);
                if along != 0.0 {
                    next[*i] = along.signum();
                }
            }
            if next == signs {
                break;
            }
            signs = next;
            (x, square) = self.solved(&signs);
        }
        (signs, square)
    }

    /// All rows up to one turned: the best of them.
    fn best_block(&self) -> Vec<f64> {
        let (mut gradient, mut whole) = self.sums(&vec![1.0; self.of.len()]);
        let mut best = (f64::INFINITY, 0);
        for (turned, i) in self.mine.iter().enumerate() {
            gradient -= self.pull(*i) * 2.0;
            whole += 4.0 * self.agreement(*i);
            let square = whole - gradient.dot(&self.sight.solve(&gradient));
            if square < best.0 {
                best = (square, turned + 1);
            }
        }
        let mut signs = vec![1.0; self.of.len()];
        self.mine.iter().take(best.1).for_each(|i| signs[*i] = -1.0);
        signs
    }

    /// The direction in which the rows pull, whatever their signs: the first principal axis of N^(−1/2) J_iᵀ d_i.
    fn principal(&self) -> Vec<f64> {
        let n = self.columns.nrows();
        let scale = DVector::from_fn(n, |k, _| self.columns.row(k).norm().max(1e-300).recip());
        let mut moment = DMatrix::zeros(n, n);
        for i in &self.mine {
            let g = self.pull(*i).component_mul(&scale);
            moment += &g * g.transpose();
        }
        let eigen = moment.symmetric_eigen();
        let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        let mut signs = vec![1.0; self.of.len()];
        for i in &self.mine {
            signs[*i] = match self.pull(*i).component_mul(&scale).dot(&axis) < 0.0 {
                true => -1.0,
                false => 1.0,
            };
        }
        signs
    }

    /// The rows of the rarer sign.
    fn fewer(&self, signs: &[f64]) -> Vec<usize> {
        let with = |sign: f64| -> Vec<usize> {
            self.mine.iter().copied().filter(|i| signs[*i] == sign).collect()
        };
        let (plus, minus) = (with(1.0), with(-1.0));
        let fewer = if plus.len() < minus.len() { plus } else { minus };
        if fewer.len() < FEWEST { Vec::new() } else { fewer }
    }
}
