//! Form from points (ISO 1101): an element through the points of a table, its form deviation with U, and the decision by
//! ISO 14253-1.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::form::{Element, FormRequest, evaluate_form};
//! // A straightedge: 3 µm too high in the middle.
//! let text = "x_mm,z_um\n0,0\n100,3\n200,0\n";
//! let request = FormRequest { u_mm: Some(0.0001), ..FormRequest::new(Element::Line, "edge.csv", text) };
//! let found = evaluate_form(&request, &mut Diagnostics::new()).unwrap();
//! assert!((found.form_mm() - 0.003).abs() < 1e-9);
//! ```

mod filtered;
mod points;
mod remarks;

pub use trueaxis_form::{Criterion, Element};

use points::Points;
use trueaxis_form::checks::Cover;
use trueaxis_form::{
    Fitted, FormNoise, Known, PointUncertainty, Reference, Source, Uncertainty, fit,
    noise_of_neighbours,
};
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// A Gaussian filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Filter {
    /// Of a round profile: half of the amplitude of so many undulations per revolution passes.
    Undulations(f64),
    /// Of an open profile: half of the amplitude of waves of this length passes, mm.
    CutOff(f64),
}

impl Filter {
    /// As a user writes it.
    pub fn text(self) -> String {
        match self {
            Self::Undulations(n) => format!("Gauss, {n} undulations per revolution"),
            Self::CutOff(mm) => format!("Gauss, cut-off {mm} mm"),
        }
    }
}

/// What to evaluate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormRequest<'a> {
    /// The element.
    pub element: Element,
    /// The file of the points, as the user named it.
    pub file: &'a str,
    /// Its text.
    pub text: &'a str,
    /// The reference element that decides.
    pub reference: Criterion,
    /// A filter for a profile.
    pub filter: Option<Filter>,
    /// The tolerance of the form deviation, mm.
    pub tolerance_mm: Option<f64>,
    /// The standard uncertainty of a point along the normal, mm.
    pub u_mm: Option<f64>,
}

impl<'a> FormRequest<'a> {
    /// By the minimum zone, without filter, tolerance and u.
    pub fn new(element: Element, file: &'a str, text: &'a str) -> Self {
        let reference = Criterion::MinimumZone;
        Self { element, file, text, reference, filter: None, tolerance_mm: None, u_mm: None }
    }
}

/// The decision about a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decision {
    /// Value + U is within it.
    Pass,
    /// Value − U is beyond it.
    Fail,
    /// Neither, or without U.
    Undecided,
}

/// The points, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct FormEvaluation {
    /// The element through the points, after the filter.
    pub fitted: Fitted,
    /// The reference element that decides.
    pub reference: Criterion,
    /// The points, after the filter, mm.
    pub points_mm: Vec<Vec3>,
    /// The line of each point in its file; none after a filter.
    pub lines: Option<Vec<usize>>,
    /// How many points the file has.
    pub points_read: usize,
    /// The plane of a profile or circle: known, not fitted.
    pub normal: Option<Vec3>,
    /// The filter.
    pub filter: Option<Filter>,
    /// Uncertainties of the least-squares element, if u of a point is known or the points scatter.
    pub uncertainty: Option<Uncertainty>,
    /// The standard uncertainty of a point for the form deviation, after the filter: the stated one, of a profile also
    /// that of neighbouring points.
    pub of_point: Option<PointUncertainty>,
    /// What noise of the points does to the form deviation of each reference.
    pub noise: Vec<(Criterion, FormNoise)>,
    /// How much of the element has points.
    pub cover: Cover,
    /// The tolerance, mm.
    pub tolerance_mm: Option<f64>,
}

impl FormEvaluation {
    /// The reference element that decides; least squares where the points do not have it.
    pub fn deciding(&self) -> &Reference {
        self.fitted.reference(self.reference).unwrap_or(&self.fitted.references[0])
    }

    /// The form deviation by that element, mm.
    pub fn form_mm(&self) -> f64 {
        self.deciding().form_mm()
    }

    /// U of the form deviation by a reference, mm; `None` if nothing is known of the points.
    pub fn expanded_mm(&self, criterion: Criterion) -> Option<f64> {
        let (_, noise) = self.noise.iter().find(|(c, _)| *c == criterion)?;
        Some(noise.expanded_mm(self.of_point?.coverage))
    }

