//! From the cut surface to the values of the characteristics.

use super::feature::across;
use super::{Characteristic, Feature, Kind, Part};
use crate::Error;
use trueaxis_form::circle::Fitter;
use trueaxis_form::{Criterion, Element, Known, Shape, fit_by};
use trueaxis_geometry::Vec3;

/// The surface as it was cut: the deviation of each point along its normal, feature after feature.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// Positive where material is left, mm.
    pub deviation_mm: &'a [f64],
}

/// Places of a feature.
struct Surface<'a> {
    feature: &'a Feature,
    deviation_mm: &'a [f64],
    places_mm: Vec<Vec3>,
}

impl Part {
    /// The value of each characteristic, mm.
    ///
    /// # Errors
    /// A list of another length, a deviation that is not finite, points through which no element goes.
    pub fn evaluate(&self, cut: &Cut<'_>) -> Result<Vec<f64>, Error> {
        let (found, expected) = (cut.deviation_mm.len(), self.points());
        if found != expected {
            return Err(Error::WrongLength { what: "deviations", found, expected });
        }
        if let Some(index) = cut.deviation_mm.iter().position(|d| !d.is_finite()) {
            return Err(Error::NotFinite { index });
        }
        let mut rest = cut.deviation_mm;
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
    let datum = asked.datum.map(|datum| surfaces[datum].datum()).transpose()?;
    match asked.kind {
        Kind::Flatness => surface.form(Element::Plane),
        Kind::Cylindricity => surface.form(Element::Cylinder),
        Kind::Roundness => surface.roundness(),
        Kind::Diameter => {
            let shape = surface.element(Element::Cylinder, Criterion::LeastSquares)?;
            Ok(2.0 * (shape.radius_mm - surface.nominal_radius_mm()))
        }
        Kind::Profile => Ok(2.0 * surface.farthest_mm()),
        Kind::Position => match surface.feature.geometry.axis() {
            Some((at, axis)) => surface.about_axis(&at, &axis),
            None => Ok(2.0 * surface.farthest_mm()),
        },
        Kind::Parallelism => surface.oriented(&datum.ok_or_else(no_datum)?, true),
        Kind::Perpendicularity => surface.oriented(&datum.ok_or_else(no_datum)?, false),
        Kind::Coaxiality => {
            let datum = datum.ok_or_else(no_datum)?;
            surface.about_axis(&datum.point_mm, &datum.direction)
        }
        Kind::CircularRunOut => surface.run_out(&datum.ok_or_else(no_datum)?, true),
        Kind::TotalRunOut => surface.run_out(&datum.ok_or_else(no_datum)?, false),
    }
}

fn no_datum() -> Error {
    Error::Shape { what: "a characteristic without the datum that it needs".to_owned() }
}

impl Surface<'_> {
    fn element(&self, element: Element, criterion: Criterion) -> Result<Shape, Error> {
        let fitted = fit_by(element, &self.places_mm, &Known::default(), &[criterion])?;
        let reference = fitted.reference(criterion).unwrap_or(&fitted.references[0]);
        Ok(reference.shape)
    }

    fn form(&self, element: Element) -> Result<f64, Error> {
        let fitted =
            fit_by(element, &self.places_mm, &Known::default(), &[Criterion::MinimumZone])?;
        let zone = fitted.reference(Criterion::MinimumZone).unwrap_or(&fitted.references[0]);
        Ok(zone.form_mm())
    }

    /// The associated element, ISO 5459: the plane of the minimum zone, the axis of the largest inscribed cylinder of a hole,
    /// of the smallest circumscribed one of a shaft.
    fn datum(&self) -> Result<Shape, Error> {
        use super::Geometry;
        match self.feature.geometry {
            Geometry::Cylinder { is_hole: true, .. } => {
                self.element(Element::Cylinder, Criterion::MaximumInscribed)
            }
            Geometry::Cylinder { .. } => {
                self.element(Element::Cylinder, Criterion::MinimumCircumscribed)
            }
            _ => self.element(Element::Plane, Criterion::MinimumZone),
        }
    }

    fn nominal_radius_mm(&self) -> f64 {
        match self.feature.geometry {
            super::Geometry::Cylinder { radius_mm, .. } => radius_mm,
            _ => 0.0,
        }
    }

    fn farthest_mm(&self) -> f64 {
        self.deviation_mm.iter().fold(0.0, |most: f64, d| most.max(d.abs()))
    }

    /// Each section across an axis, in its plane.
    fn sections(&self, axis: &Vec3) -> impl Iterator<Item = Vec<[f64; 2]>> {
        let [x, y] = across(axis);
        self.feature.sections.iter().map(move |section| {
            self.places_mm[section.clone()].iter().map(|p| [p.dot(&x), p.dot(&y)]).collect()
        })
    }

    fn roundness(&self) -> Result<f64, Error> {
        let Some((_, axis)) = self.feature.geometry.axis() else { return Err(no_datum()) };
        let mut fitter = Fitter::default();
        self.sections(&axis).try_fold(0.0, |most: f64, section| {
            Ok(most.max(fitter.minimum_zone(&section)?.width_mm()))
        })
    }

