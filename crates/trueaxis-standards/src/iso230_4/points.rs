//! The points of a circular test: columns to paths, without their overlap.

use crate::conditions::Circle;
use std::f64::consts::{PI, TAU};
use trueaxis_form::circle::least_squares;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension};

/// The sense of rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Counter-clockwise: the angle grows.
    CounterClockwise,
    /// Clockwise.
    Clockwise,
}

impl Sense {
    /// +1 counter-clockwise, −1 clockwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }

    /// `ccw` or `cw`.
    pub fn word(self) -> &'static str {
        match self {
            Self::CounterClockwise => "ccw",
            Self::Clockwise => "cw",
        }
    }

    fn of(word: &str) -> Option<Self> {
        match word.to_ascii_lowercase().as_str() {
            "ccw" | "+" | "1" | "g3" | "g03" | "counter-clockwise" => Some(Self::CounterClockwise),
            "cw" | "-" | "-1" | "g2" | "g02" | "clockwise" => Some(Self::Clockwise),
            _ => None,
        }
    }
}

/// One turn around.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// The sense of rotation.
    pub sense: Sense,
    /// The points of one turn, mm.
    pub points_mm: Vec<[f64; 2]>,
    /// How much was recorded beyond the turn and left out, rad.
    pub overlap_rad: f64,
}

/// What was read.
pub(super) struct Points {
    pub axes: [String; 2],
    pub centre_mm: [f64; 2],
    /// Whether the centre is the nominal one, not only that of the points.
    pub centre_is_nominal: bool,
    pub radius_mm: Option<f64>,
    pub paths: Vec<Path>,
}

const AXES: [&str; 3] = ["x", "y", "z"];
/// A path that leaves out more than this is no whole circle, rad.
const LARGEST_GAP: f64 = PI / 18.0;

fn cells(name: &str) -> Cells {
    match heading(name).0 {
        "x" | "y" | "z" | "angle" | "radius" | "deviation" | "time" | "temperature" => {
            Cells::Numbers
        }
        _ if name == "direction" => Cells::Words,
        _ => Cells::Unused,
    }
}

pub(super) fn read(
    file: &str,
    text: &str,
    nominal: Circle,
    problems: &mut Diagnostics,
) -> Option<Points> {
    let sheet = Sheet::parse(file, text, cells, problems)?;
    crate::check_temperatures(&sheet, problems);
    crate::check_times(&sheet, false, problems);
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
        let message = format!("column `{}` is not used", column.name);
        let hint = "known here: two of x_mm, y_mm, z_mm, or angle_deg with radius_mm or \
                    deviation_um; direction (cw, ccw)";
        problems.warn("unused-column", column.place.clone(), message, hint);
    }
    let linear: Vec<&str> = AXES.into_iter().filter(|a| sheet.about(a).is_some()).collect();
    let centre_mm = nominal.centre_mm.unwrap_or_default();
    let (axes, points): (_, Vec<[f64; 2]>) = match linear[..] {
        [a, b] => {
            let first = sheet.inner(sheet.about(a)?, Dimension::Length, problems)?;
            let second = sheet.inner(sheet.about(b)?, Dimension::Length, problems)?;
            let points = first.into_iter().zip(second).map(|(x, y)| [x, y]).collect();
            // G18 looks along +Y: there Z is the first axis of the plane and X the second.
            ([a.to_uppercase(), b.to_uppercase()], points)
        }
        [] => {
            let axes = nominal.plane.unwrap_or(['X', 'Y']).map(|axis| axis.to_string());
            (axes, polar(&sheet, nominal, centre_mm, problems)?)
        }
        _ => {
            let message = format!("{} of the columns x, y, z: a circle has two", linear.len());
            let hint = "two of x_mm, y_mm, z_mm, or angle_deg with radius_mm or deviation_um";
            problems.error("missing-column", sheet.headings_place(), message, hint);
            return None;
        }
    };
    let senses = senses(&sheet, problems)?;
    // Angles and radii are about the nominal centre already.
    let unknown = nominal.centre_mm.is_none() && !linear.is_empty();
    let off = unknown.then(|| centre_off_zero(&points)).flatten();
    if let Some([x, y]) = off {
        let message =
            format!("the circle is centred at {x:.3}, {y:.3} mm, its nominal centre is not stated");
        let hint = "write [circle] centre = \"100 50 mm\" in the conditions file; without it there is \
                    no F";
        problems.warn("missing-centre", sheet.headings_place(), message, hint);
    }
    let (centre_mm, centre_is_nominal) = (off.unwrap_or(centre_mm), off.is_none());
    let paths = split(&points, senses.as_deref(), centre_mm, &sheet, problems);
    Some(Points { axes, centre_mm, centre_is_nominal, radius_mm: nominal.radius_mm, paths })
}

