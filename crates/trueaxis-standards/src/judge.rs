//! Figures of an evaluation against their tolerances: docs/model.md eq. 260.
//!
//! ```
//! use trueaxis_standards::judge::{Decision, decide};
//! // 10 µm allowed: 8 ± 1 conforms, 12 ± 1 does not, 9.5 ± 1 is proved neither way.
//! assert_eq!(decide(8.0, Some(1.0), 10.0, true), Decision::Conforming);
//! assert_eq!(decide(-12.0, Some(1.0), 10.0, true), Decision::NotConforming);
//! assert_eq!(decide(9.5, Some(1.0), 10.0, true), Decision::NotProved);
//! assert_eq!(decide(9.5, None, 10.0, false), Decision::Conforming); // simple acceptance
//! ```

use crate::Evaluated;
use crate::conditions::{Conditions, Extent};
use crate::coverage::Expanded;
use crate::iso230_2::{Positioning, Quantity};
use crate::iso230_4::{Cause, Circular};
use std::path::Path;
use trueaxis_geometry::AxisKind;
use trueaxis_input::plausible::{self, Limits, Seen};
use trueaxis_input::{
    Diagnostics, Dimension, Files, Item, Place, Section, Severity, SourceText, parse_quantity,
};

/// A figure of an evaluation with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Its name in JSON, without the unit: `A`, `G_b`, `x.range`.
    pub name: String,
    /// Whether it is a length, an angle or a temperature.
    pub dimension: Dimension,
    /// Its value. Unit: mm, rad or °C.
    pub value: f64,
    /// Its uncertainty; `None` where too little is known of the instrument.
    pub uncertainty: Option<Expanded>,
    /// What it can be at most, where the readings leave that open. Unit: mm, rad or °C.
    pub at_most: Option<f64>,
}

/// A tolerance: the largest size that a figure may have.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// The figure.
    pub name: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// The limit. Unit: mm, rad or °C.
    pub limit: f64,
    /// Where it is stated.
    pub place: Place,
}

/// What a measurement proves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decision {
    /// Within the tolerance.
    Conforming,
    /// Outside of it.
    NotConforming,
    /// Neither.
    NotProved,
}

impl Decision {
    /// In JSON and in words.
    pub fn word(self) -> &'static str {
        match self {
            Self::Conforming => "conforming",
            Self::NotConforming => "not conforming",
            Self::NotProved => "neither proved",
        }
    }
}

/// A figure with its tolerance and the decision.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The figure.
    pub figure: Figure,
    /// Its tolerance. Unit: mm, rad or °C.
    pub limit: f64,
    /// By ISO 14253-1, not by simple acceptance.
    pub is_guarded: bool,
    /// The decision.
    pub decision: Decision,
}

/// The decision on the size of a value: by ISO 14253-1 conformity is proved below limit − U and the opposite above
/// limit + U; without U neither is. By simple acceptance the value alone counts.
pub fn decide(value: f64, expanded: Option<f64>, limit: f64, is_guarded: bool) -> Decision {
    let size = value.abs();
    match (is_guarded, expanded) {
        (false, _) if size <= limit => Decision::Conforming,
        (false, _) => Decision::NotConforming,
        (true, Some(u)) if size + u <= limit => Decision::Conforming,
        (true, Some(u)) if size - u > limit => Decision::NotConforming,
        (true, _) => Decision::NotProved,
    }
}

