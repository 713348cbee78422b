//! Points of a coordinate measuring machine, with what is wrong with them.

use std::path::Path;
use trueaxis_geometry::Vec3;
use trueaxis_input::sheet::{Cells, Column, Sheet};
use trueaxis_input::{Diagnostics, Dimension, Files, Place};
use trueaxis_machine::chain::Link;
use trueaxis_part::testpiece::cone::Cone;
use trueaxis_part::testpiece::measured::{MeasuredFault, MeasuredPoint, Suspicion};

/// The points of one part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartPoints {
    /// The file.
    pub name: String,
    /// Points of the surface in the workpiece frame.
    pub points: Vec<MeasuredPoint>,
}

/// How points are to be read.
pub(super) struct Reading<'a> {
    pub cone: &'a Cone,
    /// From the frame of the points to that of the workpiece.
    pub workpiece_from_points: Link,
    /// Radius of the stylus if centres were measured, mm.
    pub ball_radius_mm: f64,
    /// What the cutting condition leaves on the surface, mm.
    pub allowance_mm: f64,
    pub point_u_mm: f64,
}

/// More points than this are not needed for a form, and their u would take hours.
const MOST_POINTS: usize = 20_000;
/// So many faults of single points are named.
const MOST_FAULTS: usize = 10;
/// A gap of the circumference that is large enough to be named, rad.
const WIDE_GAP_RAD: f64 = 0.8;

const FORM: &str =
    "columns x_mm, y_mm, z_mm, if wanted `section` (1 at the base), or `height_mm` above the base";

