//! What shall be found: errors of the machine as sums of known functions with unknown factors.
//!
//! ```text
//!     E(q) = Σ c_k φ_k(q)                                                 docs/model.md eq. 106
//! ```

use crate::instruments::{Moment, Motion};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{AxisKind, Travel};
use trueaxis_machine::errors::{
    Curve, ErrorIndex, ErrorKind, ErrorName, ErrorValues, Harmonic, StatedError,
};

/// One known function φ of the programmed position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Basis {
    /// 1: a location error.
    Constant,
    /// Legendre's polynomial of that degree over a range of the axis.
    Legendre {
        /// Its degree.
        degree: u32,
        /// The middle of the range, mm or rad.
        middle: f64,
        /// Half the length of the range, mm or rad.
        half: f64,
    },
    /// cos kq of a rotary axis.
    Cosine(u32),
    /// sin kq of a rotary axis.
    Sine(u32),
    /// 1 at a knot, 0 at its neighbours, straight between them.
    Hat {
        /// The knot, mm or rad.
        at: f64,
        /// The distance of the knots, mm or rad.
        step: f64,
    },
    /// Half of the difference of the two directions of approach.
    Reversal,
    /// Velocity: the axis follows its command by that much time (1/Kv).
    Lag {
        /// 1 or −1: an error of a table leads the tool the other way than its axis does.
        sense: f64,
    },
    /// Half of the play: the axis stays on the side that it comes from.
    LostMotion {
        /// 1 or −1.
        sense: f64,
    },
    /// The axis sticks where it turns and comes free with this time constant.
    Friction {
        /// The time constant, s.
        free_s: f64,
        /// 1 or −1.
        sense: f64,
    },
    /// A drift in time: 0 before, growing evenly to 1 while one instrument reads, 1 after.
    Ramp {
        /// The instrument whose clock it is.
        instrument: u32,
        /// When it begins, s.
        from_s: f64,
        /// How long it grows, s.
        over_s: f64,
    },
}

impl Basis {
    /// φ at a programmed position, reached from a side (+1, −1, 0).
    pub fn value(self, q: f64, approach: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Legendre { degree, middle, half } => legendre(degree, [(q - middle) / half])[0],
            Self::Cosine(order) => (f64::from(order) * q).cos(),
            Self::Sine(order) => (f64::from(order) * q).sin(),
            Self::Hat { at, step } => (1.0 - ((q - at) / step).abs()).max(0.0),
            Self::Reversal => 0.5 * approach,
            Self::LostMotion { sense } => -0.5 * sense * approach,
            // They say nothing of an axis that stands, and nothing without a time.
            Self::Lag { .. } | Self::Friction { .. } | Self::Ramp { .. } => 0.0,
        }
    }

    /// φ where an axis moves: `−v`, `−½ side`, `−d e^{−age/t}` of the servo, `value` of the others.
    pub fn in_motion(
        self,
        command: &[f64; 6],
        approach: &[f64; 6],
        axis: usize,
        m: &Motion,
    ) -> f64 {
        match self {
            Self::Lag { sense } => -sense * m.speed[axis],
            Self::Friction { free_s, sense } => {
                -sense * m.turned[axis] * (-m.turned_ago_s[axis].max(0.0) / free_s).exp()
            }
            _ => self.value(command[axis], approach[axis]),
        }
    }

    /// φ at a reading, at a command of the axis whose position counts.
    pub fn at(self, command: &[f64; 6], axis: Option<usize>, moment: &Moment) -> f64 {
        match (self, axis) {
            (Self::Ramp { instrument, .. }, _) if instrument != moment.instrument => 0.0,
            (Self::Ramp { from_s, over_s, .. }, _) => {
                ((moment.time_s - from_s) / over_s).clamp(0.0, 1.0)
            }
            (_, Some(axis)) => self.in_motion(command, &moment.approach, axis, &moment.motion),
            (_, None) => self.value(0.0, 0.0),
        }
    }

    /// Whether it is of the servo: how an axis follows, not how it is made.
    pub fn is_servo(self) -> bool {
        matches!(self, Self::Lag { .. } | Self::LostMotion { .. } | Self::Friction { .. })
    }

    /// Whether it is a lag.
    pub fn is_lag(self) -> bool {
        matches!(self, Self::Lag { .. })
    }
}

