//! Unknowns that readings cannot separate, in words.
//!
//! The null space of a design is a space; people want sentences with few names. So the basis is
//! turned until its columns have as few members as we can find.

use super::design::{Design, Unknown};
use super::fit::Observability;
use nalgebra::DMatrix;

/// A member below this share of the greatest one of its combination is rounding.
const NOTHING: f64 = 1e-6;
/// How many orders of the unknowns are tried.
const TRIES: u64 = 60;

/// A combination of unknowns that no reading sees.
#[derive(Debug, Clone, PartialEq)]
pub struct Confusion {
    /// Number of the unknown and its share, in mm, rad or 1; the first one is 1.
    pub members: Vec<(usize, f64)>,
}

impl Confusion {
    /// The combination as a sum: `EX0C − 1 ball_x + 120 mm/rad EB0C`.
    pub fn formula(&self, design: &Design) -> String {
        let mut text = String::new();
        for (i, (k, share)) in self.members.iter().enumerate() {
            let Some(unknown) = design.unknown(*k) else { continue };
            let sign = match (i, *share < 0.0) {
                (0, false) => "",
                (0, true) => "−",
                (_, false) => " + ",
                (_, true) => " − ",
            };
            let first_is_angle = self.members.first().and_then(|(k, _)| design.unknown(*k));
            let unit = match (first_is_angle.is_some_and(|u| u.is_angle()), unknown.is_angle()) {
                // Factors of a time are in its own unit of mm, rad and s.
                _ if by_time(&unknown) || first_is_angle.is_some_and(|u| by_time(&u)) => "",
                (true, false) => " mm/rad",
                (false, true) => " rad/mm",
                _ => "",
            };
            let size = share.abs();
            let factor = match (size - 1.0).abs() < 1e-6 && unit.is_empty() {
                true => String::new(),
                false => format!("{}{unit} · ", significant(size)),
            };
            text += &format!("{sign}{factor}{}", unknown.name());
        }
        text
    }