impl Reading<'_> {
    /// The points of one file.
    pub fn read(
        &self,
        files: &Files,
        path: &Path,
        problems: &mut Diagnostics,
    ) -> Option<PartPoints> {
        let text = files.text(path, "a table of points (CSV)", problems)?;
        let name = path.display().to_string();
        let read = ["x", "y", "z", "section", "height"];
        let is_read =
            |h: &str| read.contains(&h) || read.contains(&trueaxis_input::sheet::heading(h).0);
        let cells = |h: &str| if is_read(h) { Cells::Numbers } else { Cells::Unused };
        let sheet = Sheet::parse(&name, &text, cells, problems)?.with_copies_once(problems);
        for column in sheet.columns.iter().filter(|c| c.cells == Cells::Unused) {
            let message = format!("column `{}` is not read", column.name);
            problems.warn("unused-column", column.place.clone(), message, FORM);
        }
        let raw = coordinates(&sheet, problems)?;
        if raw.len() > MOST_POINTS {
            let message = format!("{} points, at most {MOST_POINTS} are evaluated", raw.len());
            problems.error("too-many-points", sheet.row_place(0), message, "thin them out evenly");
            return None;
        }
        let here = |p: &Vec3| {
            self.workpiece_from_points.linear() * p + self.workpiece_from_points.shift_mm()
        };
        let inwards_mm = self.ball_radius_mm + self.allowance_mm;
        let places: Vec<Vec3> =
            raw.iter().map(|p| self.cone.contact_mm(here(p), inwards_mm)).collect();
        if let Some(suspicion) = self.cone.suspicion(&places) {
            self.report(&suspicion, &sheet, problems);
            return None;
        }
        let sections = self.sections(&sheet, &places, problems)?;
        let points = places.into_iter().zip(sections);
        let points: Vec<MeasuredPoint> =
            points.map(|(place_mm, section)| MeasuredPoint { place_mm, section }).collect();
        self.check(&points, &sheet, problems).then_some(PartPoints { name, points })
    }

    /// Which section each point belongs to.
    fn sections(
        &self,
        sheet: &Sheet,
        places: &[Vec3],
        problems: &mut Diagnostics,
    ) -> Option<Vec<usize>> {
        let heights = &self.cone.size().heights_mm;
        let numbered = sheet.about("section");
        let stated = sheet.about("height");
        if let (Some(_), Some(height)) = (numbered, stated) {
            let message = "`section` and `height` say the same".to_owned();
            problems.error("duplicate-column", height.place.clone(), message, "keep one of them");
            return None;
        }
        if let Some(column) = numbered {
            let number = |(row, v): (usize, &f64)| {
                let found = (1..=heights.len()).find(|n| *n as f64 == *v).map(|n| n - 1);
                if found.is_none() {
                    let message = format!("the test piece has no section {v}");
                    let hint = format!("1 to {}, from the base upwards", heights.len());
                    problems.error("no-such-section", sheet.row_place(row), message, &hint);
                }
                found
            };
            // All rows are read before the first fault counts.
            let all: Vec<_> = column.values.iter().enumerate().map(number).collect();
            return all.into_iter().collect();
        }
        let Some(column) = stated else {
            return Some(places.iter().map(|p| self.cone.nearest_section(p)).collect());
        };
        let values = sheet.inner(column, Dimension::Length, problems)?;
        let number = |(row, v): (usize, &f64)| {
            let found = heights.iter().position(|h| (h - v).abs() < 1e-6);
            if found.is_none() {
                let message = format!("the test piece has no section at a height of {v} mm");
                let hint = format!("heights above the base, mm: {heights:?}");
                problems.error("no-such-section", sheet.row_place(row), message, &hint);
            }
            found
        };
        let all: Vec<_> = values.iter().enumerate().map(number).collect();
        all.into_iter().collect()
    }

    /// Faults of single points and of sections; whether they can be evaluated.
    fn check(&self, points: &[MeasuredPoint], sheet: &Sheet, problems: &mut Diagnostics) -> bool {
        let before = problems.has_errors();
        let mut kept = points.to_vec();
        let mut rows: Vec<usize> = (0..points.len()).collect();
        // One fault after the other, each without the point that had the last one.
        for _ in 0..MOST_FAULTS {
            let Err(fault) = self.cone.measured(&kept, 0.0) else { break };
            let place = |point: usize| sheet.row_place(rows[point]);
            let (point, code, at, hint) = match &fault {
                MeasuredFault::NotFinite { point } => {
                    (*point, "not-finite", place(*point), "write a number")
                }
                MeasuredFault::NoSection { point, .. } => (
                    *point,
                    "no-such-section",
                    place(*point),
                    "number the sections from the base, from 1",
                ),
                MeasuredFault::OtherHeight { point, .. } => (
                    *point,
                    "point-off-piece",
                    place(*point),
                    "is it a point of this section? otherwise correct or remove the row",
                ),
                MeasuredFault::OffSurface { point, .. } => (
                    *point,
                    "point-off-piece",
                    place(*point),
                    "a wrong contact, a burr or another face: correct or remove the row",
                ),
                MeasuredFault::Duplicate { point, first } => {
                    let message = format!("this point stands in line {} too", place(*first).line);
                    let hint = "a point that counts twice makes u too small: remove one";
                    problems.error("duplicate-row", place(*point), message, hint);
                    rows.remove(*point);
                    kept.remove(*point);
                    continue;
                }
                _ => {
                    self.whole(&fault, sheet, problems);
                    return false;
                }
            };
            let words = without_number(&fault);
            problems.error(code, at, words, hint);
            rows.remove(point);
            kept.remove(point);
        }
        if problems.has_errors() && !before {
            return false;
        }
        self.warn(points, sheet, problems);
        true
    }

    /// A fault of a section.
    fn whole(&self, fault: &MeasuredFault, sheet: &Sheet, problems: &mut Diagnostics) {
        let place = Place::whole(&sheet.file);
        match fault {
            MeasuredFault::TooFew { section, found } => {
                let message =
                    format!("section {} has {found} points, at least 8 are needed", section + 1);
                problems.error("too-few-points", place, message, "measure more points around it");
            }
            MeasuredFault::Arc { section, gap_rad } => {
                let message = format!(
                    "section {} has no point over {:.0} deg of its circumference",
                    section + 1,
                    gap_rad.to_degrees()
                );
                let hint =
                    "an arc shows neither form nor position: measure the whole circumference";
                problems.error("arc-of-points", place, message, hint);
            }
            other => problems.error("not-evaluable", place, other.to_string(), "check the points"),
        }
    }

    /// What can be believed, but should be checked.
    fn warn(&self, points: &[MeasuredPoint], sheet: &Sheet, problems: &mut Diagnostics) {
        for (point, by_mm) in self.cone.gross_points(points, self.point_u_mm).unwrap_or_default() {
            let message = format!(
                "the point lies {:+.1} µm off the line through its neighbours, far more than the others",
                by_mm * 1e3
            );
            let hint =
                "dirt, a burr, or a false contact? it counts: measure it again or remove the row";
            problems.warn("jumping-point", sheet.row_place(point), message, hint);
        }
        for section in 0..self.cone.size().heights_mm.len() {
            let mine = points.iter().filter(|p| p.section == section);
            let mut at: Vec<f64> = mine.map(|p| p.place_mm.y.atan2(p.place_mm.x)).collect();
            at.sort_by(f64::total_cmp);
            let (Some(first), Some(last)) = (at.first(), at.last()) else { continue };
            let around = first + std::f64::consts::TAU - last;
            let gap = at.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max);
            if gap > WIDE_GAP_RAD {
                let message = format!(
                    "section {} has no point over {:.0} deg: its form there is not known, and u of its position grows",
                    section + 1,
                    gap.to_degrees()
                );
                let hint = "measure points there too";
                problems.warn("arc-of-points", Place::whole(&sheet.file), message, hint);
            }
        }
    }

    /// Why all points lie beside the piece.
    fn report(&self, suspicion: &Suspicion, sheet: &Sheet, problems: &mut Diagnostics) {
        let place = sheet.headings_place();
        match suspicion {
            Suspicion::Unit(factor) => {
                let message = format!(
                    "the points do not lie on the piece; multiplied by {factor:.6} they do: another unit"
                );
                let hint = match *factor {
                    f if (f - 25.4).abs() < 1e-9 => {
                        "the numbers are inches: name the columns x_in, y_in, z_in"
                    }
                    f if (f - 1e-3).abs() < 1e-12 => {
                        "the numbers are µm: name the columns x_um, y_um, z_um"
                    }
                    _ => {
                        "name the columns with the unit of the numbers: x_mm, x_um, x_in, x_cm, x_m"
                    }
                };
                problems.error("wrong-unit", place, message, hint);
            }
            Suspicion::Columns(order) => {
                let of = |i: usize| ["x", "y", "z"][i];
                let message = format!(
                    "the points do not lie on the piece; with {} as x, {} as y and {} as z they do",
                    of(order[0]),
                    of(order[1]),
                    of(order[2])
                );
                problems.error("swapped-columns", place, message, "correct the headings");
            }
            Suspicion::Radius(mm) => self.report_radius(*mm, place, problems),
            Suspicion::UpsideDown => {
                let message =
                    "the points lie on the piece with z pointing the other way".to_owned();
                let hint = "z points out of the top face; turn the frame, or say frame = [\"turn X 180 deg\"]";
                problems.error("other-frame", place, message, hint);
            }
            Suspicion::Frame { shift_mm, tilt_rad } => {
                let message = format!(
                    "the points lie on this cone, but its top centre is at {:.3} {:.3} {:.3} mm, its axis {:.3} deg off z",
                    shift_mm.x,
                    shift_mm.y,
                    shift_mm.z,
                    tilt_rad.to_degrees()
                );
                let hint = "the workpiece frame has its origin in the centre of the top face and z along the datum \
                            axis: measure in it, or state the pose of that frame: frame = [\"x y z mm\", \"turn Y 10 deg\"]";
                problems.error("other-frame", place, message, hint);
            }
        }
    }

    fn report_radius(&self, mm: f64, place: Place, problems: &mut Diagnostics) {
        let side = if mm > 0.0 { "outside" } else { "inside" };
        let message =
            format!("all points lie {:.3} mm {side} of the nominal surface on average", mm.abs());
        let hint = match (mm > 0.0, self.ball_radius_mm > 0.0) {
            (true, false) => {
                "the radius of the stylus? then they are centres: probe = \"centres\" with stylus_diameter; \
                 on a step with an allowance name its `condition`"
            }
            (false, true) => {
                "were they corrected already? then probe = \"corrected\"; otherwise check stylus_diameter"
            }
            _ => "check stylus_diameter, `condition` and the diameter of the cutter",
        };
        problems.error("stylus-radius", place, message, hint);
    }
}

/// The words of a fault without the number of its point: the place says it.
fn without_number(fault: &MeasuredFault) -> String {
    let text = fault.to_string();
    let rest = text.strip_prefix("point ").and_then(|t| t.split_once(' ')).map(|(_, rest)| rest);
    rest.map_or(text.clone(), |rest| format!("the point {rest}"))
}

fn coordinates(sheet: &Sheet, problems: &mut Diagnostics) -> Option<Vec<Vec3>> {
    let column = |role: &str, problems: &mut Diagnostics| -> Option<Column> {
        let found = sheet.about(role).cloned();
        if found.is_none() {
            let message = format!("the table has no column `{role}` of coordinates");
            problems.error("missing-column", sheet.headings_place(), message, FORM);
        }
        found
    };
    let [x, y, z] = ["x", "y", "z"].map(|role| column(role, problems));
    let [x, y, z] = [x, y, z].map(|c| c.and_then(|c| sheet.inner(&c, Dimension::Length, problems)));
    let (x, y, z) = (x?, y?, z?);
    Some(x.into_iter().zip(y).zip(z).map(|((x, y), z)| Vec3::new(x, y, z)).collect())
}