/// Legendre's polynomial at N places.
///
/// ```text
///     (k + 1) P_{k+1} = (2k + 1) x P_k − k P_{k−1}        (Bonnet)
/// ```
pub(super) fn legendre<const N: usize>(degree: u32, x: [f64; N]) -> [f64; N] {
    let (mut before, mut here) = ([1.0; N], x);
    if degree == 0 {
        return before;
    }
    for k in 1..degree {
        let k = f64::from(k);
        let next =
            std::array::from_fn(|i| ((2.0 * k + 1.0) * x[i] * here[i] - k * before[i]) / (k + 1.0));
        (before, here) = (here, next);
    }
    here
}

/// One unknown of the machine: a factor c of one function of one error, mm or rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// The error.
    pub error: ErrorName,
    /// Where it stands in the chain.
    pub index: ErrorIndex,
    /// The axis whose position counts; none for location errors.
    pub axis: Option<usize>,
    /// φ.
    pub basis: Basis,
    /// What was known of c before: value and standard uncertainty, mm or rad.
    pub prior: Option<(f64, f64)>,
}

impl Term {
    /// Its name: `EC0Y`, `EXX P2`, `EAC cos 2`.
    pub fn name(&self) -> String {
        let error = self.error;
        match self.basis {
            Basis::Constant => error.to_string(),
            Basis::Legendre { degree, .. } => format!("{error} P{degree}"),
            Basis::Cosine(order) => format!("{error} cos {order}"),
            Basis::Sine(order) => format!("{error} sin {order}"),
            Basis::Hat { at, .. } if error.body.is_rotary() => {
                format!("{error} at {:.3} deg", at.to_degrees())
            }
            Basis::Hat { at, .. } => format!("{error} at {at:.3} mm"),
            Basis::Reversal => format!("{error} reversal"),
            Basis::Lag { .. } => format!("lag {}", error.body),
            Basis::LostMotion { .. } => format!("lost motion {}", error.body),
            Basis::Friction { .. } => format!("friction {}", error.body),
            Basis::Ramp { instrument, from_s, .. } => {
                let along = ["x", "y", "z"][error.component as usize % 3];
                format!("drift {along} {instrument} from {from_s:.0} s")
            }
        }
    }

    /// φ at a command.
    pub fn value(&self, command: &[f64; 6], approach: &[f64; 6]) -> f64 {
        let (q, side) = self.axis.map_or((0.0, 0.0), |i| (command[i], approach[i]));
        self.basis.value(q, side)
    }

    /// How one axis follows, as an unknown of its error of position (EXX, ECC); none if the axis does
    /// not lie along X, Y or Z of the machine. `basis` makes φ from the sense of that error.
    pub fn servo(machine: &Machine, axis: usize, basis: impl Fn(f64) -> Basis) -> Option<Self> {
        use trueaxis_machine::errors::Component::{A, B, C, X, Y, Z};
        let of = machine.axes().get(axis)?;
        let components = match of.kind {
            AxisKind::Linear => [X, Y, Z],
            AxisKind::Rotary => [A, B, C],
        };
        let senses = [(0, 1.0), (1, 1.0), (2, 1.0), (0, -1.0), (1, -1.0), (2, -1.0)];
        senses.iter().find_map(|(k, sense)| {
            let name =
                ErrorName { body: of.name, kind: ErrorKind::Motion, component: components[*k] };
            let index = machine.error_index(name)?;
            let (axis, basis) = (Some(axis), basis(*sense));
            let term = Self { error: name, index, axis, basis, prior: None };
            moves_alike(machine, &term, *sense).then_some(term)
        })
    }

    /// A location error as an unknown.
    pub fn location(machine: &Machine, error: ErrorName) -> Option<Self> {
        let index = machine.error_index(error).filter(|_| error.kind == ErrorKind::Location)?;
        Some(Self { error, index, axis: None, basis: Basis::Constant, prior: None })
    }
}