/// Every figure of an evaluation that may have a tolerance.
pub fn figures(evaluated: &Evaluated, conditions: &Conditions) -> Vec<Figure> {
    let plain = |name: String, dimension, value: Option<f64>| {
        value.map(|value| Figure { name, dimension, value, uncertainty: None, at_most: None })
    };
    match evaluated {
        Evaluated::Positioning(_, result) => positioning("", result),
        Evaluated::Circular(circle) => circular(circle, conditions),
        Evaluated::Diagonals(found) => {
            let own = found.diagonals.iter();
            let own = own.flat_map(|d| positioning(&format!("{}.", d.diagonal.name()), &d.result));
            let largest = [Quantity::E, Quantity::R, Quantity::B, Quantity::A].map(|quantity| {
                let all = found.diagonals.iter().filter_map(|d| {
                    Some((d.result.value(quantity)?, d.result.expanded_of(quantity)))
                });
                let (value, expanded) =
                    all.reduce(|a, b| if b.0.abs() > a.0.abs() { b } else { a })?;
                let name = format!("{}_d", quantity.key());
                let uncertainty = expanded.map(prescribed);
                Some(Figure {
                    name,
                    dimension: Dimension::Length,
                    value,
                    uncertainty,
                    at_most: None,
                })
            });
            largest.into_iter().flatten().chain(own).collect()
        }
        Evaluated::Drift(drift) => {
            let of_channel = drift.channels.iter().flat_map(|c| {
                let of = |name: &str, value, at_most: Option<f64>| {
                    let figure = plain(format!("{}.{name}", c.name), c.dimension, Some(value));
                    figure.map(|figure| Figure { at_most, ..figure })
                };
                [
                    of("range", c.range, None),
                    of("first_window", c.first_window, Some(c.at_most[0])),
                    of("largest_window", c.largest_window.0, Some(c.at_most[1])),
                ]
            });
            of_channel.flatten().collect()
        }
        Evaluated::Geometric(test) => {
            let of = |q: &crate::iso230_1::Quantity| Figure {
                name: q.name.clone(),
                dimension: if q.is_angle { Dimension::Angle } else { Dimension::Length },
                value: q.value,
                uncertainty: q.expanded.map(prescribed),
                at_most: None,
            };
            test.quantities.iter().map(of).collect()
        }
        Evaluated::Probing(test) => {
            let of = |q: &crate::iso230_10::ProbingQuantity| Figure {
                name: q.name.clone(),
                dimension: Dimension::Length,
                value: q.value_mm,
                uncertainty: q.expanded_mm.map(prescribed),
                at_most: None,
            };
            test.quantities.iter().map(of).collect()
        }
        Evaluated::Rotation(rotation) => {
            let of_motion = rotation.motions.iter().flat_map(|m| {
                let of = |name: &str, value| {
                    plain(format!("{}.{name}", m.sensitive.name()), Dimension::Length, value)
                };
                [
                    of("total", Some(m.total_mm)),
                    of("synchronous", Some(m.synchronous_mm)),
                    of("asynchronous", m.asynchronous_mm),
                    of("fundamental", Some(m.fundamental_mm)),
                ]
            });
            of_motion.flatten().collect()
        }
    }
}

/// U with the k = 2 that ISO/TR 230-9 prescribes for contributions that are stated, not estimated.
fn prescribed(expanded: f64) -> Expanded {
    Expanded { u: 0.5 * expanded, degrees_of_freedom: None, coverage_factor: 2.0 }
}

fn positioning(prefix: &str, result: &Positioning) -> Vec<Figure> {
    let dimension = match result.kind {
        AxisKind::Linear => Dimension::Length,
        AxisKind::Rotary => Dimension::Angle,
    };
    let of = |quantity: Quantity| {
        Some(Figure {
            name: format!("{prefix}{}", quantity.key()),
            dimension,
            value: result.value(quantity)?,
            uncertainty: result.expanded_of(quantity).map(prescribed),
            at_most: None,
        })
    };
    let vdi = &result.others.vdi3441;
    let others = [("P", vdi.p), ("Pa", vdi.pa), ("Ps", vdi.ps), ("Umax", vdi.u)];
    let others = others.into_iter().filter_map(|(name, value)| {
        let name = format!("{prefix}{name}");
        Some(Figure { name, dimension, value: value?, uncertainty: None, at_most: None })
    });
    Quantity::ALL.into_iter().filter_map(of).chain(others).collect()
}

