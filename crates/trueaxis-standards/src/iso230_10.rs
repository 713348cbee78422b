//! Probing performance after ISO 230-10: contacting probes that measure single points; docs/model.md eq. 280 to 283.
//!
//! The text of the standard was not available. Its catalogue page states what it covers (7.1: touch trigger
//! and scanning probes in discrete-point mode); the quantities are those that literature gives for the same
//! tests of coordinate measuring machines, and ours where nothing was found. docs/model.md says which.
//!
//! ```
//! use trueaxis_input::Diagnostics;
//! use trueaxis_standards::conditions::Conditions;
//! use trueaxis_standards::iso230_10;
//! // Four points of a ring, one of them 4 µm out: the least-squares circle shares it out.
//! let text = "test,x_mm,y_mm\nring,10.004,0\nring,0,10\nring,-10,0\nring,0,-10\n";
//! let mut problems = Diagnostics::new();
//! let found = iso230_10::evaluate("p.csv", text, &Conditions::default(), &mut problems).unwrap();
//! assert!((found.quantities[0].value_mm - 0.002).abs() < 1e-6);
//! ```

mod sphere;

use crate::conditions::Conditions;
use crate::conditions::probing::ProbingTest;
use crate::judge::{Decision, decide};
use trueaxis_form::circle;
use trueaxis_geometry::statistics::coverage_factor;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension, MeasuredValue, Place};

/// Fewer points of a ring show no lobes.
const FEW_RING: usize = 12;
/// So many points of a sphere are usual.
const SPHERE: usize = 25;

/// A quantity of a probing test.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbingQuantity {
    /// Its name.
    pub name: String,
    /// Its value, mm.
    pub value_mm: f64,
    /// Its expanded uncertainty, 95 %, mm; `None` of a range of repeated readings, or if it is not known.
    pub expanded_mm: Option<f64>,
    /// What is allowed, mm.
    pub limit_mm: Option<f64>,
    /// The decision.
    pub outcome: Option<Decision>,
}

/// The deviations of a ring or a sphere from its least-squares element.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviations {
    /// Which.
    pub name: String,
    /// Angle in the plane x y, height angle, and deviation of the radius. Unit: mm or rad.
    pub points: Vec<[f64; 3]>,
    /// Whether it is a sphere.
    pub is_sphere: bool,
}

/// A probing test, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Probing {
    /// All quantities.
    pub quantities: Vec<ProbingQuantity>,
    /// Ring and sphere.
    pub deviations: Vec<Deviations>,
    /// Standard deviation of a hit at one point, mm, with its degrees of freedom.
    pub scatter: Option<(f64, f64)>,
}

impl Probing {
    /// Whether everything that has a tolerance is within it.
    pub fn is_yes(&self) -> bool {
        self.quantities.iter().all(|q| q.outcome.is_none_or(|o| o == Decision::Conforming))
    }
}

fn cells(name: &str) -> Cells {
    match heading(name).0 {
        "x" | "y" | "z" | "orientation" | "time" | "temperature" => Cells::Numbers,
        "test" | "direction" | "run" => Cells::Words,
        _ => Cells::Unused,
    }
}

/// A row: which test, in which group, where.
struct Row {
    test: String,
    group: String,
    turn_deg: Option<i64>,
    at_mm: [f64; 3],
    place: Place,
}

/// Reads and evaluates the readings; `None` with errors in `problems`.
pub fn evaluate(
    file: &str,
    text: &str,
    conditions: &Conditions,
    problems: &mut Diagnostics,
) -> Option<Probing> {
    let sheet = once(&Sheet::parse(file, text, cells, problems)?, problems);
    super::check_temperatures(&sheet, problems);
    let known = ["angle", "i", "j", "k"];
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
        if !known.contains(&column.role()) {
            let message = format!("column `{}` is not used", column.name);
            problems.warn("unused-column", column.place.clone(), message, "");
        }
    }
    let rows = rows(&sheet, problems)?;
    let none = ProbingTest::default();
    let test = conditions.probing.as_ref().unwrap_or(&none);
    let of = |name: &str| -> Vec<&Row> { rows.iter().filter(|r| r.test == name).collect() };
    let mut found = Probing { quantities: Vec::new(), deviations: Vec::new(), scatter: None };
    points(&of("point"), test, &mut found, problems)?;
    tools(&of("tool"), test, &mut found);
    let doubt = Doubt::of(test, found.scatter);
    ring(&of("ring"), test, doubt, &mut found, problems)?;
    ball(&of("sphere"), test, doubt, &mut found, problems)?;
    if found.quantities.is_empty() {
        let message = "the table has no readings of a test".to_owned();
        let hint = "a column `test` with point, tool, ring or sphere";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    }
    Some(found)
}

