//! ISO 230-1: straightness, flatness, squareness and parallelism from readings of the customary instruments;
//! docs/model.md eq. 273 to 277.
//!
//! The text of the standard was not at our disposal: the definitions are those of open literature, named in
//! docs/model.md, and no clause is cited.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::conditions::Conditions;
//! use trueaxis_standards::iso230_1;
//! // 4 µm in the middle of 400 mm: 4 µm about the line through the ends.
//! let text = "position_mm,deviation_um\n0,0\n200,4\n400,0\n";
//! let (conditions, _) = Conditions::read("x.toml", "[test]\nkind = 'straightness'");
//! let found = iso230_1::evaluate("x.csv", text, &conditions, &mut Diagnostics::new()).unwrap();
//! assert!((found.judged().value - 0.004).abs() < 1e-12);
//! ```

mod lattice;
mod profile;
mod zone;

pub use lattice::Closure;
pub use profile::Profile;
pub use zone::Zone;

use crate::conditions::geometry::{Geometry, Kind, Reference};
use crate::conditions::{Conditions, Extent};
use crate::judge::{Decision, decide};
use profile::Profiles;
use trueaxis_geometry::statistics::{coverage_factor, pooled_deviation};
use trueaxis_input::sheet::{Cells, Sheet};
use trueaxis_input::{Diagnostics, Dimension, Place};

/// More rows than this are a log, not a test.
const MOST_ROWS: usize = 2000;

/// A quantity of a test.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Such as `straightness, minimum zone`, or the error `EC0Y`.
    pub name: String,
    /// The value. Unit: mm or rad.
    pub value: f64,
    /// Its expanded uncertainty; `None` if nothing is known of the readings. Unit: mm or rad.
    pub expanded: Option<f64>,
    /// Whether it is an angle.
    pub is_angle: bool,
}

/// A line as it is drawn: its deviations from the reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Which.
    pub name: String,
    /// Position, mm, and deviation, mm.
    pub points_mm: Vec<[f64; 2]>,
}

/// A test, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometric {
    /// What was asked.
    pub test: Geometry,
    /// All quantities; the one that is judged is the first.
    pub quantities: Vec<Quantity>,
    /// Pass, fail or undecided by ISO 14253-1; `None` without tolerance.
    pub outcome: Option<Decision>,
    /// The lines, about the reference.
    pub lines: Vec<Line>,
    /// The points of a surface and their deviations from the reference, mm.
    pub surface_mm: Vec<[f64; 3]>,
    /// Closure errors of the lines of a surface.
    pub closures: Vec<Closure>,
    /// The standard deviation of a reading from runs or closure, with its degrees of freedom. Unit: mm or rad.
    pub scatter: Option<(f64, f64)>,
    /// Whether angles were read.
    pub of_angles: bool,
}

impl Geometric {
    /// The quantity that the tolerance is compared with.
    pub fn judged(&self) -> &Quantity {
        &self.quantities[0]
    }
}

/// What a reading is uncertain by, and the factor of U.
#[derive(Clone, Copy)]
struct Doubt {
    u: f64,
    factor: f64,
}

impl Doubt {
    /// The larger of what is stated and what runs or closure show.
    fn of(stated: Option<Extent>, seen: Option<(f64, f64)>, of_angles: bool) -> Option<Self> {
        let stated = stated.and_then(|extent| value_of(extent, of_angles));
        match (stated, seen) {
            (Some(u), Some((s, _))) if u >= s => Some(Self { u, factor: 2.0 }),
            (_, Some((s, free))) => Some(Self { u: s, factor: coverage_factor(free) }),
            (Some(u), None) => Some(Self { u, factor: 2.0 }),
            (None, None) => None,
        }
    }

    fn expanded(self, variance: f64, other_u: f64) -> f64 {
        self.factor * (self.u * self.u * variance + other_u * other_u).sqrt()
    }
}

fn value_of(extent: Extent, angle: bool) -> Option<f64> {
    match (extent, angle) {
        (Extent::Angle(rad), true) => Some(rad),
        (Extent::Length(mm), false) => Some(mm),
        _ => None,
    }
}