/// G is the difference of two readings, F and D are one; what the length of the bar is not known to counts in F and D.
fn circular(circle: &Circular, conditions: &Conditions) -> Vec<Figure> {
    let device = conditions.instrument.and_then(|i| i.device_expanded);
    let u = match device {
        Some(Extent::Length(expanded)) => Some(0.5 * expanded),
        _ => None,
    };
    let length_u = conditions.circle.length_u_mm.unwrap_or(0.0);
    let known = |u: f64| Expanded { u, degrees_of_freedom: None, coverage_factor: 2.0 };
    let (two, one) =
        (u.map(|u| known(std::f64::consts::SQRT_2 * u)), u.map(|u| known(u.hypot(length_u))));
    let mut all = Vec::new();
    let mut put = |name: String, value: Option<f64>, uncertainty: Option<Expanded>| {
        let dimension = Dimension::Length;
        all.extend(value.map(|value| Figure {
            name,
            dimension,
            value,
            uncertainty,
            at_most: None,
        }));
    };
    for sense in circle.senses() {
        let (word, worst) = (sense.word(), circle.worst(Some(sense)));
        put(format!("G_{word}"), worst.map(|w| w.g_mm), two);
        put(format!("F_{word}_max"), worst.and_then(|w| w.f_mm).map(|f| f[0]), one);
        put(format!("F_{word}_min"), worst.and_then(|w| w.f_mm).map(|f| f[1]), one);
    }
    let worst = circle.worst(None);
    put("G".to_owned(), worst.map(|w| w.g_mm), two);
    put("G_b".to_owned(), circle.g_both_mm, two);
    put("F_max".to_owned(), worst.and_then(|w| w.f_mm).map(|f| f[0]), one);
    put("F_min".to_owned(), worst.and_then(|w| w.f_mm).map(|f| f[1]), one);
    put("D".to_owned(), circle.d_mm, one);
    for f in circle.diagnosis.iter().flat_map(|d| &d.found) {
        if matches!(f.cause, Cause::Unexplained) {
            continue;
        }
        let axis = f.cause.axis().map(|i| format!(".{}", circle.axes[i])).unwrap_or_default();
        let dimension =
            if f.cause == Cause::Squareness { Dimension::Angle } else { Dimension::Length };
        let name = format!("{}{axis}", f.cause.key());
        let uncertainty = Some(f.uncertainty);
        all.push(Figure { name, dimension, value: f.value, uncertainty, at_most: None });
    }
    all
}

/// Where tolerances are read from, and what they are for.
#[derive(Debug, Clone, Copy)]
pub struct ToleranceFile<'a> {
    /// The file of tolerances, if there is one.
    pub path: Option<&'a Path>,
    /// Where it lies.
    pub files: &'a Files,
    /// The axis that was measured.
    pub axis: Option<&'a str>,
    /// The figures of the evaluation.
    pub figures: &'a [Figure],
}

/// Reads tolerances: `A=10 um` each, and those of a file for the axis that was measured; what was typed has priority.
pub fn tolerances(
    typed: &[String],
    of: &ToleranceFile<'_>,
    problems: &mut Diagnostics,
) -> Vec<Tolerance> {
    let ToleranceFile { path: file, files, axis, figures } = *of;
    let place = Place::whole("--tolerance");
    let mut all: Vec<Tolerance> = Vec::new();
    for text in typed {
        let Some((name, value)) = text.split_once('=') else {
            let message = format!("`{text}` is not a figure, = and a limit");
            problems.error("bad-tolerance", place.clone(), message, "--tolerance \"A=10 um\"");
            continue;
        };
        let read = limit(value.trim(), Limits::default(), &place, problems);
        let Some((dimension, limit)) = read else { continue };
        let name = name.trim().to_owned();
        if all.iter().any(|t| t.name == name) {
            let message = format!("`{name}` has two tolerances");
            problems.error("bad-tolerance", place.clone(), message, "one for each figure");
            continue;
        }
        all.push(Tolerance { name, dimension, limit, place: place.clone() });
    }
    let what = "a file of tolerances (TOML)";
    let text = file.and_then(|path| Some((path, files.text(path, what, problems)?)));
    if let Some((path, text)) = text {
        let file = path.display().to_string();
        let source = SourceText::new(&file, &text);
        let of_file = source.read(|root| read_file(root, axis, figures));
        let read = source.finish();
        if of_file.is_empty() && !read.has_errors() {
            let of = axis.map_or(String::new(), |a| format!(" to axis {a}"));
            let message = format!("no tolerance of this file applies{of}: nothing of it is judged");
            let hint = "[tolerance] for every axis, [axis.X] for the axis that the conditions name";
            problems.warn("tolerances-unused", Place::whole(&file), message, hint);
        }
        problems.append(read);
        let is_new = |t: &Tolerance| all.iter().all(|known| known.name != t.name);
        let new: Vec<Tolerance> = of_file.into_iter().filter(is_new).collect();
        all.extend(new);
    }
    all
}

