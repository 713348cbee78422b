//! The shape of a cutter of revolution: the seven parameters of APT, and how far a point is from it.

use thiserror::Error;

/// Why a cutter is none.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CutterError {
    /// A parameter that is no number, or no length.
    #[error("{0} must be a number, and lengths must be positive")]
    NotANumber(&'static str),
    /// The end of the cutter is hollow.
    #[error(
        "the angle of the bottom is {0:.3}°: a cutter with a hollow end is not supported, 0 to 90° are"
    )]
    Hollow(f64),
    /// The bottom does not meet the corner circle.
    #[error(
        "the bottom passes the corner circle by {0:.4} mm: centre and radius of the corner do not fit its angle"
    )]
    BottomApart(f64),
    /// The side does not meet the corner circle.
    #[error(
        "the side passes the corner circle by {0:.4} mm: centre and radius of the corner do not fit diameter and angle of the side"
    )]
    SideApart(f64),
    /// The side would begin before the bottom ends.
    #[error("the side begins before the bottom ends: the corner circle fits neither of them")]
    Crossed,
    /// The side reaches the axis below the height.
    #[error("the side reaches the axis {0:.3} mm above the tip, below the height of the cutter")]
    Pointed(f64),
}

/// The seven parameters of `CUTTER/d,r,e,f,a,b,h` in APT (ISO 4343).
///
/// ```text
///      axis
///       |          / side, β from the axis
///       |    _____/
///       |   (  +   )   corner circle: radius r, centre e from the axis and f above the tip
///       | _/
///     tip   bottom, α from the plane
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Apt {
    /// d: twice the distance from the axis to where bottom and side, made longer, meet.
    pub diameter_mm: f64,
    /// r: radius of the corner.
    pub corner_mm: f64,
    /// e: from the axis to the centre of the corner; negative for a barrel.
    pub corner_radial_mm: f64,
    /// f: from the tip to the centre of the corner, along the axis.
    pub corner_axial_mm: f64,
    /// α: of the bottom, from the plane across the axis.
    pub bottom_rad: f64,
    /// β: of the side, from the axis; positive if it widens upwards.
    pub side_rad: f64,
    /// h: from the tip to the end of the cutting part.
    pub height_mm: f64,
}

/// A convex cutter of revolution; its tip is at the origin, its axis is z.
///
/// ```
/// use trueaxis_cut::Cutter;
/// let ball = Cutter::ball(10.0, 40.0).unwrap();
/// // 3-4-5 from the centre of the ball, which is 5 mm above the tip: on it.
/// assert!(ball.distance(3.0, 1.0).0.abs() < 1e-12);
/// // Below the tip, and outside of the side.
/// assert_eq!(ball.distance(0.0, -2.0).0, 2.0);
/// assert_eq!(ball.distance(6.5, 20.0).0, 1.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutter {
    bottom: Line,
    side: Line,
    /// Centre of the corner circle: radial, axial.
    centre_mm: [f64; 2],
    corner_mm: f64,
    /// Directions from the centre to both ends of the arc.
    arc: [[f64; 2]; 2],
    /// Points where neighbours meet at an angle, with the outward directions of both.
    corners: [Corner; 4],
    height_mm: f64,
    widest_mm: f64,
}

/// A straight piece of the profile: outward direction, and where it is along it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    out: [f64; 2],
    at_mm: f64,
}

