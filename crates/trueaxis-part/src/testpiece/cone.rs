//! The truncated cone, cut by the flank of an end mill whose axis is parallel to the generatrix.

use super::{
    Contact, CutSurface, Datum, Family, Feature, IndexName, PartSection, Scratch, TestPiece,
    ToolPosition,
};
use crate::Error;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point, Workpiece};

/// The dimensions of a cone and of its machining.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeSize {
    /// Half of the apex angle, α; 0 is a cylinder.
    pub half_angle_rad: f64,
    /// Diameter of the base circle, D_c.
    pub base_diameter_mm: f64,
    /// Height from the base to the top face along the axis, h1.
    pub height_mm: f64,
    /// Diameter of the end mill.
    pub tool_diameter_mm: f64,
    /// Tool positions around the cone, m ≥ 8, at azimuth 0, 360°/m, …
    pub positions: usize,
    /// Heights above the base (along the axis) that are evaluated; the first is the base, 0.
    pub heights_mm: Vec<f64>,
    /// The height of roundness and coaxiality; one of `heights_mm`.
    pub roundness_height_mm: f64,
    /// The heights of angularity, upwards; all in `heights_mm`.
    pub angularity_heights_mm: Vec<f64>,
}

impl ConeSize {
    /// The frustum of Wu et al. 2022 with its positions 1 … 4 (z = −60, −35, −10, 0 mm).
    ///
    /// # Example
    /// ```
    /// use trueaxis_part::testpiece::cone::ConeSize;
    /// let size = ConeSize::nas979();
    /// // 125 − 60 · tan 15° = 108.923 mm at the top
    /// let top_radius_mm = 125.0 - size.height_mm * size.half_angle_rad.tan();
    /// assert!((top_radius_mm - 108.923).abs() < 1e-3);
    /// ```
    /// # Source
    /// Wu et al. 2022, table 2, fig. 13; the paper does not state m; 72 is our choice.
    pub fn nas979() -> Self {
        Self {
            half_angle_rad: 15f64.to_radians(),
            base_diameter_mm: 250.0,
            height_mm: 60.0,
            tool_diameter_mm: 20.0,
            positions: 72,
            heights_mm: vec![0.0, 25.0, 50.0, 60.0],
            roundness_height_mm: 25.0,
            angularity_heights_mm: vec![0.0, 25.0, 50.0],
        }
    }
}

const fn index(family: Family, key: &'static str, feature: Feature) -> IndexName {
    IndexName { family, key, feature, decisive: false }
}

const fn decisive(name: IndexName) -> IndexName {
    IndexName { decisive: true, ..name }
}

/// All indices of a cone, in the order of all lists of values.
pub const INDICES: [IndexName; 11] = [
    index(Family::Paper, "roundness_eq18_mm", Feature::Roundness),
    index(Family::Paper, "angularity_eq19_mm", Feature::Angularity),
    index(Family::Paper, "coaxiality_eq20_mm", Feature::Coaxiality),
    index(Family::Paper, "coaxiality_diameter_mm", Feature::Coaxiality),
    index(Family::Iso, "roundness_lsc_mm", Feature::Roundness),
    decisive(index(Family::Iso, "roundness_mzc_mm", Feature::Roundness)),
    index(Family::Iso, "roundness_mic_mm", Feature::Roundness),
    index(Family::Iso, "roundness_mcc_mm", Feature::Roundness),
    decisive(index(Family::Iso, "coaxiality_lsc_mm", Feature::Coaxiality)),
    decisive(index(Family::Iso, "angularity_zone_mm", Feature::Angularity)),
    index(Family::Spatial, "volumetric_max_mm", Feature::Volumetric),
];

/// Position of `angularity_zone_mm` in [`INDICES`].
const ANGULARITY_ZONE: usize = 9;
/// Least number of tool positions that shows the form of a section.
const MIN_POSITIONS: usize = 8;
/// Largest accepted number of tool positions.
const MAX_POSITIONS: usize = 100_000;

