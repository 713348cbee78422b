//! What makes the circle deviate, each cause with its uncertainty and its share: docs/model.md eq. 252 to 255.
//!
//! The causes and their names are those that users of a ball-bar know. A change of the master drive between two synchronised
//! ones has no public definition and is not looked for.

use super::causes::{after_reversal, doubtful_rad, sign};
use super::{Circular, PathResult, Sense};
use crate::conditions::{Conditions, Extent};
use crate::coverage::{Contribution, Expanded, combine};
use crate::least_squares::LeastSquares;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueaxis_input::{Diagnostics, Place};

/// After a reversal the axis may stick: these angles are searched for a spike, and used for nothing else, rad.
const SPIKE_WINDOW_RAD: f64 = 10.0 * TAU / 360.0;

/// Unknowns: radius of ccw and cw, centre, scale, squareness, servo, reversal of both axes and its change along them,
/// lateral play, straightness, two cyclic errors.
const UNKNOWNS: usize = 19;

/// What makes a circle deviate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The angle between the axes.
    Squareness,
    /// One axis longer than the other.
    ScaleMismatch,
    /// Both axes longer or shorter: mean radius − nominal radius. It makes no circular deviation.
    Size,
    /// One axis lags more than the other.
    ServoMismatch,
    /// An axis does not follow its reversal at once.
    Backlash(usize),
    /// An axis moves sideways when it reverses.
    LateralPlay(usize),
    /// An axis is bowed.
    Straightness(usize),
    /// An error that repeats with the pitch of the screw or the scale.
    Cyclic(usize),
    /// An axis sticks when it reverses.
    Spike(usize),
    /// What none of them explains.
    Unexplained,
}

impl Cause {
    /// The key in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::Squareness => "squareness",
            Self::ScaleMismatch => "scale-mismatch",
            Self::Size => "size",
            Self::ServoMismatch => "servo-mismatch",
            Self::Backlash(_) => "backlash",
            Self::LateralPlay(_) => "lateral-play",
            Self::Straightness(_) => "straightness",
            Self::Cyclic(_) => "cyclic-error",
            Self::Spike(_) => "reversal-spike",
            Self::Unexplained => "unexplained",
        }
    }

    /// The axis that it belongs to, 0 or 1.
    pub fn axis(self) -> Option<usize> {
        match self {
            Self::Backlash(axis)
            | Self::LateralPlay(axis)
            | Self::Straightness(axis)
            | Self::Cyclic(axis)
            | Self::Spike(axis) => Some(axis),
            _ => None,
        }
    }
}

/// One cause.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Which.
    pub cause: Cause,
    /// Its value. Unit: mm or rad.
    pub value: f64,
    /// Its uncertainty.
    pub uncertainty: Expanded,
    /// Of a backlash: its values where the axis reverses at its positive and at its negative end, mm.
    pub ends_mm: Option<[f64; 2]>,
    /// Of an error that repeats: the amplitudes of its cosine and sine over the position of the axis, mm.
    pub waves_mm: Option<[f64; 2]>,
    /// The circular deviation G(b) that it makes alone, mm.
    pub alone_mm: f64,
    /// Its part of the sum of all these. Unit: 1.
    pub share: f64,
}

/// The causes of a circle, the largest share first.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// All causes that were looked for.
    pub found: Vec<Found>,
    /// Whether the length of the instrument is calibrated, so that the size states the scales of the axes.
    pub is_calibrated: bool,
    /// Nominal radius, mm.
    pub radius_mm: f64,
    /// Standard deviation of the residuals, mm.
    pub residual_mm: f64,
    /// Degrees of freedom of the residuals, which follow each other closely. Unit: 1.
    pub degrees_of_freedom: f64,
    /// By how much the two axes lag one another at the feed that is stated, s.
    pub servo_lag_s: Option<f64>,
}

impl Diagnosis {
    /// What was found of a cause.
    pub fn of(&self, cause: Cause) -> Option<&Found> {
        self.found.iter().find(|f| f.cause == cause)
    }
}

/// The numbers of a circle that the rows need.
struct Setting {
    radius_mm: f64,
    /// The centre as commanded: where on the axes the circle lies.
    centre_mm: [f64; 2],
    /// The centre of the points: radii and angles are taken about it.
    about_mm: [f64; 2],
    pitch_mm: [Option<f64>; 2],
}

