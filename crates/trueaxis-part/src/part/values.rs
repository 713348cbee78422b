//! From the cut surface to the values of the characteristics.

use super::feature::across;
use super::{Characteristic, Feature, Geometry, Kind, Part};
use crate::Error;
use std::ops::Range;
use trueaxis_form::circle::Fitter;
use trueaxis_form::{Criterion, Element, Known, Reference, Shape, fit_by};
use trueaxis_geometry::Vec3;

/// Places of a feature.
struct Surface<'a> {
    feature: &'a Feature,
    deviation_mm: &'a [f64],
    places_mm: Vec<Vec3>,
}

/// Sections across an axis, in coordinates of their planes.
struct Sections {
    axis: Vec3,
    across: [Vec3; 2],
    flat_mm: Vec<Vec<[f64; 2]>>,
}

impl Part {
    /// The value of each characteristic, mm, by the deviation of each point along its normal, feature after feature; positive where
    /// material is left.
    ///
    /// # Errors
    /// A list of another length, a deviation that is not finite, points through which no element goes.
    pub fn evaluate(&self, deviation_mm: &[f64]) -> Result<Vec<f64>, Error> {
        let (found, expected) = (deviation_mm.len(), self.points());
        if found != expected {
            return Err(Error::WrongLength { what: "deviations", found, expected });
        }
        if let Some(index) = deviation_mm.iter().position(|d| !d.is_finite()) {
            return Err(Error::NotFinite { index });
        }
        let mut rest = deviation_mm;
        let surfaces: Vec<Surface<'_>> = self
            .features
            .iter()
            .map(|feature| {
                let (deviation_mm, others) = rest.split_at(feature.points.len());
                rest = others;
                let places = feature.points.iter().zip(deviation_mm);
                let places_mm = places.map(|(p, d)| p.point_mm + p.normal * *d).collect();
                Surface { feature, deviation_mm, places_mm }
            })
            .collect();
        self.characteristics.iter().map(|asked| value(asked, &surfaces)).collect()
    }
}

