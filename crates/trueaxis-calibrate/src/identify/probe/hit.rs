//! A hit of a touch probe on a gauge, and what its position says of the pre-travel.

use trueaxis_geometry::Vec3;
use trueaxis_input::Place;

/// What the probe touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GaugeKind {
    /// Hits in the plane of the ring.
    Ring,
    /// Hits in three dimensions.
    Sphere,
}

/// Where the material is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The ball is within the ring and moves outwards.
    Inside,
    /// The ball is outside of the ring or sphere and moves inwards.
    Outside,
}

impl Side {
    /// +1 within, −1 outside.
    pub fn sign(self) -> f64 {
        match self {
            Self::Inside => 1.0,
            Self::Outside => -1.0,
        }
    }
}

/// A ring or sphere of known diameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Ring or sphere.
    pub kind: GaugeKind,
    /// Where the material is.
    pub side: Side,
    /// Its radius, mm.
    pub radius_mm: f64,
    /// Standard uncertainty of the radius, mm.
    pub u_radius_mm: f64,
    /// Its centre in machine coordinates, if it is known: where the spindle stands when its axis
    /// goes through the centre.
    pub centre_mm: Option<Vec3>,
    /// Standard uncertainty of each coordinate of the centre, mm.
    pub u_centre_mm: f64,
}

impl Gauge {
    /// Coordinates that count: a ring says nothing along its axis.
    pub fn dimensions(&self) -> usize {
        match self.kind {
            GaugeKind::Ring => 2,
            GaugeKind::Sphere => 3,
        }
    }

    /// How far the centre of a ball stands from that of the gauge when they touch, mm.
    pub fn contact_mm(&self, ball_radius_mm: f64) -> f64 {
        self.radius_mm - self.side.sign() * ball_radius_mm
    }
}

/// One trigger.
#[derive(Debug, Clone, PartialEq)]
pub struct Hit {
    /// The spindle at the trigger, machine coordinates, mm; z is 0 on a ring.
    pub spindle_mm: Vec3,
    /// The direction of motion, a unit vector.
    pub direction: Vec3,
    /// How far the spindle is turned, rad.
    pub orientation_rad: f64,
    /// The row that says so.
    pub place: Place,
}

/// Turns a vector about z, as the spindle turns the probe.
pub fn turned(vector: Vec3, angle_rad: f64) -> Vec3 {
    let (s, c) = angle_rad.sin_cos();
    Vec3::new(c * vector.x - s * vector.y, s * vector.x + c * vector.y, vector.z)
}

impl Hit {
    /// The direction of motion as the probe sees it.
    pub fn probe_direction(&self) -> Vec3 {
        turned(self.direction, -self.orientation_rad)
    }
}

/// What one hit says: its pre-travel, and how that follows the place of the ball.
#[derive(Debug, Clone, Copy)]
pub struct Travelled {
    /// How far the spindle moved on after the ball touched, mm.
    pub travel_mm: f64,
    /// Its derivative to the place of the ball.
    pub gradient: Vec3,
}

/// The pre-travel of a hit if the ball stands at `offset` from the spindle axis and the gauge at
/// `centre`.
///
/// ```text
///     w = p + R(φ)·o − c        t = w·u − σ √(ρ² − |w⊥u|²)                       docs/model.md eq. 136
/// ```
///
/// `None`: on this line the ball does not meet the gauge.
pub fn travelled(
    hit: &Hit,
    offset_mm: Vec3,
    centre_mm: Vec3,
    (side, contact_mm): (Side, f64),
) -> Option<Travelled> {
    let ball = hit.spindle_mm + turned(offset_mm, hit.orientation_rad) - centre_mm;
    let along = ball.dot(&hit.direction);
    let across = ball - hit.direction * along;
    let square = contact_mm * contact_mm - across.norm_squared();
    if square <= 0.0 || !square.is_finite() {
        return None;
    }
    let depth = square.sqrt();
    let sign = side.sign();
    Some(Travelled {
        travel_mm: along - sign * depth,
        gradient: hit.direction + across * (sign / depth),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(x: f64, y: f64, direction: Vec3) -> Hit {
        let spindle_mm = Vec3::new(x, y, 0.0);
        Hit { spindle_mm, direction, orientation_rad: 0.0, place: Place::default() }
    }

    #[test]
    fn a_ball_off_the_axis_meets_the_ring_on_a_chord() {
        // Ball 3 mm above the axis, ρ = 5: it touches at x = 4; the spindle went on to 4.01.
        let hit = hit(4.01, 0.0, Vec3::x());
        let found = travelled(&hit, Vec3::new(0.0, 3.0, 0.0), Vec3::zeros(), (Side::Inside, 5.0));
        let found = found.unwrap();
        assert!((found.travel_mm - 0.01).abs() < 1e-12);
        // Raised by a little more, it would touch by 3/4 of that sooner.
        assert!((found.gradient.y - 0.75).abs() < 1e-12);
    }

    #[test]
    fn outside_the_spindle_goes_deeper_too() {
        // From the right onto a sphere with ρ = 5: it touches at 5 and triggers at 4.98.
        let hit = hit(4.98, 0.0, -Vec3::x());
        let found = travelled(&hit, Vec3::zeros(), Vec3::zeros(), (Side::Outside, 5.0)).unwrap();
        assert!((found.travel_mm - 0.02).abs() < 1e-12);
    }
}
