//! ISO 230-6: positioning along body and face diagonals; docs/model.md eq. 71, 72.
//!
//! Each diagonal is evaluated as an axis of ISO 230-2; the machine's parameters are the largest of all
//! diagonals. From how much longer one diagonal is than another follow the angles between the axes,
//! as an estimate: other errors change the length of a diagonal too.

use super::conditions::Conditions;
use super::iso230_2;
use super::iso230_2::{Budget, Measurement, Positioning, Quantity, role_cells};
use trueaxis_input::sheet::{Cells, Sheet};
use trueaxis_input::{Diagnostics, Place};

/// The direction of a diagonal: +1, −1 or 0 (not moved) for X, Y, Z; the first that moves is +1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Diagonal(pub [i8; 3]);

const AXES: [char; 3] = ['X', 'Y', 'Z'];

impl Diagonal {
    /// Reads `+++`, `++-` or `+X-Y`, `+X+Y-Z`.
    pub fn parse(text: &str) -> Option<Self> {
        let mut signs = [0_i8; 3];
        let letters: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
        let sign = |c: &char| match c {
            '+' => Some(1),
            '-' | '−' => Some(-1),
            _ => None,
        };
        if letters.len() == 3 && letters.iter().all(|c| sign(c).is_some()) {
            for (slot, letter) in signs.iter_mut().zip(&letters) {
                *slot = sign(letter)?;
            }
        } else {
            for pair in letters.chunks(2) {
                let [sign_text, axis] = pair else { return None };
                let axis = AXES.iter().position(|a| a == &axis.to_ascii_uppercase())?;
                if signs[axis] != 0 {
                    return None;
                }
                signs[axis] = sign(sign_text)?;
            }
        }
        let first = *signs.iter().find(|s| **s != 0)?;
        let diagonal = Self(signs.map(|s| s * first));
        (diagonal.axes().count() >= 2).then_some(diagonal)
    }

    /// The axes that move.
    fn axes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(|i| self.0[*i] != 0)
    }

    /// Three axes, not two.
    pub fn is_body(&self) -> bool {
        self.axes().count() == 3
    }

    /// `+X+Y-Z`.
    pub fn name(&self) -> String {
        let word = |i: usize| format!("{}{}", if self.0[i] > 0 { '+' } else { '-' }, AXES[i]);
        self.axes().map(word).collect()
    }
}

/// One diagonal, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagonalResult {
    /// Which.
    pub diagonal: Diagonal,
    /// Its readings.
    pub measurement: Measurement,
    /// Its parameters.
    pub result: Positioning,
    /// Slope of the mean deviation: how much it is too long, as a ratio. `None` from one target. Unit: 1.
    pub stretch: Option<f64>,
}

/// The angle between two axes, from diagonals.
#[derive(Debug, Clone, PartialEq)]
pub struct SquarenessHint {
    /// Such as `XY`.
    pub axes: String,
    /// Angle by which the axes are closer than 90°, rad.
    pub closer_rad: f64,
    /// From body diagonals, not from those of the face.
    pub of_body: bool,
}

/// A test of diagonals, evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagonals {
    /// Every diagonal, in the order of the file.
    pub diagonals: Vec<DiagonalResult>,
    /// Angles between the axes, where edges and enough diagonals are known.
    pub squareness: Vec<SquarenessHint>,
}

impl Diagonals {
    /// The largest value of all diagonals, mm.
    pub fn largest(&self, quantity: Quantity) -> Option<f64> {
        let values = self.diagonals.iter().filter_map(|d| d.result.value(quantity));
        values.reduce(|a, b| if b.abs() > a.abs() { b } else { a })
    }
}

/// Reads and evaluates a table of diagonals; `None` with errors in `problems`.
pub fn evaluate(
    file: &str,
    text: &str,
    conditions: &Conditions,
    problems: &mut Diagnostics,
) -> Option<Diagonals> {
    let sheet = Sheet::parse(file, text, role_cells, problems)?.with_repeats(problems);
    iso230_2::warn_of_unused(&sheet, &["direction", "diagonal"], problems);
    super::check_temperatures(&sheet, problems);
    super::check_times(&sheet, false, problems);
    let Some(column) =
        sheet.columns.iter().find(|c| c.name == "diagonal" && c.cells == Cells::Words)
    else {
        let message = "the table has no column `diagonal`".to_owned();
        let hint = "name each: +++, ++-, +-+, +-- for body diagonals, +X+Y, +X-Y for a face";
        problems.error("missing-column", sheet.headings_place(), message, hint);
        return None;
    };
    let mut order: Vec<f64> = Vec::new();
    for (row, word) in column.values.iter().enumerate() {
        if order.contains(word) {
            continue;
        }
        if Diagonal::parse(&sheet.words[*word as usize]).is_none() {
            let message = format!("`{}` is not a diagonal", sheet.words[*word as usize]);
            let hint = "+++, ++-, +-+, +-- for body diagonals, +X+Y, +X-Y for a face";
            problems.error("bad-diagonal", sheet.row_place(row), message, hint);
            return None;
        }
        order.push(*word);
    }
    let mut diagonals: Vec<DiagonalResult> = Vec::new();
    for word in order {
        let diagonal = Diagonal::parse(&sheet.words[word as usize])?;
        let name = format!("{file} ({})", diagonal.name());
        if diagonals.iter().any(|d| d.diagonal == diagonal) {
            let message = format!("{} is there under two names", diagonal.name());
            let hint = "a diagonal and its opposite are one; give it one name";
            problems.error("duplicate-diagonal", Place::whole(file), message, hint);
            return None;
        }
        let measurement = iso230_2::from_sheet(&sheet.rows_with(column, word), problems)?;
        iso230_2::check(&measurement, &name, problems);
        let place = Place::whole(&name);
        let (kind, length) = (measurement.kind, measurement.length());
        let budget = Budget::new(conditions, kind, length, &place, problems);
        let result = iso230_2::evaluate(&measurement, budget);
        let stretch = stretch(&result);
        diagonals.push(DiagonalResult { diagonal, measurement, result, stretch });
    }
    check_edges(file, &diagonals, conditions, problems)?;
    let squareness = squareness(&diagonals, conditions);
    if squareness.is_empty() {
        let message = "the squareness of the axes is not evaluated".to_owned();
        let hint = "it needs [volume] edges = \"500 400 300 mm\" in the conditions file, and both \
                    diagonals of a face or all four of the body";
        problems.note("no-squareness", Place::whole(file), message, hint);
    }
    Some(Diagonals { diagonals, squareness })
}