impl Line {
    fn through(point: [f64; 2], out: [f64; 2]) -> Self {
        Self { out, at_mm: dot(point, out) }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    point: [f64; 2],
    between: [[f64; 2]; 2],
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Positive if b is counter-clockwise of a.
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Whether a direction lies between these two, the second counter-clockwise of the first; equal ones count as a ray.
fn between([first, second]: &[[f64; 2]; 2], way: [f64; 2]) -> bool {
    cross(*first, way) >= 0.0
        && cross(way, *second) >= 0.0
        && dot(way, [first[0] + second[0], first[1] + second[1]]) > 0.0
}

impl Cutter {
    /// A ball-nosed end mill.
    ///
    /// # Errors
    /// Sizes that are none, or a height below the radius.
    pub fn ball(diameter_mm: f64, height_mm: f64) -> Result<Self, CutterError> {
        Self::bull(diameter_mm, 0.5 * diameter_mm, height_mm)
    }

    /// A flat end mill.
    ///
    /// # Errors
    /// Sizes that are none.
    pub fn flat(diameter_mm: f64, height_mm: f64) -> Result<Self, CutterError> {
        Self::bull(diameter_mm, 0.0, height_mm)
    }

    /// An end mill with rounded corners.
    ///
    /// # Errors
    /// Sizes that are none.
    pub fn bull(diameter_mm: f64, corner_mm: f64, height_mm: f64) -> Result<Self, CutterError> {
        Self::new(&Apt {
            diameter_mm,
            corner_mm,
            corner_radial_mm: 0.5 * diameter_mm - corner_mm,
            corner_axial_mm: corner_mm,
            bottom_rad: 0.0,
            side_rad: 0.0,
            height_mm,
        })
    }

    /// A drill with this angle of its point, 118° for the usual one.
    ///
    /// # Errors
    /// Sizes that are none.
    pub fn drill(diameter_mm: f64, point_rad: f64, height_mm: f64) -> Result<Self, CutterError> {
        let bottom_rad = 0.5 * (std::f64::consts::PI - point_rad);
        Self::new(&Apt {
            diameter_mm,
            corner_mm: 0.0,
            corner_radial_mm: 0.5 * diameter_mm,
            corner_axial_mm: 0.5 * diameter_mm * bottom_rad.tan(),
            bottom_rad,
            side_rad: 0.0,
            height_mm,
        })
    }

    /// Any cutter of APT whose end is not hollow.
    ///
    /// # Errors
    /// What does not fit together, by the name of the parameter.
    pub fn new(apt: &Apt) -> Result<Self, CutterError> {
        checked(apt)?;
        let Apt { corner_mm, height_mm, bottom_rad, side_rad, .. } = *apt;
        let centre = [apt.corner_radial_mm, apt.corner_axial_mm];
        let along = [bottom_rad.cos(), bottom_rad.sin()];
        let bottom = Line { out: [along[1], -along[0]], at_mm: 0.0 };
        let meet = 0.5 * apt.diameter_mm;
        let side =
            Line::through([meet, meet * bottom_rad.tan()], [side_rad.cos(), -side_rad.sin()]);
        // The bottom leaves the corner circle at the far crossing, the side reaches it at the near one.
        let from = crossing(&bottom, centre, corner_mm, 1.0).map_err(CutterError::BottomApart)?;
        let from = if from[0] < 0.0 { [0.0; 2] } else { from };
        let to = crossing(&side, centre, corner_mm, -1.0).map_err(CutterError::SideApart)?;
        let out_at = |point, line: &Line| match corner_mm > 0.0 {
            true => towards(centre, point),
            false => line.out,
        };
        let mut arc = [out_at(from, &bottom), out_at(to, &side)];
        let mut ends = [to, [to[0] + (height_mm - to[1]) * side_rad.tan(), height_mm]];
        if to[1] >= height_mm {
            // Half a ball, or a short barrel: the cutting part ends on the arc.
            let rise = height_mm - centre[1];
            let half = (corner_mm * corner_mm - rise * rise).max(0.0).sqrt();
            ends = [[centre[0] + half, height_mm]; 2];
            arc[1] = out_at(ends[0], &side);
        }
        if cross(arc[0], arc[1]) < -1e-9 || ends[0][0] < 0.0 {
            return Err(CutterError::Crossed);
        }
        if ends[1][0] < 0.0 {
            return Err(CutterError::Pointed(to[1] - to[0] / side_rad.tan()));
        }
        let corners = [
            Corner { point: [0.0; 2], between: [[0.0, -1.0], bottom.out] },
            Corner { point: from, between: [bottom.out, arc[0]] },
            Corner { point: ends[0], between: [arc[1], side.out] },
            Corner { point: ends[1], between: [side.out, [0.0, 1.0]] },
        ];
        let equator = arc[0][1] <= 0.0 && arc[1][1] >= 0.0;
        let widest_mm = [from[0], ends[0][0], ends[1][0]]
            .into_iter()
            .chain(equator.then_some(centre[0] + corner_mm))
            .fold(0.0, f64::max);
        Ok(Self { bottom, side, centre_mm: centre, corner_mm, arc, corners, height_mm, widest_mm })
    }

    /// The signed distance of the point at this radius and height from the cutter, negative inside, and its gradient.
    ///
    /// It is the largest of what its flats, its arc and its corners say: each of them alone says too little, never too
    /// much, as the cutter is convex (the distance from a convex body is that from its farthest supporting plane).
    #[inline]
    pub fn distance(&self, radial_mm: f64, axial_mm: f64) -> (f64, [f64; 2]) {
        let p = [radial_mm, axial_mm];
        let from_centre = [p[0] - self.centre_mm[0], p[1] - self.centre_mm[1]];
        if between(&self.arc, from_centre) {
            let far = dot(from_centre, from_centre).sqrt();
            if far > self.corner_mm {
                return (far - self.corner_mm, from_centre.map(|c| c / far));
            }
        }
        self.elsewhere(p, from_centre)
    }

    fn elsewhere(&self, p: [f64; 2], from_centre: [f64; 2]) -> (f64, [f64; 2]) {
        let mut best = (p[1] - self.height_mm, [0.0, 1.0]);
        for line in [&self.bottom, &self.side] {
            let off = dot(p, line.out) - line.at_mm;
            if off > best.0 {
                best = (off, line.out);
            }
        }
        if best.0 <= 0.0 {
            // Inside: the arc is nearer than the flats say.
            let far = dot(from_centre, from_centre).sqrt();
            if between(&self.arc, from_centre) && far > 0.0 && far - self.corner_mm > best.0 {
                best = (far - self.corner_mm, from_centre.map(|c| c / far));
            }
            return best;
        }
        for corner in &self.corners {
            let off = [p[0] - corner.point[0], p[1] - corner.point[1]];
            if between(&corner.between, off) {
                let far = dot(off, off).sqrt();
                if far > best.0 {
                    best = (far, off.map(|c| c / far));
                }
            }
        }
        best
    }

    /// From the tip to the end of the cutting part.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// The largest distance of its surface from the axis.
    pub fn widest_mm(&self) -> f64 {
        self.widest_mm
    }

    /// The height about which it turns with the least change of its surface: that of the corner circle.
    pub(crate) fn pivot_mm(&self) -> f64 {
        self.centre_mm[1].clamp(0.0, self.height_mm)
    }

    /// Its largest radius, and its height.
    pub(crate) fn extent_mm(&self) -> (f64, f64) {
        (self.widest_mm, self.height_mm)
    }

    /// The radius of its corner.
    pub(crate) fn corner_mm(&self) -> f64 {
        self.corner_mm
    }

    /// The height of the centre of a ball nose, if it is one.
    pub(crate) fn ball_mm(&self) -> Option<f64> {
        let [radial, axial] = self.centre_mm;
        let all = self.arc[0][1] <= -1.0 + 1e-12 && self.arc[1][1] >= -1e-12;
        (radial == 0.0 && self.corner_mm > 0.0 && all).then_some(axial)
    }

    /// The farthest point of it from the pivot.
    pub(crate) fn reach_mm(&self) -> f64 {
        let pivot = self.pivot_mm();
        self.widest_mm.hypot(pivot.max(self.height_mm - pivot))
    }
}

fn checked(apt: &Apt) -> Result<(), CutterError> {
    let named = [
        ("the diameter", apt.diameter_mm, f64::MIN_POSITIVE),
        ("the height", apt.height_mm, f64::MIN_POSITIVE),
        ("the corner radius", apt.corner_mm, 0.0),
        ("the place of the corner along the axis", apt.corner_axial_mm, 0.0),
        ("the place of the corner across the axis", apt.corner_radial_mm, f64::MIN),
        ("the angle of the bottom", apt.bottom_rad, f64::MIN),
        ("the angle of the side", apt.side_rad, f64::MIN),
    ];
    for (name, value, least) in named {
        if !value.is_finite() || value < least || value.abs() > 1e6 {
            return Err(CutterError::NotANumber(name));
        }
    }
    let right = std::f64::consts::FRAC_PI_2;
    if !(0.0..right).contains(&apt.bottom_rad) {
        return Err(CutterError::Hollow(apt.bottom_rad.to_degrees()));
    }
    match apt.side_rad.abs() < right {
        true => Ok(()),
        false => Err(CutterError::NotANumber("the angle of the side, less than 90°,")),
    }
}

fn towards(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = dot(way, way).sqrt();
    way.map(|w| w / length)
}

/// Where a line meets the corner circle, the later (+1) or the earlier (−1) crossing along it from bottom to top; a line
/// that touches it does so where it touches. Else how far it passes.
fn crossing(line: &Line, centre: [f64; 2], radius: f64, sign: f64) -> Result<[f64; 2], f64> {
    let along = [-line.out[1], line.out[0]];
    let off = line.at_mm - dot(centre, line.out);
    // Parameters are written with four digits or more.
    if off.abs() - radius > 1e-3 * radius.max(1.0) {
        return Err(off.abs() - radius);
    }
    let half = radius * radius - off * off;
    // A square root turns 1e-16 into 1e-8: a line that touches to rounding touches.
    let half = if half > 1e-9 * radius * radius { half.sqrt() } else { 0.0 };
    Ok([0, 1].map(|k| centre[k] + off * line.out[k] + sign * half * along[k]))
}