/// The centre of the points, if it is so far from 0 0 that this cannot be the nominal one.
fn centre_off_zero(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let zone = least_squares(points).ok()?;
    let [x, y] = zone.center_mm;
    (x.hypot(y) > 0.01 * zone.radius_mm).then_some([x, y])
}

fn polar(
    sheet: &Sheet,
    nominal: Circle,
    centre: [f64; 2],
    problems: &mut Diagnostics,
) -> Option<Vec<[f64; 2]>> {
    let mut missing = |message: &str, hint: &str| {
        problems.error("missing-column", sheet.headings_place(), message.to_owned(), hint);
    };
    let Some(angle) = sheet.about("angle") else {
        let hint = "two of x_mm, y_mm, z_mm, or angle_deg with radius_mm or deviation_um";
        missing("the table has no points", hint);
        return None;
    };
    let (column, base) = match (sheet.about("radius"), sheet.about("deviation"), nominal.radius_mm)
    {
        (Some(column), None, _) => (column, 0.0),
        (None, Some(column), Some(radius)) => (column, radius),
        (None, Some(_), None) => {
            let hint = "write [circle] radius in the conditions file, or --radius 150";
            missing("radial deviations need the nominal radius", hint);
            return None;
        }
        _ => {
            missing("one column in addition to the angle", "radius_mm or deviation_um");
            return None;
        }
    };
    let angles = sheet.inner(angle, Dimension::Angle, problems)?;
    let radii = sheet.inner(column, Dimension::Length, problems)?;
    let point = |(a, r): (&f64, f64)| {
        let r = base + r;
        [centre[0] + r * a.cos(), centre[1] + r * a.sin()]
    };
    Some(angles.iter().zip(radii).map(point).collect())
}

