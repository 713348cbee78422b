//! From the cut surface to the values of the characteristics.

use super::datum::{self, DatumFrame, all_degrees, held};
use super::feature::across;
use super::pattern;
use super::{Characteristic, Datum, Feature, Geometry, Kind, Part};
use crate::Error;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;
use trueaxis_form::circle::Fitter;
use trueaxis_form::placed::place;
use trueaxis_form::{Criterion, Element, Known, Reference, Shape, fit_by};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::SurfacePoint;

/// Places of a feature.
pub(super) struct Surface<'a> {
    pub feature: &'a Feature,
    pub(super) deviation_mm: &'a [f64],
    pub places_mm: Vec<Vec3>,
    /// Its element as a datum, once it was asked for.
    pub datum: OnceCell<Shape>,
    /// Its element of the minimum zone, once it was asked for.
    pub zone: OnceCell<Reference>,
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
    /// A list of another length, a deviation that is not finite, points that fit no element.
    pub fn evaluate(&self, deviation_mm: &[f64]) -> Result<Vec<f64>, Error> {
        self.evaluate_each(deviation_mm)?.into_iter().collect()
    }

    /// Each of them, or why it has none.
    fn evaluate_each(&self, deviation_mm: &[f64]) -> Result<Vec<Result<f64, Error>>, Error> {
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
                let (datum, zone) = (OnceCell::new(), OnceCell::new());
                Surface { feature, deviation_mm, places_mm, datum, zone }
            })
            .collect();
        let mut systems = Systems { features: &self.features, found: Vec::new() };
        let each = self.characteristics.iter().map(|asked| {
            let refused = |e: Error| Error::Characteristic {
                name: asked.name.clone(),
                reason: e.to_string(),
            };
            value(asked, &surfaces, &mut systems).map_err(refused)
        });
        Ok(each.collect())
    }

    /// By how much each value changes with half of the rows, or with half of the points of each: the largest change, mm. A value that
    /// half of the points does not have counts whole.
    ///
    /// # Errors
    /// As [`Part::evaluate`].
    pub fn by_points_mm(&self, deviation_mm: &[f64]) -> Result<Vec<f64>, Error> {
        let all = self.evaluate(deviation_mm)?;
        let thinned = [0, 1, 2, 3].map(|way| {
            let features = self.features.iter().map(|f| f.thinned(way)).collect();
            let is_kept = self.features.iter().flat_map(|f| &f.is_kept);
            let kept = is_kept.zip(deviation_mm).filter(|(kept, _)| kept[way]).map(|(_, d)| *d);
            Self { features, ..self.clone() }.evaluate_each(&kept.collect::<Vec<f64>>()).ok()
        });
        let change = |(i, value): (usize, &f64)| {
            let of = |found: &Option<Vec<Result<f64, Error>>>| {
                let found = found.as_ref().and_then(|all| all[i].as_ref().ok());
                found.map_or(value.abs(), |found| (found - value).abs())
            };
            thinned.iter().map(of).fold(0.0, f64::max)
        };
        Ok(all.iter().enumerate().map(change).collect())
    }
}

/// Datum systems of a part, each found once.
struct Systems<'p> {
    features: &'p [Feature],
    found: Vec<(&'p [Datum], DatumFrame)>,
}