/// Whether a small displacement of the axis and its error lead the tool the same way.
fn moves_alike(machine: &Machine, term: &Term, sense: f64) -> bool {
    const STEP: f64 = 1e-5;
    let none = ErrorValues::default();
    let mut here = [0.0; 6];
    for (i, q) in here.iter_mut().enumerate().take(machine.axes().len()) {
        *q = 0.1 + 0.07 * i as f64;
    }
    let (mut there, mut errors) = (here, none);
    there[term.axis.unwrap_or(0)] += STEP;
    errors.add(term.index, sense * STEP);
    let [start, by_axis, by_error] =
        [(&here, &none), (&there, &none), (&here, &errors)].map(|(q, e)| machine.pose(q, e));
    let off = (by_axis.shift_mm() - by_error.shift_mm()).norm()
        + (by_axis.linear() - by_error.linear()).norm();
    let size =
        (by_axis.shift_mm() - start.shift_mm()).norm() + (by_axis.linear() - start.linear()).norm();
    off < 1e-3 * size
}

/// How an error motion is described: `"polynomial 3"`, `"polynomial 2-4"`, `"fourier 2"`,
/// `"linear 7"` (knots), `"constant"`, each with `" + reversal"` if wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shape {
    /// The functions.
    pub family: Family,
    /// Whether the two directions of approach differ.
    pub reversal: bool,
}

/// A family of functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Legendre polynomials of degrees from and to.
    Polynomial(u32, u32),
    /// Harmonics of orders from and to.
    Fourier(u32, u32),
    /// Straight between that many knots.
    Linear(u32),
    /// Nothing but the reversal.
    None,
}

/// Beyond this a description is a slip of the pen.
const MOST_FUNCTIONS: u32 = 100;

impl Shape {
    /// Reads a description.
    ///
    /// ```
    /// use trueaxis_measure::unknowns::term::{Family, Shape};
    /// let shape = Shape::parse("fourier 2 + reversal").expect("a shape");
    /// assert_eq!(shape, Shape { family: Family::Fourier(1, 2), reversal: true });
    /// assert!(Shape::parse("fourier many").is_none());
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split('+').map(str::trim);
        let first = parts.next()?;
        let rest: Vec<&str> = parts.collect();
        if first == "reversal" && rest.is_empty() {
            return Some(Self { family: Family::None, reversal: true });
        }
        let reversal = match rest[..] {
            [] => false,
            ["reversal"] => true,
            _ => return None,
        };
        let (family, range) = first.split_once(' ').unwrap_or((first, ""));
        let range = range.trim();
        let count =
            |text: &str| text.parse::<u32>().ok().filter(|n| (1..=MOST_FUNCTIONS).contains(n));
        let (from, to) = match range.split_once('-') {
            Some((from, to)) => (count(from)?, count(to)?),
            None => (1, count(range)?),
        };
        let family = match family {
            "polynomial" => Family::Polynomial(from, to),
            "fourier" => Family::Fourier(from, to),
            "linear" if from == 1 && to >= 2 => Family::Linear(to),
            _ => return None,
        };
        (from <= to).then_some(Self { family, reversal })
    }

    /// The unknowns of one error motion of that shape.
    pub fn terms(&self, machine: &Machine, error: ErrorName) -> Vec<Term> {
        let Some(index) = machine.error_index(error) else { return Vec::new() };
        let Some(axis) = machine.bodies()[index.body].axis else { return Vec::new() };
        let (from, to) = range(machine, axis);
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut functions: Vec<Basis> = match self.family {
            Family::None => Vec::new(),
            Family::Polynomial(a, b) => {
                (a..=b).map(|degree| Basis::Legendre { degree, middle, half }).collect()
            }
            Family::Fourier(a, b) => {
                (a..=b).flat_map(|k| [Basis::Cosine(k), Basis::Sine(k)]).collect()
            }
            Family::Linear(n) => {
                let step = (to - from) / f64::from(n.max(2) - 1);
                (0..n).map(|k| Basis::Hat { at: from + f64::from(k) * step, step }).collect()
            }
        };
        functions.extend(self.reversal.then_some(Basis::Reversal));
        let term = |basis| Term { error, index, axis: Some(axis), basis, prior: None };
        functions.into_iter().map(term).collect()
    }
}