/// Without copies: of points around a ring or a ball none is hit twice alike; hits of one point may read the same, unless
/// the whole table was pasted again.
fn once(sheet: &Sheet, problems: &mut Diagnostics) -> Sheet {
    let sheet = sheet.with_repeats(problems);
    let test = sheet.columns.iter().find(|c| c.name == "test" && c.cells == Cells::Words);
    let is_of_one_point = |row: usize| {
        test.is_some_and(|c| ["point", "tool"].contains(&&*sheet.words[c.values[row] as usize]))
    };
    sheet.with_copies_once_of(|row| !is_of_one_point(row), problems)
}

fn rows(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Vec<Row>> {
    let words = |name: &str| {
        let column = sheet.columns.iter().find(|c| c.name == name && c.cells == Cells::Words);
        let word = |row: usize| column.map(|c| sheet.words[c.values[row] as usize].clone());
        (0..sheet.rows()).map(word).collect::<Vec<_>>()
    };
    let mut numbers = |role: &str| match sheet.about(role) {
        Some(column) => sheet.inner(column, Dimension::Length, problems).map(Some),
        None => Some(None),
    };
    let (x, y, z) = (numbers("x")?, numbers("y")?, numbers("z")?);
    let turns = match sheet.about("orientation") {
        Some(column) => Some(sheet.inner(column, Dimension::Angle, problems)?),
        None => None,
    };
    let (test, direction, run) = (words("test"), words("direction"), words("run"));
    let usual = if z.is_some() { "sphere" } else { "ring" };
    let mut rows = Vec::new();
    for row in 0..sheet.rows() {
        let name = test[row].clone().unwrap_or_else(|| usual.to_owned());
        let place = sheet.row_place(row);
        if !["point", "tool", "ring", "sphere"].contains(&name.as_str()) {
            let message = format!("`{name}` is no test of a probe");
            problems.error("unknown-word", place, message, "point, tool, ring or sphere");
            return None;
        }
        let needed = if name == "ring" { &[&x, &y][..] } else { &[&x, &y, &z][..] };
        if needed.iter().any(|column| column.is_none()) {
            let message = format!("the rows of `{name}` need more columns");
            let hint = "x_mm and y_mm of a ring; x_mm, y_mm and z_mm otherwise";
            problems.error("missing-column", sheet.headings_place(), message, hint);
            return None;
        }
        let of = |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |c| c[row]);
        rows.push(Row {
            group: match name.as_str() {
                "point" => direction[row].clone().unwrap_or_default(),
                _ => run[row].clone().unwrap_or_default(),
            },
            test: name,
            // why: an angle within the limits of the unit fits as whole hundredths of a degree.
            turn_deg: turns.as_ref().map(|t| (t[row].to_degrees() * 100.0).round() as i64),
            at_mm: [of(&x), of(&y), of(&z)],
            place,
        });
    }
    Some(rows)
}

/// What a hit is uncertain by, and the factor of U.
#[derive(Clone, Copy)]
struct Doubt {
    hit_mm: f64,
    form_mm: f64,
    factor: f64,
}

impl Doubt {
    fn of(test: &ProbingTest, seen: Option<(f64, f64)>) -> Option<Self> {
        let form_mm = test.form_u_mm.unwrap_or(0.0);
        match (test.reading_u_mm, seen) {
            (Some(u), Some((s, _))) if u >= s => Some(Self { hit_mm: u, form_mm, factor: 2.0 }),
            (_, Some((s, free))) => {
                Some(Self { hit_mm: s, form_mm, factor: coverage_factor(free) })
            }
            (Some(u), None) => Some(Self { hit_mm: u, form_mm, factor: 2.0 }),
            (None, None) => None,
        }
    }

    /// Of a value that one hit enters with this weight.
    fn expanded(self, weight: f64, other_mm: f64) -> f64 {
        self.factor * (self.hit_mm * weight).hypot(other_mm)
    }
}

fn add(
    found: &mut Probing,
    name: String,
    value_mm: f64,
    expanded_mm: Option<f64>,
    limit_mm: Option<f64>,
    is_range: bool,
) {
    // The range of repeated readings is what the tolerance is stated for; a form error is measured.
    let u = if is_range { Some(0.0) } else { expanded_mm };
    let outcome = limit_mm.map(|limit| decide(value_mm, u, limit, true));
    found.quantities.push(ProbingQuantity { name, value_mm, expanded_mm, limit_mm, outcome });
}

fn range(values: &[f64]) -> f64 {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    high - low
}