/// A truncated cone that can be cut and evaluated.
///
/// ```text
/// n  = (−sin α cos φ, −sin α sin φ, cos α)        tool axis, parallel to the generatrix
/// n_f = (cos α cos φ, cos α sin φ, sin α)         out of the material
/// tip = base circle + D/2 · n_f                   the end of the mill at the base
/// E_H = n_f · E_v,H                                > 0: material left
/// section radius = D_c/2 − H tan α + E_H / cos α
/// ```
///
/// docs/model.md eq. 18, 20, 21; the indices are eq. 22 to 28 there.
///
/// # Example
/// ```
/// use trueaxis_geometry::Vec3;
/// use trueaxis_part::testpiece::{CutSurface, TestPiece, cone::{Cone, ConeSize}};
/// let cone = Cone::new("NAS 979", ConeSize::nas979())?;
/// // The whole cut is displaced by 10 µm in x: the section is round, but eccentric.
/// let off = vec![Vec3::new(0.010, 0.0, 0.0); 72 * 4];
/// let mut indices_mm = [0.0; 11];
/// cone.evaluate(&CutSurface::about_ideal_axis(&off), &mut cone.scratch(), &mut indices_mm)?;
/// assert!((indices_mm[0] - 0.010 * 15f64.to_radians().cos()).abs() < 1e-12); // Eq 18: e cos α
/// assert!(indices_mm[5] < 1e-6);                                             // minimum zone: e²/R
/// assert!((indices_mm[8] - 0.020).abs() < 1e-6);                             // φ = 2e
/// # Ok::<(), trueaxis_part::Error>(())
/// ```
/// # Source
/// Wu et al. 2022, Eq 14–20 with the corrections 000-9 … 000-15, see docs/validation.md.
#[derive(Debug, Clone)]
pub struct Cone {
    name: String,
    size: ConeSize,
    round: usize,
    angular: Vec<usize>,
    cos: f64,
    azimuths: Vec<Azimuth>,
    /// Ideal position of every contact on the tool axis, row-major, mm.
    places_mm: Vec<Vec3>,
}

#[derive(Debug, Clone, Copy)]
struct Azimuth {
    angle_rad: f64,
    cos: f64,
    sin: f64,
    tip_mm: Vec3,
    axis: Vec3,
    normal: Vec3,
}

impl Cone {
    /// Checks the dimensions.
    ///
    /// # Errors
    /// [`Error::Shape`] names the dimension and its permitted range.
    pub fn new(name: &str, size: ConeSize) -> Result<Self, Error> {
        check(&size)?;
        let find = |height: f64| size.heights_mm.iter().position(|h| *h == height);
        let missing = |what: &str| Error::Shape {
            what: format!("{what} must be one of the section heights"),
        };
        let round =
            find(size.roundness_height_mm).ok_or_else(|| missing("the height of roundness"))?;
        let angular = size
            .angularity_heights_mm
            .iter()
            .map(|h| find(*h).ok_or_else(|| missing("each height of angularity")))
            .collect::<Result<Vec<_>, _>>()?;
        let azimuths: Vec<_> = (0..size.positions).map(|i| Azimuth::new(&size, i)).collect();
        let cos = size.half_angle_rad.cos();
        let places_mm = azimuths
            .iter()
            .flat_map(|a| size.heights_mm.iter().map(move |h| a.tip_mm + a.axis * (h / cos)))
            .collect();
        Ok(Self { name: name.to_owned(), round, angular, cos, azimuths, places_mm, size })
    }

    /// The dimensions.
    pub fn size(&self) -> &ConeSize {
        &self.size
    }

    /// The nominal radius at a height above the base.
    ///
    /// ```text
    /// R(H) = D_c/2 − H tan α
    /// ```
    ///
    /// # Example
    /// ```
    /// use trueaxis_part::testpiece::cone::{Cone, ConeSize};
    /// let cone = Cone::new("NAS 979", ConeSize::nas979())?;
    /// assert!((cone.radius_mm(25.0) - 118.3013).abs() < 1e-4); // 125 − 25 · 0.267949
    /// # Ok::<(), trueaxis_part::Error>(())
    /// ```
    pub fn radius_mm(&self, height_mm: f64) -> f64 {
        0.5 * self.size.base_diameter_mm - height_mm * self.size.half_angle_rad.tan()
    }