/// Evaluates a test; `None` with errors in `problems`.
pub fn evaluate(
    file: &str,
    text: &str,
    conditions: &Conditions,
    problems: &mut Diagnostics,
) -> Option<Geometric> {
    let Some(test) = &conditions.test else {
        let message = "the conditions do not say which test this is".to_owned();
        let hint = "write [test] kind = \"straightness\" (flatness, squareness, parallelism) into the TOML file \
                    beside the readings";
        problems.error("missing-test", Place::whole(file), message, hint);
        return None;
    };
    let sheet = Sheet::parse(file, text, profile::cells, problems)?.with_repeats(problems);
    super::check_temperatures(&sheet, problems);
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
        let message = format!("column `{}` is not used", column.name);
        problems.warn("unused-column", column.place.clone(), message, "");
    }
    let of_angles = sheet.about("angle").is_some();
    if sheet.rows() > MOST_ROWS {
        let message = format!("{} rows are too many", sheet.rows());
        let hint = format!("at most {MOST_ROWS}; thin them");
        problems.error("too-many-readings", Place::whole(file), message, &hint);
        return None;
    }
    check_units(test, of_angles, file, problems)?;
    let mut found = match test.kind {
        Kind::Flatness => flatness(&sheet, test, problems)?,
        kind => {
            let profiles = profile::read(&sheet, test.base_mm, problems)?;
            match kind {
                Kind::Straightness => straightness(&sheet, test, &profiles, problems)?,
                Kind::Squareness => squareness(&sheet, test, &profiles, problems)?,
                _ => parallelism(&sheet, test, &profiles, problems)?,
            }
        }
    };
    if found.judged().expanded.is_none() {
        let message = "nothing is known of the uncertainty of the readings".to_owned();
        let hint = "state [test] reading_u = \"0.3 um\" (or \"1 urad\"), or read several runs";
        problems.warn("missing-uncertainty", Place::whole(file), message, hint);
    }
    found.outcome = outcome(found.judged(), test, file, problems)?;
    Some(found)
}

