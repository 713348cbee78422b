//! Circles as CATIA and Creo (APT_FORMAT) write them: `INDIRV/i,j,k`, then
//! `TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x2,y2,z2)`.
//!
//! The tool begins in the direction of INDIRV and goes round the circle, which is parallel to XY, to the line from its centre to
//! the end point; no GOTO follows. The line meets the circle twice: `ON,2,INTOF` is the second place that the tool comes to.
//! Help of PTC Creo, "CL Output for Circular Interpolation".

use super::super::numbers::{Fault, norm, number};
use super::super::scan::Statement;
use super::super::{ClCircle, ClPoint, Word};
use super::Reader;
use super::circle::off_circle_mm;
use std::f64::consts::{PI, TAU};

/// Heights of one circle that differ by more are those of a helix, mm.
const OFF_PLANE_MM: f64 = 5e-3;

/// A direction whose part across the circle is greater is no tangent.
const OFF_TANGENT: f64 = 0.02;

const HINT: &str = "let the CAM system write points (GOTO), or CIRCLE and GOTO";

const FORM: &str = "write INDIRV/i,j,k and TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x2,y2,z2)";

/// What the statement says.
struct Said {
    center: [f64; 3],
    radius: f64,
    line: [[f64; 3]; 2],
    second: bool,
}

impl Reader<'_> {
    /// TLON,GOFWD along a circle; every other motion along surfaces is refused.
    pub(super) fn along(&mut self, s: &Statement) -> Result<Word, Fault> {
        let Some(said) = said(s)? else {
            let message = format!("{} is not read: motion along surfaces", s.word);
            return Err(("motion-not-read", message, HINT));
        };
        let unit_mm = self.unit_mm;
        let place = |p: [f64; 3]| super::near(self.displaced(p.map(|v| v * unit_mm)));
        let (center, begin, end) =
            (place(said.center)?, place(said.line[0])?, place(said.line[1])?);
        let radius_mm = said.radius * unit_mm;
        let Some((from, direction)) = self.tip_mm.zip(self.direction.take()) else {
            return refused("it states no direction or has no point before it", FORM);
        };
        if let Some(line) = self.cycle_on {
            return refused(
                &format!("the CYCLE of line {line} is on"),
                "write CYCLE/OFF before it",
            );
        }
        check_places([center, begin, from, end], radius_mm)?;
        let sign = sense([center, from], direction)?;
        let circle = ClCircle { center_mm: center, normal: [0.0, 0.0, sign], turn_rad: None };
        let turn_rad = turn(&circle, [from, end], said.second)?;
        let to: ClPoint = self.moved(end, None, s)?;
        Ok(Word::Arc(ClCircle { turn_rad: Some(turn_rad), ..circle }, to))
    }
}

fn refused<T>(why: &str, hint: &'static str) -> Result<T, Fault> {
    Err(("bad-circle", format!("the circle of TLON,GOFWD is not read: {why}"), hint))
}

