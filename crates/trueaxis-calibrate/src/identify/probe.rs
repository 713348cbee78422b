//! Calibration of a touch probe on a ring or a sphere (Zhang et al. 2023, 2.3.2).
//!
//! [`read_study`] reads a study with its hits, [`identify_probe`] finds the offset of the stylus ball
//! and how the pre-travel follows the direction, [`correct`] applies it to other hits.
//! [`datums`] are the steps before: eccentricity, Z and X, Y by four hits.
//!
//! Directions are those of motion; the offset is ball − spindle; a deviation is counted along the
//! direction of motion, so that within a ring it is measured radius − ring radius.

mod check;
pub mod datums;
mod file;
mod fit;
mod hit;
mod hits_file;
mod lobing;
mod log;
pub mod program;

pub use check::{MOST_HITS, check_hits};
pub use file::{Purpose, Study, Stylus, Tables, parse_study, read_study};
pub use fit::{Fit, Free, Sample, Score, choose, fit};
pub use hit::{Gauge, GaugeKind, Hit, Side, Travelled, travelled, turned};
pub use hits_file::{Reading, Setup, parse_hits};
pub use lobing::{Lobing, LobingModel, Term};

use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::student_above;
use trueaxis_input::{Diagnostics, Place};

/// Outside of the latitudes of the calibration by more than this nothing is corrected, rad.
const BEYOND_RAD: f64 = 0.1;
/// Half of what an interval of 95 % leaves out.
const TAIL: f64 = 0.025;
/// A mean pre-travel this many standard uncertainties below 0 is a wrong size. Unit: 1.
const SURE: f64 = 3.0;
/// No mean of hits is known better, mm.
const LEAST_U_MM: f64 = 1e-4;

/// Range and root mean square of deviations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// Greatest less smallest, mm.
    pub range_mm: f64,
    /// Root mean square, mm.
    pub rms_mm: f64,
    /// Mean, mm.
    pub mean_mm: f64,
}

impl Spread {
    /// Of some deviations.
    pub fn of(deviations_mm: &[f64]) -> Self {
        let low = deviations_mm.iter().copied().fold(f64::INFINITY, f64::min);
        let high = deviations_mm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let squares: f64 = deviations_mm.iter().map(|d| d * d).sum();
        let count = deviations_mm.len() as f64;
        match deviations_mm.is_empty() {
            true => Self::default(),
            false => Self {
                range_mm: high - low,
                rms_mm: (squares / count).sqrt(),
                mean_mm: deviations_mm.iter().sum::<f64>() / count,
            },
        }
    }

    /// Root mean square about the mean, mm: what another ball radius would not take away.
    pub fn rms_about_mean(&self) -> f64 {
        (self.rms_mm.powi(2) - self.mean_mm.powi(2)).max(0.0).sqrt()
    }
}

/// The offset of the stylus ball, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    /// Ball − spindle in the frame of the probe (spindle at 0), mm. Hits determine the place of
    /// the ball less the first degree of the pre-travel: no hit separates these two.
    pub value_mm: Vec3,
    /// Standard uncertainty of each coordinate, mm.
    pub u_mm: Vec3,
    /// How many coordinates the hits determine: x, y; on a sphere of known centre also z.
    pub coordinates: usize,
}

/// Probing errors about the circle or sphere of least squares of the measured points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormError {
    /// Range of the radial distances as measured, mm.
    pub before_mm: f64,
    /// The same after the correction, mm.
    pub after_mm: f64,
}

/// Hits in one and the same direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeats {
    /// Directions with two hits or more.
    pub directions: usize,
    /// Standard deviation of one hit, pooled, mm.
    pub s_mm: f64,
    /// The largest range in one direction, mm.
    pub range_mm: f64,
}

/// Hits that the calibration has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct FreshCheck {
    /// Hit by hit: deviation as measured and after the correction, mm.
    pub deviations_mm: Vec<[f64; 2]>,
    /// As measured.
    pub before: Spread,
    /// Corrected.
    pub after: Spread,
    /// The share of hits whose deviation is within its U (95 %). Unit: 1.
    pub covered: f64,
}