fn senses(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Option<Vec<Sense>>> {
    let Some(column) = sheet.columns.iter().find(|c| c.name == "direction") else {
        return Some(None);
    };
    let known: Vec<Option<Sense>> = sheet.words.iter().map(|w| Sense::of(w)).collect();
    let mut senses = Vec::with_capacity(sheet.rows());
    for (row, value) in column.values.iter().enumerate() {
        let Some(sense) = known.get(*value as usize).copied().flatten() else {
            let message = format!("`{}` is not a direction", sheet.words[*value as usize]);
            problems.error("bad-direction", sheet.row_place(row), message, "write cw or ccw");
            return None;
        };
        senses.push(sense);
    }
    Some(Some(senses))
}

/// The angle from one point to the next about the centre, in (−π, π].
fn turn(from: [f64; 2], to: [f64; 2], centre: [f64; 2]) -> f64 {
    let (a, b) =
        ([from[0] - centre[0], from[1] - centre[1]], [to[0] - centre[0], to[1] - centre[1]]);
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

fn split(
    points: &[[f64; 2]],
    senses: Option<&[Sense]>,
    centre: [f64; 2],
    sheet: &Sheet,
    problems: &mut Diagnostics,
) -> Vec<Path> {
    let mut pieces: Vec<(Option<Sense>, usize, usize)> = Vec::new();
    for i in 0..points.len() {
        let sense = senses.map(|s| s[i]);
        match pieces.last_mut() {
            Some((last, _, end)) if *last == sense => *end = i + 1,
            _ => pieces.push((sense, i, i + 1)),
        }
    }
    let turned: Vec<Turned> =
        pieces.into_iter().map(|piece| Turned::of(piece, points, centre)).collect();
    let any_is_whole = turned.iter().any(Turned::is_whole);
    let mut paths = Vec::new();
    for path in turned {
        let place = sheet.row_place(path.from);
        if path.stated.is_some_and(|s| s != path.found()) {
            let message =
                format!("the points run {}, the table states the opposite", path.found().word());
            let hint = "seen from the positive third axis; are the two axes swapped? the stated \
                        direction is used";
            problems.warn("wrong-direction", place.clone(), message, hint);
        }
        if !path.is_whole() {
            let degrees = path.swept().abs().to_degrees();
            let message = format!("only {degrees:.1}° of a circle were recorded");
            let hint = match any_is_whole {
                true => "this path is in no result: there are whole ones",
                false => {
                    "the results hold for this arc; the centre may be wrong (or [circle] centre)"
                }
            };
            problems.warn("partial-circle", place, message, hint);
        }
        if path.is_whole() || !any_is_whole {
            path.turns(points, &mut paths);
        }
    }
    paths
}

/// Neighbouring rows of one direction.
struct Turned {
    stated: Option<Sense>,
    from: usize,
    /// How far the points have turned from the first one, rad.
    angles: Vec<f64>,
}

impl Turned {
    fn of(
        (stated, from, to): (Option<Sense>, usize, usize),
        points: &[[f64; 2]],
        centre: [f64; 2],
    ) -> Self {
        let mut angles = vec![0.0];
        for pair in points[from..to].windows(2) {
            angles.push(angles[angles.len() - 1] + turn(pair[0], pair[1], centre));
        }
        Self { stated, from, angles }
    }

    fn swept(&self) -> f64 {
        self.angles.last().copied().unwrap_or(0.0)
    }

    fn found(&self) -> Sense {
        if self.swept() < 0.0 { Sense::Clockwise } else { Sense::CounterClockwise }
    }

    fn is_whole(&self) -> bool {
        self.swept().abs() >= TAU - LARGEST_GAP
    }

    /// Each whole turn is a path; what was recorded beyond them is left out, half at each end.
    fn turns(&self, points: &[[f64; 2]], paths: &mut Vec<Path>) {
        let swept = self.swept().abs();
        let count = ((swept + LARGEST_GAP) / TAU).floor().max(1.0);
        let overlap_rad = (swept - count * TAU).max(0.0);
        let sense = self.stated.unwrap_or(self.found());
        let points = &points[self.from..self.from + self.angles.len()];
        for turn in 0..count as usize {
            let begin = 0.5 * overlap_rad + turn as f64 * TAU;
            let end = if count > 1.0 { begin + TAU } else { swept - 0.5 * overlap_rad };
            // A rounding must not cost the first or the last point.
            let inside = |a: &f64| (begin - 1e-9..=end + 1e-9).contains(&a.abs());
            let all_count = count <= 1.0 && overlap_rad <= 0.0;
            let kept = points.iter().zip(&self.angles).filter(|(_, a)| all_count || inside(a));
            paths.push(Path { sense, points_mm: kept.map(|(p, _)| *p).collect(), overlap_rad });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_that_stands_elsewhere_is_seen() {
        let rows: String = (0..36)
            .map(|i| f64::from(10 * i).to_radians())
            .map(|a| format!("{},{},ccw\n", 300.0 + 10.0 * a.cos(), -20.0 + 10.0 * a.sin()))
            .collect();
        let mut problems = Diagnostics::new();
        let text = format!("x_mm,y_mm,direction\n{rows}");
        let points = read("c.csv", &text, Circle::default(), &mut problems).unwrap();
        assert!(!points.centre_is_nominal && (points.centre_mm[0] - 300.0).abs() < 1e-9);
        let codes: Vec<_> = problems.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["missing-centre"]);
    }

    #[test]
    fn start_and_end_beyond_one_turn_are_left_out() {
        // 45° of overlap on either side, at a wrong radius.
        let rows: String = (-45..=405)
            .map(|i| {
                let r = if (0..=360).contains(&i) { 10.0 } else { 12.0 };
                format!("{i},{r}\n")
            })
            .collect();
        let text = format!("angle_deg,radius_mm\n{rows}");
        let mut problems = Diagnostics::new();
        let points = read("c.csv", &text, Circle::default(), &mut problems).unwrap();
        let path = &points.paths[0];
        assert_eq!((path.points_mm.len(), path.sense), (361, Sense::CounterClockwise));
        assert!((path.overlap_rad.to_degrees() - 90.0).abs() < 1e-6);
        assert!(path.points_mm.iter().all(|p| (p[0].hypot(p[1]) - 10.0).abs() < 1e-9));
    }
}
