//! Whether a characteristic can be asked of its feature, to its datums.

use crate::part::datum::{all_degrees, described, held};
use crate::part::{Datum, Feature, Geometry, Kind};
use trueaxis_form::placed::Freedom;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Item, Section};

/// Directions of a nominal part that differ by less are the same. Unit: rad.
const SAME_RAD: f64 = 1e-6;
/// Nominal axes that lie nearer to each other are one. Unit: mm.
const SAME_MM: f64 = 1e-3;
/// A projected zone is at most so many times as long as the feature: farther away its direction says nothing.
const MOST_PROJECTED: f64 = 20.0;
/// Degrees that one datum may hold.
const MOST_HELD: usize = 5;

/// What a kind asks of its feature and its datums.
pub(super) struct Asked<'a, 's> {
    pub section: &'a Section<'s>,
    pub features: &'a [Feature],
    pub kind: Kind,
    pub of: &'a Feature,
    /// Whether other features have the same place to each other.
    pub is_pattern: bool,
}

impl Asked<'_, '_> {
    fn refuse(&self, code: &'static str, message: String, hint: &str) -> Option<()> {
        self.section.error(code, message, hint);
        None
    }

    /// Whether all of it fits; what does not is an error.
    pub fn check(&self, datums: &[Datum]) -> Option<()> {
        self.check_feature()?;
        let (kind, of) = (self.kind, self.of);
        if datums.is_empty() {
            if kind.needs_datum() {
                let message = format!("{} needs a datum", kind.name());
                return self.refuse(
                    "wrong-feature",
                    message,
                    "datum = \"NAME\" of another feature",
                );
            }
            return Some(());
        }
        if matches!(of.geometry, Geometry::Programmed { .. }) {
            let message = format!("`{}` counts from the zero that was set", of.name);
            return self.refuse("bad-datum", message, "leave `datum` out");
        }
        if kind.is_alone() {
            let message = format!("{} has no datum: it is of `{}` alone", kind.name(), of.name);
            return self.refuse("wrong-feature", message, "leave `datum` out");
        }
        let all: Vec<usize> = datums.iter().flat_map(|d| d.features.iter().copied()).collect();
        for (rank, datum) in all.iter().enumerate() {
            let datum = &self.features[*datum];
            if std::ptr::eq(datum, of) {
                let message = format!("`{}` is its own datum", of.name);
                return self.refuse("wrong-feature", message, "name another feature");
            }
            if all[..rank].iter().any(|d| std::ptr::eq(&self.features[*d], datum)) {
                let message = format!("the datum `{}` is named twice", datum.label());
                return self.refuse("bad-datum", message, "name each datum once");
            }
            self.check_datum(datum, datums.len())?;
        }
        if matches!(self.kind, Kind::Coaxiality | Kind::CircularRunOut | Kind::TotalRunOut) {
            for datum in &all {
                self.check_axes(&self.features[*datum])?;
            }
            return Some(());
        }
        if kind == Kind::Symmetry {
            self.check_median(&datums[0])?;
        }
        let free = self.freedom(datums)?;
        if kind.is_oriented() { self.check_angle(datums, &free) } else { self.check_place(&free) }
    }

    fn check_feature(&self) -> Option<()> {
        let (kind, of) = (self.kind, self.of);
        let is_plane = matches!(of.geometry, Geometry::Plane { .. });
        let is_cylinder = matches!(of.geometry, Geometry::Cylinder { .. });
        let fits = match kind {
            Kind::Flatness => is_plane,
            Kind::Roundness | Kind::Coaxiality | Kind::Straightness => of.geometry.axis().is_some(),
            Kind::Cylindricity | Kind::Diameter | Kind::CircularRunOut => is_cylinder,
            Kind::TotalRunOut => is_cylinder || is_plane,
            Kind::LineStraightness => is_plane || of.geometry.axis().is_some(),
            Kind::LineProfile => of.geometry.across_rows().is_some(),
            Kind::Profile => true,
            Kind::Width | Kind::Symmetry => of.geometry.median().is_some(),
            Kind::Parallelism | Kind::Perpendicularity | Kind::Angularity | Kind::Position => {
                of.geometry.direction().is_some()
            }
        };
        if fits {
            return self.check_points();
        }
        let shape = of.geometry.name();
        let message = format!("{} is not asked of a {shape}: `{}`", kind.name(), of.name);
        self.refuse("wrong-feature", message, "choose another feature or another characteristic")
    }