/// One point.
struct Point {
    angle: f64,
    sense: Sense,
    radial: f64,
    /// Which path it belongs to.
    path: usize,
    /// Half of which reversal lies before it, and how far.
    after: f64,
    quarter: usize,
}

impl Setting {
    fn residual(&self, p: &Point, x: &[f64; UNKNOWNS]) -> f64 {
        let row = self.row(p.angle, p.sense);
        p.radial - row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>()
    }

    fn row(&self, angle: f64, sense: Sense) -> [f64; UNKNOWNS] {
        let s = sense.sign();
        let (sin, cos) = angle.sin_cos();
        let (sin2, cos2) = (2.0 * angle).sin_cos();
        // Half of a reversal error to either side: the velocities are −s sin θ and s cos θ.
        let (half_a, half_b) = (0.5 * sign(-s * sin), 0.5 * sign(s * cos));
        let [ccw, cw] = if s > 0.0 { [1.0, 0.0] } else { [0.0, 1.0] };
        let mut row = [0.0; UNKNOWNS];
        row[..15].copy_from_slice(&[
            ccw,
            cw,
            cos,
            sin,
            0.25 * cos2,
            0.5 * self.radius_mm * sin2,
            0.5 * s * sin2,
            half_a * cos,
            half_b * sin,
            half_a * cos * cos,
            half_b * sin * sin,
            half_a * sin,
            half_b * cos,
            cos * cos * sin,
            sin * sin * cos,
        ]);
        for (axis, direction) in [(0, cos), (1, sin)] {
            if let Some(pitch) = self.pitch_mm[axis] {
                let phase = TAU * (self.centre_mm[axis] + self.radius_mm * direction) / pitch;
                row[15 + 2 * axis] = phase.cos() * direction;
                row[16 + 2 * axis] = phase.sin() * direction;
            }
        }
        row
    }
}

/// The unknowns of a cause.
fn unknowns(cause: Cause) -> &'static [usize] {
    match cause {
        Cause::ScaleMismatch => &[4],
        Cause::Squareness => &[5],
        Cause::ServoMismatch => &[6],
        Cause::Backlash(0) => &[7, 9],
        Cause::Backlash(_) => &[8, 10],
        Cause::LateralPlay(0) => &[11],
        Cause::LateralPlay(_) => &[12],
        Cause::Straightness(0) => &[13],
        Cause::Straightness(_) => &[14],
        Cause::Cyclic(0) => &[15, 16],
        Cause::Cyclic(_) => &[17, 18],
        Cause::Size | Cause::Spike(_) | Cause::Unexplained => &[],
    }
}

/// How large a cause is that makes a radial amplitude of 1 mm.
fn per_amplitude(cause: Cause, radius_mm: f64) -> f64 {
    match cause {
        Cause::Squareness => 2.0 / radius_mm,
        Cause::ScaleMismatch | Cause::Straightness(_) => 4.0,
        Cause::ServoMismatch | Cause::Backlash(_) | Cause::LateralPlay(_) => 2.0,
        Cause::Size | Cause::Cyclic(_) | Cause::Spike(_) | Cause::Unexplained => 1.0,
    }
}

/// The causes of a circle that was run in both directions; `None` where they cannot be separated.
pub fn diagnose(
    circle: &Circular,
    conditions: &Conditions,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<Diagnosis> {
    let both = circle.paths.iter().any(|p| p.path.sense != circle.paths[0].path.sense);
    if !both || !circle.paths.iter().all(is_whole) {
        return None;
    }
    let fitted = Fitted::of(circle, circle.radius_mm?, conditions)?;
    let instrument_u = instrument_u(conditions, place, problems);
    let causes = looked_for(&fitted.setting.pitch_mm);
    let mut found: Vec<Found> = causes.into_iter().map(|c| fitted.cause(c, instrument_u)).collect();
    found.extend((0..2).map(|axis| fitted.spike(axis, instrument_u)));
    found.push(fitted.size(conditions, instrument_u));
    found.push(fitted.unexplained());
    let sum: f64 = found.iter().map(|f| f.alone_mm).sum();
    found.iter_mut().for_each(|f| f.share = if sum > 0.0 { f.alone_mm / sum } else { 0.0 });
    found.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.cause.cmp(&b.cause)));
    Some(Diagnosis {
        found,
        is_calibrated: conditions.circle.length_u_mm.is_some(),
        radius_mm: fitted.setting.radius_mm,
        residual_mm: fitted.noise.residual_mm,
        degrees_of_freedom: fitted.noise.degrees_of_freedom,
        // An ellipse along 45° from lags that differ by Δτ has the zone F |Δτ|: eq. 213.
        servo_lag_s: conditions.circle.feed_mm_s.map(|feed| fitted.x[6] / feed),
    })
}

