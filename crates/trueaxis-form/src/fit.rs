//! Elements through points: least squares, and the elements of contact points.

mod curved;
mod lines;
mod proof;

use crate::chebyshev::{self, Contact, Distances, Minimax, Start};
use crate::surface::{Family, Frame, MOST, Place, upright};
use crate::{Criterion, Element, Error, Shape, circle, start};
use nalgebra::DMatrix;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_geometry::{Mat3, Vec3};

/// Limit of the coordinates.
const LARGEST_MM: f64 = 1e100;

/// What is known of an element before.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Known {
    /// The normal of the plane that a circle or the profile of a line lies in; a line without one is a line in space,
    /// and the plane of a circle goes through the points.
    pub normal: Option<Vec3>,
    /// A sphere, cylinder or cone that the points are very near to, such as the nominal one of a part within some hundredths of a millimetre:
    /// the search begins there and nowhere else.
    pub near: Option<Shape>,
}

/// How a result is proved to be the best.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Proof {
    /// No other element is better: an exact method.
    Global,
    /// No other element has a smaller form deviation (of an inscribed one: no larger radius) than this, mm.
    Bound(f64),
    /// None nearby is better, by contact points and multipliers; so many starts were tried, and so many of them led
    /// here.
    Local {
        /// Starts.
        starts: usize,
        /// Of them, how many came to this result.
        agreed: usize,
    },
    /// Not proved: the slope at the result is not zero.
    None,
}

/// One element through the points.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// What was made small.
    pub criterion: Criterion,
    /// The element.
    pub shape: Shape,
    /// The smallest deviation from it; of a line in space 0, mm.
    pub low_mm: f64,
    /// The largest deviation from it, mm.
    pub high_mm: f64,
    /// The points that hold it; none for least squares.
    pub contacts: Vec<Contact>,
    /// How it is proved; `None` for least squares.
    pub proof: Option<Proof>,
    is_space_line: bool,
}

impl Reference {
    /// The form deviation: the range of the deviations; of a line in space the diameter of the cylinder around it.
    pub fn form_mm(&self) -> f64 {
        if self.is_space_line { 2.0 * self.high_mm } else { self.high_mm - self.low_mm }
    }
}

/// What a standard deviation of 1 mm of every point makes of the values of the least-squares element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Covariance of the point. Unit: mm²/mm².
    pub point: Mat3,
    /// The same from deviations along the normal of a circle. Unit: mm²/mm².
    pub axial_point: Mat3,
    /// Covariance of the direction, of a circle from deviations along its normal. Unit: rad²/mm².
    pub direction: Mat3,
    /// Of the radius. Unit: mm/mm.
    pub radius: f64,
    /// Of the half angle. Unit: rad/mm.
    pub half_angle_rad_per_mm: f64,
}

/// An element through points.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Which kind.
    pub element: Element,
    /// Each criterion of the element, least squares first; one that the points do not have is left out.
    pub references: Vec<Reference>,
    /// Standard deviation of the residuals of least squares, mm.
    pub residual_deviation_mm: f64,
    /// Their degrees of freedom.
    pub degrees_of_freedom: usize,
    /// The same along the normal of a circle whose plane was fitted, with its degrees of freedom, mm.
    pub axial_deviation_mm: Option<(f64, usize)>,
    /// From the points to the values of the least-squares element.
    pub sensitivity: Sensitivity,
    /// Whether the least-squares search converged, and the points determine all values.
    pub is_determined: bool,
    pub(crate) size_mm: f64,
    pub(crate) middle_mm: Vec3,
    /// Of the plane of a profile.
    pub(crate) normal: Option<Vec3>,
}

impl Fitted {
    /// The element of one criterion.
    pub fn reference(&self, criterion: Criterion) -> Option<&Reference> {
        self.references.iter().find(|r| r.criterion == criterion)
    }

    /// The least-squares element.
    pub fn shape(&self) -> &Shape {
        &self.references[0].shape
    }
}

/// Lays an element through points by every criterion that it has.
///
/// ```
/// use trueaxis_form::{Criterion, Element, Known, fit};
/// use trueaxis_geometry::Vec3;
/// // A plane with one corner that is 4 µm higher: the minimum zone halves twice that.
/// let corners = [(0.0, 0.0, 0.0), (100.0, 0.0, 0.0), (0.0, 100.0, 0.0), (100.0, 100.0, 0.004)];
/// let points = corners.map(|(x, y, z)| Vec3::new(x, y, z));
/// let plane = fit(Element::Plane, &points, &Known::default())?;
/// let zone = plane.reference(Criterion::MinimumZone).unwrap();
/// assert!((zone.form_mm() - 0.002).abs() < 1e-9);
/// # Ok::<(), trueaxis_form::Error>(())
/// ```
///
/// # Errors
/// Fewer points than unknowns, one that is not finite, points that do not determine the element.
///
/// # Source
/// ISO 1101, ISO 12780-1, ISO 12781-1, ISO 12181-1, ISO 12180-1 (reference elements).
pub fn fit(element: Element, points_mm: &[Vec3], known: &Known) -> Result<Fitted, Error> {
    fit_by(element, points_mm, known, element.criteria())
}