    /// The decision, if there is a tolerance.
    ///
    /// # Source
    /// ISO 14253-1.
    pub fn decision(&self) -> Option<Decision> {
        let (limit, value) = (self.tolerance_mm?, self.form_mm());
        Some(match self.expanded_mm(self.deciding().criterion) {
            Some(u) if value + u <= limit => Decision::Pass,
            Some(u) if value - u > limit => Decision::Fail,
            _ => Decision::Undecided,
        })
    }

    /// Deviations of the points from the deciding element, mm; of a profile signed to its side.
    pub fn deviations_mm(&self) -> Vec<f64> {
        let shape = &self.deciding().shape;
        let side = self.normal.map(|n| n.cross(&shape.direction));
        let of = |p: &Vec3| match (shape.element, side) {
            (Element::Line, Some(side)) => (p - shape.point_mm).dot(&side),
            _ => shape.deviation_mm(p),
        };
        self.points_mm.iter().map(of).collect()
    }

    /// Angle between the direction of the element and the axis of the frame that is nearest to it, rad, with the
    /// letter of that axis; none for a sphere.
    pub fn tilt(&self) -> Option<(f64, char)> {
        let d = self.fitted.shape().direction;
        let nearest = d.iamax();
        let mut axis = Vec3::zeros();
        axis[nearest] = d[nearest].signum();
        let letter = ['X', 'Y', 'Z'][nearest];
        (d.norm() > 0.5).then(|| (trueaxis_geometry::angle(&d, &axis), letter))
    }

    /// Standard uncertainty of the tilt, rad.
    pub fn tilt_u_rad(&self) -> Option<f64> {
        let u = self.uncertainty?.direction;
        let nearest = self.fitted.shape().direction.iamax();
        let across = u.iter().enumerate().filter(|(k, _)| *k != nearest);
        Some(across.map(|(_, u)| u * u).sum::<f64>().sqrt())
    }
}

/// Reads points and evaluates their form; `None` with errors in `problems`.
pub fn evaluate_form(
    request: &FormRequest<'_>,
    problems: &mut Diagnostics,
) -> Option<FormEvaluation> {
    let Points { points_mm, lines, normal } = points::read(request, problems)?;
    evaluate_points(request, points_mm, lines, normal, problems)
}

fn evaluate_points(
    request: &FormRequest<'_>,
    points_mm: Vec<Vec3>,
    lines: Vec<usize>,
    normal: Option<Vec3>,
    problems: &mut Diagnostics,
) -> Option<FormEvaluation> {
    let known = Known { normal, ..Known::default() };
    let read = match fit(request.element, &points_mm, &known) {
        Ok(fitted) => fitted,
        Err(error) => {
            remarks::no_element(request, &error, &lines, problems);
            return None;
        }
    };
    let cover = trueaxis_form::checks::cover(&read, &points_mm);
    remarks::of_points(request, &read, &points_mm, &lines, cover, problems);
    let uncertainty = read.uncertainty(request.u_mm);
    let points_read = points_mm.len();
    // Form deviations are in the scatter, but they are no noise of the form deviation: a stated u counts there.
    let stated = |u_mm| PointUncertainty { u_mm, source: Source::Stated, coverage: 2.0 };
    let mut of_point = request.u_mm.map(stated).or_else(|| neighbours(&read, &points_mm, normal));
    let mut evaluation = FormEvaluation {
        fitted: read,
        reference: request.reference,
        points_mm,
        lines: Some(lines),
        points_read,
        normal,
        filter: request.filter,
        uncertainty,
        of_point,
        noise: Vec::new(),
        cover,
        tolerance_mm: request.tolerance_mm,
    };
    if let Some(filter) = request.filter {
        let filtered = filtered::apply(request, filter, &evaluation, problems)?;
        of_point = of_point.map(|u| PointUncertainty { u_mm: u.u_mm * filtered.gain, ..u });
        evaluation.fitted = filtered.fitted;
        evaluation.points_mm = filtered.points_mm;
        evaluation.normal = Some(filtered.normal);
        (evaluation.lines, evaluation.of_point) = (None, of_point);
    }
    if let Some(of_point) = of_point {
        evaluation.noise = evaluation.fitted.form_noise(&evaluation.points_mm, of_point.u_mm);
    }
    remarks::of_result(request, &evaluation, problems);
    Some(evaluation)
}