/// The unknowns, fitted to a circle.
struct Fitted {
    setting: Setting,
    points: Vec<Point>,
    x: [f64; UNKNOWNS],
    variances: [f64; UNKNOWNS],
    noise: Noise,
    /// Least and largest residual away from the reversals, mm.
    ends: [f64; 2],
    doubtful: f64,
}

impl Fitted {
    fn of(circle: &Circular, radius_mm: f64, conditions: &Conditions) -> Option<Self> {
        let (pitch_mm, centre_mm) = (conditions.circle.pitch_mm, circle.centre_mm);
        let about_mm = circle.points_centre_mm();
        let setting = Setting { radius_mm, centre_mm, about_mm, pitch_mm };
        let points = points(&circle.paths, &setting);
        let doubtful = doubtful_rad(&circle.paths);
        let counts = |p: &&Point| p.after > SPIKE_WINDOW_RAD && p.after <= FRAC_PI_2 - doubtful;
        let mut fit = LeastSquares::<UNKNOWNS>::default();
        for p in points.iter().filter(counts) {
            fit.add(&setting.row(p.angle, p.sense), p.radial);
        }
        let (x, variances) = (fit.solve()?, fit.variances()?);
        let rest: Vec<(usize, f64)> =
            points.iter().filter(counts).map(|p| (p.path, setting.residual(p, &x))).collect();
        let noise = Noise::of(&rest, 15 + 2 * pitch_mm.iter().flatten().count())?;
        let ends =
            rest.iter().fold([0.0_f64; 2], |[low, high], (_, r)| [low.min(*r), high.max(*r)]);
        Some(Self { setting, points, x, variances, noise, ends, doubtful })
    }

    /// Of an unknown with this variance; `of_instrument`: what the instrument adds to it.
    fn uncertainty(&self, variance: f64, of_instrument: f64) -> Expanded {
        let u = self.noise.residual_mm * (variance * self.noise.inflation).sqrt();
        let degrees_of_freedom = Some(self.noise.degrees_of_freedom);
        let scatter = Contribution { u, degrees_of_freedom };
        combine(&[scatter, Contribution { u: of_instrument, degrees_of_freedom: None }])
    }

    fn cause(&self, cause: Cause, instrument_u: f64) -> Found {
        let (x, unknowns) = (&self.x, unknowns(cause));
        let first = unknowns[0];
        let part = |p: &Point| {
            let row = self.setting.row(p.angle, p.sense);
            unknowns.iter().map(|k| row[*k] * x[*k]).sum::<f64>()
        };
        let per_amplitude = per_amplitude(cause, self.setting.radius_mm);
        let uncertainty = self.uncertainty(self.variances[first], instrument_u * per_amplitude);
        let mut found = Found::new(cause, x[first], uncertainty, alone(&self.points, part));
        match (cause, unknowns) {
            (Cause::Backlash(_), &[mean, change]) => {
                found.ends_mm = Some([x[mean] + x[change], x[mean] - x[change]]);
            }
            // From crest to trough.
            (Cause::Cyclic(_), &[cosine, sine]) => {
                found.waves_mm = Some([x[cosine], x[sine]]);
                found.value = 2.0 * x[cosine].hypot(x[sine]);
                found.uncertainty = uncertainty.scaled(2.0);
            }
            _ => {}
        }
        found
    }

    /// The largest residual just after the reversals of an axis.
    fn spike(&self, axis: usize, instrument_u: f64) -> Found {
        let near = self.doubtful..=SPIKE_WINDOW_RAD;
        let in_window = |p: &&Point| p.quarter % 2 == axis && near.contains(&p.after);
        let heights =
            self.points.iter().filter(in_window).map(|p| self.setting.residual(p, &self.x));
        let value = heights.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let uncertainty = self.uncertainty(1.0 / self.noise.inflation, instrument_u);
        Found::new(Cause::Spike(axis), value, uncertainty, value.abs())
    }