/// A diagonal that is longer than its edges allow is that of another volume, and its direction is not known.
fn check_edges(
    file: &str,
    diagonals: &[DiagonalResult],
    conditions: &Conditions,
    problems: &mut Diagnostics,
) -> Option<()> {
    /// Targets may lie a little beyond the corners.
    const BEYOND: f64 = 1.02;
    let Some(edges) = conditions.edges_mm else { return Some(()) };
    let edges = [edges.x, edges.y, edges.z];
    for d in diagonals {
        let whole: f64 = d.diagonal.axes().map(|i| edges[i] * edges[i]).sum();
        let (whole, measured) = (whole.sqrt(), d.measurement.length());
        if measured > BEYOND * whole {
            let message = format!(
                "{} was measured over {measured:.1} mm, with these edges it has {whole:.1} mm",
                d.diagonal.name()
            );
            let hint = "[volume] edges = \"500 400 300 mm\" along X, Y and Z: those of the volume that was measured";
            problems.error("edges-differ", Place::whole(file), message, hint);
            return None;
        }
    }
    Some(())
}

/// Slope of the mean deviations over the targets.
fn stretch(result: &Positioning) -> Option<f64> {
    let one = |p: &iso230_2::Position| {
        let side = p.up.or(p.down).map(|a| a.mean);
        Some((p.target, p.mean().or(side)?))
    };
    let points: Vec<(f64, f64)> = result.positions.iter().filter_map(one).collect();
    let n = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let slope = points.iter().map(|p| (p.0 - mean_x) * p.1).sum::<f64>() / spread;
    Some(slope).filter(|s| s.is_finite())
}

/// A small shear γ of two axes stretches a diagonal with direction cosines u by γ·u_a·u_b.
fn squareness(diagonals: &[DiagonalResult], conditions: &Conditions) -> Vec<SquarenessHint> {
    let Some(edges) = conditions.edges_mm else { return Vec::new() };
    let edges = [edges.x, edges.y, edges.z];
    let mut hints = Vec::new();
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        for of_body in [true, false] {
            let fits = |d: &&DiagonalResult| {
                let moves = |i: usize| d.diagonal.0[i] != 0;
                d.diagonal.is_body() == of_body && moves(a) && moves(b)
            };
            let stretched: Vec<(f64, f64)> = diagonals
                .iter()
                .filter(fits)
                .filter_map(|d| Some((f64::from(d.diagonal.0[a] * d.diagonal.0[b]), d.stretch?)))
                .collect();
            if stretched.len() != if of_body { 4 } else { 2 } {
                continue;
            }
            let moved = (0..3).filter(|i| of_body || *i == a || *i == b);
            let square: f64 = moved.map(|i| edges[i] * edges[i]).sum();
            let cosines = edges[a] * edges[b] / square;
            let mean = stretched.iter().map(|(s, e)| s * e).sum::<f64>() / stretched.len() as f64;
            let closer_rad = mean / cosines;
            if closer_rad.is_finite() {
                let axes = [AXES[a], AXES[b]].iter().collect();
                hints.push(SquarenessHint { axes, closer_rad, of_body });
            }
        }
    }
    hints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_either_way() {
        assert_eq!(Diagonal::parse("++-"), Diagonal::parse("+X+Y-Z"));
        assert_eq!(Diagonal::parse("--+"), Diagonal::parse("++-"));
        assert_eq!(Diagonal::parse("+X-Y").unwrap().name(), "+X-Y");
        for bad in ["", "++", "+X", "+X+X", "+Q+X", "XYZ", "++++"] {
            assert_eq!(Diagonal::parse(bad), None, "{bad}");
        }
    }

    #[test]
    fn squareness_by_hand() {
        // A square face: u_a·u_b = 1/2. The stretches ±10 µm/m differ by 20: γ = 20 µrad.
        let mut text = "diagonal,target_mm,direction,deviation_um\n".to_owned();
        for (name, end) in [("+X+Y", 5.0), ("+X-Y", -5.0)] {
            text += &format!("{name},0,up,0\n{name},500,up,{end}\n");
        }
        let (conditions, _) = Conditions::read("c.toml", "[volume]\nedges = '400 400 300 mm'");
        let mut problems = Diagnostics::new();
        let result = evaluate("d.csv", &text, &conditions, &mut problems).unwrap();
        assert!((result.squareness[0].closer_rad * 1e6 - 20.0).abs() < 1e-9);
        assert!((result.largest(Quantity::EUp).unwrap() * 1e3 - 5.0).abs() < 1e-12);
    }
}
