//! A probe whose pre-travel is known, and the hits that it makes.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal};
use std::f64::consts::TAU;
use trueaxis::geometry::Vec3;
use trueaxis::identify::probe::{
    Gauge, GaugeKind, Hit, LobingModel, Reading, Side, Study, Stylus, turned,
};
use trueaxis::input::Place;

/// What is true.
#[derive(Clone)]
pub struct VirtualProbe<'a> {
    /// Pre-travel by direction as the probe sees it, mm.
    pub travel: &'a dyn Fn(Vec3) -> f64,
    pub offset_mm: Vec3,
    pub centre_mm: Vec3,
    pub kind: GaugeKind,
    pub side: Side,
    pub noise_mm: f64,
    pub seed: u64,
}

impl Default for VirtualProbe<'_> {
    fn default() -> Self {
        Self {
            travel: &|_| 0.0,
            offset_mm: Vec3::zeros(),
            centre_mm: Vec3::zeros(),
            kind: GaugeKind::Ring,
            side: Side::Inside,
            noise_mm: 0.0,
            seed: 1,
        }
    }
}

pub const RADIUS_MM: f64 = 31.0;
pub const BALL_MM: f64 = 2.0;

/// Directions evenly around, from an angle on.
pub fn even(count: usize, from_rad: f64) -> Vec<Vec3> {
    let angle = |i: usize| from_rad + TAU * i as f64 / count as f64;
    (0..count).map(|i| Vec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect()
}

impl VirtualProbe<'_> {
    fn contact(&self) -> f64 {
        RADIUS_MM - self.side.sign() * BALL_MM
    }

    /// The trigger on the line through the centre: the spindle starts above it.
    pub fn hit(&self, u: Vec3, orientation_rad: f64) -> Hit {
        let offset = turned(self.offset_mm, orientation_rad);
        let along = offset.dot(&u);
        let across = (offset - u * along).norm_squared();
        let contact = self.contact();
        let s = -along + self.side.sign() * (contact * contact - across).sqrt();
        let travel = (self.travel)(turned(u, -orientation_rad));
        let spindle_mm = self.centre_mm + u * (s + travel);
        Hit { spindle_mm, direction: u, orientation_rad, place: Place::default() }
    }

    /// Without noise, along the direction of motion, as measured.
    pub fn deviation(&self, u: Vec3, orientation_rad: f64) -> f64 {
        let hit = self.hit(u, orientation_rad);
        (hit.spindle_mm - self.centre_mm).dot(&u) - self.side.sign() * self.contact()
    }

    /// A calibration with the spindle at 0.
    pub fn study(&self, directions: Vec<Vec3>) -> Study {
        self.study_turned(directions, &[0.0])
    }

    /// A calibration at several orientations; the centre is stated.
    pub fn study_turned(&self, directions: Vec<Vec3>, orientations_rad: &[f64]) -> Study {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let noise = Normal::new(0.0, self.noise_mm).expect("finite");
        let mut hits = Vec::new();
        for (orientation, u) in
            orientations_rad.iter().flat_map(|o| directions.iter().map(move |u| (*o, *u)))
        {
            let mut hit = self.hit(u, orientation);
            hit.spindle_mm += u * noise.sample(&mut random);
            hits.push(hit);
        }
        let gauge = Gauge {
            kind: self.kind,
            side: self.side,
            radius_mm: RADIUS_MM,
            u_radius_mm: 0.0,
            centre_mm: Some(self.centre_mm),
            u_centre_mm: 0.0,
        };
        let stylus = Stylus {
            name: "a".to_owned(),
            ball_radius_mm: BALL_MM,
            reading: Reading::Spindle,
            hits,
            check: Vec::new(),
        };
        Study {
            file: "virtual.toml".to_owned(),
            name: "virtual".to_owned(),
            model: LobingModel::Fourier,
            most_harmonics: 12,
            table_steps: 60,
            gauge,
            styli: vec![stylus],
            eccentricity: None,
            z_datum: None,
            xy_datum: None,
            program: None,
        }
    }
}
