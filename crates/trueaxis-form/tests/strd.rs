//! The nonlinear solver on all data sets of NIST StRD, from both starts.

use nalgebra::DMatrix;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};
use trueaxis_form::least_squares::{Residuals, solve};

/// A value with its derivatives by up to nine unknowns: the models are written once.
#[derive(Clone, Copy)]
struct D {
    v: f64,
    d: [f64; 9],
}

fn con(v: f64) -> D {
    D { v, d: [0.0; 9] }
}

impl D {
    fn chain(self, v: f64, slope: f64) -> D {
        D { v, d: self.d.map(|d| d * slope) }
    }
    fn exp(self) -> D {
        let e = self.v.exp();
        self.chain(e, e)
    }
    fn cos(self) -> D {
        self.chain(self.v.cos(), -self.v.sin())
    }
    fn sin(self) -> D {
        self.chain(self.v.sin(), self.v.cos())
    }
    fn atan(self) -> D {
        self.chain(self.v.atan(), 1.0 / (1.0 + self.v * self.v))
    }
    fn ln(self) -> D {
        self.chain(self.v.ln(), 1.0 / self.v)
    }
    fn sq(self) -> D {
        self * self
    }
    fn powf(self, e: f64) -> D {
        self.chain(self.v.powf(e), e * self.v.powf(e - 1.0))
    }
    fn pow(self, e: D) -> D {
        (e * self.ln()).exp()
    }
}

impl Neg for D {
    type Output = D;
    fn neg(self) -> D {
        self.chain(-self.v, -1.0)
    }
}
impl Add for D {
    type Output = D;
    fn add(self, o: D) -> D {
        D { v: self.v + o.v, d: std::array::from_fn(|i| self.d[i] + o.d[i]) }
    }
}
impl Sub for D {
    type Output = D;
    fn sub(self, o: D) -> D {
        self + -o
    }
}
impl Mul for D {
    type Output = D;
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
    fn mul(self, o: D) -> D {
        D { v: self.v * o.v, d: std::array::from_fn(|i| self.d[i] * o.v + self.v * o.d[i]) }
    }
}
impl Div for D {
    type Output = D;
    fn div(self, o: D) -> D {
        self * o.chain(1.0 / o.v, -1.0 / (o.v * o.v))
    }
}

/// The model of a data set: b are the unknowns, x the predictors.
fn model(name: &str, b: &[D], x: &[f64]) -> D {
    let one = con(1.0);
    let (t, two) = (con(x[0]), con(2.0));
    match name {
        "Misra1a" | "BoxBOD" => b[0] * (one - (-b[1] * t).exp()),
        "Misra1b" => b[0] * (one - (one + b[1] * t / two).powf(-2.0)),
        "Misra1c" => b[0] * (one - (one + two * b[1] * t).powf(-0.5)),
        "Misra1d" => b[0] * b[1] * t / (one + b[1] * t),
        "Chwirut1" | "Chwirut2" => (-b[0] * t).exp() / (b[1] + b[2] * t),
        "Lanczos1" | "Lanczos2" | "Lanczos3" => {
            b[0] * (-b[1] * t).exp() + b[2] * (-b[3] * t).exp() + b[4] * (-b[5] * t).exp()
        }
        "Gauss1" | "Gauss2" | "Gauss3" => {
            let bell = |h: D, c: D, w: D| h * (-((t - c) / w).sq()).exp();
            b[0] * (-b[1] * t).exp() + bell(b[2], b[3], b[4]) + bell(b[5], b[6], b[7])
        }
        "DanWood" => b[0] * t.pow(b[1]),
        "Kirby2" => (b[0] + b[1] * t + b[2] * t.sq()) / (one + b[3] * t + b[4] * t.sq()),
        "Hahn1" | "Thurber" => {
            let cube = t.sq() * t;
            (b[0] + b[1] * t + b[2] * t.sq() + b[3] * cube)
                / (one + b[4] * t + b[5] * t.sq() + b[6] * cube)
        }
        "Nelson" => b[0] - b[1] * t * (-b[2] * con(x[1])).exp(),
        "MGH17" => b[0] + b[1] * (-t * b[3]).exp() + b[2] * (-t * b[4]).exp(),
        "Roszman1" => b[0] - b[1] * t - (b[2] / (t - b[3])).atan() / con(PI),
        "ENSO" => {
            let wave = |c: D, s: D, period: D| {
                let phase = con(2.0 * PI * x[0]) / period;
                c * phase.cos() + s * phase.sin()
            };
            b[0] + wave(b[1], b[2], con(12.0)) + wave(b[4], b[5], b[3]) + wave(b[7], b[8], b[6])
        }
        "MGH09" => b[0] * (t.sq() + t * b[1]) / (t.sq() + t * b[2] + b[3]),
        "Rat42" => b[0] / (one + (b[1] - b[2] * t).exp()),
        "MGH10" => b[0] * (b[1] / (t + b[2])).exp(),
        "Eckerle4" => b[0] / b[1] * (con(-0.5) * ((t - b[2]) / b[1]).sq()).exp(),
        "Rat43" => b[0] / (one + (b[1] - b[2] * t).exp()).pow(one / b[3]),
        "Bennett5" => b[0] * (b[1] + t).pow(-(one / b[2])),
        other => panic!("no model {other}"),
    }
}