/// What a probe with one stylus is like.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// The name of the stylus.
    pub stylus: String,
    /// What it touched.
    pub gauge: Gauge,
    /// Radius of its ball as stated, mm.
    pub ball_radius_mm: f64,
    /// Offset, pre-travel and centre.
    pub fit: Fit,
    /// Every size of the model that was tried, and of the model that was not asked for.
    pub scores: Vec<Score>,
    /// The offset; `None` if it is not separable from the centre of the gauge.
    pub offset: Option<Offset>,
    /// Hit by hit: deviation as measured, mm.
    pub before_mm: Vec<f64>,
    /// As measured.
    pub before: Spread,
    /// With the offset alone.
    pub offset_only: Spread,
    /// Corrected, of the hits that the model was made of.
    pub after: Spread,
    /// Corrected by a model that has not seen this direction.
    pub held_out: Spread,
    /// About the circle or sphere of least squares.
    pub form: Option<FormError>,
    /// Hits in one and the same direction, if there are.
    pub repeats: Option<Repeats>,
    /// On fresh directions, if the study has them.
    pub check: Option<FreshCheck>,
    /// Orientations of the spindle, rad.
    pub orientations_rad: Vec<f64>,
    /// The least and the greatest sine of latitude of the hits. Unit: 1.
    pub latitude: [f64; 2],
    /// The widest arc without a hit, rad.
    pub gap_rad: f64,
    /// The factor of U (95 %, Student). Unit: 1.
    pub coverage_factor: f64,
}

/// One direction of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableRow {
    /// Direction of motion, rad.
    pub direction_rad: f64,
    /// Deviation along the direction of motion (dR within a ring), mm.
    pub deviation_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_mm: f64,
}

/// Calibrates every stylus of a study.
///
/// `None` with errors among the problems: these hits determine no calibration.
pub fn identify_probe(study: &Study, problems: &mut Diagnostics) -> Option<Vec<Calibration>> {
    let found: Vec<_> = study.styli.iter().map(|s| calibrate(study, s, problems)).collect();
    found.into_iter().collect()
}

fn calibrate(study: &Study, stylus: &Stylus, problems: &mut Diagnostics) -> Option<Calibration> {
    let gap_rad = check_hits(study, stylus, problems)?;
    let gauge = &study.gauge;
    let contact_mm = gauge.contact_mm(stylus.ball_radius_mm);
    let sample = Sample { hits: &stylus.hits, gauge, contact_mm };
    let place = || Place::whole(&study.file);
    let chosen = choose(&sample, study.model, study.most_harmonics, gap_rad);
    let Some((fit, mut scores)) = chosen else {
        let message = format!(
            "the {} hits of stylus `{}` determine no calibration",
            stylus.hits.len(),
            stylus.name
        );
        let hint = "spread them evenly over all directions; 12 or more show three lobes";
        problems.error("too-few-hits", place(), message, hint);
        return None;
    };
    let other = match study.model {
        LobingModel::Fourier => LobingModel::Spline,
        LobingModel::Spline => LobingModel::Fourier,
    };
    if gauge.kind == GaugeKind::Ring {
        let tried = choose(&sample, other, study.most_harmonics, gap_rad);
        scores.extend(tried.into_iter().flat_map(|t| t.1));
    }
    let mut found = describe(study, stylus, fit, scores);
    found.gap_rad = gap_rad;
    found.check = fresh_check(&found, &stylus.check);
    warn(&found, stylus, &place(), problems);
    Some(found)
}

fn describe(study: &Study, stylus: &Stylus, fit: Fit, scores: Vec<Score>) -> Calibration {
    let gauge = &study.gauge;
    let rule = (gauge.side, gauge.contact_mm(stylus.ball_radius_mm));
    let deviation = |offset: Vec3| -> Vec<f64> {
        let of = |h: &Hit| travelled(h, offset, fit.centre_mm, rule).map_or(0.0, |t| t.travel_mm);
        stylus.hits.iter().map(of).collect()
    };
    let before_mm = deviation(Vec3::zeros());
    let latitudes = || stylus.hits.iter().map(|h| h.direction.z);
    let coverage_factor = student_above(TAIL, fit.freedom() as f64);
    let mut found = Calibration {
        stylus: stylus.name.clone(),
        gauge: gauge.clone(),
        ball_radius_mm: stylus.ball_radius_mm,
        offset: offset(gauge, &fit),
        before: Spread::of(&before_mm),
        offset_only: Spread::of(&deviation(fit.offset_mm)),
        after: Spread::of(&fit.left_mm),
        held_out: Spread::of(&fit.held_out_mm),
        before_mm,
        form: None,
        repeats: repeats(&stylus.hits, &fit.left_mm),
        check: None,
        orientations_rad: orientations(&stylus.hits),
        latitude: [
            latitudes().fold(f64::INFINITY, f64::min),
            latitudes().fold(f64::NEG_INFINITY, f64::max),
        ],
        gap_rad: 0.0,
        coverage_factor,
        fit,
        scores,
    };
    found.form = form_error(&found, &stylus.hits);
    found
}