    fn accept(&self, cut: &CutSurface<'_>) -> Result<(), Error> {
        let (found, expected) = (cut.deviation_mm.len(), self.places_mm.len());
        if found != expected {
            return Err(Error::WrongLength { what: "deviations of the cut", found, expected });
        }
        let usable = |v: &Vec3| v.iter().all(|c| c.abs() <= 1e100);
        match cut.deviation_mm.iter().position(|v| !usable(v)) {
            Some(index) => Err(Error::NotFinite { index }),
            None if usable(&cut.datum.shift_mm) && usable(&cut.datum.tilt_rad) => Ok(()),
            None => Err(Error::NotFinite { index: 0 }),
        }
    }

    /// E_v of one contact relative to the datum.
    fn vector(&self, cut: &CutSurface<'_>, position: usize, section: usize) -> Vec3 {
        let at = position * self.size.heights_mm.len() + section;
        cut.deviation_mm[at] - cut.datum.displacement_mm(self.places_mm[at])
    }

    /// E = n_f · E_v.
    fn normal_error(&self, cut: &CutSurface<'_>, position: usize, section: usize) -> f64 {
        self.azimuths[position].normal.dot(&self.vector(cut, position, section))
    }

    fn profile(&self, cut: &CutSurface<'_>, section: usize, out: &mut Vec<[f64; 2]>) {
        let nominal = self.radius_mm(self.size.heights_mm[section]);
        out.clear();
        out.extend(self.azimuths.iter().enumerate().map(|(i, a)| {
            let radius = nominal + self.normal_error(cut, i, section) / self.cos;
            [radius * a.cos, radius * a.sin]
        }));
    }

    /// All indices of one height except the zone over several; the profile remains in the scratch.
    fn at_height(
        &self,
        cut: &CutSurface<'_>,
        section: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> Result<crate::fit::circle::Circles, Error> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut rise, mut sum, mut largest) = (f64::NEG_INFINITY, Vec3::zeros(), 0.0f64);
        for i in 0..self.azimuths.len() {
            let vector = self.vector(cut, i, section);
            let error = self.azimuths[i].normal.dot(&vector);
            (low, high) = (low.min(error), high.max(error));
            rise = rise.max(error - self.normal_error(cut, i, 0));
            sum += vector;
            largest =
                largest.max(cut.deviation_mm[i * self.size.heights_mm.len() + section].norm());
        }
        self.profile(cut, section, &mut scratch.profile_mm);
        let circles = scratch.fitter.all(&scratch.profile_mm)?;
        let mean = sum / self.azimuths.len() as f64;
        let distance = mean.x.hypot(mean.y);
        out.copy_from_slice(&[
            0.5 * (high - low),
            rise,
            distance,
            2.0 * distance,
            circles.lsc.width_mm(),
            circles.mzc.width_mm(),
            circles.mic.width_mm(),
            circles.mcc.width_mm(),
            circles.lsc.coaxiality_mm(),
            f64::NAN,
            largest,
        ]);
        Ok(circles)
    }

    /// Eq 19 as printed: the largest signed difference from the lowest to the highest height.
    fn rise(&self, cut: &CutSurface<'_>) -> f64 {
        let (first, last) = (self.angular[0], self.angular[self.angular.len() - 1]);
        (0..self.azimuths.len())
            .map(|i| self.normal_error(cut, i, last) - self.normal_error(cut, i, first))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Largest over the azimuth of the range of E over the heights of angularity.
    fn angularity_zone(&self, cut: &CutSurface<'_>) -> f64 {
        let range = |i: usize| {
            let errors = self.angular.iter().map(|&s| self.normal_error(cut, i, s));
            let (low, high) =
                errors.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), e| (l.min(e), h.max(e)));
            high - low
        };
        (0..self.azimuths.len()).map(range).fold(0.0, f64::max)
    }

    /// Largest |E_v| at the tip, independent of the datum: it is an error of the machine.
    fn volumetric(&self, cut: &CutSurface<'_>) -> f64 {
        let contacts = self.size.heights_mm.len();
        cut.deviation_mm.iter().step_by(contacts).map(Vec3::norm).fold(0.0, f64::max)
    }
}

