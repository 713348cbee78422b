//! ISO 230-4: circular tests: G, G(b), F, D, and the causes of the deviations.
//!
//! Docs/model.md eq. 68 to 70. G is taken about the least-squares centre, F about the nominal one,
//! outward positive; what was recorded beyond whole turns is left out, half at each end, and arcs beside whole circles are,
//! too. Of several paths in one direction the worst counts.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::{conditions::Circle, iso230_4};
//! // A circle that is 2 µm too large: round, F = D = 2 µm.
//! let rows: String = (0..=36).map(|i| {
//!     let a = f64::from(10 * i).to_radians();
//!     format!("{},{},ccw\n", 100.002 * a.cos(), 100.002 * a.sin())
//! }).collect();
//! let mut problems = Diagnostics::new();
//! let nominal = Circle { radius_mm: Some(100.0), ..Circle::default() };
//! let text = format!("x_mm,y_mm,direction\n{rows}");
//! let result = iso230_4::evaluate("c.csv", &text, nominal, &mut problems).unwrap();
//! assert!((result.paths[0].mean_radial_mm.unwrap() - 0.002).abs() < 1e-9);
//! assert!(result.paths[0].g_mm < 1e-9);
//! ```

mod causes;
mod diagnosis;
mod points;

pub use causes::{Causes, Spike};
pub use diagnosis::{Cause, Diagnosis, Found, diagnose};
pub use points::{Path, Sense};

use crate::conditions::Circle;
use trueaxis_form::circle::{Zone, least_squares};
use trueaxis_input::Diagnostics;

/// No machine deviates so far from its radius.
const WRONG_RADIUS: f64 = 0.02;

/// One path, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct PathResult {
    /// Its points without the overlap.
    pub path: Path,
    /// The least-squares circle.
    pub circle: Zone,
    /// G, circular deviation about the least-squares centre, mm.
    pub g_mm: f64,
    /// F max and F min, radial deviation from the nominal circle, mm; outward positive.
    pub f_mm: Option<[f64; 2]>,
    /// Mean radius about the least-squares centre − nominal, mm.
    pub mean_radial_mm: Option<f64>,
}

/// A circular test, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Circular {
    /// The names of the two axes.
    pub axes: [String; 2],
    /// Centre of the nominal circle, mm.
    pub centre_mm: [f64; 2],
    /// Nominal radius, mm.
    pub radius_mm: Option<f64>,
    /// Every path, in the order of the file.
    pub paths: Vec<PathResult>,
    /// G(b): all paths of both directions about their common least-squares centre, mm.
    pub g_both_mm: Option<f64>,
    /// F max and F min of both directions, mm.
    pub f_both_mm: Option<[f64; 2]>,
    /// D, mean bidirectional radial deviation, mm: of all pairs of a path in each direction the one farthest from zero.
    pub d_mm: Option<f64>,
    /// The causes of the deviations.
    pub causes: Option<Causes>,
    /// All causes with uncertainties and shares, from both directions.
    pub diagnosis: Option<Diagnosis>,
}

/// The results of a direction, or of all paths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The largest G, mm.
    pub g_mm: f64,
    /// The largest F max and the smallest F min, mm.
    pub f_mm: Option<[f64; 2]>,
}

impl Circular {
    /// The worst of the paths in one direction, or of all; the order of the paths does not matter.
    pub fn worst(&self, sense: Option<Sense>) -> Option<Worst> {
        let of = |p: &PathResult| Worst { g_mm: p.g_mm, f_mm: p.f_mm };
        let paths = self.paths.iter().filter(|p| sense.is_none_or(|s| p.path.sense == s));
        paths.map(of).reduce(|a, b| Worst {
            g_mm: a.g_mm.max(b.g_mm),
            f_mm: a.f_mm.zip(b.f_mm).map(|(a, b)| [a[0].max(b[0]), a[1].min(b[1])]),
        })
    }

    /// The directions that were run, in the order of the file.
    pub fn senses(&self) -> Vec<Sense> {
        let mut senses: Vec<Sense> = self.paths.iter().map(|p| p.path.sense).collect();
        if let Some(first) = senses.first().copied() {
            let other = senses.iter().copied().find(|s| *s != first);
            senses = std::iter::once(first).chain(other).collect();
        }
        senses
    }

