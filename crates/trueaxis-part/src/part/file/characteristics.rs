//! Characteristics of the part file: what is asked of which feature, to which datums.

use super::positive;
use crate::part::datum::{all_degrees, described, held};
use crate::part::{Characteristic, Datum, Feature, Geometry, Kind, Limits};
use trueaxis_form::placed::Freedom;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Dimension, Item, Section};

/// Directions of a nominal part that differ by less are the same. Unit: rad.
const SAME_RAD: f64 = 1e-6;
/// Nominal axes that lie nearer to each other are one. Unit: mm.
const SAME_MM: f64 = 1e-3;
/// Degrees that one datum may hold.
const MOST_HELD: usize = 5;

pub(super) fn read_characteristic(
    section: &Section<'_>,
    features: &[Feature],
    complete: bool,
) -> Option<Characteristic> {
    let stated: Vec<(Kind, Item<'_>)> = Kind::ALL
        .into_iter()
        .filter_map(|kind| section.get(kind.key()).map(|i| (kind, i)))
        .collect();
    for word in ["maximum_material", "least_material", "envelope", "projected"] {
        if section.get(word).is_some() {
            material_condition(section, &format!("`{word}`"));
        }
    }
    let named = |key: &str, word: &str| {
        let is_meant = |f: &Feature| f.name == word || f.letter.as_deref() == Some(word);
        let found = features.iter().position(is_meant);
        // A feature with a mistake of its own is not called unknown.
        if found.is_none() && complete {
            let known: Vec<&str> = features.iter().map(|f| f.name.as_str()).collect();
            let message = format!("`{key}`: the part has no feature `{word}`");
            let hint = format!("its features: {}", known.join(", "));
            section.error("unknown-feature", message, &hint);
        }
        found
    };
    let feature = section
        .require("of", "the name of a feature: of = \"top\"")
        .and_then(|item| item.text())
        .and_then(|word| {
            let is_member = |f: &Feature| f.pattern.as_deref() == Some(word);
            let members: Vec<usize> =
                (0..features.len()).filter(|i| is_member(&features[*i])).collect();
            match members.is_empty() {
                true => named("of", word).map(|one| (features[one].name.as_str(), vec![one])),
                false => Some((word, members)),
            }
        });
    let datums: Option<Vec<Datum>> = match section.get("datum") {
        None => Some(Vec::new()),
        Some(item) => datum_words(&item).and_then(|words| {
            let datum = |word: &String| {
                let parts = parts_of(word, features);
                let all: Vec<Option<usize>> = parts.iter().map(|w| named("datum", w)).collect();
                all.into_iter().collect::<Option<Vec<usize>>>().map(|features| Datum { features })
            };
            let all: Vec<Option<Datum>> = words.iter().map(datum).collect();
            all.into_iter().collect()
        }),
    };
    let name = section.text("name").map(str::to_owned);
    let [(kind, item)] = stated[..] else {
        let known: Vec<&str> = Kind::ALL.iter().map(|k| k.key()).collect();
        let message = format!("{} characteristics are stated, expected one", stated.len());
        section.error("one-characteristic", message, &format!("one of {}", known.join(", ")));
        return None;
    };
    let limits = read_limits(&item, kind);
    let ((of, members), datums) = (feature?, datums?);
    for member in &members {
        let is_pattern = members.len() > 1;
        Asked { section, features, kind, of: &features[*member], is_pattern }.check(&datums)?;
    }
    let name = name.unwrap_or_else(|| {
        let labels: Vec<String> = datums.iter().map(|d| d.label(features)).collect();
        match labels[..] {
            [] => format!("{} of {of}", kind.name()),
            _ => format!("{} of {of} to {}", kind.name(), labels.join("|")),
        }
    });
    let of = of.to_owned();
    Some(Characteristic { name, kind, of, features: members, datums, limits: limits? })
}

/// The names that a datum is made of: itself, the members of a pattern, or what dashes divide, `A-B`.
fn parts_of<'w>(word: &'w str, features: &'w [Feature]) -> Vec<&'w str> {
    let is_one = |f: &Feature| f.name == word || f.letter.as_deref() == Some(word);
    if features.iter().any(is_one) || word.split('-').any(str::is_empty) {
        return vec![word];
    }
    let is_member = |f: &&Feature| f.pattern.as_deref() == Some(word);
    let members: Vec<&str> = features.iter().filter(is_member).map(|f| f.name.as_str()).collect();
    match members.is_empty() {
        false => members,
        true if word.contains('-') => {
            word.split('-').map(str::trim).flat_map(|part| parts_of(part, features)).collect()
        }
        true => vec![word],
    }
}

fn material_condition(section: &Section<'_>, what: &str) {
    let message = format!("{what}: zones with material conditions are not judged");
    section.error("material-condition", message, "leave it out and judge the zone without it");
}

/// `"A|B|C"`, or a list of names.
fn datum_words(item: &Item<'_>) -> Option<Vec<String>> {
    let words: Vec<String> = match item.is_list() {
        true => {
            let list = item.list()?;
            let words: Option<Vec<String>> =
                list.iter().map(|i| i.text().map(str::to_owned)).collect();
            words?
        }
        false => item.text()?.split('|').map(|w| w.trim().to_owned()).collect(),
    };
    for word in &words {
        let is_material = ["Ⓜ", "Ⓛ", "(M)", "(L)"].iter().any(|sign| word.contains(sign));
        if is_material {
            let message =
                format!("datum `{word}`: datums with material conditions are not evaluated");
            item.error("material-condition", message, "name the datum without it");
            return None;
        }
    }
    if words.is_empty() || words.len() > 3 || words.iter().any(String::is_empty) {
        let message = format!("a datum system has one to three datums, not {}", words.len());
        item.error(
            "bad-datum",
            message,
            "datum = \"A\", of a system \"A|B|C\", of a common datum \"A-B\"",
        );
        return None;
    }
    Some(words)
}

/// `"20 um"`, for a size `"±20 um"` or `["-10 um", "25 um"]`.
fn read_limits(item: &Item<'_>, kind: Kind) -> Option<Limits> {
    if !kind.is_size() {
        return positive(item, kind.key()).map(|tolerance_mm| Limits::Zone { tolerance_mm });
    }
    let limits = match item.is_list() {
        true => {
            let list = item.list()?;
            let both: Vec<Option<f64>> =
                list.iter().map(|i| i.quantity(Dimension::Length)).collect();
            match both[..] {
                [Some(low_mm), Some(high_mm)] => Some((low_mm, high_mm)),
                _ => None,
            }
        }
        false => item.quantity(Dimension::Length).map(|v| (-v, v)),
    };
    match limits {
        Some((low_mm, high_mm)) if low_mm < high_mm => Some(Limits::Size { low_mm, high_mm }),
        _ => {
            let hint = "\"20 um\" for either way, or [\"-10 um\", \"25 um\"]";
            let message = "limits of a size are a lower and an upper deviation".to_owned();
            item.error("bad-limits", message, hint);
            None
        }
    }
}

/// What a kind asks of its feature and its datums.
struct Asked<'a, 's> {
    section: &'a Section<'s>,
    features: &'a [Feature],
    kind: Kind,
    of: &'a Feature,
    /// Whether other features have the same place to each other.
    is_pattern: bool,
}

impl Asked<'_, '_> {
    fn refuse(&self, code: &'static str, message: String, hint: &str) -> Option<()> {
        self.section.error(code, message, hint);
        None
    }

    fn check(&self, datums: &[Datum]) -> Option<()> {
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
            Kind::Profile => true,
            Kind::Width | Kind::Symmetry => of.geometry.median().is_some(),
            Kind::Parallelism | Kind::Perpendicularity | Kind::Angularity | Kind::Position => {
                of.geometry.direction().is_some()
            }
        };
        if fits {
            return Some(());
        }
        let shape = of.geometry.name();
        let message = format!("{} is not asked of a {shape}: `{}`", kind.name(), of.name);
        self.refuse("wrong-feature", message, "choose another feature or another characteristic")
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
            Kind::Symmetry => true,
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
