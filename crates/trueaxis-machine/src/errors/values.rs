//! The errors of all bodies at one command, as one flat array.

use super::Component;
use trueaxis_geometry::{Mat3, Vec3};

/// At most six axes, the workpiece and the tool.
pub const MAX_BODIES: usize = 8;

/// Six errors of one body, in mm and rad, in the order X Y Z A B C.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SixErrors(pub [f64; 6]);

impl SixErrors {
    /// The shift in mm.
    pub fn shift_mm(&self) -> Vec3 {
        Vec3::new(self.0[0], self.0[1], self.0[2])
    }

    /// Whether there is no error at all.
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(|error| *error == 0.0)
    }

    /// `R − I` of the rotation: `R = Rz(EC)·Ry(EB)·Rx(EA)` exactly, or `I + [ε]×`.
    ///
    /// The difference is formed without subtracting 1 from a cosine, so that a microradian keeps
    /// all its digits.
    pub fn rotation_minus_identity(&self, rotation: Rotation) -> Mat3 {
        let [_, _, _, a, b, c] = self.0;
        if rotation == Rotation::SmallAngle {
            return Mat3::new(0.0, -c, b, c, 0.0, -a, -b, a, 0.0);
        }
        let [(sa, va), (sb, vb), (sc, vc)] = [a, b, c].map(sine_and_versine);
        let (ca, cb, cc) = (1.0 - va, 1.0 - vb, 1.0 - vc);
        Mat3::new(
            vb * vc - vb - vc,
            sa * sb * cc - ca * sc,
            ca * sb * cc + sa * sc,
            cb * sc,
            sa * sb * sc + va * vc - va - vc,
            ca * sb * sc - sa * cc,
            -sb,
            sa * cb,
            va * vb - va - vb,
        )
    }
}

/// sin x and 1 − cos x, both to the last digit.
///
/// Below a milliradian, where every error of a real machine lies, the series end at a term that a
/// double does not feel (x⁷/5040 and x⁸/40320) and cost a tenth of the library's functions.
fn sine_and_versine(x: f64) -> (f64, f64) {
    let square = x * x;
    if square < 1e-6 {
        let sine = x * (1.0 - square / 6.0 * (1.0 - square / 20.0));
        return (sine, 0.5 * square * (1.0 - square / 12.0 * (1.0 - square / 30.0)));
    }
    let half = (0.5 * x).sin();
    (x.sin(), 2.0 * half * half)
}

/// How the angles of an error become a matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rotation {
    /// `Rz(EC)·Ry(EB)·Rx(EA)`.
    #[default]
    Exact,
    /// `I + [ε]×`, as the papers write it.
    SmallAngle,
}

/// The errors of one body relative to its predecessor at one position.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyErrors {
    /// Λ: constant.
    pub location: SixErrors,
    /// E: at this position.
    pub motion: SixErrors,
}

impl BodyErrors {
    /// Location errors or error motions.
    pub fn six(&self, kind: super::ErrorKind) -> &SixErrors {
        match kind {
            super::ErrorKind::Location => &self.location,
            super::ErrorKind::Motion => &self.motion,
        }
    }

    /// The same, to change them.
    pub fn six_mut(&mut self, kind: super::ErrorKind) -> &mut SixErrors {
        match kind {
            super::ErrorKind::Location => &mut self.location,
            super::ErrorKind::Motion => &mut self.motion,
        }
    }
}

/// The value of every error of the machine at one position; bodies in chain order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ErrorValues {
    /// One entry per body of [`crate::Machine::bodies`]; the rest is zero.
    pub bodies: [BodyErrors; MAX_BODIES],
    /// E_w: how far the material under the nominal tip has gone because the workpiece is not at
    /// 20 °C, in the workpiece frame, mm. The tool misses by minus that.
    pub workpiece_mm: Vec3,
}

/// Which entry of [`ErrorValues`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ErrorIndex {
    /// The body, in chain order.
    pub body: usize,
    /// Constant or function of position.
    pub kind: super::ErrorKind,
    /// The direction.
    pub component: Component,
}

impl ErrorValues {
    /// One value, in mm or rad.
    pub fn get(&self, index: ErrorIndex) -> f64 {
        self.six(index).0[index.component as usize]
    }

    /// Sets one value, in mm or rad.
    pub fn set(&mut self, index: ErrorIndex, value: f64) {
        self.bodies[index.body].six_mut(index.kind).0[index.component as usize] = value;
    }

    /// Adds to one value, in mm or rad.
    pub fn add(&mut self, index: ErrorIndex, by: f64) {
        let six = self.bodies[index.body].six_mut(index.kind);
        six.0[index.component as usize] += by;
    }

    /// Only this error, all others zero.
    pub fn only(&self, index: ErrorIndex) -> Self {
        let mut alone = Self::default();
        alone.set(index, self.get(index));
        alone
    }

    /// All errors times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = *self;
        scaled.workpiece_mm *= factor;
        for body in &mut scaled.bodies {
            for value in body.location.0.iter_mut().chain(&mut body.motion.0) {
                *value *= factor;
            }
        }
        scaled
    }

    fn six(&self, index: ErrorIndex) -> &SixErrors {
        self.bodies[index.body].six(index.kind)
    }
}

impl ErrorIndex {
    /// Every entry of [`ErrorValues`]: bodies in chain order, constants before error motions.
    pub fn all() -> impl Iterator<Item = Self> {
        let kinds = [super::ErrorKind::Location, super::ErrorKind::Motion];
        (0..MAX_BODIES).flat_map(move |body| {
            kinds.into_iter().flat_map(move |kind| {
                Component::ALL.into_iter().map(move |component| Self { body, kind, component })
            })
        })
    }
}