/// Uncertainties of the kind that the readings and the artefact have.
fn check_units(
    test: &Geometry,
    of_angles: bool,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<()> {
    let artefact_is_angle = test.kind == Kind::Squareness;
    let either = test.kind == Kind::Parallelism;
    let wrong = |extent: Option<Extent>, angle: bool| {
        extent.is_some_and(|extent| value_of(extent, angle).is_none())
    };
    let (key, wanted) = match () {
        () if wrong(test.reading_u, of_angles) => ("reading_u", of_angles),
        () if !either && wrong(test.artefact_u, artefact_is_angle) => {
            ("artefact_u", artefact_is_angle)
        }
        () => return Some(()),
    };
    let message = format!("{key} is of another kind than what it belongs to");
    let hint = if wanted { "an angle, such as \"1 urad\"" } else { "a length, such as \"0.3 um\"" };
    problems.error("wrong-unit", Place::whole(file), message, hint);
    None
}

/// ISO 14253-1: U on the side of the one who must prove.
fn outcome(
    judged: &Quantity,
    test: &Geometry,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<Option<Decision>> {
    let Some(tolerance) = test.tolerance else { return Some(None) };
    let Some(limit) = value_of(tolerance, judged.is_angle) else {
        let message = "the tolerance is of another kind than the result".to_owned();
        let hint = if judged.is_angle { "such as \"20 urad\"" } else { "such as \"8 um\"" };
        problems.error("wrong-unit", Place::whole(file), message, hint);
        return None;
    };
    Some(Some(decide(judged.value, judged.expanded, limit, true)))
}

fn empty(
    test: &Geometry,
    quantities: Vec<Quantity>,
    (scatter, of_angles): (Option<(f64, f64)>, bool),
) -> Geometric {
    Geometric {
        test: test.clone(),
        quantities,
        outcome: None,
        lines: Vec::new(),
        surface_mm: Vec::new(),
        closures: Vec::new(),
        scatter,
        of_angles,
    }
}

fn line_zone(reference: Reference, profile: &Profile) -> Zone {
    let (x, h) = (&profile.x_mm, &profile.heights_mm);
    match reference {
        Reference::MinimumZone => zone::line_minimum_zone(x, h),
        Reference::LeastSquares => zone::line_least_squares(x, h),
        Reference::Points => zone::line_end_points(x, h),
    }
}

/// The three references, the one that is asked for first.
fn references(asked: Reference, points: &'static str) -> [(Reference, &'static str); 3] {
    let mut all = [
        (Reference::MinimumZone, "minimum zone"),
        (Reference::LeastSquares, "least squares"),
        (Reference::Points, points),
    ];
    all.sort_by_key(|(reference, _)| *reference != asked);
    all
}

fn drawn(profile: &Profile, zone: &Zone) -> Line {
    let points = profile.x_mm.iter().zip(&zone.residuals_mm).map(|(x, r)| [*x, *r]);
    Line { name: profile.name.clone(), points_mm: points.collect() }
}

/// The straightness of a profile about a reference.
fn range(
    name: String,
    profile: &Profile,
    zone: &Zone,
    doubt: Option<Doubt>,
    other: f64,
) -> Quantity {
    let expanded = doubt.map(|d| d.expanded(profile.variance(&zone.weights), other));
    Quantity { name, value: zone.range_mm, expanded, is_angle: false }
}

/// The profile of the axis and, after a reversal, that of the straightedge or square.
fn reversed(first: &Profile, second: Option<&Profile>) -> (Profile, Option<Profile>) {
    match second {
        Some(second) => (first.combined(second, 1.0), Some(first.combined(second, -1.0))),
        None => (first.clone(), None),
    }
}

fn straightness(
    sheet: &Sheet,
    test: &Geometry,
    profiles: &Profiles,
    problems: &mut Diagnostics,
) -> Option<Geometric> {
    let [(_, first, second)] = &profiles.lines[..] else {
        let message = format!("the table has {} lines", profiles.lines.len());
        let hint = "straightness is that of one line; parallelism and squareness compare two";
        problems.error("wrong-lines", sheet.headings_place(), message, hint);
        return None;
    };
    let doubt = Doubt::of(test.reading_u, profiles.scatter, profiles.of_angles);
    let (mut own, artefact) = reversed(first, second.as_ref());
    let other = match (&artefact, test.artefact_u) {
        (None, Some(Extent::Length(u))) => u,
        _ => 0.0,
    };
    if test.carries_workpiece {
        // The body moves towards the tool where the tool seems to move away from it.
        own.heights_mm.iter_mut().for_each(|h| *h = -*h);
    }
    let mut quantities = Vec::new();
    let mut lines = Vec::new();
    for (reference, name) in references(test.reference, "end points") {
        let zone = line_zone(reference, &own);
        quantities.push(range(format!("straightness, {name}"), &own, &zone, doubt, other));
        if reference == test.reference {
            lines.push(drawn(&own, &zone));
        }
    }
    if let Some(mut artefact) = artefact {
        artefact.name = "straightedge".to_owned();
        let zone = line_zone(test.reference, &artefact);
        quantities.push(range("straightedge".to_owned(), &artefact, &zone, doubt, 0.0));
        lines.push(drawn(&artefact, &zone));
    }
    Some(Geometric { lines, ..empty(test, quantities, profiles.seen()) })
}

/// A slope with its variance by readings of variance 1.
fn slope(profile: &Profile) -> (f64, f64) {
    let weights = zone::slope_weights(&profile.x_mm);
    let slope = weights.iter().zip(&profile.heights_mm).map(|(w, h)| w * h).sum();
    (slope, profile.variance(&weights))
}

/// 0, 1, 2 of X, Y, Z.
fn axis_of(name: &str) -> Option<usize> {
    ["X", "Y", "Z"].iter().position(|axis| *axis == name)
}

fn squareness(
    sheet: &Sheet,
    test: &Geometry,
    profiles: &Profiles,
    problems: &mut Diagnostics,
) -> Option<Geometric> {
    let axes: Vec<Option<usize>> = profiles.lines.iter().map(|(name, ..)| axis_of(name)).collect();
    let [Some(first), Some(second)] = axes[..] else {
        let message = "squareness needs two lines, one along each of two axes".to_owned();
        let hint = "a column `axis` with X, Y or Z: the axis that moved; the deviation is in the direction of the \
                    other one";
        problems.error("wrong-lines", sheet.headings_place(), message, hint);
        return None;
    };
    let third = 3 - first - second;
    let name = format!("E{}0{}", ["A", "B", "C"][third], ["X", "Y", "Z"][second]);
    if test.error.as_ref().is_some_and(|stated| *stated != name) {
        let message = format!("the lines give {name}, not {}", test.error.as_deref().unwrap_or(""));
        let hint = "the error of the second axis of the table to the first one; exchange the lines";
        problems.error("wrong-error", sheet.headings_place(), message, hint);
        return None;
    }
    let doubt = Doubt::of(test.reading_u, profiles.scatter, profiles.of_angles);
    let mut lines = Vec::new();
    let (mut angle, mut variance, mut square) = (0.0, 0.0, 0.0);
    let mut is_reversed = true;
    for (i, (_, one, other)) in profiles.lines.iter().enumerate() {
        let (own, artefact) = reversed(one, other.as_ref());
        // A deviation of axis i towards axis k turns it by ε(i, k, third) of it.
        let (from, to) = if i == 0 { (first, second) } else { (second, first) };
        let turns = if (from + 1) % 3 == to { 1.0 } else { -1.0 };
        let of_second = if i == 0 { -1.0 } else { 1.0 };
        let (own_slope, own_variance) = slope(&own);
        angle += of_second * turns * own_slope;
        variance += own_variance;
        is_reversed &= artefact.is_some();
        square += artefact.map_or(0.0, |a| of_second * turns * slope(&a).0);
        lines.push(drawn(&own, &line_zone(test.reference, &own)));
    }
    let other = match (is_reversed, test.artefact_u) {
        (false, Some(Extent::Angle(u))) => u,
        _ => 0.0,
    };
    let of = |name: String, value: f64, other: f64| Quantity {
        name,
        value,
        expanded: doubt.map(|d| d.expanded(variance, other)),
        is_angle: true,
    };
    let mut quantities = vec![of(name, angle, other)];
    if is_reversed {
        quantities.push(of("square".to_owned(), square, 0.0));
    }
    for (line, (_, one, reversed_one)) in lines.iter().zip(&profiles.lines) {
        let (own, _) = reversed(one, reversed_one.as_ref());
        let zone = line_zone(test.reference, &own);
        quantities.push(range(format!("straightness of {}", line.name), &own, &zone, doubt, 0.0));
    }
    Some(Geometric { lines, ..empty(test, quantities, profiles.seen()) })
}

fn parallelism(
    sheet: &Sheet,
    test: &Geometry,
    profiles: &Profiles,
    problems: &mut Diagnostics,
) -> Option<Geometric> {
    let own: Vec<Profile> =
        profiles.lines.iter().map(|(_, one, other)| reversed(one, other.as_ref()).0).collect();
    let (angle, variance, length) = match &own[..] {
        [one] => {
            let (slope, variance) = slope(one);
            (slope, variance, one.x_mm[one.x_mm.len() - 1] - one.x_mm[0])
        }
        [one, two] => {
            let ((a, v), (b, w)) = (slope(one), slope(two));
            let end = |p: &Profile| p.x_mm[p.x_mm.len() - 1];
            (b - a, v + w, end(one).min(end(two)) - one.x_mm[0].max(two.x_mm[0]))
        }
        more => {
            let message = format!("the table has {} lines", more.len());
            let hint = "one line to the direction of the axis, or two lines (column `line`)";
            problems.error("wrong-lines", sheet.headings_place(), message, hint);
            return None;
        }
    };
    if length <= 0.0 {
        let message = "the two lines have no common length".to_owned();
        problems.error(
            "wrong-lines",
            sheet.headings_place(),
            message,
            "read both over the same length",
        );
        return None;
    }
    let doubt = Doubt::of(test.reading_u, profiles.scatter, profiles.of_angles);
    let artefact = match test.artefact_u {
        Some(Extent::Angle(u)) => u,
        Some(Extent::Length(u)) => u / length,
        None => 0.0,
    };
    let u = doubt.map(|d| d.expanded(variance, artefact));
    let as_angle =
        Quantity { name: "parallelism".to_owned(), value: angle, expanded: u, is_angle: true };
    let as_length = Quantity {
        name: format!("parallelism over {length:.0} mm"),
        value: angle * length,
        expanded: u.map(|u| u * length),
        is_angle: false,
    };
    let mut quantities = vec![as_length, as_angle];
    if matches!(test.tolerance, Some(Extent::Angle(_))) {
        quantities.reverse();
    }
    let mut lines = Vec::new();
    for profile in &own {
        let zone = line_zone(test.reference, profile);
        quantities.push(range(
            format!("straightness of {}", profile.name),
            profile,
            &zone,
            doubt,
            0.0,
        ));
        let mean = profile.heights_mm.iter().sum::<f64>() / profile.heights_mm.len() as f64;
        let points = profile.x_mm.iter().zip(&profile.heights_mm).map(|(x, h)| [*x, h - mean]);
        lines.push(Line { name: profile.name.clone(), points_mm: points.collect() });
    }
    Some(Geometric { lines, ..empty(test, quantities, profiles.seen()) })
}

/// The heights of a surface, however they were read.
struct Surface {
    at_mm: Vec<[f64; 2]>,
    heights_mm: Vec<f64>,
    lattice: Option<lattice::Lattice>,
    /// Readings of each height.
    counts: Vec<f64>,
    scatter: Option<(f64, f64)>,
}

impl Surface {
    fn variance(&self, weights: &[f64]) -> f64 {
        match &self.lattice {
            Some(lattice) => lattice.variance(weights),
            None => weights.iter().zip(&self.counts).map(|(w, n)| w * w / n).sum(),
        }
    }
}

fn points(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Surface> {
    let mut read = |role: &str| {
        let column = sheet.about(role);
        if column.is_none() {
            let message = format!("the table has no column `{role}`");
            let hint = "x_mm, y_mm and z_um of points";
            problems.error("missing-column", sheet.headings_place(), message, hint);
        }
        sheet.inner(column?, Dimension::Length, problems)
    };
    let (x, y, z) = (read("x")?, read("y")?, read("z")?);
    let mut groups: Vec<([f64; 2], Vec<f64>)> = Vec::new();
    for ((x, y), z) in x.into_iter().zip(y).zip(z) {
        match groups.iter_mut().find(|(at, _)| *at == [x, y]) {
            Some((_, values)) => values.push(z),
            None => groups.push(([x, y], vec![z])),
        }
    }
    let mean = |v: &Vec<f64>| v.iter().sum::<f64>() / v.len() as f64;
    Some(Surface {
        at_mm: groups.iter().map(|(at, _)| *at).collect(),
        heights_mm: groups.iter().map(|(_, v)| mean(v)).collect(),
        lattice: None,
        counts: groups.iter().map(|(_, v)| v.len() as f64).collect(),
        scatter: pooled_deviation(groups.iter().map(|(_, v)| v.as_slice())),
    })
}

fn flatness(sheet: &Sheet, test: &Geometry, problems: &mut Diagnostics) -> Option<Geometric> {
    let of_angles = sheet.about("angle").is_some();
    let surface = match of_angles {
        false => points(sheet, problems)?,
        true => {
            let found = lattice::read(sheet, test.base_mm, test.gravity, problems)?;
            Surface {
                at_mm: found.at_mm.clone(),
                heights_mm: found.heights_mm.clone(),
                counts: Vec::new(),
                scatter: found.scatter,
                lattice: Some(found),
            }
        }
    };
    let (at, heights) = (&surface.at_mm, &surface.heights_mm);
    let doubt = Doubt::of(test.reading_u, surface.scatter, of_angles);
    let other = match test.artefact_u {
        Some(Extent::Length(u)) => u,
        _ => 0.0,
    };
    let three = three_points(at, test.points_mm);
    let mut quantities = Vec::new();
    let mut shown = None;
    for (reference, name) in references(test.reference, "three points") {
        let zone = match reference {
            Reference::MinimumZone => zone::plane_minimum_zone(at, heights),
            Reference::LeastSquares => zone::plane_least_squares(at, heights),
            Reference::Points => zone::plane_three_points(at, heights, three),
        };
        let Some(zone) = zone else {
            let message = format!("these points determine no plane ({name})");
            let hint = "at least four points, not all on one line";
            problems.error("no-plane", sheet.headings_place(), message, hint);
            return None;
        };
        let expanded = doubt.map(|d| d.expanded(surface.variance(&zone.weights), other));
        let name = format!("flatness, {name}");
        quantities.push(Quantity { name, value: zone.range_mm, expanded, is_angle: false });
        shown = shown.or(Some(zone));
    }
    let residuals = shown?.residuals_mm;
    let mut found = empty(test, quantities, (surface.scatter, of_angles));
    found.surface_mm = at.iter().zip(&residuals).map(|([x, y], r)| [*x, *y, *r]).collect();
    if let Some(lattice) = &surface.lattice {
        found.closures.clone_from(&lattice.closures);
        for (name, nodes) in &lattice.lines {
            let end = lattice::end_of(at, nodes);
            let away = |i: &usize| (at[*i][0] - end[0]).hypot(at[*i][1] - end[1]);
            let mut points_mm: Vec<[f64; 2]> =
                nodes.iter().map(|i| [away(i), residuals[*i]]).collect();
            points_mm.sort_by(|a, b| a[0].total_cmp(&b[0]));
            found.lines.push(Line { name: name.clone(), points_mm });
        }
    }
    Some(found)
}

/// The points that are stated, or those nearest to three corners of the region.
fn three_points(at: &[[f64; 2]], stated: Option<[[f64; 2]; 3]>) -> [usize; 3] {
    let bound =
        |k: usize, start: f64, of: fn(f64, f64) -> f64| at.iter().map(|p| p[k]).fold(start, of);
    let low = [0, 1].map(|k| bound(k, f64::INFINITY, f64::min));
    let high = [0, 1].map(|k| bound(k, f64::NEG_INFINITY, f64::max));
    let corners = [low, [high[0], low[1]], [low[0], high[1]]];
    stated.unwrap_or(corners).map(|corner| {
        let away = |i: &usize| (at[*i][0] - corner[0]).hypot(at[*i][1] - corner[1]);
        (0..at.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    })
}