    fn size(&self, conditions: &Conditions, instrument_u: f64) -> Found {
        let length_u = conditions.circle.length_u_mm.unwrap_or(0.0);
        let variance = 0.25 * (self.variances[0] + self.variances[1]);
        let uncertainty = self.uncertainty(variance, instrument_u.hypot(length_u));
        Found::new(Cause::Size, 0.5 * (self.x[0] + self.x[1]), uncertainty, 0.0)
    }

    fn unexplained(&self) -> Found {
        let none = Expanded { u: 0.0, degrees_of_freedom: None, coverage_factor: 2.0 };
        let [low, high] = self.ends;
        Found::new(Cause::Unexplained, self.noise.residual_mm, none, high - low)
    }
}

impl Found {
    fn new(cause: Cause, value: f64, uncertainty: Expanded, alone_mm: f64) -> Self {
        let (ends_mm, waves_mm, share) = (None, None, 0.0);
        Self { cause, value, uncertainty, ends_mm, waves_mm, alone_mm, share }
    }
}

fn looked_for(pitch_mm: &[Option<f64>; 2]) -> Vec<Cause> {
    let mut causes = vec![
        Cause::Squareness,
        Cause::ScaleMismatch,
        Cause::ServoMismatch,
        Cause::Backlash(0),
        Cause::Backlash(1),
        Cause::LateralPlay(0),
        Cause::LateralPlay(1),
        Cause::Straightness(0),
        Cause::Straightness(1),
    ];
    causes.extend((0..2).filter(|axis| pitch_mm[*axis].is_some()).map(Cause::Cyclic));
    causes
}

/// Whether points lie all around.
fn is_whole(path: &PathResult) -> bool {
    const WIDEST_GAP_RAD: f64 = 0.35;
    let [x, y] = path.circle.center_mm;
    let mut angles: Vec<f64> =
        path.path.points_mm.iter().map(|p| (p[1] - y).atan2(p[0] - x)).collect();
    angles.sort_by(f64::total_cmp);
    let Some((first, last)) = angles.first().zip(angles.last()) else { return false };
    let around = first + TAU - last;
    angles.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max) < WIDEST_GAP_RAD
}

fn points(paths: &[PathResult], setting: &Setting) -> Vec<Point> {
    let mut all = Vec::new();
    for (path, result) in paths.iter().enumerate() {
        for p in &result.path.points_mm {
            let (x, y) = (p[0] - setting.about_mm[0], p[1] - setting.about_mm[1]);
            let (angle, sense) = (y.atan2(x), result.path.sense);
            let (after, quarter) = after_reversal(angle, sense);
            let radial = x.hypot(y) - setting.radius_mm;
            all.push(Point { angle, sense, radial, path, after, quarter });
        }
    }
    all
}

/// G(b) of a part of the deviations: its range about the circle that fits it best.
fn alone(points: &[Point], part: impl Fn(&Point) -> f64) -> f64 {
    let mut fit = LeastSquares::<3>::default();
    let row = |p: &Point| [1.0, p.angle.cos(), p.angle.sin()];
    for p in points {
        fit.add(&row(p), part(p));
    }
    let Some(circle) = fit.solve() else { return 0.0 };
    let left = points
        .iter()
        .map(|p| part(p) - row(p).iter().zip(&circle).map(|(a, b)| a * b).sum::<f64>());
    let [low, high] =
        left.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    (high - low).max(0.0)
}

/// The scatter of residuals that follow each other closely: docs/model.md eq. 254.
struct Noise {
    residual_mm: f64,
    /// By how much the variance of an unknown is larger than with independent residuals.
    inflation: f64,
    degrees_of_freedom: f64,
}

impl Noise {
    fn of(rest: &[(usize, f64)], unknowns: usize) -> Option<Self> {
        let count = rest.len();
        if count <= unknowns + 1 {
            return None;
        }
        let squares: f64 = rest.iter().map(|(_, r)| r * r).sum();
        let pairs = rest.windows(2).filter(|w| w[0].0 == w[1].0);
        let products: f64 = pairs.map(|w| w[0].1 * w[1].1).sum();
        // Neighbours that repel each other are not taken for more knowledge.
        let correlation = if squares > 0.0 { (products / squares).clamp(0.0, 0.99) } else { 0.0 };
        let inflation = (1.0 + correlation) / (1.0 - correlation);
        let free = (count - unknowns) as f64;
        let residual_mm = (squares / free).sqrt();
        Some(Self { residual_mm, inflation, degrees_of_freedom: (free / inflation).max(1.0) })
    }
}