    /// The centres of the sections by least squares: the extracted median line.
    fn median_line(&self) -> Result<Vec<Vec3>, Error> {
        let Some((_, axis)) = self.feature.geometry.axis() else { return Err(no_datum()) };
        let [x, y] = across(&axis);
        let mut fitter = Fitter::default();
        let mut centres = Vec::with_capacity(self.feature.sections.len());
        for (points, section) in self.sections(&axis).zip(&self.feature.sections) {
            let centre = fitter.least_squares(&points)?.center_mm;
            let places = &self.places_mm[section.clone()];
            let height = places.iter().map(|p| p.dot(&axis)).sum::<f64>() / places.len() as f64;
            centres.push(x * centre[0] + y * centre[1] + axis * height);
        }
        Ok(centres)
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
        match self.feature.geometry.axis() {
            // The planes of the zone have this normal, or one across it.
            None if is_axis != is_parallel => Ok(range(&self.places_mm, &direction)),
            None => least_range(&self.places_mm, &direction),
            // The axis of the zone is the direction of the datum.
            Some(_) if is_axis == is_parallel => {
                Ok(2.0 * enclosing_radius(&self.median_line()?, &direction))
            }
            Some(_) => Ok(range(&self.median_line()?, &direction)),
        }
    }

    fn run_out(&self, datum: &Shape, each: bool) -> Result<f64, Error> {
        let off = |p: &Vec3| {
            let arm = p - datum.point_mm;
            (arm - datum.direction * arm.dot(&datum.direction)).norm()
        };
        let range = |places: &[Vec3]| {
            let all = places.iter().map(off);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        if each {
            let sections = self.feature.sections.iter().map(|s| range(&self.places_mm[s.clone()]));
            return Ok(sections.fold(0.0, f64::max));
        }
        Ok(range(&self.places_mm))
    }
}

/// How far points are apart along a direction.
fn range(places_mm: &[Vec3], direction: &Vec3) -> f64 {
    let all = places_mm.iter().map(|p| p.dot(direction));
    all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
}

/// The least distance of two parallel planes around points, both along a direction.
fn least_range(places_mm: &[Vec3], along: &Vec3) -> Result<f64, Error> {
    let flat: Vec<Vec3> = places_mm.iter().map(|p| p - along * p.dot(along)).collect();
    let known = Known { normal: Some(*along) };
    let fitted = fit_by(Element::Line, &flat, &known, &[Criterion::MinimumZone])?;
    let zone = fitted.reference(Criterion::MinimumZone).unwrap_or(&fitted.references[0]);
    Ok(zone.form_mm())
}

/// The radius of the smallest cylinder along a direction around points.
///
/// # Source
/// E. Welzl, Smallest enclosing disks (balls and ellipsoids), 1991: a point outside of the circle so far is on the next one.
fn enclosing_radius(places_mm: &[Vec3], direction: &Vec3) -> f64 {
    let [x, y] = across(direction);
    let flat: Vec<[f64; 2]> = places_mm.iter().map(|p| [p.dot(&x), p.dot(&y)]).collect();
    let mut circle = Circle::default();
    for (i, p) in flat.iter().enumerate() {
        if i > 0 && circle.contains(p) {
            continue;
        }
        circle = Circle { centre: *p, radius: 0.0 };
        for (j, q) in flat[..i].iter().enumerate() {
            if circle.contains(q) {
                continue;
            }
            circle = Circle::over(p, q);
            for r in &flat[..j] {
                if !circle.contains(r) {
                    circle = Circle::through(p, q, r);
                }
            }
        }
    }
    circle.radius
}

#[derive(Debug, Clone, Copy, Default)]
struct Circle {
    centre: [f64; 2],
    radius: f64,
}

impl Circle {
    fn contains(&self, p: &[f64; 2]) -> bool {
        distance(&self.centre, p) <= self.radius * (1.0 + 1e-12) + 1e-12
    }

    fn over(p: &[f64; 2], q: &[f64; 2]) -> Self {
        let centre = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
        Self { centre, radius: 0.5 * distance(p, q) }
    }

    fn through(p: &[f64; 2], q: &[f64; 2], r: &[f64; 2]) -> Self {
        let (a, b) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
        let [aa, bb] = [a, b].map(|v| v[0] * v[0] + v[1] * v[1]);
        let twice = 2.0 * (a[0] * b[1] - a[1] * b[0]);
        let off = [(b[1] * aa - a[1] * bb) / twice, (a[0] * bb - b[0] * aa) / twice];
        if !off.iter().all(|c| c.is_finite()) {
            // On one line: the two that are farthest apart.
            let pairs = [Self::over(p, q), Self::over(p, r), Self::over(q, r)];
            return pairs
                .into_iter()
                .fold(pairs[0], |most, c| if c.radius > most.radius { c } else { most });
        }
        Self { centre: [p[0] + off[0], p[1] + off[1]], radius: off[0].hypot(off[1]) }
    }
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