fn offset(gauge: &Gauge, fit: &Fit) -> Option<Offset> {
    let (count, free) = (fit.coefficients_mm.len(), fit.free.offset);
    (free > 0).then(|| {
        let mut u_mm = Vec3::zeros();
        for k in 0..free {
            let mut weights = DVector::zeros(fit.cofactor.nrows());
            weights[count + k] = 1.0;
            // An error of a known centre goes whole into the offset.
            let centre = if fit.free.centre == 0 { gauge.u_centre_mm } else { 0.0 };
            u_mm[k] = fit.u_mm(&weights).hypot(centre);
        }
        Offset { value_mm: fit.offset_mm, u_mm, coordinates: free }
    })
}

fn orientations(hits: &[Hit]) -> Vec<f64> {
    let mut all: Vec<f64> = hits.iter().map(|h| h.orientation_rad).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    all
}

fn repeats(hits: &[Hit], left_mm: &[f64]) -> Option<Repeats> {
    let key = |i: usize| -> [i64; 4] {
        let [x, y, z]: [i64; 3] = hits[i].direction.map(|v| (v * 1e6).round() as i64).into();
        [x, y, z, (hits[i].orientation_rad * 1e6).round() as i64]
    };
    let mut order: Vec<usize> = (0..hits.len()).collect();
    order.sort_by_key(|i| key(*i));
    let (mut directions, mut squares, mut freedom, mut range_mm) = (0, 0.0, 0, 0.0_f64);
    for group in order.chunk_by(|a, b| key(*a) == key(*b)).filter(|g| g.len() > 1) {
        let values: Vec<f64> = group.iter().map(|i| left_mm[*i]).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        squares += values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        freedom += values.len() - 1;
        directions += 1;
        range_mm = range_mm.max(Spread::of(&values).range_mm);
    }
    (directions > 0).then(|| {
        let s_mm = (squares / freedom as f64).sqrt();
        Repeats { directions, s_mm, range_mm }
    })
}

/// Range of the distances from the centre of least squares, before and after the correction.
///
/// # Source
/// ISO 230-10, P_FTU,2D and P_FTU,3D; the numbers of hits there (36 and 25) were not checked on
/// the page.
fn form_error(found: &Calibration, hits: &[Hit]) -> Option<FormError> {
    let raw = hits.iter().map(|h| h.spindle_mm + h.direction * found.ball_radius_mm);
    let corrected = hits.iter().map(|h| found.contact_point(h));
    let range = |points: Vec<Vec3>| {
        let distances = distances(&points, found.gauge.dimensions())?;
        Some(Spread::of(&distances).range_mm)
    };
    Some(FormError { before_mm: range(raw.collect())?, after_mm: range(corrected.collect())? })
}

/// From the centre of the circle or sphere of least squares (orthogonal distances).
fn distances(points: &[Vec3], dimensions: usize) -> Option<Vec<f64>> {
    let mut centre = fit::rough_centre(points, dimensions)?;
    let reach = |centre: Vec3| points.iter().map(move |p| (p - centre).norm());
    for _ in 0..20 {
        let a = DMatrix::from_fn(points.len(), dimensions + 1, |i, j| match j < dimensions {
            true => (points[i] - centre).normalize()[j],
            false => 1.0,
        });
        let b = DVector::from_iterator(points.len(), reach(centre));
        let normal = (a.transpose() * &a).cholesky()?;
        let x = normal.solve(&(a.transpose() * b));
        let step: Vec3 = Vec3::from_fn(|j, _| if j < dimensions { x[j] } else { 0.0 });
        centre += step;
        if step.norm() < 1e-12 {
            break;
        }
    }
    Some(reach(centre).collect())
}