    /// A thread is judged by its axis, what needs sections is not asked of a helix.
    fn check_points(&self) -> Option<()> {
        let (kind, of) = (self.kind, self.of);
        let is_of_axis =
            kind == Kind::Position || kind == Kind::Coaxiality || kind == Kind::Straightness;
        if of.is_thread && !(is_of_axis || kind.is_oriented()) {
            let message = format!("{} is not asked of a thread: `{}`", kind.name(), of.name);
            let hint = "position, coaxiality, straightness and orientation of its axis; a gauge judges its flanks";
            return self.refuse("wrong-feature", message, hint);
        }
        let needs_sections = matches!(
            kind,
            Kind::Roundness
                | Kind::Straightness
                | Kind::CircularRunOut
                | Kind::LineStraightness
                | Kind::LineProfile
        );
        if needs_sections && of.geometry.axis().is_some() && of.sections.is_empty() {
            let message = format!(
                "{} needs sections, the points of `{}` lie on a helix",
                kind.name(),
                of.name
            );
            return self.refuse(
                "wrong-feature",
                message,
                "extraction = { sections = 4, points = 12 }",
            );
        }
        Some(())
    }

    /// A projected zone is about the axis of a cylinder, and no longer than a bolt.
    pub fn check_projected(&self, item: &Item<'_>, mm: f64) -> Option<()> {
        let Geometry::Cylinder { length_mm, .. } = self.of.geometry else {
            let message =
                format!("a projected zone of a {}: `{}`", self.of.geometry.name(), self.of.name);
            return self.refuse("wrong-feature", message, "of a cylinder or a hole only");
        };
        if !(self.kind.is_oriented() || self.kind == Kind::Position) {
            let message = format!("{} has no projected zone", self.kind.name());
            return self.refuse("wrong-feature", message, "position and orientation have one");
        }
        let most_mm = MOST_PROJECTED * length_mm;
        if mm == 0.0 || mm.abs() > most_mm {
            let message = format!(
                "a zone projected by {mm} mm from an axis of {length_mm} mm, expected up to {most_mm} mm either way"
            );
            item.error(
                "bad-projection",
                message,
                "projected = \"20 mm\" beyond the end of the axis, \"-20 mm\" beyond its beginning",
            );
            return None;
        }
        Some(())
    }

    fn check_datum(&self, datum: &Feature, count: usize) -> Option<()> {
        let kind = self.kind;
        let is_axis = matches!(kind, Kind::Coaxiality | Kind::CircularRunOut | Kind::TotalRunOut);
        if is_axis && count > 1 {
            let message = format!("{} to more than one datum is not evaluated", kind.name());
            return self.refuse("bad-datum", message, "name the datum axis alone");
        }
        let fits = match datum.geometry {
            Geometry::Cylinder { .. } => true,
            Geometry::Plane { .. } | Geometry::Slot { .. } => !is_axis,
            Geometry::Sphere { .. } => count > 1 || kind.is_located(),
            _ => false,
        };
        if fits {
            return Some(());
        }
        let shape = datum.geometry.name();
        let message = format!("a {shape} is no datum of {}: `{}`", kind.name(), datum.name);
        let hint =
            "a cylinder or a hole, for directions a plane or a slot, in a system a sphere, too";
        self.refuse("wrong-feature", message, hint)
    }

    /// Nominal axes are one, and a face stands across it.
    fn check_axes(&self, datum: &Feature) -> Option<()> {
        let axes = self.of.geometry.direction().zip(datum.geometry.axis());
        let Some((own, (at, axis))) = axes else { return Some(()) };
        let (kind, name) = (self.kind.name(), &self.of.name);
        if own.cross(&axis).norm() > SAME_RAD {
            let angle = own.dot(&axis).abs().min(1.0).acos().to_degrees();
            let message =
                format!("{kind}: `{name}` stands at {angle:.3}° to the axis of `{}`", datum.name);
            return self.refuse(
                "wrong-angle",
                message,
                "an axis along that of the datum, a face across it",
            );
        }
        let arm = self.of.geometry.axis().map_or(Vec3::zeros(), |(place, _)| place - at);
        let off_mm = (arm - axis * arm.dot(&axis)).norm();
        if off_mm > SAME_MM {
            let message = format!(
                "{kind}: the axis of `{name}` lies {off_mm:.3} mm beside that of `{}`",
                datum.name
            );
            return self.refuse(
                "wrong-place",
                message,
                "coaxial features only; position for others",
            );
        }
        Some(())
    }