impl<'p> Systems<'p> {
    fn frame(
        &mut self,
        surfaces: &[Surface<'_>],
        datums: &'p [Datum],
    ) -> Result<DatumFrame, Error> {
        if let Some((_, frame)) = self.found.iter().find(|(of, _)| *of == datums) {
            return Ok(frame.clone());
        }
        let frame = match datums.is_empty() {
            true => DatumFrame::of_zero(),
            false => DatumFrame::on(surfaces, datums, all_degrees(self.features))?,
        };
        self.found.push((datums, frame.clone()));
        Ok(frame)
    }
}

fn value<'p>(
    asked: &'p Characteristic,
    surfaces: &[Surface<'_>],
    systems: &mut Systems<'p>,
) -> Result<f64, Error> {
    if asked.kind == Kind::Position && asked.features.len() > 1 {
        let members: Vec<&Surface<'_>> = asked.features.iter().map(|f| &surfaces[*f]).collect();
        return pattern::position(
            &members,
            asked.projected_mm,
            &systems.frame(surfaces, &asked.datums)?,
        );
    }
    let each = asked.features.iter().map(|f| of_one(asked, &surfaces[*f], surfaces, systems));
    let values = each.collect::<Result<Vec<f64>, _>>()?;
    // Of a pattern the one that is nearest to its limit.
    let room = |v: &f64| asked.limits.room_mm(*v);
    let worst = values.into_iter().min_by(|a, b| room(a).total_cmp(&room(b)));
    worst.ok_or_else(|| unfit("a characteristic of no feature"))
}

fn of_one<'p>(
    asked: &'p Characteristic,
    surface: &Surface<'_>,
    surfaces: &[Surface<'_>],
    systems: &mut Systems<'p>,
) -> Result<f64, Error> {
    let datum = || match &asked.datums[..] {
        [datum] => datum::associated(surfaces, datum, systems.features),
        _ => Err(unfit("a characteristic without the datum that it needs")),
    };
    let is_single = asked.datums.len() == 1;
    match asked.kind {
        Kind::Flatness | Kind::Cylindricity => Ok(surface.minimum_zone()?.form_mm()),
        Kind::Straightness => surface.straightness(),
        Kind::LineStraightness => surface.line_straightness(),
        Kind::Roundness => surface.roundness(),
        Kind::Diameter => surface.diameter(),
        Kind::Width => surface.width(),
        Kind::Profile => surface.profile(&systems.frame(surfaces, &asked.datums)?),
        Kind::LineProfile => surface.line_profile(&systems.frame(surfaces, &asked.datums)?),
        Kind::Position => {
            surface.position(&systems.frame(surfaces, &asked.datums)?, asked.projected_mm)
        }
        // About an axis the zone may turn, as a pattern does.
        Kind::Symmetry => {
            pattern::position(&[surface], None, &systems.frame(surfaces, &asked.datums)?)
        }
        Kind::Parallelism | Kind::Perpendicularity if is_single => {
            surface.oriented(&datum()?, asked)
        }
        Kind::Parallelism | Kind::Perpendicularity | Kind::Angularity => {
            surface.oriented_by(&systems.frame(surfaces, &asked.datums)?, asked.projected_mm)
        }
        Kind::Coaxiality => {
            let datum = datum()?;
            surface.about_axis(&datum.point_mm, &datum.direction)
        }
        Kind::TotalRunOut if surface.feature.geometry.axis().is_none() => {
            let axis = datum()?.direction;
            Ok(range(surface.places_mm.iter().map(|p| p.dot(&axis))))
        }
        Kind::CircularRunOut => Ok(surface.run_out(&datum()?, &surface.feature.sections)),
        Kind::TotalRunOut => {
            let whole = 0..surface.places_mm.len();
            Ok(surface.run_out(&datum()?, std::slice::from_ref(&whole)))
        }
    }
}

/// What the reader of the part file refuses.
pub(super) fn unfit(what: &str) -> Error {
    Error::Shape { what: what.to_owned() }
}

/// One element through places.
pub(super) fn element(
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
    pub(super) fn element(&self, kind: Element, criterion: Criterion) -> Result<Reference, Error> {
        let near = self.feature.geometry.shape();
        element(kind, criterion, &self.places_mm, &Known { near, ..Known::default() })
    }

    /// The plane, or the cylinder, of the minimum zone.
    pub(super) fn minimum_zone(&self) -> Result<&Reference, Error> {
        if let Some(found) = self.zone.get() {
            return Ok(found);
        }
        let kind = match self.feature.geometry {
            Geometry::Plane { .. } => Element::Plane,
            Geometry::Cylinder { .. } => Element::Cylinder,
            _ => return Err(unfit("the minimum zone of what is neither a plane nor a cylinder")),
        };
        let found = self.element(kind, Criterion::MinimumZone)?;
        Ok(self.zone.get_or_init(|| found))
    }

    fn diameter(&self) -> Result<f64, Error> {
        let Geometry::Cylinder { radius_mm, .. } = self.feature.geometry else {
            return Err(unfit("the diameter of what is no cylinder"));
        };
        let found = self.element(Element::Cylinder, Criterion::LeastSquares)?;
        Ok(2.0 * (found.shape.radius_mm - radius_mm))
    }

    /// Material on the faces makes a slot narrower and a tongue wider. The faces have the same points about the same middle, so that what
    /// leans does not change the means.
    fn width(&self) -> Result<f64, Error> {
        let Geometry::Slot { is_hole, .. } = self.feature.geometry else {
            return Err(unfit("the width of what is neither a slot nor a tongue"));
        };
        let mean = self.deviation_mm.iter().sum::<f64>() / self.deviation_mm.len() as f64;
        Ok(if is_hole { -2.0 * mean } else { 2.0 * mean })
    }

    /// Half-way between the points of a slot or a tongue that face each other, and the plane in which they should be.
    pub(super) fn median(&self) -> Option<(Geometry, Vec<Vec3>)> {
        let plane = self.feature.geometry.median()?;
        let (one, other) = self.places_mm.split_at(self.places_mm.len() / 2);
        Some((plane, one.iter().zip(other).map(|(a, b)| 0.5 * (a + b)).collect()))
    }

    /// What has a direction and no axis: the points of a plane, the middle of a slot.
    pub(super) fn flat(&self) -> (Geometry, Cow<'_, [Vec3]>) {
        match self.median() {
            Some((plane, places)) => (plane, Cow::Owned(places)),
            None => (self.feature.geometry, Cow::Borrowed(&self.places_mm)),
        }
    }

    /// The axis, and each section across it in coordinates of its plane.
    fn sections(&self) -> Result<Sections, Error> {
        let Some((_, axis)) = self.feature.geometry.axis() else {
            return Err(unfit("a section of what has no axis"));
        };
        let [x, y] = across(&axis);
        let places_mm = self.in_rows(&axis);
        let flat = |i: usize| [places_mm[i].dot(&x), places_mm[i].dot(&y)];
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
    pub(super) fn median_line(&self) -> Result<Vec<Vec3>, Error> {
        let Sections { axis, across: [x, y], flat_mm } = self.sections()?;
        let mut fitter = Fitter::default();
        let centre = |(flat, section): (&Vec<[f64; 2]>, &Range<usize>)| {
            let [u, v] = fitter.least_squares(flat)?.center_mm;
            let height = self.feature.points[section.start].point_mm.dot(&axis);
            Ok(x * u + y * v + axis * height)
        };
        flat_mm.iter().zip(&self.feature.sections).map(centre).collect()
    }

    /// What of its axis is to lie in a zone: the median line; of a helix, which has no sections, both ends of the axis of least squares;
    /// of a projected zone both ends of the axis of the minimum zone in it, which begins where the feature ends, or, below zero, ends where
    /// it begins.
    pub(super) fn axis_line(&self, projected_mm: Option<f64>) -> Result<Vec<Vec3>, Error> {
        let is_helix = self.feature.sections.is_empty();
        if projected_mm.is_none() && !is_helix {
            return self.median_line();
        }
        let Geometry::Cylinder { at_mm, axis, length_mm, .. } = self.feature.geometry else {
            return Err(unfit("the axis of what is no cylinder"));
        };
        let (found, [from_mm, to_mm]) = match projected_mm {
            None => {
                let heights = self.feature.points.iter().map(|p| (p.point_mm - at_mm).dot(&axis));
                let ends = (f64::MAX, f64::MIN);
                let (low, high) = heights.fold(ends, |(l, h), v| (l.min(v), h.max(v)));
                (self.element(Element::Cylinder, Criterion::LeastSquares)?.shape, [low, high])
            }
            Some(by) if by > 0.0 => (self.minimum_zone()?.shape, [length_mm, length_mm + by]),
            Some(by) => (self.minimum_zone()?.shape, [0.0, by]),
        };
        let at = |height_mm: f64| {
            let arm = height_mm - (found.point_mm - at_mm).dot(&axis);
            found.point_mm + found.direction * (arm / found.direction.dot(&axis))
        };
        Ok(vec![at(from_mm), at(to_mm)])
    }

    /// Twice the largest distance of the median line from an axis.
    fn about_axis(&self, at: &Vec3, axis: &Vec3) -> Result<f64, Error> {
        Ok(2.0 * farthest(&self.axis_line(None)?, at, axis))
    }

    fn straightness(&self) -> Result<f64, Error> {
        let centres = self.median_line()?;
        let found = element(Element::Line, Criterion::MinimumZone, &centres, &Known::default())?;
        Ok(found.form_mm())
    }

    /// Twice the largest distance of the surface from the nominal one in the frame of the datums.
    fn profile(&self, frame: &DatumFrame) -> Result<f64, Error> {
        let geometry = self.feature.geometry;
        let seen = frame.seen(&self.places_mm);
        let off = |(place, nominal): (&Vec3, &SurfacePoint)| match geometry.outside(place) {
            Some((distance, _)) => distance.abs(),
            // To first order: a table does not say how it bends.
            None => nominal.normal.dot(&(place - nominal.point_mm)).abs(),
        };
        Ok(2.0 * seen.iter().zip(&self.feature.points).map(off).fold(0.0, f64::max))
    }

    /// Twice the largest distance of the median line, of the middle of a slot, of a plane from its nominal place in the frame of the datums.
    fn position(&self, frame: &DatumFrame, projected_mm: Option<f64>) -> Result<f64, Error> {
        if let Some((at, axis)) = self.feature.geometry.axis() {
            return Ok(2.0 * farthest(&frame.seen(&self.axis_line(projected_mm)?), &at, &axis));
        }
        let (plane, places) = self.flat();
        let off = |p: &Vec3| plane.outside(p).map_or(f64::NAN, |(distance, _)| distance.abs());
        Ok(2.0 * frame.seen(&places).iter().map(off).fold(0.0, f64::max))
    }

    /// At its angle in the frame of the datums; what they leave free turns the zone to where it is narrowest.
    fn oriented_by(&self, frame: &DatumFrame, projected_mm: Option<f64>) -> Result<f64, Error> {
        let geometry = self.feature.geometry;
        if let Some((_, axis)) = geometry.axis() {
            return narrowest_about(&frame.seen(&self.axis_line(projected_mm)?), &axis);
        }
        let (plane, places) = self.flat();
        // Shifts change no width.
        let free = frame.free.moving(&held(self.feature));
        let zone = place(&frame.seen(&places), &free, &plane.distances(), Criterion::MinimumZone)?;
        Ok(zone.high_mm - zone.low_mm)
    }

    /// Parallel or perpendicular to a plane or an axis: of a plane the width between two planes, of an axis the diameter of a
    /// cylinder or, where only one direction is fixed, the width between two planes.
    fn oriented(&self, datum: &Shape, asked: &Characteristic) -> Result<f64, Error> {
        let is_parallel = asked.kind == Kind::Parallelism;
        let line = || self.axis_line(asked.projected_mm);
        let is_axis = datum.element != Element::Plane;
        let direction = datum.direction;
        let along = |places: &[Vec3]| places.iter().map(|p| p.dot(&direction)).collect::<Vec<_>>();
        match self.feature.geometry.axis() {
            // The planes of the zone have this normal, or one across it.
            None if is_axis != is_parallel => Ok(range(along(&self.flat().1))),
            None => least_range(&self.flat().1, &direction),
            // The axis of the zone is the direction of the datum.
            Some(_) if is_axis == is_parallel => narrowest_about(&line()?, &direction),
            Some(_) => Ok(range(along(&line()?))),
        }
    }

    /// The largest range of the distances from an axis among some stretches of the points.
    fn run_out(&self, datum: &Shape, stretches: &[Range<usize>]) -> f64 {
        let off = |p: &Vec3| off_axis(p, &datum.point_mm, &datum.direction);
        let ranges = stretches.iter().map(|s| range(self.places_mm[s.clone()].iter().map(off)));
        ranges.fold(0.0, f64::max)
    }
}

/// The distance of a place from an axis.
fn off_axis(place: &Vec3, at: &Vec3, axis: &Vec3) -> f64 {
    let arm = place - at;
    (arm - axis * arm.dot(axis)).norm()
}

/// The largest distance of places from an axis.
fn farthest(places_mm: &[Vec3], at: &Vec3, axis: &Vec3) -> f64 {
    places_mm.iter().map(|p| off_axis(p, at, axis)).fold(0.0, f64::max)
}

/// The diameter of the smallest cylinder of this direction around places.
fn narrowest_about(places_mm: &[Vec3], direction: &Vec3) -> Result<f64, Error> {
    let [x, y] = across(direction);
    let flat: Vec<[f64; 2]> = places_mm.iter().map(|p| [p.dot(&x), p.dot(&y)]).collect();
    Ok(2.0 * Fitter::default().enclosing_radius_mm(&flat)?)
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
    let known = Known { normal: Some(*along), ..Known::default() };
    Ok(element(Element::Line, Criterion::MinimumZone, &flat, &known)?.form_mm())
}