impl Calibration {
    /// The deviation in a direction of motion with the spindle turned, along that direction.
    ///
    /// ```text
    ///     dR(θ) = t(θ − φ) − R(φ)·o·u(θ)                                         docs/model.md eq. 140
    /// ```
    pub fn deviation(&self, direction: Vec3, orientation_rad: f64) -> TableRow {
        let probe_direction = turned(direction, -orientation_rad);
        let mut weights = DVector::zeros(self.fit.cofactor.nrows());
        let values = self.fit.lobing.values(probe_direction);
        let count = values.len();
        values.into_iter().enumerate().for_each(|(j, v)| weights[j] = v);
        (0..self.fit.free.offset).for_each(|k| weights[count + k] = -probe_direction[k]);
        let known = self.fit.free.centre == 0;
        let u_centre = if known { self.gauge.u_centre_mm } else { 0.0 };
        let systematic = self.gauge.u_radius_mm.hypot(u_centre);
        TableRow {
            direction_rad: direction.y.atan2(direction.x),
            deviation_mm: self.fit.travel_mm(probe_direction)
                - self.fit.offset_mm.dot(&probe_direction),
            u_mm: self.fit.u_mm(&weights).hypot(systematic),
        }
    }

    /// The table of a control: so many directions from 0 on, in the plane of the ring.
    pub fn table(&self, steps: usize, orientation_rad: f64) -> Vec<TableRow> {
        let row = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / steps as f64;
            let direction = Vec3::new(angle.cos(), angle.sin(), 0.0);
            TableRow { direction_rad: angle, ..self.deviation(direction, orientation_rad) }
        };
        (0..steps).map(row).collect()
    }

    /// Where the ball touched: offset and pre-travel subtracted, ball radius added.
    ///
    /// ```text
    ///     x = p + R(φ)·o + (r − t)·u                                             docs/model.md eq. 141
    /// ```
    pub fn contact_point(&self, hit: &Hit) -> Vec3 {
        let travel_mm = self.fit.travel_mm(hit.probe_direction());
        hit.spindle_mm
            + turned(self.fit.offset_mm, hit.orientation_rad)
            + hit.direction * (self.ball_radius_mm - travel_mm)
    }

    /// Whether the calibration says anything of a direction.
    pub fn reaches(&self, direction: Vec3) -> bool {
        let latitude = direction.z.clamp(-1.0, 1.0).asin();
        let [low, high] = self.latitude.map(|s| s.clamp(-1.0, 1.0).asin());
        (low - BEYOND_RAD..=high + BEYOND_RAD).contains(&latitude)
    }

    /// Half of what the four hits X+, X−, Y+, Y− of a control take for offset though it is
    /// pre-travel: −(t(0°) − t(180°))/2 and the same of Y, mm.
    pub fn four_hit_bias_mm(&self) -> [f64; 2] {
        let half = |u: Vec3| -0.5 * (self.fit.travel_mm(u) - self.fit.travel_mm(-u));
        [half(Vec3::x()), half(Vec3::y())]
    }
}

/// Where the balls of other hits touched, or why that cannot be said.
pub fn correct(found: &Calibration, hits: &[Hit], problems: &mut Diagnostics) -> Option<Vec<Vec3>> {
    let beyond = || hits.iter().filter(|h| !found.reaches(h.direction));
    for hit in beyond() {
        let [low, high] = found.latitude.map(|s| s.clamp(-1.0, 1.0).asin().to_degrees());
        let message = format!(
            "the direction of motion rises by {:.1} deg; the calibration knows {low:.1} to {high:.1} deg",
            hit.direction.z.clamp(-1.0, 1.0).asin().to_degrees()
        );
        let hint = "calibrate on a sphere in such directions; nothing is extrapolated";
        problems.error("direction-beyond-calibration", hit.place.clone(), message, hint);
    }
    beyond().next().is_none().then(|| hits.iter().map(|h| found.contact_point(h)).collect())
}