/// `[tolerance]` for every axis, `[axis.X]` for one. Where no axis is stated, a tolerance of one axis for a figure that was
/// evaluated would be left out, and the looser one of every axis taken: that is an error.
fn read_file(root: &Section<'_>, axis: Option<&str>, figures: &[Figure]) -> Vec<Tolerance> {
    root.text("name");
    root.text("source");
    let mut all: Vec<Tolerance> = Vec::new();
    let read = |s: &Section<'_>| {
        let entries = s.entries().into_iter();
        entries.filter_map(|(name, place, item)| of_item(name, place, &item)).collect::<Vec<_>>()
    };
    root.section("axis", |axes| {
        for (name, _, item) in axes.entries() {
            let own = item.section(&axes.path(name), read).unwrap_or_default();
            let meant = own.iter().find(|t| figures.iter().any(|f| f.name == t.name));
            if let (None, Some(tolerance)) = (axis, meant) {
                let message = format!(
                    "`{}` has a tolerance for axis {name}, and the readings do not say of which axis they are",
                    tolerance.name
                );
                item.error("bad-tolerance", message, "axis = \"X\" in the conditions file");
            }
            if axis.is_some_and(|a| a.eq_ignore_ascii_case(name)) {
                all.extend(own);
            }
        }
    });
    for tolerance in root.section("tolerance", read).unwrap_or_default() {
        if all.iter().all(|known| known.name != tolerance.name) {
            all.push(tolerance);
        }
    }
    all
}

fn of_item(name: &str, place: Place, item: &Item<'_>) -> Option<Tolerance> {
    let mut problems = Diagnostics::new();
    let read = limit(item.text()?, item.limits(), &item.place(), &mut problems);
    for problem in problems.iter() {
        match problem.severity {
            Severity::Error => item.error(problem.code, problem.message.clone(), &problem.hint),
            _ => item.warn(problem.code, problem.message.clone(), &problem.hint),
        }
    }
    let (dimension, limit) = read?;
    Some(Tolerance { name: name.to_owned(), dimension, limit, place })
}

/// A limit of metres lets every figure pass: it is judged as a reading of that figure would be.
fn limit(
    text: &str,
    limits: Limits,
    place: &Place,
    problems: &mut Diagnostics,
) -> Option<(Dimension, f64)> {
    let dimensions = [Dimension::Length, Dimension::Angle, Dimension::Temperature];
    let read = dimensions.into_iter().find_map(|d| Some((d, parse_quantity(text, d).ok()?)));
    match read {
        Some((dimension, limit)) if limit > 0.0 => {
            let quantity = match dimension {
                Dimension::Length => plausible::Quantity::Deviation,
                Dimension::Angle => plausible::Quantity::AngularDeviation,
                _ => return Some((dimension, limit)),
            };
            let seen = Seen::one(text, limit);
            limits.judge(quantity, &seen, place, problems).then_some((dimension, limit))
        }
        _ => {
            let message = format!("`{text}` is not a limit above zero with its unit");
            problems.error(
                "bad-tolerance",
                place.clone(),
                message,
                "such as \"10 um\", \"5 arcsec\"",
            );
            None
        }
    }
}

/// Every figure that has a tolerance, judged; a tolerance of a figure that the evaluation does not have is an error.
pub fn judge(
    figures: &[Figure],
    tolerances: &[Tolerance],
    is_guarded: bool,
    problems: &mut Diagnostics,
) -> Vec<Judged> {
    let mut judged = Vec::new();
    for tolerance in tolerances {
        let Some(figure) = figures.iter().find(|f| f.name == tolerance.name) else {
            let names: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
            let message = format!("this evaluation has no figure `{}`", tolerance.name);
            let hint = format!("its figures are {}", names.join(", "));
            problems.error("unknown-figure", tolerance.place.clone(), message, &hint);
            continue;
        };
        if figure.dimension != tolerance.dimension {
            let message = format!(
                "the tolerance of `{}` is {}, the figure is {}",
                figure.name, tolerance.dimension, figure.dimension
            );
            problems.error(
                "wrong-unit",
                tolerance.place.clone(),
                message,
                "a limit in a unit of the figure",
            );
            continue;
        }
        let expanded = figure.uncertainty.map(|u| u.expanded());
        if is_guarded && expanded.is_none() {
            let message =
                format!("U of `{}` is not known: ISO 14253-1 can prove nothing", figure.name);
            let hint =
                "state the instrument in [uncertainty] of the conditions file, or --rule simple";
            problems.warn("missing-uncertainty", tolerance.place.clone(), message, hint);
        }
        let mut decision = decide(figure.value, expanded, tolerance.limit, is_guarded);
        // What a gap may hide conforms as well, or nothing is proved.
        let at_most =
            figure.at_most.map(|most| decide(most, expanded, tolerance.limit, is_guarded));
        if decision == Decision::Conforming
            && at_most.is_some_and(|worst| worst != Decision::Conforming)
        {
            decision = Decision::NotProved;
        }
        judged.push(Judged {
            figure: figure.clone(),
            limit: tolerance.limit,
            is_guarded,
            decision,
        });
    }
    judged
}

