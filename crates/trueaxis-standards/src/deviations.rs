//! Deviations that no machine has: the readings of a test are judged before they are evaluated.

use crate::{Request, Standard};
use trueaxis_input::plausible::Quantity;
use trueaxis_input::sheet::{Cells, Sheet, heading};
use trueaxis_input::{Diagnostics, Dimension, Unit};

/// Whether no deviation is far outside the range of its quantity; what is outside is reported with its row.
pub fn are_possible(request: &Request<'_>, problems: &mut Diagnostics) -> bool {
    let standard = request.standard;
    let cells = |name: &str| match quantity(standard, name) {
        Some(_) => Cells::Gaps,
        None => Cells::Unused,
    };
    // What cannot be read is reported by the reader of the standard.
    let mut unread = Diagnostics::new();
    let Some(sheet) = Sheet::parse(request.file, request.text, cells, &mut unread) else {
        return true;
    };
    let mut are_possible = true;
    for column in sheet.columns.iter().filter(|c| c.cells == Cells::Gaps) {
        let Some(quantity) = quantity(standard, &column.name) else { continue };
        let Ok(unit) = Unit::find(column.unit(), quantity.dimension()) else { continue };
        let values: Vec<f64> = column.values.iter().map(|v| unit.to_inner(*v)).collect();
        let named = (column.name.as_str(), values.as_slice());
        let place = |row| sheet.row_place(row);
        are_possible &= request.conditions.limits.judge_column(quantity, named, place, problems);
    }
    are_possible
}

/// What is under a heading, if it is a deviation and not a position.
fn quantity(standard: Standard, name: &str) -> Option<Quantity> {
    let (role, unit) = heading(name);
    let first = role.split('_').next().unwrap_or(role);
    let is_deviation = match standard {
        Standard::Iso230_7 => matches!(role, "radial" | "axial" | "x" | "y"),
        // Displacements of probes under names of their own, beside times and temperatures.
        Standard::Iso230_3 => !matches!(role, "time" | "temperature"),
        // Angles of a level or an autocollimator.
        Standard::Iso230_1 => matches!(role, "deviation" | "angle"),
        Standard::Iso230_10 => false,
        _ => matches!(first, "deviation" | "up" | "down"),
    };
    let is = |dimension| Unit::find(unit, dimension).is_ok();
    match is_deviation {
        true if is(Dimension::Length) => Some(Quantity::Deviation),
        true if is(Dimension::Angle) => Some(Quantity::AngularDeviation),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conditions::Conditions;

    fn codes(standard: Standard, text: &str, conditions: &str) -> Vec<(&'static str, usize)> {
        let (conditions, _) = Conditions::read("c.toml", conditions);
        let mut problems = Diagnostics::new();
        let (file, conditions_file, window_s) = ("r.csv", "c.toml", 1.0);
        let conditions = &conditions;
        are_possible(
            &Request { standard, file, text, conditions, conditions_file, window_s },
            &mut problems,
        );
        problems.iter().map(|d| (d.code, d.place.line)).collect()
    }

    #[test]
    fn a_heading_in_mm_over_values_in_micrometres_is_refused() {
        let rows = "0,up,1.5\n100,up,-12.9\n200,up,4.2\n";
        let text = |unit| format!("target_mm,direction,deviation_{unit}\n{rows}");
        assert!(codes(Standard::Iso230_2, &text("um"), "").is_empty());
        assert_eq!(codes(Standard::Iso230_2, &text("mm"), ""), [("impossible-value", 3)]);
        let wide = format!("{}{rows}", "target_mm,other,deviation_up_1_mm\n").replace("up,", "0,");
        assert_eq!(codes(Standard::B5_54, &wide, ""), [("impossible-value", 3)]);
        // The file of the conditions says that this machine is so.
        let stated = "[plausible]\nreading_um = 20000";
        assert!(codes(Standard::Iso230_2, &text("mm"), stated).is_empty());
        // Positions are no deviations, and 0.1 mrad is an angle of a level.
        let circle = "angle_deg,x_mm,y_mm\n0,150,0\n90,0,150\n";
        assert!(codes(Standard::Iso230_4, circle, "").is_empty());
        let level = "position_mm,angle_mrad\n0,0.1\n100,104\n";
        assert_eq!(codes(Standard::Iso230_1, level, ""), [("impossible-value", 3)]);
    }
}