/// As [`fit`], by least squares and those criteria that are named.
///
/// # Errors
/// As [`fit`].
pub fn fit_by(
    element: Element,
    points_mm: &[Vec3],
    known: &Known,
    criteria: &[Criterion],
) -> Result<Fitted, Error> {
    let mut cloud = Cloud::new(element, points_mm, known)?;
    cloud.criteria = criteria.to_vec();
    match (element, known.normal) {
        (Element::Line, Some(normal)) => lines::profile_line(&cloud, &normal),
        (Element::Line, None) => lines::space_line(&cloud),
        (Element::Plane, _) => plane(&cloud),
        (Element::Circle, normal) => flat_circle(&cloud, normal),
        (Element::Sphere | Element::Cylinder | Element::Cone, _) => curved::curved(element, &cloud),
    }
}

/// The points about their mean, in units of their size.
struct Cloud {
    /// What is wanted in addition to least squares.
    criteria: Vec<Criterion>,
    points: Vec<Vec3>,
    middle: Vec3,
    size: f64,
    near: Option<Shape>,
}

impl Cloud {
    fn new(element: Element, points_mm: &[Vec3], known: &Known) -> Result<Self, Error> {
        let plain = element == Element::Line && known.normal.is_some();
        let needed = if plain || element == Element::Line { 2 } else { element.unknowns() };
        if points_mm.len() < needed {
            return Err(Error::TooFewPoints { found: points_mm.len(), needed });
        }
        let usable = |p: &Vec3| p.iter().all(|v| v.abs() <= LARGEST_MM);
        if let Some(index) = points_mm.iter().position(|p| !usable(p)) {
            return Err(Error::NotFinite { index });
        }
        let count = points_mm.len() as f64;
        let rough = points_mm.iter().fold(Vec3::zeros(), |s, p| s + p / count);
        let middle = rough + points_mm.iter().fold(Vec3::zeros(), |s, p| s + (p - rough) / count);
        let size = points_mm.iter().map(|p| (p - middle).amax()).fold(0.0, f64::max);
        let noise = 8.0 * f64::EPSILON * middle.amax();
        if size <= noise.max(1.0 / LARGEST_MM) {
            return Err(Error::Coincident);
        }
        let points: Vec<Vec3> = points_mm.iter().map(|p| (p - middle) / size).collect();
        let near = known.near.filter(|shape| shape.element == element).map(|shape| Shape {
            point_mm: (shape.point_mm - middle) / size,
            radius_mm: shape.radius_mm / size,
            ..shape
        });
        let cloud = Self { criteria: Vec::new(), points, middle, size, near };
        if element != Element::Line {
            let spread = start::principal(&cloud.points);
            if spread[1].0.sqrt() <= (noise / size).max(1e-12) * count.sqrt() {
                return Err(Error::Collinear);
            }
        }
        Ok(cloud)
    }

    /// A shape in the frame of the points.
    fn outside(&self, shape: Shape) -> Shape {
        Shape {
            point_mm: self.middle + shape.point_mm * self.size,
            radius_mm: shape.radius_mm * self.size,
            ..shape
        }
    }

    fn reference(&self, criterion: Criterion, shape: Shape, ends: [f64; 2]) -> Reference {
        Reference {
            criterion,
            shape: self.outside(shape),
            low_mm: ends[0] * self.size,
            high_mm: ends[1] * self.size,
            contacts: Vec::new(),
            proof: None,
            is_space_line: false,
        }
    }

    /// A minimum as a reference.
    fn of_minimax(&self, element: Element, criterion: Criterion, found: Minimax) -> Reference {
        let offset = match criterion {
            Criterion::MinimumCircumscribed => found.high,
            Criterion::MaximumInscribed => found.low,
            _ => 0.5 * (found.low + found.high),
        };
        let is_line = element == Element::Line;
        let offset = if is_line { 0.0 } else { offset };
        let place = Place { frame: found.frame, offset, half_angle: found.half_angle };
        let shape = place.shape(element, &Vec3::zeros());
        let low = if is_line { 0.0 } else { found.low - offset };
        let mut reference = self.reference(criterion, shape, [low, found.high - offset]);
        reference.contacts = found.contacts;
        reference.is_space_line = is_line;
        reference
    }