    /// The nominal median plane is that of the first datum, or has its axis in it.
    fn check_median(&self, datum: &Datum) -> Option<()> {
        let Some(Geometry::Plane { at_mm, normal, .. }) = self.of.geometry.median() else {
            return Some(());
        };
        let (name, of) = (datum.name(self.features), &self.of.name);
        // How far it is turned, and how far off; of a common datum the middle of its features is meant.
        let mut off_mm = 0.0;
        let mut turned = 0.0_f64;
        for member in &datum.features {
            let (angle, place) = match self.features[*member].geometry {
                Geometry::Plane { at_mm: at, normal: other, .. }
                | Geometry::Slot { at_mm: at, across: other, .. } => {
                    (normal.cross(&other).norm(), at)
                }
                other => match other.axis() {
                    Some((at, axis)) => (normal.dot(&axis).abs(), at),
                    None => return Some(()),
                },
            };
            turned = turned.max(angle);
            off_mm += normal.dot(&(place - at_mm)) / datum.features.len() as f64;
        }
        if turned > SAME_RAD || off_mm.abs() > SAME_MM {
            let message = format!("symmetry: the middle of `{of}` is not that of `{name}`");
            return self.refuse("wrong-place", message, "position for features beside each other");
        }
        Some(())
    }

    /// What the datums leave free; each of them must hold something.
    fn freedom(&self, datums: &[Datum]) -> Option<Freedom> {
        let mut free = all_degrees(self.features);
        for (rank, datum) in datums.iter().enumerate() {
            let members = datum.features.iter().map(|f| &self.features[*f]);
            let rest = free.held_by(&members.flat_map(held).collect::<Vec<_>>());
            let label = datum.label(self.features);
            if rest.degrees() == free.degrees() {
                let before: Vec<String> =
                    datums[..rank].iter().map(|d| d.label(self.features)).collect();
                let message = format!(
                    "the datum `{label}` holds nothing that {} leaves free",
                    before.join("|")
                );
                self.refuse("idle-datum", message, "leave it out, or name another feature");
                return None;
            }
            if free.degrees() - rest.degrees() > MOST_HELD {
                let message = format!("the common datum `{label}` holds all six degrees at once");
                self.refuse("bad-datum", message, "a system in an order: datum = \"A|B|C\"");
                return None;
            }
            free = rest;
        }
        Some(free)
    }

    /// The nominal feature stands at the angle that the characteristic means.
    fn check_angle(&self, datums: &[Datum], free: &Freedom) -> Option<()> {
        let first = &self.features[datums[0].features[0]];
        let directions = self.of.geometry.direction().zip(first.geometry.direction());
        let Some((own, other)) = directions else {
            let message = format!("`{}` has no direction", first.name);
            return self.refuse("wrong-feature", message, "begin with a plane or a cylinder");
        };
        let angle = trueaxis_geometry::angle(&own, &other);
        let angle = angle.min(std::f64::consts::PI - angle);
        let right = std::f64::consts::FRAC_PI_2;
        // Between surfaces and axes: a plane lies across its normal.
        let is_plane = |f: &Feature| f.geometry.is_flat();
        let between = if is_plane(self.of) == is_plane(first) { angle } else { right - angle };
        let fits = match self.kind {
            Kind::Parallelism => between < SAME_RAD,
            Kind::Perpendicularity => right - between < SAME_RAD,
            _ => true,
        };
        if !fits {
            let message = format!(
                "{}: `{}` stands at {:.3}° to `{}`",
                self.kind.name(),
                self.of.name,
                between.to_degrees(),
                first.name
            );
            let hint = "parallelism is 0°, perpendicularity 90°, anything else angularity";
            return self.refuse("wrong-angle", message, hint);
        }
        let is_system = datums.len() > 1 || self.kind == Kind::Angularity;
        if !is_system || is_plane(self.of) {
            return Some(());
        }
        match free.twists().iter().find(|t| t.turn.cross(&own).norm() > 1e-6) {
            None => Some(()),
            Some(twist) => self.free("turns its axis", &described(twist)),
        }
    }

    /// Nothing that the datums leave free moves the zone.
    fn check_place(&self, free: &Freedom) -> Option<()> {
        // A pattern is laid where it fits best, as a whole (ISO 5458); the middle of a slot about an axis, too.
        let floats = match self.kind {
            Kind::Position => self.is_pattern,
            // Each line is laid for itself where it fits best.
            Kind::Symmetry | Kind::LineProfile => true,
            _ => false,
        };
        if !self.kind.is_located() || floats {
            return Some(());
        }
        match free.moving(&held(self.of)).twists().first() {
            None => Some(()),
            Some(twist) => self.free("moves it", &described(twist)),
        }
    }

    fn free(&self, does: &str, motion: &str) -> Option<()> {
        let message = format!(
            "{} of `{}`: the datums leave free what {does}: {motion}",
            self.kind.name(),
            self.of.name
        );
        self.refuse("free-degree", message, "name a further datum that holds it")
    }
}
