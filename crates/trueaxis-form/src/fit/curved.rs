//! Spheres, cylinders and cones.

use super::{Cloud, Fitted, Spread, contact_reference, range};
use crate::chebyshev::Start;
use crate::least_squares::{Residuals, solve, solve_near};
use crate::surface::{Family, Frame, MOST, Place};
use crate::{Criterion, Element, Error, Shape, start};
use nalgebra::DMatrix;
use trueaxis_geometry::{Mat3, Vec3};

/// Orthogonal distances from an element of a family: its unknowns, then the offset.
struct Orthogonal<'a> {
    family: Family,
    frame: Frame,
    points: &'a [Vec3],
}

impl Residuals for Orthogonal<'_> {
    fn count(&self) -> usize {
        self.points.len()
    }

    fn typical(&self, _: usize) -> f64 {
        1.0
    }

    fn evaluate(&self, values: &[f64], residual: &mut [f64], jacobian: Option<&mut DMatrix<f64>>) {
        let (n, mut jacobian) = (self.family.unknowns(), jacobian);
        for (i, p) in self.points.iter().enumerate() {
            let mut slope = [0.0; MOST];
            let value = self.family.value(&self.frame.local(p), values, &mut slope);
            residual[i] = value - values[n];
            if let Some(j) = jacobian.as_deref_mut() {
                (0..n).for_each(|k| j[(i, k)] = slope[k]);
                j[(i, n)] = -1.0;
            }
        }
    }
}

/// A least-squares element with its statistics.
struct Least {
    place: Place,
    squares: f64,
    inverse: DMatrix<f64>,
    rank: usize,
    is_converged: bool,
}

/// Least squares from a place, in frames that follow the element.
fn least(family: Family, points: &[Vec3], (mut place, is_near): (Place, bool)) -> Option<Least> {
    let n = family.unknowns();
    let mut found = None;
    for round in 0..8 {
        let mut start = vec![0.0; n];
        if family == Family::Cone {
            start[4] = place.half_angle;
        }
        start.push(place.offset);
        let problem = Orthogonal { family, frame: place.frame, points };
        let solution = match is_near || round > 0 {
            true => solve_near(&problem, &start)?,
            false => solve(&problem, &start)?,
        };
        let x = &solution.values;
        let change = x.iter().zip(&start).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let half_angle = if family == Family::Cone { x[4] } else { 0.0 };
        let mut frame = family.moved(&place.frame, &x[..n]);
        let mut offset = x[n];
        if family != Family::Sphere {
            // The origin follows the middle of the points, where position and tilt are not correlated.
            let along = -frame.origin.dot(&frame.direction());
            frame.origin += frame.direction() * along;
            offset += along * half_angle.sin();
        }
        place = Place { frame, offset, half_angle };
        let is_converged = solution.is_converged();
        let (squares, rank) = (solution.sum_of_squares, solution.rank);
        let inverse = solution.inverse;
        let at = Place { frame: place.frame, offset, half_angle };
        found = Some(Least { place: at, squares, inverse, rank, is_converged });
        if change < 1e-9 || frame.origin.norm() > 1e6 {
            break;
        }
    }
    found
}

/// The place of a shape, its origin next to the middle of the points.
fn place_of(shape: &Shape) -> Place {
    let (sin, cos) = shape.half_angle_rad.sin_cos();
    let along = -shape.point_mm.dot(&shape.direction);
    let frame = Frame::new(shape.point_mm + shape.direction * along, &shape.direction);
    // g = ρ cos ψ − h sin ψ is R cos ψ at the point of the shape.
    let offset = shape.radius_mm * cos + along * sin;
    Place { frame, offset, half_angle: shape.half_angle_rad }
}

/// The two guesses that come nearest to some of the points.
fn best_guesses(element: Element, cloud: &Cloud) -> Vec<Place> {
    let few = start::thinned(&cloud.points);
    let tried = guesses(element, &cloud.points).into_iter();
    let mut tried: Vec<Least> =
        tried.filter_map(|g| least(Family::of(element), &few, (g, false))).collect();
    tried.retain(|l| l.squares.is_finite() && l.place.offset.is_finite());
    tried.sort_by(|a, b| a.squares.total_cmp(&b.squares));
    tried.into_iter().take(2).map(|l| l.place).collect()
}