/// The noise of a profile that nothing is stated of.
fn neighbours(read: &Fitted, points_mm: &[Vec3], normal: Option<Vec3>) -> Option<PointUncertainty> {
    let shape = read.shape();
    let mut profile: Vec<(f64, f64)> = match (shape.element, normal) {
        (Element::Line, Some(normal)) => {
            let side = normal.cross(&shape.direction);
            let v = points_mm.iter().map(|p| p - shape.point_mm);
            v.map(|v| (v.dot(&shape.direction), v.dot(&side))).collect()
        }
        (Element::Circle, _) => {
            let (x, y) = across(&shape.direction);
            let angle = |p: &Vec3| (p - shape.point_mm).dot(&y).atan2((p - shape.point_mm).dot(&x));
            points_mm.iter().map(|p| (angle(p), shape.deviation_mm(p))).collect()
        }
        _ => return None,
    };
    profile.sort_by(|a, b| a.0.total_cmp(&b.0));
    let values: Vec<f64> = profile.into_iter().map(|(_, d)| d).collect();
    noise_of_neighbours(&values)
}

/// Two directions across one, the first as near as possible to an axis of the frame.
pub(crate) fn across(direction: &Vec3) -> (Vec3, Vec3) {
    let mut x = Vec3::zeros();
    x[direction.iamin()] = 1.0;
    let x = (x - direction * direction.dot(&x)).normalize();
    (x, direction.cross(&x))
}

/// The criterion of a name such as `MZC`, `MZCI`, `LSLI`, `MICY`.
///
/// ```
/// use trueaxis_standards::form::{Criterion, reference_named};
/// assert_eq!(reference_named("mzci"), Some(Criterion::MinimumZone));
/// assert_eq!(reference_named("MXCI"), None);
/// ```
/// # Source
/// ISO 12181-1, 12780-1, 12781-1, 12180-1 (names of reference elements).
pub fn reference_named(text: &str) -> Option<Criterion> {
    let name = text.trim().to_ascii_uppercase();
    let all = [
        ("LS", Criterion::LeastSquares),
        ("MZ", Criterion::MinimumZone),
        ("MC", Criterion::MinimumCircumscribed),
        ("MI", Criterion::MaximumInscribed),
    ];
    let (rest, criterion) =
        all.iter().find_map(|(start, c)| Some((name.strip_prefix(start)?, *c)))?;
    ["", "C", "CI", "LI", "L", "PL", "P", "CY", "SP", "S", "CO"]
        .contains(&rest)
        .then_some(criterion)
}

/// The filter of a text such as `gauss 50 upr` or `gauss 0.8 mm`.
///
/// # Errors
/// What was expected instead.
pub fn filter_named(text: &str) -> Result<Filter, String> {
    const FORM: &str = "\"gauss 50 upr\" for a circle, \"gauss 0.8 mm\" for a line";
    let words: Vec<&str> = text.split_whitespace().collect();
    let Some((&kind, rest)) = words.split_first() else { return Err(format!("expected {FORM}")) };
    if !["gauss", "gaussian"].contains(&kind.to_ascii_lowercase().as_str()) {
        return Err(format!("`{kind}` is no filter: expected {FORM}"));
    }
    let positive = |v: f64| v.is_finite() && v > 0.0;
    match rest {
        [number, unit] if unit.eq_ignore_ascii_case("upr") => {
            let value = number.parse::<f64>().ok().filter(|v| positive(*v));
            value.map(Filter::Undulations).ok_or(format!("`{number}` is no positive number"))
        }
        _ => {
            let length = rest.join(" ");
            let found = trueaxis_input::parse_quantity(&length, trueaxis_input::Dimension::Length);
            match found {
                Ok(mm) if positive(mm) => Ok(Filter::CutOff(mm)),
                Ok(_) => Err("the cut-off is not positive".to_owned()),
                Err(e) => Err(format!("{e}: expected {FORM}")),
            }
        }
    }
}

/// The place of a row.
fn place(file: &str, line: usize) -> Place {
    Place { file: file.to_owned(), line, column: 1 }
}