/// Over which positions an axis is described: its travel, or what is usual.
fn range(machine: &Machine, axis: usize) -> (f64, f64) {
    let axis = &machine.axes()[axis];
    let pi = std::f64::consts::PI;
    match (axis.travel, axis.kind) {
        (Travel::Between(from, to), AxisKind::Linear) if to > from => (from, to),
        (Travel::Between(from, to), AxisKind::Rotary) if to > from => (from.max(-pi), to.min(pi)),
        (_, AxisKind::Linear) => (-500.0, 500.0),
        (_, AxisKind::Rotary) => (-pi, pi),
    }
}

/// One error from the found factors of its terms, for a machine file.
///
/// Families are not mixed within one error, so that a curve can say it.
pub fn stated(terms: &[(Term, f64)], u: Option<f64>) -> StatedError {
    let mut polynomial: Vec<f64> = Vec::new();
    let mut place = (0.0, 1.0);
    let mut harmonics: Vec<Harmonic> = Vec::new();
    let mut knots: Vec<(f64, f64)> = Vec::new();
    let (mut constant, mut reversal) = (0.0, None);
    for (term, c) in terms {
        match term.basis {
            Basis::Constant => constant += c,
            Basis::Reversal => reversal = Some(*c),
            // Of the servo and of time: no error of the machine file says it.
            Basis::Lag { .. }
            | Basis::LostMotion { .. }
            | Basis::Friction { .. }
            | Basis::Ramp { .. } => {}
            Basis::Hat { at, .. } => knots.push((at, *c)),
            Basis::Cosine(k) | Basis::Sine(k) => {
                let order = f64::from(k);
                if harmonics.iter().all(|h| h.order != order) {
                    harmonics.push(Harmonic { order, cosine: 0.0, sine: 0.0 });
                }
                for h in harmonics.iter_mut().filter(|h| h.order == order) {
                    match term.basis {
                        Basis::Cosine(_) => h.cosine += c,
                        _ => h.sine += c,
                    }
                }
            }
            Basis::Legendre { degree, middle, half } => {
                place = (middle, half);
                for (k, p) in legendre_coefficients(degree).into_iter().enumerate() {
                    if polynomial.len() <= k {
                        polynomial.resize(k + 1, 0.0);
                    }
                    polynomial[k] += c * p;
                }
            }
        }
    }
    let mean = if !polynomial.is_empty() {
        polynomial[0] += constant;
        Curve::Polynomial { coefficients: polynomial, origin: place.0, scale: place.1 }
    } else if !harmonics.is_empty() {
        Curve::Fourier { mean: constant, terms: harmonics }
    } else if let Some(table) = table(&knots) {
        table
    } else {
        Curve::Constant(constant)
    };
    StatedError { mean, reversal: reversal.map(Curve::Constant), ..StatedError::constant(0.0, u) }
}

fn table(knots: &[(f64, f64)]) -> Option<Curve> {
    use trueaxis_machine::errors::{Extrapolation, Interpolation, Spline};
    let (at, values): (Vec<f64>, Vec<f64>) = knots.iter().copied().unzip();
    let spline = Spline::new(&at, &values, Interpolation::Linear).ok()?;
    Some(Curve::Table { spline, outside: Extrapolation::Clamp })
}

/// The coefficients of Legendre's polynomial in powers of x.
fn legendre_coefficients(degree: u32) -> Vec<f64> {
    let (mut before, mut here) = (vec![1.0], vec![0.0, 1.0]);
    if degree == 0 {
        return before;
    }
    for k in 1..degree {
        let k = f64::from(k);
        let mut next = vec![0.0; here.len() + 1];
        for (i, c) in here.iter().enumerate() {
            next[i + 1] += (2.0 * k + 1.0) * c / (k + 1.0);
        }
        for (i, c) in before.iter().enumerate() {
            next[i] -= k * c / (k + 1.0);
        }
        (before, here) = (here, next);
    }
    here
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendre_of_degree_two() {
        // P2(x) = (3x² − 1)/2: at 0.5: −0.125
        assert!((legendre(2, [0.5])[0] + 0.125).abs() < 1e-15);
        assert_eq!(legendre_coefficients(2), [-0.5, 0.0, 1.5]);
    }

    #[test]
    fn hats_sum_to_one() {
        let hat = |at| Basis::Hat { at, step: 10.0 }.value(3.0, 0.0);
        assert!((hat(0.0) + hat(10.0) - 1.0).abs() < 1e-15);
    }
}
