//! Measured coordinates of points that lie on an element, in whatever frame they were measured.
//!
//! The frame follows from the places where the points are nominally: what remains of it, a displacement of all points
//! together, is that of the element, which is not known in any case.

use super::element::{Element, nearest_motion};
use super::instrument::Instrument;
use super::readings::Readings;
use trueaxis_geometry::Vec3;
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Place, Unit};
use trueaxis_machine::Machine;
use trueaxis_machine::errors::ErrorValues;

/// Farther from where it is nominally no point was measured, mm.
const FAR_MM: f64 = 5.0;

/// Puts how far measured points are from the element into the readings, if the table has `x_mm`, `y_mm` and `z_mm`;
/// whether the table is sound.
pub(super) fn read_points(
    table: &CsvTable,
    machine: &Machine,
    instrument: &Instrument,
    readings: &mut Readings,
    problems: &mut Diagnostics,
) -> bool {
    let Some(element) = instrument.kind.element() else { return true };
    let Some(measured) = measured_points(table, problems) else {
        return !problems.has_errors();
    };
    let whole = Place::whole(&table.file);
    let given = instrument.kind.channels();
    let doubled = table.columns.iter().find(|c| given.iter().any(|name| c.name.starts_with(name)));
    if let Some(column) = doubled {
        let message = format!("`{}` and x, y, z both say where the points are", column.name);
        let hint = "leave out one of them";
        problems.error("place-twice", column.place.clone(), message, hint);
        return false;
    }
    let nominal = readings.commands.iter().map(|command| {
        let tool = instrument.tool_seen(machine, command, &ErrorValues::default());
        tool.linear() * instrument.tool_point_mm + tool.shift_mm()
    });
    let nominal: Vec<Vec3> = nominal.collect();
    let motion = nearest_motion(&measured, &nominal).filter(|_| element != Element::Line);
    let Some((turn, shift)) = motion else {
        let message = "the points lie on a line: how their frame is turned about it cannot be seen"
            .to_owned();
        let hint = "give their deviations instead: across_1_um, across_2_um, deviation_um";
        problems.error("frame-not-seen", whole, message, hint);
        return false;
    };
    let placed: Vec<Vec3> = measured.iter().map(|q| turn * q + shift).collect();
    let off = |i: usize| (placed[i] - nominal[i]).norm();
    let worst = (0..placed.len()).max_by(|a, b| off(*a).total_cmp(&off(*b)));
    if let Some(row) = worst.filter(|row| off(*row) > FAR_MM || off(*row).is_nan()) {
        let message = format!(
            "the points do not have the form of the positions: here {:.1} mm are left in the best frame",
            off(row)
        );
        let hint = "a wrong row or unit, another order of rows, a mirrored frame, or the length of the tool";
        problems.error("far-from-points", table.row_place(row), message, hint);
        return false;
    }
    for (value, place) in readings.values.iter_mut().zip(&placed) {
        let d = place - instrument.reference_point_mm;
        *value = element.distances_mm(d, instrument.direction, instrument.length_mm);
    }
    true
}

/// The coordinates, mm; none where the table has not all three.
fn measured_points(table: &CsvTable, problems: &mut Diagnostics) -> Option<Vec<Vec3>> {
    let column = |axis: &str| {
        table.columns.iter().find(|c| c.name.rsplit_once('_').is_some_and(|(name, _)| name == axis))
    };
    let all = ["x", "y", "z"].map(column);
    let found = all.iter().flatten().next()?;
    let [Some(x), Some(y), Some(z)] = all else {
        let message = "a point has three coordinates".to_owned();
        let hint = "columns x_mm, y_mm and z_mm";
        problems.error("missing-column", found.place.clone(), message, hint);
        return None;
    };
    let mut scales = Vec::new();
    for column in [x, y, z] {
        let unit = column.name.rsplit_once('_').map_or("", |(_, unit)| unit);
        match Unit::find(unit, Dimension::Length) {
            Ok(unit) => scales.push(unit),
            Err(e) => {
                problems.error(e.code(), column.place.clone(), e.to_string(), &e.hint());
                return None;
            }
        }
    }
    let at = |row: usize| {
        let one = |(column, unit): (&&trueaxis_input::CsvColumn, &Unit)| {
            unit.to_inner(column.values[row])
        };
        Vec3::from_iterator([x, y, z].iter().zip(&scales).map(one))
    };
    Some((0..table.rows()).map(at).collect())
}
