//! The rotary axes: the smallest motion that turns the tool axis back, and where that is too much.

use crate::axis::{Command, MAX_AXES};
use trueaxis_geometry::Vec3;

/// The columns of the tool axis in the plane across it: 2 × n.
pub(super) struct Turns<'a> {
    rotary: &'a [usize],
    /// Two unit vectors across the tool axis.
    basis: [Vec3; 2],
    rows: [Command; 2],
}

/// How the rotary axes may serve the tool axis at a pose.
#[derive(Debug, Clone, Copy)]
pub(super) enum Freedom {
    /// In both directions across it.
    Both,
    /// In one direction only: the other would swing the axes beyond the limit.
    One {
        /// Along which the tool axis is corrected; a unit vector in the workpiece frame.
        along: Vec3,
        /// The unit motion of the rotary axes that does it.
        motion: Command,
        /// What they do once for the other direction.
        damped: Command,
    },
    /// In none.
    None,
}

impl<'a> Turns<'a> {
    pub fn of(turning: &[Vec3; MAX_AXES], rotary: &'a [usize], axis: Vec3) -> Self {
        // The machine axis that the tool axis is least along.
        let least = axis.abs().imin();
        let first =
            axis.cross(&Vec3::from_fn(|k, _| if k == least { 1.0 } else { 0.0 })).normalize();
        let basis = [first, axis.cross(&first).normalize()];
        let mut rows = [Command::default(); 2];
        for (row, across) in rows.iter_mut().zip(basis) {
            for &i in rotary {
                row[i] = across.dot(&turning[i]);
            }
        }
        Self { rotary, basis, rows }
    }

    /// K·Kᵀ: `[a, b, c]` of the symmetric matrix `a b; b c`.
    fn gram(&self) -> [f64; 3] {
        let [first, second] = &self.rows;
        [dot(first, first), dot(first, second), dot(second, second)]
    }

    /// The smallest motion that takes the deviation away: `−Kᵀ(K·Kᵀ)⁻¹·e`.
    pub fn least_motion(&self, deviation: Vec3) -> Command {
        let [a, b, c] = self.gram();
        let determinant = a * c - b * b;
        let [e, f] = self.basis.map(|across| across.dot(&deviation));
        let [u, v] = [(c * e - b * f) / determinant, (a * f - b * e) / determinant];
        std::array::from_fn(|i| -(self.rows[0][i] * u + self.rows[1][i] * v))
    }

    /// What is allowed where no axis shall move by more than `most_swing` times the deviation, and
    /// the axis that would.
    ///
    /// ```text
    ///     K = Σ σ_k u_k v_kᵀ      σ_k ≥ s: −(u·e)/σ_k · v_k      σ_k < s: −(u·e)·σ_k/s² · v_k, once
    /// ```
    /// with s = 1/`most_swing` (docs/model.md eq. 162): continuous at s, nothing at the pole.
    pub fn freedom(&self, deviation: Vec3, most_swing: f64) -> (Freedom, Option<usize>) {
        let [a, b, c] = self.gram();
        let (half, spread) = (0.5 * (a - c), (0.5 * (a - c)).hypot(b));
        let strong_square = 0.5 * (a + c) + spread;
        let weak_square = ((a * c - b * b) / strong_square).max(0.0);
        let least = most_swing.powi(-2);
        // NaN: no rotary axis turns the tool at all.
        if weak_square >= least {
            return (Freedom::Both, None);
        }
        let (x, y) = if half >= 0.0 { (half + spread, b) } else { (b, spread - half) };
        let length = x.hypot(y);
        let (x, y) = if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) };
        let mix = |x: f64, y: f64| -> Command {
            std::array::from_fn(|i| self.rows[0][i] * x + self.rows[1][i] * y)
        };
        let (strong, weak) = (mix(x, y), mix(-y, x));
        let swinging = self.swinging(&strong);
        if strong_square.is_nan() || strong_square < least {
            return (Freedom::None, swinging);
        }
        let [along, across] =
            [self.basis[0] * x + self.basis[1] * y, self.basis[1] * x - self.basis[0] * y];
        let by = -across.dot(&deviation) / least;
        let motion = strong.map(|m| m / strong_square.sqrt());
        (Freedom::One { along, motion, damped: weak.map(|m| m * by) }, swinging)
    }

    /// The axis that has the least share in the motion that works.
    fn swinging(&self, strong: &Command) -> Option<usize> {
        let by_share = |i: &&usize, k: &&usize| strong[**i].abs().total_cmp(&strong[**k].abs());
        self.rotary.iter().min_by(by_share).copied()
    }
}

fn dot(a: &Command, b: &Command) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