/// Groups in the order in which they come.
fn groups<'a, K: PartialEq>(rows: &[&'a Row], key: impl Fn(&Row) -> K) -> Vec<(K, Vec<&'a Row>)> {
    let mut all: Vec<(K, Vec<&Row>)> = Vec::new();
    for row in rows {
        let own = key(row);
        match all.iter_mut().find(|(k, _)| *k == own) {
            Some((_, group)) => group.push(row),
            None => all.push((own, vec![row])),
        }
    }
    all
}

/// Hits of one point, over and over, in each direction: single-direction repeatability.
fn points(
    rows: &[&Row],
    test: &ProbingTest,
    found: &mut Probing,
    problems: &mut Diagnostics,
) -> Option<()> {
    let (mut squares, mut free) = (0.0, 0.0);
    for (direction, group) in groups(rows, |r| r.group.clone()) {
        let axis =
            ["X", "Y", "Z"].iter().position(|a| direction.trim_start_matches(['+', '-']) == *a);
        let Some(axis) = axis else {
            let message = format!("`{direction}` is no direction of a hit");
            problems.error(
                "unknown-word",
                group[0].place.clone(),
                message,
                "+X, -X, +Y, -Y, +Z or -Z",
            );
            return None;
        };
        let along: Vec<f64> = group.iter().map(|r| r.at_mm[axis]).collect();
        if along.len() < 2 {
            let message = format!("one hit along {direction} does not repeat");
            problems.error("few-hits", group[0].place.clone(), message, "ten hits are usual");
            return None;
        }
        let mean = along.iter().sum::<f64>() / along.len() as f64;
        squares += along.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        free += along.len() as f64 - 1.0;
        let name = format!("repeatability along {direction}, range of {} hits", along.len());
        add(found, name, range(&along), None, test.allowed_point_mm, true);
    }
    if free > 0.0 {
        found.scatter = Some(((squares / free).sqrt(), free));
    }
    Some(())
}

/// The same feature again after the probe was changed in and out.
fn tools(rows: &[&Row], test: &ProbingTest, found: &mut Probing) {
    if rows.len() < 2 {
        return;
    }
    for (axis, name) in ["X", "Y", "Z"].iter().enumerate() {
        let along: Vec<f64> = rows.iter().map(|r| r.at_mm[axis]).collect();
        let name =
            format!("location of the probing tool along {name}, range of {} changes", along.len());
        add(found, name, range(&along), None, test.allowed_tool_mm, true);
    }
}

/// Circles of the ring: form, effective diameter of the ball, location, offset of the ball.
fn ring(
    rows: &[&Row],
    test: &ProbingTest,
    doubt: Option<Doubt>,
    found: &mut Probing,
    problems: &mut Diagnostics,
) -> Option<()> {
    let mut centres: Vec<(Option<i64>, [f64; 2], usize)> = Vec::new();
    for ((run, turn), group) in groups(rows, |r| (r.group.clone(), r.turn_deg)) {
        let name = named("ring", &run, turn);
        let at: Vec<[f64; 2]> = group.iter().map(|r| [r.at_mm[0], r.at_mm[1]]).collect();
        let Ok(fit) = circle::least_squares(&at) else {
            return refuse(&name, "circle", group[0], problems);
        };
        if at.len() < FEW_RING {
            let message = format!("{name} has {} points", at.len());
            problems.warn(
                "few-hits",
                group[0].place.clone(),
                message,
                "36 around the whole ring show its lobes",
            );
        }
        let deviation = |p: &[f64; 2]| {
            let (x, y) = (p[0] - fit.center_mm[0], p[1] - fit.center_mm[1]);
            [y.atan2(x), 0.0, x.hypot(y) - fit.radius_mm]
        };
        let points = at.iter().map(deviation).collect();
        let expanded = doubt.map(|d| d.expanded(2.0_f64.sqrt(), d.form_mm));
        add(
            found,
            format!("P_FTU,2D of {name}"),
            fit.width_mm(),
            expanded,
            test.allowed_2d_mm,
            false,
        );
        size(&name, 2.0 * fit.radius_mm, at.len(), (test.ring_mm, -1.0), (test, doubt), found);
        if let Some(centre) = test.ring_centre_mm {
            let off = (fit.center_mm[0] - centre[0]).hypot(fit.center_mm[1] - centre[1]);
            let weight = (2.0 / at.len() as f64).sqrt();
            let expanded = doubt.map(|d| d.expanded(weight, 0.0));
            add(found, format!("location of {name}"), off, expanded, None, false);
        }
        centres.push((turn, fit.center_mm, at.len()));
        found.deviations.push(Deviations { name, points, is_sphere: false });
    }
    offset(&centres, doubt, found);
    Some(())
}