fn value(asked: &Characteristic, surfaces: &[Surface<'_>]) -> Result<f64, Error> {
    let surface = &surfaces[asked.feature];
    let datum = || {
        let datum =
            asked.datum.ok_or_else(|| unfit("a characteristic without the datum that it needs"))?;
        surfaces[datum].datum()
    };
    match asked.kind {
        Kind::Flatness => surface.form(Element::Plane),
        Kind::Cylindricity => surface.form(Element::Cylinder),
        Kind::Roundness => surface.roundness(),
        Kind::Diameter => surface.diameter(),
        Kind::Profile => Ok(2.0 * surface.farthest_mm()),
        Kind::Position => match surface.feature.geometry.axis() {
            Some((at, axis)) => surface.about_axis(&at, &axis),
            None => Ok(2.0 * surface.farthest_mm()),
        },
        Kind::Parallelism => surface.oriented(&datum()?, true),
        Kind::Perpendicularity => surface.oriented(&datum()?, false),
        Kind::Coaxiality => {
            let datum = datum()?;
            surface.about_axis(&datum.point_mm, &datum.direction)
        }
        Kind::CircularRunOut => Ok(surface.run_out(&datum()?, &surface.feature.sections)),
        Kind::TotalRunOut => {
            let whole = 0..surface.places_mm.len();
            Ok(surface.run_out(&datum()?, std::slice::from_ref(&whole)))
        }
    }
}

/// What the reader of the part file refuses.
fn unfit(what: &str) -> Error {
    Error::Shape { what: what.to_owned() }
}

/// One element through places.
fn element(
    element: Element,
    criterion: Criterion,
    places_mm: &[Vec3],
    known: &Known,
) -> Result<Reference, Error> {
    let fitted = fit_by(element, places_mm, known, &[criterion])?;
    let found = fitted.references.into_iter().find(|r| r.criterion == criterion);
    found.ok_or_else(|| unfit(&format!("the points have no element of {}", criterion.name())))
}

impl Surface<'_> {
    fn element(&self, kind: Element, criterion: Criterion) -> Result<Reference, Error> {
        element(kind, criterion, &self.places_mm, &Known::default())
    }

    fn form(&self, kind: Element) -> Result<f64, Error> {
        Ok(self.element(kind, Criterion::MinimumZone)?.form_mm())
    }

    fn diameter(&self) -> Result<f64, Error> {
        let Geometry::Cylinder { radius_mm, .. } = self.feature.geometry else {
            return Err(unfit("the diameter of what is no cylinder"));
        };
        let found = self.element(Element::Cylinder, Criterion::LeastSquares)?;
        Ok(2.0 * (found.shape.radius_mm - radius_mm))
    }

    /// The associated element, ISO 5459: the plane of the minimum zone, the axis of the largest inscribed cylinder of a hole,
    /// of the smallest circumscribed one of a shaft.
    fn datum(&self) -> Result<Shape, Error> {
        let (kind, criterion) = match self.feature.geometry {
            Geometry::Plane { .. } => (Element::Plane, Criterion::MinimumZone),
            Geometry::Cylinder { is_hole: true, .. } => {
                (Element::Cylinder, Criterion::MaximumInscribed)
            }
            Geometry::Cylinder { .. } => (Element::Cylinder, Criterion::MinimumCircumscribed),
            _ => return Err(unfit("a datum that is neither a plane nor a cylinder")),
        };
        Ok(self.element(kind, criterion)?.shape)
    }

    fn farthest_mm(&self) -> f64 {
        self.deviation_mm.iter().fold(0.0, |most: f64, d| most.max(d.abs()))
    }

    /// The axis, and each section across it in coordinates of its plane.
    ///
    /// Material along the normal is more in the plane of the section of a cone: δ / cos α, as in docs/model.md eq. 21.
    fn sections(&self) -> Result<Sections, Error> {
        let Some((_, axis)) = self.feature.geometry.axis() else {
            return Err(unfit("a section of what has no axis"));
        };
        let [x, y] = across(&axis);
        let flat = |i: usize| {
            let point = &self.feature.points[i];
            let out = point.normal - axis * point.normal.dot(&axis);
            let place = point.point_mm + out * (self.deviation_mm[i] / out.norm_squared());
            [place.dot(&x), place.dot(&y)]
        };
        let sections = self.feature.sections.iter().map(|s| s.clone().map(flat).collect());
        Ok(Sections { axis, across: [x, y], flat_mm: sections.collect() })
    }

    fn roundness(&self) -> Result<f64, Error> {
        let mut fitter = Fitter::default();
        let sections = self.sections()?;
        sections.flat_mm.iter().try_fold(0.0, |most: f64, section| {
            Ok(most.max(fitter.minimum_zone(section)?.width_mm()))
        })
    }

    /// The centres of the sections by least squares: the extracted median line.
    fn median_line(&self) -> Result<Vec<Vec3>, Error> {
        let Sections { axis, across: [x, y], flat_mm } = self.sections()?;
        let mut fitter = Fitter::default();
        let centre = |(flat, section): (&Vec<[f64; 2]>, &Range<usize>)| {
            let [u, v] = fitter.least_squares(flat)?.center_mm;
            let height = self.feature.points[section.start].point_mm.dot(&axis);
            Ok(x * u + y * v + axis * height)
        };
        flat_mm.iter().zip(&self.feature.sections).map(centre).collect()
    }

    /// Twice the largest distance of the median line from an axis.
    fn about_axis(&self, at: &Vec3, axis: &Vec3) -> Result<f64, Error> {
        let centres = self.median_line()?;
        let off = |centre: &Vec3| {
            let arm = centre - at;
            (arm - axis * arm.dot(axis)).norm()
        };
        Ok(2.0 * centres.iter().map(off).fold(0.0, f64::max))
    }

    /// Parallel or perpendicular to a plane or an axis: of a plane the width between two planes, of an axis the diameter of a
    /// cylinder or, where only one direction is fixed, the width between two planes.
    fn oriented(&self, datum: &Shape, is_parallel: bool) -> Result<f64, Error> {
        let is_axis = datum.element != Element::Plane;
        let direction = datum.direction;
        let along = |places: &[Vec3]| places.iter().map(|p| p.dot(&direction)).collect::<Vec<_>>();
        match self.feature.geometry.axis() {
            // The planes of the zone have this normal, or one across it.
            None if is_axis != is_parallel => Ok(range(along(&self.places_mm))),
            None => least_range(&self.places_mm, &direction),
            // The axis of the zone is the direction of the datum.
            Some(_) if is_axis == is_parallel => {
                let [x, y] = across(&direction);
                let centres = self.median_line()?;
                let flat: Vec<[f64; 2]> = centres.iter().map(|p| [p.dot(&x), p.dot(&y)]).collect();
                Ok(2.0 * Fitter::default().enclosing_radius_mm(&flat)?)
            }
            Some(_) => Ok(range(along(&self.median_line()?))),
        }
    }

    /// The largest range of the distances from an axis among some stretches of the points.
    fn run_out(&self, datum: &Shape, stretches: &[Range<usize>]) -> f64 {
        let off = |p: &Vec3| {
            let arm = p - datum.point_mm;
            (arm - datum.direction * arm.dot(&datum.direction)).norm()
        };
        let ranges = stretches.iter().map(|s| range(self.places_mm[s.clone()].iter().map(off)));
        ranges.fold(0.0, f64::max)
    }
}

/// The largest value less the smallest.
fn range(values: impl IntoIterator<Item = f64>) -> f64 {
    let ends = (f64::MAX, f64::MIN);
    let (low, high) = values.into_iter().fold(ends, |(low, high), v| (low.min(v), high.max(v)));
    high - low
}

/// The least distance of two parallel planes around points, both along a direction.
fn least_range(places_mm: &[Vec3], along: &Vec3) -> Result<f64, Error> {
    let flat: Vec<Vec3> = places_mm.iter().map(|p| p - along * p.dot(along)).collect();
    let known = Known { normal: Some(*along) };
    Ok(element(Element::Line, Criterion::MinimumZone, &flat, &known)?.form_mm())
}
