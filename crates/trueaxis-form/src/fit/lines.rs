//! Lines: of a profile in its plane, and in space.

use super::{Cloud, Fitted, Spread, contact_reference, outer, range};
use crate::chebyshev::{Contact, Start};
use crate::surface::{Frame, Place, upright};
use crate::{Criterion, Element, Error, Proof, Shape, profile, start};
use trueaxis_geometry::{Mat3, Vec3};

pub(super) fn profile_line(cloud: &Cloud, normal: &Vec3) -> Result<Fitted, Error> {
    let frame = Frame::new(Vec3::zeros(), normal);
    let flat: Vec<[f64; 2]> = cloud.points.iter().map(|p| frame.local(p).xy().into()).collect();
    let points: Vec<Vec3> = flat.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect();
    let [(length, along), ..] = start::principal(&points);
    if length <= 0.0 {
        return Err(Error::Coincident);
    }
    let along = frame.axes.tr_mul(&upright(frame.axes * along));
    let across = Vec3::new(-along.y, along.x, 0.0);
    let n = points.len();
    let squares = points.iter().map(|p| p.dot(&across).powi(2)).sum();
    let shape = |direction: Vec3, point: Vec3| Shape {
        element: Element::Line,
        point_mm: frame.axes * point,
        direction: frame.axes * direction,
        radius_mm: 0.0,
        half_angle_rad: 0.0,
    };
    let ends = range(points.iter().map(|p| p.dot(&across)));
    let mut references =
        vec![cloud.reference(Criterion::LeastSquares, shape(along, Vec3::zeros()), ends)];
    let wanted = cloud.criteria.contains(&Criterion::MinimumZone);
    if let Some(strip) = profile::narrowest(&flat).filter(|_| wanted) {
        let direction = Vec3::new(strip.direction[0], strip.direction[1], 0.0);
        let direction = direction * direction.dot(&along).signum();
        let side = Vec3::new(-direction.y, direction.x, 0.0);
        let [low, high] = range(points.iter().map(|p| p.dot(&side)));
        let middle = 0.5 * (low + high);
        let ends = [low - middle, high - middle];
        let shape = shape(direction, side * middle);
        let mut zone = cloud.reference(Criterion::MinimumZone, shape, ends);
        zone.contacts = strip_contacts(&strip, &points, &direction, &side, middle);
        zone.proof = Some(Proof::Global);
        references.push(zone);
    }
    let out = frame.axes * across;
    let spread = Spread {
        squares,
        degrees: n.saturating_sub(2),
        point: outer(&out) / n as f64,
        direction: outer(&out) / length,
        is_determined: true,
        ..Spread::default()
    };
    let mut fitted = cloud.fitted(Element::Line, references, &spread);
    fitted.normal = Some(frame.direction());
    Ok(fitted)
}

/// The two ends of an edge share its line in the manner of a lever.
fn strip_contacts(
    strip: &profile::Strip,
    points: &[Vec3],
    direction: &Vec3,
    side: &Vec3,
    middle: f64,
) -> Vec<Contact> {
    let [a, b, c] = strip.contacts;
    let along = |i: usize| points[i].dot(direction);
    let share = ((along(c) - along(a)) / (along(b) - along(a))).clamp(0.0, 1.0);
    let weights = [1.0 - share, share, 1.0];
    let contact = |(index, weight): (usize, f64)| Contact {
        index,
        is_outer: points[index].dot(side) > middle,
        weight,
    };
    let all = [a, b, c].into_iter().zip(weights);
    all.map(contact).filter(|c| c.weight > 1e-12).collect()
}

pub(super) fn space_line(cloud: &Cloud) -> Result<Fitted, Error> {
    let [(length, along), ..] = start::principal(&cloud.points);
    let frame = Frame::new(Vec3::zeros(), &along);
    let local: Vec<Vec3> = cloud.points.iter().map(|p| frame.local(p)).collect();
    let n = local.len();
    let squares = local.iter().map(|q| q.xy().norm_squared()).sum();
    let high = local.iter().map(|q| q.xy().norm()).fold(0.0, f64::max);
    let place = Place { frame, offset: 0.0, half_angle: 0.0 };
    let shape = place.shape(Element::Line, &Vec3::zeros());
    let mut least = cloud.reference(Criterion::LeastSquares, shape, [0.0, high]);
    least.is_space_line = true;
    let mut references = vec![least];
    references.extend(contact_reference(
        cloud,
        Element::Line,
        Criterion::MinimumZone,
        &[Start { frame, half_angle: 0.0 }],
    ));
    let across = Mat3::identity() - outer(&along);
    let spread = Spread {
        squares,
        degrees: (2 * n).saturating_sub(4),
        point: across / n as f64,
        direction: across / length,
        is_determined: true,
        ..Spread::default()
    };
    Ok(cloud.fitted(Element::Line, references, &spread))
}