impl TestPiece for Cone {
    fn name(&self) -> &str {
        &self.name
    }

    fn tool_positions(&self) -> Vec<ToolPosition> {
        self.azimuths.iter().map(|a| self.tool_position(a)).collect()
    }

    fn finer_positions(&self, times: usize) -> Vec<ToolPosition> {
        let count = self.size.positions * times.max(1);
        let size = ConeSize { positions: count, ..self.size.clone() };
        (0..count).map(|number| self.tool_position(&Azimuth::new(&size, number))).collect()
    }

    fn position_count(&self) -> usize {
        self.azimuths.len()
    }

    fn contacts_per_position(&self) -> usize {
        self.size.heights_mm.len()
    }

    fn index_names(&self) -> &[IndexName] {
        &INDICES
    }

    fn evaluate(
        &self,
        cut: &CutSurface<'_>,
        scratch: &mut Scratch,
        indices_mm: &mut [f64],
    ) -> Result<(), Error> {
        self.accept(cut)?;
        let (found, expected) = (indices_mm.len(), INDICES.len());
        if found != expected {
            return Err(Error::WrongLength { what: "indices", found, expected });
        }
        self.at_height(cut, self.round, scratch, indices_mm)?;
        indices_mm[1] = self.rise(cut);
        indices_mm[ANGULARITY_ZONE] = self.angularity_zone(cut);
        indices_mm[INDICES.len() - 1] = self.volumetric(cut);
        Ok(())
    }

    fn best_fit(&self, deviation_mm: &[Vec3]) -> Datum {
        self.best_fit_of_cut(deviation_mm)
    }

    fn sections(&self, cut: &CutSurface<'_>) -> Result<Vec<PartSection>, Error> {
        self.accept(cut)?;
        let mut scratch = self.scratch();
        (0..self.size.heights_mm.len())
            .map(|section| self.section(cut, section, &mut scratch))
            .collect()
    }
}

impl Cone {
    fn tool_position(&self, azimuth: &Azimuth) -> ToolPosition {
        let contact = |(section, height): (usize, &f64)| {
            Some(Contact {
                along_axis_mm: height / self.cos,
                normal: Direction::of(azimuth.normal)?,
                section,
            })
        };
        ToolPosition {
            tip: Point::from_vector(azimuth.tip_mm),
            // Both are unit vectors by construction; Z would replace only a zero vector.
            axis: Direction::<Workpiece>::of(azimuth.axis).unwrap_or(Direction::Z),
            contacts: self.size.heights_mm.iter().enumerate().filter_map(contact).collect(),
        }
    }

    fn section(
        &self,
        cut: &CutSurface<'_>,
        section: usize,
        scratch: &mut Scratch,
    ) -> Result<PartSection, Error> {
        let mut values = [0.0; INDICES.len()];
        let circles = self.at_height(cut, section, scratch, &mut values)?;
        let height_mm = self.size.heights_mm[section];
        let known = |(k, v): (usize, &f64)| (k != ANGULARITY_ZONE).then_some(*v);
        Ok(PartSection {
            height_mm,
            z_mm: height_mm - self.size.height_mm,
            radius_mm: self.radius_mm(height_mm),
            azimuth_rad: self.azimuths.iter().map(|a| a.angle_rad).collect(),
            deviation_mm: (0..self.azimuths.len())
                .map(|i| self.normal_error(cut, i, section))
                .collect(),
            profile_mm: scratch.profile_mm.clone(),
            circles,
            indices_mm: values.iter().enumerate().map(known).collect(),
        })
    }
}

impl Azimuth {
    fn new(size: &ConeSize, number: usize) -> Self {
        let angle_rad = std::f64::consts::TAU * number as f64 / size.positions as f64;
        // A quarter turn is exactly perpendicular.
        let clean = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
        let (sin, cos) = (clean(angle_rad.sin()), clean(angle_rad.cos()));
        let (tilt_sin, tilt_cos) = size.half_angle_rad.sin_cos();
        let normal = Vec3::new(tilt_cos * cos, tilt_cos * sin, tilt_sin);
        let axis = Vec3::new(-tilt_sin * cos, -tilt_sin * sin, tilt_cos);
        let base = 0.5 * size.base_diameter_mm;
        let foot = Vec3::new(base * cos, base * sin, -size.height_mm);
        let tip_mm = foot + normal * (0.5 * size.tool_diameter_mm);
        Self { angle_rad, cos, sin, tip_mm, axis, normal }
    }
}