/// First guesses of a curved element.
fn guesses(element: Element, points: &[Vec3]) -> Vec<Place> {
    if element == Element::Sphere {
        let sphere = start::sphere(points);
        let place = |(centre, offset)| {
            let frame = Frame { origin: centre, axes: Mat3::identity() };
            Place { frame, offset, half_angle: 0.0 }
        };
        return sphere.map(place).into_iter().collect();
    }
    let cone = element == Element::Cone;
    let place = |g: start::AxisGuess| {
        let offset = g.radius * g.half_angle.cos();
        Place { frame: g.frame, offset, half_angle: g.half_angle }
    };
    start::axes(points, cone).into_iter().map(place).collect()
}

pub(super) fn curved(element: Element, cloud: &Cloud) -> Result<Fitted, Error> {
    let family = Family::of(element);
    let begins = match &cloud.near {
        Some(near) => vec![place_of(near)],
        None => best_guesses(element, cloud),
    };
    let finals = begins
        .into_iter()
        .filter_map(|place| least(family, &cloud.points, (place, cloud.near.is_some())));
    let mut finals: Vec<Least> = finals.collect();
    finals.sort_by(|a, b| a.squares.total_cmp(&b.squares));
    let best = finals.first().ok_or(Error::NoCentre)?;
    let shape = best.place.shape(element, &Vec3::zeros());
    if !shape.radius_mm.is_finite() || shape.radius_mm > 1e6 {
        return Err(Error::NoCentre);
    }
    let ends = range(cloud.points.iter().map(|p| shape.deviation_mm(p)));
    let mut references = vec![cloud.reference(Criterion::LeastSquares, shape, ends)];
    let starts: Vec<Start> = finals
        .iter()
        .map(|l| Start { frame: l.place.frame, half_angle: l.place.half_angle })
        .collect();
    for criterion in &element.criteria()[1..] {
        references.extend(contact_reference(cloud, element, *criterion, &starts));
    }
    let spread = curved_spread(element, cloud, best);
    Ok(cloud.fitted(element, references, &spread))
}

fn curved_spread(element: Element, cloud: &Cloud, least: &Least) -> Spread {
    let n = Family::of(element).unknowns();
    let axes = least.place.frame.axes;
    let columns = [axes.column(0), axes.column(1), axes.column(2)];
    let sum = |first: usize, count: usize| {
        let mut matrix = Mat3::zeros();
        for i in 0..count {
            for j in 0..count {
                let part = columns[i] * columns[j].transpose();
                matrix += least.inverse[(first + i, first + j)] * part;
            }
        }
        matrix
    };
    let is_sphere = element == Element::Sphere;
    let place = &least.place;
    let (sin, cos) = place.half_angle.sin_cos();
    // The radius of a cone at its point is offset / cos ψ.
    let by_angle = if element == Element::Cone { place.offset * sin / (cos * cos) } else { 0.0 };
    let inverse = &least.inverse;
    let mut radius = inverse[(n, n)] / (cos * cos);
    let mut half_angle = 0.0;
    if element == Element::Cone {
        half_angle = inverse[(4, 4)].max(0.0).sqrt();
        radius += by_angle * by_angle * inverse[(4, 4)] + 2.0 * by_angle * inverse[(4, n)] / cos;
    }
    Spread {
        squares: least.squares,
        degrees: cloud.points.len().saturating_sub(n + 1),
        point: if is_sphere { sum(0, 3) } else { sum(0, 2) },
        direction: if is_sphere { Mat3::zeros() } else { sum(2, 2) },
        radius: radius.max(0.0).sqrt(),
        half_angle,
        is_determined: least.is_converged && least.rank == n + 1,
        ..Spread::default()
    }
}
