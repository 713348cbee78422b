//! The part of a study, cut once and measured on a coordinate measuring machine.

use super::cutting::Cutting;
use super::judge::Judge;
use super::monte_carlo::draw;
use super::{Error, Study};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use trueaxis_geometry::Vec3;
use trueaxis_part::Shape;
use trueaxis_part::testpiece::CutSurface;
use trueaxis_part::testpiece::measured::MeasuredPoint;

/// The noise of the points comes from a stream of its own.
const NOISE_STREAM: u64 = u64::MAX;

/// A part that was cut and measured virtually.
#[derive(Debug, Clone, PartialEq)]
pub struct VirtualPart {
    /// The points that the measuring machine gives, against the datum of the study.
    pub points: Vec<MeasuredPoint>,
    /// The indices of the part before its points became noisy, mm.
    pub indices_mm: Vec<f64>,
}

/// Cuts the part of a study on one machine, and measures it.
///
/// With `draw_errors` the errors of this machine are drawn within their uncertainties (the first sample of
/// [`super::monte_carlo`] with this seed), otherwise they are as stated. Each point deviates by a normal draw along
/// the normal of the surface.
///
/// # Errors
/// As [`super::predict`].
pub fn cut_virtually(
    study: &Study,
    (seed, draw_errors): (u64, bool),
    u_point_mm: f64,
) -> Result<VirtualPart, Error> {
    let (machine, piece) = (&study.machine, study.piece());
    let (temperatures, program) = (study.temperatures.as_ref(), study.program.as_ref());
    let cutting = Cutting::along(machine, piece, &study.reference, temperatures, program)?;
    let judge = Judge { cutting: &cutting, piece };
    let factors = match draw_errors {
        true => draw(machine.uncertain_quantities().len(), seed, 0),
        false => vec![0.0; machine.uncertain_quantities().len()],
    };
    let mut deviations = Vec::new();
    let datum = judge.cut(&|values, u| u.displaced(values, &factors), &mut deviations);
    let surface = CutSurface { deviation_mm: &deviations, datum };
    let mut indices_mm = vec![0.0; judge.index_count()];
    let evaluated = piece.evaluate(&surface, &mut piece.scratch(), &mut indices_mm);
    evaluated.map_err(Error::Evaluation)?;
    let Shape::Cone(cone) = &study.test_piece.shape;
    let mut points = cone.points_of(&surface);
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(NOISE_STREAM);
    let (tilt_sin, tilt_cos) = cone.size().half_angle_rad.sin_cos();
    for point in points.iter_mut().filter(|_| u_point_mm > 0.0) {
        let z: f64 = StandardNormal.sample(&mut generator);
        let (sin, cos) = point.place_mm.y.atan2(point.place_mm.x).sin_cos();
        point.place_mm += Vec3::new(tilt_cos * cos, tilt_cos * sin, tilt_sin) * (z * u_point_mm);
    }
    Ok(VirtualPart { points, indices_mm })
}