struct Set {
    name: String,
    degrees: usize,
    squares: f64,
    deviation: f64,
    /// Start 1, start 2, certified value, certified standard deviation.
    unknowns: Vec<[f64; 4]>,
    rows: Vec<Vec<f64>>,
}

impl Residuals for Set {
    fn count(&self) -> usize {
        self.rows.len()
    }

    fn evaluate(&self, values: &[f64], residual: &mut [f64], jacobian: Option<&mut DMatrix<f64>>) {
        let mut jacobian = jacobian;
        let b: Vec<D> = values
            .iter()
            .enumerate()
            .map(|(i, v)| D { v: *v, d: std::array::from_fn(|k| f64::from(u8::from(k == i))) })
            .collect();
        for (i, row) in self.rows.iter().enumerate() {
            let y = if self.name == "Nelson" { row[0].ln() } else { row[0] };
            let found = model(&self.name, &b, &row[1..]);
            residual[i] = found.v - y;
            if let Some(j) = jacobian.as_deref_mut() {
                (0..values.len()).for_each(|k| j[(i, k)] = found.d[k]);
            }
        }
    }
}

fn sets() -> Vec<Set> {
    let text = include_str!("data/nist_strd.txt");
    let mut sets: Vec<Set> = Vec::new();
    let number = |w: &str| w.parse::<f64>().unwrap();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[0] {
            "=" => sets.push(Set {
                name: words[1].to_owned(),
                degrees: words[3].parse().unwrap(),
                squares: number(words[4]),
                deviation: number(words[5]),
                unknowns: Vec::new(),
                rows: Vec::new(),
            }),
            "b" => {
                let set = sets.last_mut().unwrap();
                set.unknowns.push(std::array::from_fn(|i| number(words[i + 1])));
            }
            _ => sets.last_mut().unwrap().rows.push(words.iter().map(|w| number(w)).collect()),
        }
    }
    sets
}

/// Correct digits: −log₁₀ of the relative error.
fn digits(found: f64, certified: f64) -> f64 {
    match (found - certified).abs() / certified.abs() {
        0.0 => 11.0,
        e => (-e.log10()).min(11.0),
    }
}

#[test]
fn oracle_strd_all_27_sets_from_both_starts_to_8_digits() {
    let mut wrong = Vec::new();
    let sets = sets();
    assert_eq!(sets.len(), 27);
    for set in &sets {
        for start in 0..2 {
            let from: Vec<f64> = set.unknowns.iter().map(|b| b[start]).collect();
            let Some(found) = solve(set, &from) else {
                wrong.push(format!("{} start {}: no residual", set.name, start + 1));
                continue;
            };
            let all = |pairs: Vec<(f64, f64)>| {
                pairs.into_iter().map(|(a, b)| digits(a, b)).fold(11.0, f64::min)
            };
            let values =
                all(found.values.iter().zip(&set.unknowns).map(|(v, b)| (*v, b[2])).collect());
            let s = found.residual_deviation();
            let u = found.uncertainties(s);
            let u = all(u.iter().zip(&set.unknowns).map(|(u, b)| (*u, b[3])).collect());
            let spread = digits(s, set.deviation).min(digits(found.sum_of_squares, set.squares));
            let fine = values >= 8.0
                && found.is_converged()
                // DIFFERENCE: the file of Rat43 states 9 degrees of freedom; its own s and S give 15 − 4 = 11.
                && found.degrees_of_freedom() == if set.name == "Rat43" { 11 } else { set.degrees }
                && (set.name == "Lanczos1" || (u >= 6.0 && spread >= 8.0));
            if !fine {
                wrong.push(format!(
                    "{} start {}: {values:.1} digits, u {u:.1}, s {spread:.1}; {:?} after {} steps, S {:e} ({:e})",
                    set.name, start + 1, found.ending, found.steps, found.sum_of_squares, set.squares
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