/// The numbers of the statement; none where it is another motion.
fn said(s: &Statement) -> Result<Option<Said>, Fault> {
    let rest: String = s.text.chars().filter(|c| !c.is_whitespace()).collect();
    let rest = rest.to_ascii_uppercase();
    let Some(rest) = rest.strip_prefix("TLON,GOFWD/(CIRCLE/") else { return Ok(None) };
    let Some((circle, rest)) = rest.split_once("),ON,") else { return Ok(None) };
    let (second, rest) = match rest.strip_prefix("2,INTOF,") {
        Some(rest) => (true, rest),
        None => (false, rest),
    };
    let line = rest.strip_prefix("(LINE/").and_then(|rest| rest.strip_suffix(')'));
    let Some(line) = line else { return Ok(None) };
    let numbers = |text: &str| text.split(',').map(number).collect::<Result<Vec<f64>, Fault>>();
    // With words in them they are other circles and lines.
    if circle.starts_with(|c: char| c.is_ascii_alphabetic())
        || line.starts_with(|c: char| c.is_ascii_alphabetic())
    {
        return Ok(None);
    }
    match (numbers(circle)?.as_slice(), numbers(line)?.as_slice()) {
        (&[x, y, z, radius], &[a, b, c, d, e, f]) => {
            let line = [[a, b, c], [d, e, f]];
            Ok(Some(Said { center: [x, y, z], radius, line, second }))
        }
        (circle, line) => refused(
            &format!("it has {} and {} numbers, not 4 and 6", circle.len(), line.len()),
            FORM,
        ),
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Centre, the point before and the end lie at one height; both points lie on the circle, and the line begins at the centre.
fn check_places([center, begin, from, end]: [[f64; 3]; 4], radius_mm: f64) -> Result<(), Fault> {
    let places = [
        ("the point before", from),
        ("the second point of LINE", end),
        ("the first point of LINE", begin),
    ];
    for (name, place) in places {
        let up = place[2] - center[2];
        if up.abs() > OFF_PLANE_MM {
            return refused(
                &format!("{name} is {up:.4} mm above its centre: a helix, or another plane"),
                HINT,
            );
        }
    }
    if norm(&minus(begin, center)) > OFF_PLANE_MM {
        return refused("LINE does not begin at its centre", FORM);
    }
    for (name, place) in &places[..2] {
        let is_mm = norm(&minus(*place, center));
        if !(radius_mm > 0.0 && (is_mm - radius_mm).abs() <= off_circle_mm(radius_mm)) {
            let why =
                format!("{name} is {is_mm:.4} mm from its centre, its radius is {radius_mm:.4} mm");
            return refused(&why, "check the points, the centre and the units");
        }
    }
    Ok(())
}

/// The sense about +Z in which the tool begins: 1 counter-clockwise, -1 clockwise.
fn sense([center, from]: [[f64; 3]; 2], direction: [f64; 3]) -> Result<f64, Fault> {
    let out = minus(from, center);
    let length = norm(&direction) * norm(&out);
    let along = (out[0] * direction[1] - out[1] * direction[0]) / length;
    let across = (out[0] * direction[0] + out[1] * direction[1]) / length;
    let up = direction[2] / norm(&direction);
    // NaN is no direction.
    if along.abs() > 0.5 && across.abs() <= OFF_TANGENT && up.abs() <= OFF_TANGENT {
        return Ok(along.signum());
    }
    let [i, j, k] = direction;
    let why = format!("INDIRV/{i},{j},{k} is not its tangent at the point before");
    refused(&why, "check INDIRV and the point before")
}

/// How far the tool goes round; the place that is reached must be the one that the words say.
fn turn(circle: &ClCircle, [from, end]: [[f64; 3]; 2], second: bool) -> Result<f64, Fault> {
    let [a, b] = [from, end].map(|place| minus(place, circle.center_mm));
    let sine = circle.normal[2] * (a[0] * b[1] - a[1] * b[0]);
    let angle = sine.atan2(a[0] * b[0] + a[1] * b[1]);
    // Both ends are as exact as the file.
    let allowed = (off_circle_mm(norm(&a)) / norm(&a)).min(0.1);
    let angle = if angle <= if second { allowed } else { 0.0 } { angle + TAU } else { angle };
    let degrees = angle.to_degrees();
    match second {
        false if angle > PI + allowed || angle < OFF_PLANE_MM / norm(&a) => refused(
            &format!(
                "to the second point of LINE are {degrees:.3} deg, and the line is reached earlier"
            ),
            "write ON,2,INTOF where the second place is meant",
        ),
        true if angle < PI - allowed => refused(
            &format!(
                "to the second point of LINE are {degrees:.3} deg, which is the first place and not the second"
            ),
            "leave out 2,INTOF, or check INDIRV",
        ),
        _ => Ok(angle),
    }
}