    /// What that means: which unknowns, how much of each, and why.
    pub fn words(&self, design: &Design) -> String {
        let unknowns: Vec<(Unknown<'_>, f64)> =
            self.members.iter().filter_map(|(k, s)| Some((design.unknown(*k)?, *s))).collect();
        let names: Vec<String> = unknowns.iter().map(|(u, _)| u.name()).collect();
        let sentence = match &names[..] {
            [] => return String::new(),
            [alone] => return format!("no reading depends on {alone}: {NOT_MOVED}"),
            [first, second] => format!("{first} cannot be separated from {second}"),
            [first, rest @ .., last] => {
                format!("{first} cannot be separated from {} and {last} together", rest.join(", "))
            }
        };
        format!(
            "{sentence}: {} leave every reading as it is; {}",
            amounts(&unknowns),
            why(&unknowns)
        )
    }
}

/// Whether its unit contains a time.
fn by_time(unknown: &Unknown<'_>) -> bool {
    unknown.is_time() || unknown.is_rate()
}

/// Why a reading depends on something not at all.
const NOT_MOVED: &str = "no pose moves what it acts on";

/// `10 µm of EX0C and −10 µm of probe.ball_x`: the greatest is 10.
fn amounts(unknowns: &[(Unknown<'_>, f64)]) -> String {
    let micro = |unknown: &Unknown<'_>, share: f64| match unknown.shown_unit() {
        // Combinations of millionths.
        _ if unknown.is_time() => (share * 1e6, "µs"),
        (unit, scale) => (share * scale, unit),
    };
    let greatest = unknowns.iter().map(|(u, s)| micro(u, *s).0.abs()).fold(0.0, f64::max);
    let one = |(unknown, share): &(Unknown<'_>, f64)| {
        let (amount, unit) = micro(unknown, *share);
        let amount = amount * 10.0 / greatest;
        let sign = if amount < 0.0 { "−" } else { "" };
        format!("{sign}{} {unit} of {}", significant(amount.abs()), unknown.name())
    };
    let all: Vec<String> = unknowns.iter().map(one).collect();
    match &all[..] {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => all.join(""),
    }
}

/// The physical sense of a combination.
fn why(unknowns: &[(Unknown<'_>, f64)]) -> String {
    use crate::instruments::instrument::SetupError;
    let setup = unknowns.iter().find_map(|(u, _)| match u {
        Unknown::Setup(instrument, unknown) => Some((instrument, unknown.error)),
        Unknown::Term(_) => None,
    });
    let machine = unknowns.iter().any(|(u, _)| matches!(u, Unknown::Term(_)));
    match setup {
        None => "in these poses they move the tool alike".to_owned(),
        Some((instrument, _)) if !machine => {
            format!("they are one and the same to {}", instrument.name)
        }
        Some((instrument, error)) => {
            let (point, tool) = (instrument.kind.reference_point(), instrument.kind.tool_point());
            let what = match error {
                SetupError::ReferencePoint(_) => format!("where the {point} stands"),
                SetupError::ReferenceTurn(_) => format!("how the {point} lies"),
                SetupError::Shift(_) => format!("where the element of {} lies", instrument.name),
                SetupError::Tilt(_) => format!("how the element of {} is tilted", instrument.name),
                SetupError::ToolPoint(2) => format!("how far out the {tool} is (the tool length)"),
                SetupError::ToolPoint(_) => format!("where the {tool} sits in the spindle"),
                SetupError::Zero(_) => {
                    format!("the {} of {}", instrument.kind.zero(), instrument.name)
                }
                SetupError::Scale => format!("the scale of {}", instrument.name),
                SetupError::Material => format!("the material of {}", instrument.name),
                SetupError::Drift(_) => format!("the drift of the {point}"),
                SetupError::ZeroDrift => {
                    format!("the drift of the {} of {}", instrument.kind.zero(), instrument.name)
                }
                SetupError::ToolDrift => format!("the drift of the {tool} along the tool"),
            };
            let what = what.replace('_', " ");
            format!("{what} is not known better than by these readings themselves")
        }
    }
}

fn significant(size: f64) -> String {
    let digits = (3 - size.abs().max(1e-12).log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{size:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The combinations that cannot be seen, each with as few members as we can find.
pub fn confusions(sight: &Observability) -> Vec<Confusion> {
    let (n, d) = sight.null_space.shape();
    if d == 0 {
        return Vec::new();
    }
    // Columns of the design scaled to 1: mm and rad weigh alike.
    let scaled = sight.scaled_null_space();
    let mut best: Option<(usize, DMatrix<f64>)> = None;
    for seed in 0..TRIES {
        let reduced = reduced(scaled.transpose(), &order(n, seed));
        let members = reduced.iter().filter(|v| v.abs() > NOTHING).count();
        if best.as_ref().is_none_or(|(fewest, _)| members < *fewest) {
            best = Some((members, reduced));
        }
    }
    let Some((_, rows)) = best else { return Vec::new() };
    let mut found: Vec<Confusion> = rows
        .row_iter()
        .map(|row| {
            let greatest = row.amax();
            let members = row.iter().enumerate().filter(|(_, v)| v.abs() > NOTHING * greatest);
            let raw: Vec<(usize, f64)> =
                members.map(|(k, v)| (k, v / sight.column_length(k))).collect();
            let first = raw.first().map_or(1.0, |(_, v)| *v);
            Confusion { members: raw.into_iter().map(|(k, v)| (k, v / first)).collect() }
        })
        .collect();
    found.sort_by_key(|c| (c.members.len(), c.members.first().map(|m| m.0)));
    found
}

/// An order of the unknowns: the first as they stand, the second backwards, then mixed.
fn order(n: usize, seed: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    match seed {
        0 => {}
        1 => order.reverse(),
        _ => {
            let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let mut key = |_: &usize| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                state >> 33
            };
            let keys: Vec<u64> = order.iter().map(&mut key).collect();
            order.sort_by_key(|k| keys[*k]);
        }
    }
    order
}

/// Gauss and Jordan: every row keeps one unknown that no other row has.
fn reduced(mut rows: DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    let mut next = 0;
    for &k in order {
        if next == rows.nrows() {
            break;
        }
        let pivot =
            (next..rows.nrows()).max_by(|a, b| rows[(*a, k)].abs().total_cmp(&rows[(*b, k)].abs()));
        let Some(pivot) = pivot.filter(|p| rows[(*p, k)].abs() > 1e-4) else { continue };
        rows.swap_rows(next, pivot);
        let by = rows[(next, k)];
        rows.row_mut(next).unscale_mut(by);
        let row = rows.row(next).into_owned();
        for other in (0..rows.nrows()).filter(|r| *r != next) {
            let factor = rows[(other, k)];
            if factor != 0.0 {
                let mut target = rows.row_mut(other);
                target -= &row * factor;
            }
        }
        next += 1;
    }
    rows
}

/// Whether further readings see a combination.
pub fn resolves(
    design: &Design,
    further: &crate::instruments::Readings,
    confusion: &Confusion,
) -> bool {
    let columns = design.columns(further, 0..further.len());
    let mut along = nalgebra::DVector::zeros(design.unknowns());
    for (k, share) in &confusion.members {
        along[*k] = *share;
    }
    // Against what each member alone would show.
    let alone: f64 =
        confusion.members.iter().map(|(k, s)| (columns.row(*k) * *s).norm()).fold(0.0, f64::max);
    (columns.transpose() * along).norm() > 1e-6 * alone
}