/// Standard uncertainty of a reading that does not average out, mm; 0 with a warning where it is not stated.
fn instrument_u(conditions: &Conditions, place: &Place, problems: &mut Diagnostics) -> f64 {
    match conditions.instrument.and_then(|i| i.device_expanded) {
        Some(Extent::Length(expanded)) => 0.5 * expanded,
        Some(Extent::Angle(_)) => {
            let message = "`device_expanded` of a circular test is a length".to_owned();
            problems.error(
                "wrong-unit",
                place.clone(),
                message,
                "device_expanded = \"0.7 um\" (k = 2)",
            );
            0.0
        }
        None => {
            let message = "no uncertainty of the instrument is stated: U of the causes is that of the scatter".to_owned();
            let hint =
                "write [uncertainty] device_expanded = \"0.7 um\" (k = 2) in the conditions file";
            problems.warn("missing-uncertainty", place.clone(), message, hint);
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::iso230_4::tests::circle;

    fn diagnosed(radial: impl Fn(f64, f64) -> f64, pitch: Option<f64>) -> Diagnosis {
        let circle = circle(radial);
        let mut conditions = Conditions::default();
        conditions.circle.pitch_mm = [pitch, None];
        let mut problems = Diagnostics::new();
        diagnose(&circle, &conditions, &Place::whole("c.csv"), &mut problems).unwrap()
    }

    fn of(v: f64) -> f64 {
        if v > 0.0 { 1.0 } else { -1.0 }
    }

    /// Each cause alone, by its own formula: it is found, and nothing else.
    #[test]
    fn every_cause_is_found_alone() {
        let wave = |a: f64| (TAU * 100.0 * a.cos() / 7.0).cos() * a.cos();
        type Radial<'a> = &'a dyn Fn(f64, f64) -> f64;
        let cases: [(Cause, f64, Radial<'_>); 9] = [
            (Cause::Squareness, 30e-6, &|a, _| 1.5 * (2.0 * a).sin()),
            (Cause::ScaleMismatch, 8e-3, &|a, _| 2.0 * (2.0 * a).cos()),
            (Cause::ServoMismatch, 3e-3, &|a, s| 1.5 * s * (2.0 * a).sin()),
            (Cause::Backlash(0), -4e-3, &|a, s| -2.0 * of(-s * a.sin()) * a.cos()),
            (Cause::Backlash(1), 5e-3, &|a, s| 2.5 * of(s * a.cos()) * a.sin()),
            (Cause::LateralPlay(0), 3e-3, &|a, s| 1.5 * of(-s * a.sin()) * a.sin()),
            (Cause::LateralPlay(1), -2e-3, &|a, s| -of(s * a.cos()) * a.cos()),
            (Cause::Straightness(0), 6e-3, &|a, _| 6.0 * a.cos().powi(2) * a.sin()),
            (Cause::Cyclic(0), 2e-3, &|a, _| wave(a)),
        ];
        for (cause, value, radial) in cases {
            let pitch = (cause == Cause::Cyclic(0)).then_some(7.0);
            let found = diagnosed(radial, pitch);
            let best = &found.found[0];
            assert_eq!(best.cause, cause);
            assert!((best.value - value).abs() < 2e-3 * value.abs(), "{cause:?}: {}", best.value);
            assert!(best.share > 0.98, "{cause:?}: {}", best.share);
            assert!((found.found.iter().map(|f| f.share).sum::<f64>() - 1.0).abs() < 1e-12);
        }
        let size = diagnosed(|_, _| 3.0, None);
        assert!((size.of(Cause::Size).unwrap().value - 3e-3).abs() < 1e-9);
    }

    /// A reversal that is larger at one end, and a spike of its own.
    #[test]
    fn ends_and_spikes() {
        let found = diagnosed(
            |a, s| {
                let stick = if (0.0..0.09).contains(&(s * a).rem_euclid(TAU)) { 4.0 } else { 0.0 };
                0.5 * (3.0 + a.cos()) * of(-s * a.sin()) * a.cos() + stick
            },
            None,
        );
        let [positive, negative] = found.of(Cause::Backlash(0)).unwrap().ends_mm.unwrap();
        assert!((positive - 4e-3).abs() < 1e-5 && (negative - 2e-3).abs() < 1e-5);
        assert!((found.of(Cause::Spike(0)).unwrap().value - 4e-3).abs() < 1e-4);
        assert!(found.of(Cause::Spike(1)).unwrap().value.abs() < 1e-4);
    }
}