fn fresh_check(found: &Calibration, hits: &[Hit]) -> Option<FreshCheck> {
    let rule = (found.gauge.side, found.gauge.contact_mm(found.ball_radius_mm));
    let (mut deviations_mm, mut within) = (Vec::new(), 0);
    for hit in hits {
        let of = |offset| travelled(hit, offset, found.fit.centre_mm, rule).map(|t| t.travel_mm);
        let (before, with) = (of(Vec3::zeros())?, of(found.fit.offset_mm)?);
        let after = with - found.fit.travel_mm(hit.probe_direction());
        let u = found.deviation(hit.direction, hit.orientation_rad).u_mm.hypot(found.fit.s_mm());
        within += usize::from(after.abs() <= found.coverage_factor * u);
        deviations_mm.push([before, after]);
    }
    let of = |k: usize| Spread::of(&deviations_mm.iter().map(|d| d[k]).collect::<Vec<_>>());
    let (before, after) = (of(0), of(1));
    let covered = within as f64 / hits.len().max(1) as f64;
    (!hits.is_empty()).then_some(FreshCheck { deviations_mm, before, after, covered })
}

/// No probe triggers before it touches: a mean pre-travel below 0 is a wrong size.
fn warn_of_sizes(found: &Calibration, place: &Place, problems: &mut Diagnostics) {
    let count = found.before_mm.len().max(1) as f64;
    let scatter = found.offset_only.rms_about_mean() / count.sqrt();
    let u_mm = scatter.hypot(found.gauge.u_radius_mm).max(LEAST_U_MM);
    let mean_mm = found.offset_only.mean_mm;
    if mean_mm < -SURE * u_mm {
        let message = format!(
            "stylus `{}`: the mean pre-travel is {:.2} µm, below 0 by more than {SURE} u ({:.2} µm): no probe \
             triggers before it touches",
            found.stylus,
            mean_mm * 1e3,
            u_mm * 1e3
        );
        let hint = "the diameter of gauge or ball is another one than stated: calibrated values, ball_diameter";
        problems.warn("wrong-size", place.clone(), message, hint);
    }
    let is_known = found.gauge.centre_mm.is_some() && found.fit.free.centre == 0;
    if is_known && found.gauge.u_centre_mm == 0.0 && found.offset.is_some() {
        let message = format!(
            "stylus `{}`: the stated centre counts as exact in U of the offset",
            found.stylus
        );
        let hint = "how well was it found? centre_u = \"1 um\"";
        problems.note("no-uncertainty", place.clone(), message, hint);
    }
}

fn warn(found: &Calibration, stylus: &Stylus, place: &Place, problems: &mut Diagnostics) {
    if found.offset.is_none() {
        let message = format!(
            "stylus `{}`: the offset cannot be separated from the centre of the gauge; the table has the \
             harmonics from the second on",
            stylus.name
        );
        let hint = "state the centre (found with a dial in the spindle), or probe with the spindle at 0 \
                    deg and again at 180 deg";
        problems.warn("offset-unknown", place.clone(), message, hint);
    }
    warn_of_sizes(found, place, problems);
    let fourier = |s: &&Score| s.model == LobingModel::Fourier;
    if found.scores.iter().filter(fourier).all(|s| s.size < 3) {
        let message = format!(
            "stylus `{}`: {} hits, up to {:.0} deg apart, do not show three lobes",
            stylus.name,
            stylus.hits.len(),
            found.gap_rad.to_degrees()
        );
        problems.warn("few-directions", place.clone(), message, "probe 12 directions or more");
    }
    // 5 % that any of all hits is beyond it, if they are normal (Bonferroni).
    let count = stylus.hits.len() as f64;
    let limit = student_above(TAIL / count, found.fit.freedom().max(3) as f64);
    let scale = trueaxis_geometry::statistics::robust_deviation(found.fit.left_mm.iter().copied());
    for (hit, error) in stylus.hits.iter().zip(&found.fit.held_out_mm) {
        if error.abs() > 1.5 * limit * scale.max(1e-6) {
            let message = format!(
                "this hit stands {:.2} µm off what its neighbours say; their scatter is {:.2} µm",
                error * 1e3,
                scale * 1e3
            );
            let hint = "dirt, a slipped trigger? repeat it; it still counts";
            problems.warn("outlier", hit.place.clone(), message, hint);
        }
    }
}