    fn fitted(&self, element: Element, references: Vec<Reference>, spread: &Spread) -> Fitted {
        Fitted {
            element,
            references,
            residual_deviation_mm: spread.deviation() * self.size,
            degrees_of_freedom: spread.degrees,
            axial_deviation_mm: spread.axial.map(|(s, n)| (s * self.size, n)),
            sensitivity: Sensitivity {
                point: spread.point,
                axial_point: spread.axial_point,
                direction: spread.direction / (self.size * self.size),
                radius: spread.radius,
                half_angle_rad_per_mm: spread.half_angle / self.size,
            },
            is_determined: spread.is_determined,
            size_mm: self.size,
            middle_mm: self.middle,
            normal: None,
        }
    }
}

/// The statistics of least squares, in units of the size.
#[derive(Default)]
struct Spread {
    squares: f64,
    degrees: usize,
    axial: Option<(f64, usize)>,
    point: Mat3,
    axial_point: Mat3,
    direction: Mat3,
    radius: f64,
    half_angle: f64,
    is_determined: bool,
}

impl Spread {
    fn deviation(&self) -> f64 {
        match self.degrees {
            0 => 0.0,
            n => (self.squares / n as f64).sqrt(),
        }
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    values.fold(start, |[low, high], v| [low.min(v), high.max(v)])
}

/// A square of a direction.
fn outer(v: &Vec3) -> Mat3 {
    v * v.transpose()
}

fn plane(cloud: &Cloud) -> Result<Fitted, Error> {
    let [(_, x), (_, y), (_, z)] = start::principal(&cloud.points);
    // The normal points to the side where its largest part is positive.
    let z = upright(z);
    let frame = Frame::new(Vec3::zeros(), &z);
    let n = cloud.points.len();
    let [low, high] = range(cloud.points.iter().map(|p| p.dot(&z)));
    let squares = cloud.points.iter().map(|p| p.dot(&z).powi(2)).sum();
    let place = Place { frame, offset: 0.0, half_angle: 0.0 };
    let shape = place.shape(Element::Plane, &Vec3::zeros());
    let mut references = vec![cloud.reference(Criterion::LeastSquares, shape, [low, high])];
    let start = Start { frame, half_angle: 0.0 };
    references.extend(contact_reference(cloud, Element::Plane, Criterion::MinimumZone, &[start]));
    let along = |v: &Vec3| cloud.points.iter().map(|p| p.dot(v).powi(2)).sum::<f64>();
    let spread = Spread {
        squares,
        degrees: n.saturating_sub(3),
        point: outer(&z) / n as f64,
        direction: outer(&x) / along(&x) + outer(&y) / along(&y),
        is_determined: true,
        ..Spread::default()
    };
    Ok(cloud.fitted(Element::Plane, references, &spread))
}

fn flat_circle(cloud: &Cloud, normal: Option<Vec3>) -> Result<Fitted, Error> {
    let [(_, x), (_, y), (_, z)] = start::principal(&cloud.points);
    let z = normal.unwrap_or(upright(z));
    let frame = Frame::new(Vec3::zeros(), &z);
    let z = frame.direction();
    let n = cloud.points.len();
    let flat: Vec<[f64; 2]> = cloud.points.iter().map(|p| frame.local(p).xy().into()).collect();
    let mut fitter = circle::Fitter::default();
    let least = fitter.least_squares(&flat)?;
    let mut references = Vec::new();
    for criterion in Element::Circle.criteria() {
        if *criterion != Criterion::LeastSquares && !cloud.criteria.contains(criterion) {
            continue;
        }
        let zone = match criterion {
            Criterion::LeastSquares => Ok(least),
            Criterion::MinimumZone => fitter.minimum_zone(&flat),
            Criterion::MinimumCircumscribed => fitter.minimum_circumscribed(&flat),
            Criterion::MaximumInscribed => fitter.maximum_inscribed(&flat),
        };
        let Ok(zone) = zone else { continue };
        let centre = Vec3::new(zone.center_mm[0], zone.center_mm[1], 0.0);
        let frame = Frame { origin: frame.out_of(&centre), ..frame };
        let place = Place { frame, offset: zone.radius_mm, half_angle: 0.0 };
        let shape = place.shape(Element::Circle, &Vec3::zeros());
        let ends = [zone.inner_mm - zone.radius_mm, zone.outer_mm - zone.radius_mm];
        let mut reference = cloud.reference(*criterion, shape, ends);
        if *criterion != Criterion::LeastSquares {
            let at = Distances::about(Family::Disc, &frame, 0.0, &cloud.points);
            reference.contacts = chebyshev::contacts_of(&at, Family::Disc, *criterion);
            reference.proof = Some(Proof::Global);
        }
        references.push(reference);
    }
    let axial: f64 = cloud.points.iter().map(|p| p.dot(&z).powi(2)).sum();
    let fitted_plane = normal.is_none();
    let along = |v: &Vec3| cloud.points.iter().map(|p| p.dot(v).powi(2)).sum::<f64>();
    let tilts = match fitted_plane {
        true => outer(&x) / along(&x) + outer(&y) / along(&y),
        false => Mat3::zeros(),
    };
    let place = Place { frame, offset: least.radius_mm, half_angle: 0.0 };
    let centre = [least.center_mm[0], least.center_mm[1]];
    let mut spread = disc_spread(&flat, centre, &place);
    spread.axial_point = outer(&z) / n as f64;
    spread.direction = tilts;
    let degrees = n.saturating_sub(3);
    let deviation = if degrees > 0 { (axial / degrees as f64).sqrt() } else { 0.0 };
    spread.axial = fitted_plane.then_some((deviation, degrees));
    Ok(cloud.fitted(Element::Circle, references, &spread))
}

/// Of the circle in its plane.
fn disc_spread(flat: &[[f64; 2]], centre: [f64; 2], place: &Place) -> Spread {
    let jacobian = DMatrix::from_fn(flat.len(), 3, |i, k| {
        let v = [flat[i][0] - centre[0], flat[i][1] - centre[1]];
        if k < 2 { v[k] / v[0].hypot(v[1]).max(f64::MIN_POSITIVE) } else { 1.0 }
    });
    let residual = |p: &[f64; 2]| (p[0] - centre[0]).hypot(p[1] - centre[1]) - place.offset;
    let squares = flat.iter().map(|p| residual(p).powi(2)).sum();
    let r = jacobian.qr().r();
    let inverse = r.clone().pseudo_inverse(1e-13).unwrap_or(DMatrix::zeros(3, 3));
    let covariance = &inverse * inverse.transpose();
    let axes = place.frame.axes;
    let (x, y) = (axes.column(0), axes.column(1));
    let mut point = Mat3::zeros();
    for (i, a) in [x, y].into_iter().enumerate() {
        for (j, b) in [x, y].into_iter().enumerate() {
            point += covariance[(i, j)] * a * b.transpose();
        }
    }
    Spread {
        squares,
        degrees: flat.len().saturating_sub(3),
        point,
        radius: covariance[(2, 2)].sqrt(),
        is_determined: true,
        ..Spread::default()
    }
}

/// The best element of contact points from several starts; `None` where there is none near the points.
fn contact_reference(
    cloud: &Cloud,
    element: Element,
    criterion: Criterion,
    starts: &[Start],
) -> Option<Reference> {
    if !cloud.criteria.contains(&criterion) {
        return None;
    }
    // The zone of a line in space is the smallest cylinder around the points.
    let wanted = if element == Element::Line { Criterion::MinimumCircumscribed } else { criterion };
    let more = match element {
        _ if cloud.near.is_some() => Vec::new(),
        Element::Plane => Vec::new(),
        _ => disturbed(element, wanted, cloud, &starts[0]),
    };
    let starts: Vec<Start> = starts.iter().copied().chain(more).collect();
    let found = starts.iter();
    let found = found.filter_map(|s| chebyshev::minimise(element, wanted, &cloud.points, *s));
    let found: Vec<Minimax> = found.filter(|m| m.slope.is_finite()).collect();
    let size = |m: &Minimax| m.objective(wanted);
    let best = found.iter().min_by(|a, b| size(a).total_cmp(&size(b)))?.clone();
    let near = |m: &&Minimax| size(m) - size(&best) <= 1e-9 * (best.high - best.low) + 1e-14;
    let agreed = found.iter().filter(near).count();
    if criterion == Criterion::MaximumInscribed && best.slope > 1e-3 {
        return None;
    }
    let proof = proof::of(element, wanted, cloud, &best, [starts.len(), agreed]);
    let mut reference = cloud.of_minimax(element, wanted, best);
    reference.criterion = criterion;
    reference.proof = Some(proof);
    Some(reference)
}

/// Starts around one: by a few times the form deviation.
fn disturbed(element: Element, criterion: Criterion, cloud: &Cloud, start: &Start) -> Vec<Start> {
    let family = Family::of(element);
    let Start { frame, half_angle } = *start;
    let points = start::thinned(&cloud.points);
    let (low, high) = Distances::about(family, &frame, half_angle, &points).range();
    let by = 3.0 * (high - low).clamp(1e-9, 0.1);
    let seed = 220 + u64::from(criterion == Criterion::MaximumInscribed);
    let mut random = SplitMix64::new(seed);
    (0..3)
        .map(|_| {
            let mut x: [f64; MOST] = std::array::from_fn(|_| by * (2.0 * random.unit() - 1.0));
            if family != Family::Cone {
                x[4] = 0.0;
            }
            Start { frame: family.moved(&frame, &x), half_angle: half_angle + x[4] }
        })
        .collect()
}