/// The decision on all of them together.
pub fn overall(judged: &[Judged]) -> Option<Decision> {
    let worst = |a: Decision, b: Decision| match (a, b) {
        (Decision::NotConforming, _) | (_, Decision::NotConforming) => Decision::NotConforming,
        (Decision::NotProved, _) | (_, Decision::NotProved) => Decision::NotProved,
        _ => Decision::Conforming,
    };
    judged.iter().map(|j| j.decision).reduce(worst)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A of 1 µm without U.
    fn figure() -> Figure {
        Figure {
            name: "A".into(),
            dimension: Dimension::Length,
            value: 1e-3,
            uncertainty: None,
            at_most: None,
        }
    }

    #[test]
    fn a_file_has_limits_for_all_axes_and_for_one() {
        let text =
            "[tolerance]\nA = '10 um'\nR = '6 um'\n[axis.X]\nA = '8 um'\n[axis.C]\nA = '5 arcsec'";
        let read = |axis: Option<&str>| {
            let source = SourceText::new("t.toml", text);
            let all = source.read(|root| read_file(root, axis, &[figure()]));
            // Without an axis it is not known whether 10 or 8 µm hold.
            assert_eq!(source.finish().has_errors(), axis.is_none());
            all.iter().map(|t| (t.name.clone(), t.limit)).collect::<Vec<_>>()
        };
        let a = |limit: f64| ("A".to_owned(), limit);
        assert_eq!(read(None), [a(0.010), ("R".to_owned(), 0.006)]);
        assert_eq!(read(Some("x"))[0], a(0.008));
    }

    #[test]
    fn bad_tolerances_are_named() {
        let figure = figure();
        for (typed, code) in [
            ("A", "bad-tolerance"),
            ("A=-1 um", "bad-tolerance"),
            ("A=1", "bad-tolerance"),
            ("Q=1 um", "unknown-figure"),
            ("A=1 arcsec", "wrong-unit"),
            ("A=2 um", "missing-uncertainty"),
        ] {
            let mut problems = Diagnostics::new();
            let files = Files::none();
            let of = ToleranceFile { path: None, files: &files, axis: None, figures: &[] };
            let read = tolerances(&[typed.to_owned()], &of, &mut problems);
            judge(std::slice::from_ref(&figure), &read, true, &mut problems);
            assert_eq!(problems.iter().next().map(|d| d.code), Some(code), "{typed}");
        }
    }

    #[test]
    fn what_is_prescribed_is_expanded_by_two() {
        // ISO/TR 230-9: U = 2 u
        let known = prescribed(0.006);
        assert_eq!((known.u, known.coverage_factor, known.expanded()), (0.003, 2.0, 0.006));
    }

    #[test]
    fn f_of_both_senses_is_the_larger_and_the_smaller() {
        // ccw an ellipse of ±3 µm, cw one of ±1 µm about +1 µm: F from 3 to −3 and from 2 to 0
        let mut text = "x_mm,y_mm,direction\n".to_owned();
        for (word, sign, middle, half) in [("ccw", 1.0, 0.0, 3e-3), ("cw", -1.0, 1e-3, 1e-3)] {
            for i in 0..360 {
                let a = sign * f64::from(i).to_radians();
                let r = 100.0 + middle + half * (2.0 * a).cos();
                text += &format!("{},{},{word}\n", r * a.cos(), r * a.sin());
            }
        }
        let (centre_mm, radius_mm) = (Some([0.0; 2]), Some(100.0));
        let nominal = crate::conditions::Circle { centre_mm, radius_mm, ..Default::default() };
        let mut problems = Diagnostics::new();
        let found = crate::iso230_4::evaluate("c.csv", &text, nominal, &mut problems).unwrap();
        let all = figures(&Evaluated::Circular(Box::new(found)), &Conditions::default());
        let of = |name: &str| all.iter().find(|f| f.name == name).unwrap().value;
        for (name, mm) in [
            ("F_ccw_max", 3e-3),
            ("F_cw_max", 2e-3),
            ("F_ccw_min", -3e-3),
            ("F_cw_min", 0.0),
            ("F_max", 3e-3),
            ("F_min", -3e-3),
        ] {
            assert!((of(name) - mm).abs() < 2e-5, "{name}: {}", of(name));
        }
    }
}