/// Half the distance of the centres with the spindle at two opposite orientations.
fn offset(centres: &[(Option<i64>, [f64; 2], usize)], doubt: Option<Doubt>, found: &mut Probing) {
    let opposite = |a: i64, b: i64| (a - b).rem_euclid(36_000) == 18_000;
    for (i, (one, a, count)) in centres.iter().enumerate() {
        let other = centres[i + 1..]
            .iter()
            .find(|(turn, ..)| one.zip(*turn).is_some_and(|(one, other)| opposite(one, other)));
        if let Some((_, b, _)) = other {
            let half = 0.5 * (a[0] - b[0]).hypot(a[1] - b[1]);
            let expanded = doubt.map(|d| d.expanded((1.0 / *count as f64).sqrt(), 0.0));
            add(
                found,
                "offset of the ball from the spindle".to_owned(),
                half,
                expanded,
                None,
                false,
            );
            return;
        }
    }
}

/// The sphere: form, effective diameter of the ball, location.
fn ball(
    rows: &[&Row],
    test: &ProbingTest,
    doubt: Option<Doubt>,
    found: &mut Probing,
    problems: &mut Diagnostics,
) -> Option<()> {
    for ((run, turn), group) in groups(rows, |r| (r.group.clone(), r.turn_deg)) {
        let name = named("sphere", &run, turn);
        let at: Vec<[f64; 3]> = group.iter().map(|r| r.at_mm).collect();
        let Some((centre, radius)) = sphere::least_squares(&at) else {
            return refuse(&name, "sphere", group[0], problems);
        };
        if at.len() != SPHERE {
            let message = format!("{name} has {} points", at.len());
            let hint = "25 are usual, over the half of the sphere that the probe reaches; ranges of other numbers \
                        do not compare";
            problems.warn("not-25-points", group[0].place.clone(), message, hint);
        }
        let deviation = |p: &[f64; 3]| {
            let [x, y, z] = [0, 1, 2].map(|k| p[k] - centre[k]);
            [y.atan2(x), z.atan2(x.hypot(y)), x.hypot(y).hypot(z) - radius]
        };
        let points: Vec<[f64; 3]> = at.iter().map(deviation).collect();
        let form = range(&points.iter().map(|p| p[2]).collect::<Vec<_>>());
        let expanded = doubt.map(|d| d.expanded(2.0_f64.sqrt(), d.form_mm));
        add(found, format!("P_FTU,3D of {name}"), form, expanded, test.allowed_3d_mm, false);
        size(&name, 2.0 * radius, at.len(), (test.sphere_mm, 1.0), (test, doubt), found);
        if let Some(nominal) = test.sphere_centre_mm {
            let off = (0..3).map(|k| (centre[k] - nominal[k]).powi(2)).sum::<f64>().sqrt();
            let expanded = doubt.map(|d| d.expanded((3.0 / at.len() as f64).sqrt(), 0.0));
            add(found, format!("location of {name}"), off, expanded, None, false);
        }
        found.deviations.push(Deviations { name, points, is_sphere: true });
    }
    Some(())
}

/// The size error of contact points, or what the ball acts like and how far that is from its diameter.
fn size(
    name: &str,
    measured_mm: f64,
    count: usize,
    (gauge, side): (Option<MeasuredValue>, f64),
    (test, doubt): (&ProbingTest, Option<Doubt>),
    found: &mut Probing,
) {
    let Some(gauge) = gauge else { return };
    let weight = 2.0 / (count as f64).sqrt();
    let expanded = doubt.map(|d| d.expanded(weight, gauge.u.unwrap_or(0.0)));
    if test.is_corrected {
        let error = measured_mm - gauge.value;
        add(found, format!("size error of {name}"), error, expanded, None, false);
        return;
    }
    let effective = side * (measured_mm - gauge.value);
    add(found, format!("effective ball diameter by {name}"), effective, expanded, None, false);
    if let Some(ball) = test.stylus_mm {
        let name = format!("effective less stated ball diameter by {name}");
        add(found, name, effective - ball, expanded, None, false);
    }
}

fn named(what: &str, run: &str, turn: Option<i64>) -> String {
    let run = if run.is_empty() { String::new() } else { format!(" {run}") };
    match turn {
        Some(turn) => format!("{what}{run} at {}°", turn as f64 / 100.0),
        None => format!("{what}{run}"),
    }
}

fn refuse(name: &str, shape: &str, row: &Row, problems: &mut Diagnostics) -> Option<()> {
    let message = format!("the points of {name} determine no {shape}");
    let hint = "points all around: of a ring in its plane, of a sphere also above its equator";
    problems.error("no-shape", row.place.clone(), message, hint);
    None
}