    /// The centre of all points: what they deviate is exact in the radius about it. About the nominal centre an
    /// eccentricity e looks like an ellipse of e²/(2R).
    pub fn points_centre_mm(&self) -> [f64; 2] {
        points_centre_mm(&self.paths).unwrap_or(self.centre_mm)
    }
}

fn points_centre_mm(paths: &[PathResult]) -> Option<[f64; 2]> {
    let all: Vec<[f64; 2]> = paths.iter().flat_map(|p| p.path.points_mm.iter().copied()).collect();
    least_squares(&all).ok().map(|zone| zone.center_mm)
}

/// The mean of two mean radial deviations that is farthest from zero.
fn d_mm(paths: &[PathResult]) -> Option<f64> {
    let ends = |sense: Sense| {
        let of = paths.iter().filter(|p| p.path.sense == sense);
        let means: Vec<f64> = of.filter_map(|p| p.mean_radial_mm).collect();
        let [low, high] =
            [means.iter().copied().reduce(f64::min), means.into_iter().reduce(f64::max)];
        Some([low?, high?])
    };
    let (a, b) = (ends(Sense::Clockwise)?, ends(Sense::CounterClockwise)?);
    let [low, high] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    Some(if low.abs() > high.abs() { low } else { high })
}

/// Reads and evaluates the points of a circular test; `None` with errors in `problems`.
pub fn evaluate(
    file: &str,
    text: &str,
    nominal: Circle,
    problems: &mut Diagnostics,
) -> Option<Circular> {
    let points = points::read(file, text, nominal, problems)?;
    let centre_mm = points.centre_mm;
    let place = trueaxis_input::Place::whole(file);
    let mut paths = Vec::new();
    for path in points.paths {
        match least_squares(&path.points_mm) {
            Ok(circle) => {
                let nominal = points.radius_mm;
                let mut result = result(path, circle, centre_mm, nominal);
                result.f_mm = result.f_mm.filter(|_| points.centre_is_nominal);
                paths.push(result);
            }
            Err(error) => {
                let message = format!("no circle through the points: {error}");
                let hint = "at least three different points, better some hundred, all around";
                problems.error("no-circle", place.clone(), message, hint);
                return None;
            }
        }
    }
    if points.radius_mm.is_none() {
        let message = "the nominal radius is not known: no F, no D".to_owned();
        let hint = "write [circle] radius = \"150 mm\" in the conditions file, or --radius 150";
        problems.warn("missing-radius", place.clone(), message, hint);
    }
    let is_wrong = |p: &&PathResult, nominal: f64| {
        (p.circle.radius_mm - nominal).abs() > WRONG_RADIUS * nominal
    };
    if let Some(nominal) = points.radius_mm
        && let Some(path) = paths.iter().find(|p| is_wrong(p, nominal))
    {
        let message = format!(
            "the circle has a radius of {:.3} mm, the nominal one {nominal} mm",
            path.circle.radius_mm
        );
        let hint = "is the nominal radius or a unit wrong? F and D are those of the stated one";
        problems.warn("wrong-radius", place.clone(), message, hint);
    }
    let ran = |s: Sense| paths.iter().any(|p| p.path.sense == s);
    let both = (ran(Sense::Clockwise) && ran(Sense::CounterClockwise)).then_some(());
    if both.is_none() {
        let message = "one direction only: no G(b), no D".to_owned();
        let hint = "servo mismatch and squareness cannot be separated either; run cw and ccw";
        problems.warn("one-direction", place, message, hint);
    }
    let g_both_mm = both.and_then(|()| {
        let all = paths.iter().flat_map(|p| p.path.points_mm.iter().copied());
        least_squares(&all.collect::<Vec<_>>()).ok().map(|zone| zone.width_mm())
    });
    let f = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
    let f_both_mm = both.and_then(|()| paths.iter().filter_map(|p| p.f_mm).reduce(f));
    let d_mm = d_mm(&paths);
    let causes = causes::separate(&paths, centre_mm, points.radius_mm);
    let (axes, radius_mm) = (points.axes, points.radius_mm);
    let diagnosis = None;
    Some(Circular {
        axes,
        centre_mm,
        radius_mm,
        paths,
        g_both_mm,
        f_both_mm,
        d_mm,
        causes,
        diagnosis,
    })
}