fn check(size: &ConeSize) -> Result<(), Error> {
    let refuse = |what: String| Err(Error::Shape { what });
    let length = |v: f64| v > 0.0 && v <= 1e6;
    if !(0.0..=1.5).contains(&size.half_angle_rad) {
        return refuse("the half angle must be from 0 to 85 deg".into());
    }
    for (name, value) in [
        ("the base diameter", size.base_diameter_mm),
        ("the height", size.height_mm),
        ("the tool diameter", size.tool_diameter_mm),
    ] {
        if !length(value) {
            return refuse(format!("{name} must be above 0 and at most 1 km"));
        }
    }
    if !(MIN_POSITIONS..=MAX_POSITIONS).contains(&size.positions) {
        return refuse(format!(
            "{} tool positions, expected {MIN_POSITIONS} to {MAX_POSITIONS}",
            size.positions
        ));
    }
    if 0.5 * size.base_diameter_mm <= size.height_mm * size.half_angle_rad.tan() {
        return refuse("the cone ends in a point below its top face".into());
    }
    check_heights(size)
}

fn check_heights(size: &ConeSize) -> Result<(), Error> {
    let refuse = |what: &str| Err(Error::Shape { what: what.to_owned() });
    let upwards = |list: &[f64]| list.windows(2).all(|w| w[0] < w[1]);
    if size.heights_mm.first() != Some(&0.0) || !upwards(&size.heights_mm) {
        return refuse("the section heights must begin with 0 (the base) and increase");
    }
    if size.heights_mm.len() > 1000 || !size.heights_mm.iter().all(|h| *h <= size.height_mm) {
        return refuse("a section is above the top face");
    }
    if size.angularity_heights_mm.len() < 2 || !upwards(&size.angularity_heights_mm) {
        return refuse("angularity needs at least two heights in increasing order");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tool_lies_along_the_generatrix() {
        let cone = Cone::new("c", ConeSize::nas979()).unwrap();
        let positions = cone.tool_positions();
        let tip = positions[0].tip.vector();
        // 125 + 10 cos 15° = 134.6593; −60 + 10 sin 15° = −57.4118
        assert!((tip - Vec3::new(134.659_258, 0.0, -57.411_810)).norm() < 1e-6);
        // From every contact the surface is one tool radius inwards, on the nominal cone.
        for position in &positions {
            for contact in &position.contacts {
                let axis = position.tip.along(position.axis, contact.along_axis_mm).vector();
                let surface = axis - contact.normal.vector() * 10.0;
                let height = cone.size.heights_mm[contact.section];
                assert!((surface.z - (height - 60.0)).abs() < 1e-12);
                assert!((surface.xy().norm() - cone.radius_mm(height)).abs() < 1e-12);
            }
        }
        assert!((positions[0].contacts[3].along_axis_mm - 62.117).abs() < 1e-3);
    }

    #[test]
    fn impossible_cones_are_refused() {
        let wrong = |change: fn(&mut ConeSize)| {
            let mut size = ConeSize::nas979();
            change(&mut size);
            matches!(Cone::new("c", size), Err(Error::Shape { .. }))
        };
        assert!(wrong(|s| s.positions = 7));
        assert!(wrong(|s| s.half_angle_rad = f64::NAN));
        assert!(wrong(|s| s.half_angle_rad = 1.3));
        assert!(wrong(|s| s.base_diameter_mm = -1.0));
        assert!(wrong(|s| s.heights_mm = vec![]));
        assert!(wrong(|s| s.heights_mm[3] = 61.0));
        assert!(wrong(|s| s.roundness_height_mm = 24.0));
        assert!(wrong(|s| s.angularity_heights_mm = vec![0.0]));
    }
}