fn result(path: Path, circle: Zone, centre_mm: [f64; 2], radius: Option<f64>) -> PathResult {
    let f_mm = radius.map(|radius| {
        let radial = |p: &[f64; 2]| (p[0] - centre_mm[0]).hypot(p[1] - centre_mm[1]) - radius;
        let start = [f64::NEG_INFINITY, f64::INFINITY];
        let ends = path.points_mm.iter().map(radial);
        ends.fold(start, |[max, min], f| [max.max(f), min.min(f)])
    });
    let mean_radial_mm = radius.map(|radius| circle.radius_mm - radius);
    PathResult { path, g_mm: circle.width_mm(), circle, f_mm, mean_radial_mm }
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn circle(radial: impl Fn(f64, f64) -> f64) -> Circular {
        let mut text = "x_mm,y_mm,direction\n".to_owned();
        for (word, s) in [("ccw", 1.0), ("cw", -1.0)] {
            for i in 0..360 {
                let a = s * f64::from(i).to_radians() + 1e-4;
                let r = 100.0 + radial(a, s) * 1e-3;
                text += &format!("{},{},{word}\n", r * a.cos(), r * a.sin());
            }
        }
        let nominal = Circle { radius_mm: Some(100.0), ..Circle::default() };
        let mut problems = Diagnostics::new();
        let result = evaluate("c.csv", &text, nominal, &mut problems).unwrap();
        assert!(!problems.has_errors());
        result
    }

    #[track_caller]
    fn near(mm: f64, um: f64, allowed: f64) {
        assert!((mm * 1e3 - um).abs() < allowed, "{} µm, not {um}", mm * 1e3);
    }

    #[test]
    fn an_ellipse_and_a_shift_by_hand() {
        // 3 µm at 2θ: G = 6, F = ±3, D = 0
        let r = circle(|a, _| 3.0 * (2.0 * a).cos());
        near(r.paths[0].g_mm, 6.0, 1e-3);
        near(r.g_both_mm.unwrap(), 6.0, 1e-3);
        near(r.f_both_mm.unwrap()[0], 3.0, 1e-3);
        near(r.d_mm.unwrap(), 0.0, 1e-2);
        // A shift of 5 µm is not a roundness error, but F contains it.
        let r = circle(|a, _| 5.0 * a.cos());
        near(r.paths[0].g_mm, 0.0, 1e-2);
        near(r.paths[0].f_mm.unwrap()[1], -5.0, 1e-2);
        // cw 2 µm larger than ccw: D is the mean, G(b) the distance.
        let r = circle(|_, s| if s > 0.0 { 1.0 } else { 3.0 });
        near(r.d_mm.unwrap(), 2.0, 1e-6);
        near(r.g_both_mm.unwrap(), 2.0, 1e-6);
    }

    #[test]
    fn causes_are_separated() {
        // B_x = −4, B_y = −2, scale 8 µm over the diameter, squareness and servo at 2θ.
        let r = circle(|a, s| {
            let sign = |v: f64| if v > 0.0 { 1.0 } else { -1.0 };
            let backlash = -2.0 * sign(-s * a.sin()) * a.cos() - sign(s * a.cos()) * a.sin();
            let scale = 2.0 * (2.0 * a).cos();
            backlash + scale + (1.5 + 0.75 * s) * (2.0 * a).sin() + 0.5
        });
        let causes = r.causes.unwrap();
        near(causes.backlash_mm[0], -4.0, 1e-2);
        near(causes.backlash_mm[1], -2.0, 1e-2);
        near(causes.scale_mismatch_mm, 8.0, 2e-2);
        // 1.5 µm · sin 2θ = ½ γ R sin 2θ: γ = 30 µrad
        assert!((causes.squareness_rad.unwrap() * 1e6 - 30.0).abs() < 0.1);
        near(causes.servo_mismatch_mm.unwrap(), 1.5, 1e-2);
        assert!(causes.residual_rms_mm < 2e-5);
    }
}
