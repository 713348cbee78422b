//! Circles that stay circles: one through the corrected places, where it keeps the residual.

use super::block::{Block, Put};
use super::number::Of;
use super::words::Word;
use trueaxis_motion::axis_path::Fault;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Arc, Axis, Position};

/// How far the radii at both ends of an arc may differ for every control, mm.
///
/// # Source
/// LinuxCNC 2.9 user manual, "G2, G3 Arc Move", Center Format Arcs: an arc is refused from 0.0127 mm (0.0005
/// inch) on if that is more than 0.1 % of its radius. Other controls state such a limit in a parameter; ours
/// is the sum of two roundings to 1 µm.
const RADII_MM: f64 = 2e-3;

/// A place of the corrected path in program coordinates: from 0 at the beginning to 1 at the end.
pub(super) struct PathPlace {
    pub u: f64,
    pub at: Position,
}

/// What an arc may leave: mm, and degrees of the rotary axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    pub linear_mm: f64,
    pub rotary_deg: f64,
}

/// The arc through corrected places; `None` if none keeps within what is allowed. `round` rounds to the
/// increments of the control.
pub(super) fn fit(
    arc: &Arc,
    places: &[PathPlace],
    allowed: Allowed,
    round: impl Fn(f64) -> f64,
) -> Option<Arc> {
    let [first, second, _] = arc.plane.axes();
    let flat = |p: &PathPlace| [p.at[first], p.at[second]];
    let (start, end) = (flat(places.first()?), flat(places.last()?));
    let center = match distance(start, end) > 1e-2 {
        true => center_between(start, end, &places.iter().map(flat).collect::<Vec<_>>())?,
        false => mean(places, flat),
    };
    let from_start = [0, 1].map(|i| round(center[i] - start[i]));
    let center_mm = [0, 1].map(|i| start[i] + from_start[i]);
    let fitted = Arc { center_mm, ..*arc };
    let differs = (distance(start, center_mm) - distance(end, center_mm)).abs();
    let keeps = |p: &PathPlace| is_near(&fitted, places, p, allowed);
    (differs <= RADII_MM && places.iter().all(keeps)).then_some(fitted)
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The centre as far from both ends, with the least squares of the distances between.
///
/// ```text
///     c = m + t n,  n ⟂ (e − s);   |p − c|² = |s − c|²   is linear in t:   2 t n·(p − s) = |p−m|² − |s−m|²
/// ```
fn center_between(start: [f64; 2], end: [f64; 2], places: &[[f64; 2]]) -> Option<[f64; 2]> {
    let middle = [0, 1].map(|i| 0.5 * (start[i] + end[i]));
    let length = distance(start, end);
    let normal = [-(end[1] - start[1]) / length, (end[0] - start[0]) / length];
    let square = distance(start, middle).powi(2);
    let (mut above, mut below) = (0.0, 0.0);
    for p in places {
        let along = 2.0 * (normal[0] * (p[0] - start[0]) + normal[1] * (p[1] - start[1]));
        above += along * (distance(*p, middle).powi(2) - square);
        below += along * along;
    }
    let t = above / below;
    t.is_finite().then(|| [0, 1].map(|i| middle[i] + t * normal[i]))
}

/// The centre of a full circle: the mean of places that follow each other evenly.
fn mean(places: &[PathPlace], flat: impl Fn(&PathPlace) -> [f64; 2]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for pair in places.windows(2) {
        let share = 0.5 * (pair[1].u - pair[0].u);
        let (a, b) = (flat(&pair[0]), flat(&pair[1]));
        sum = [0, 1].map(|i| sum[i] + share * (a[i] + b[i]));
    }
    sum
}

/// Whether the arc passes a place at its time.
fn is_near(arc: &Arc, places: &[PathPlace], place: &PathPlace, allowed: Allowed) -> bool {
    let (Some(start), Some(end)) = (places.first(), places.last()) else { return false };
    let [first, second, _] = arc.plane.axes();
    let arm = |p: &Position| [p[first] - arc.center_mm[0], p[second] - arc.center_mm[1]];
    let (from, to) = (arm(&start.at), arm(&end.at));
    let sense = if arc.ccw { 1.0 } else { -1.0 };
    let turn = std::f64::consts::TAU;
    let between = to[1].atan2(to[0]) - from[1].atan2(from[0]);
    let mut sweep = (sense * between).rem_euclid(turn);
    if sweep < 1e-6 {
        sweep += turn;
    }
    sweep += turn * f64::from(arc.turns.saturating_sub(1));
    let angle = from[1].atan2(from[0]) + sense * sweep * place.u;
    let radius = from[0].hypot(from[1]) * (1.0 - place.u) + to[0].hypot(to[1]) * place.u;
    let mut at = Position::default();
    for axis in Axis::ALL {
        at[axis] = start.at[axis] + (end.at[axis] - start.at[axis]) * place.u;
    }
    at[first] = arc.center_mm[0] + radius * angle.cos();
    at[second] = arc.center_mm[1] + radius * angle.sin();
    let off = |axis: Axis| at[axis] - place.at[axis];
    let linear = [Axis::X, Axis::Y, Axis::Z].map(off).iter().map(|d| d * d).sum::<f64>().sqrt();
    let rotary = Axis::ALL.into_iter().filter(|a| a.is_rotary()).map(|a| off(a).abs());
    linear <= allowed.linear_mm && rotary.fold(0.0, f64::max) <= allowed.rotary_deg
}

impl Block<'_> {
    /// Whether the words of the circle can be corrected: I J K, R or CR.
    pub(super) fn has_arc_words(&self) -> bool {
        let is_plain = |word: &Option<Word>| word.as_ref().is_none_or(|w| w.value.is_some());
        let centers = self.words.vector.iter().all(is_plain);
        let named = self.words.vector.iter().flatten().count();
        // A computed radius cannot become a centre.
        let one_radius = self.words.circle_words.len() == 1 && (named > 0 || !self.resting.circle);
        let only_centers = named > 0 && self.words.circle_words.len() == named;
        self.control != Control::Heidenhain && centers && (one_radius || only_centers)
    }

    /// Centre words for the arc that is written, from the place where it begins.
    pub(super) fn arc_words(
        &mut self,
        arc: &Arc,
        from: &Position,
        puts: &mut Vec<Put>,
    ) -> Result<(), Fault> {
        let [first, second, _] = arc.plane.axes();
        let mut texts = Vec::new();
        for (axis, center) in [first, second].into_iter().zip(arc.center_mm) {
            let value = center - from[axis];
            let value = self.grid.round(value, Of::Linear);
            let letters = match axis {
                Axis::X => "I",
                Axis::Y => "J",
                _ => "K",
            };
            match self.words.vector[axis as usize].clone() {
                Some(word) => {
                    let mm = self.grid.unit.mm();
                    let word = Word { value: word.value.map(|v| v * mm), ..word };
                    self.put_number(&word, value, Of::Linear)?;
                }
                None => {
                    let text = self.grid.text(value, Of::Linear, self.control);
                    texts.push(Put { letters, text });
                }
            }
        }
        if self.words.vector.iter().flatten().next().is_some() {
            // The other centre word was zero before: it is written only where it is not now.
            puts.extend(
                texts.into_iter().filter(|put| !put.text.trim_matches(['0', '.', '-']).is_empty()),
            );
            return Ok(());
        }
        let equals = if self.control == Control::Sinumerik840d { "=" } else { "" };
        let words: Vec<String> =
            texts.iter().map(|put| format!("{}{equals}{}", put.letters, put.text)).collect();
        if let Some(radius) = self.words.circle_words.first() {
            self.edits.put(radius.clone(), &words.join(" "));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_nc::moves::Plane;

    fn places(center: [f64; 2], radius: f64, from_deg: f64, sweep_deg: f64) -> Vec<PathPlace> {
        let place = |k: u32| {
            let u = f64::from(k) / 20.0;
            let angle = (from_deg + sweep_deg * u).to_radians();
            let mut at = Position::default();
            at.0[0] = center[0] + radius * angle.cos();
            at.0[1] = center[1] + radius * angle.sin();
            PathPlace { u, at }
        };
        (0..=20).map(place).collect()
    }

    #[test]
    fn circles_are_found_again() {
        let allowed = Allowed { linear_mm: 1e-9, rotary_deg: 1e-9 };
        for (sweep, ccw) in [(90.0, true), (200.0, true), (360.0, true), (-45.0, false)] {
            let arc = Arc { plane: Plane::Xy, center_mm: [0.0; 2], turns: 1, ccw };
            let found = fit(&arc, &places([3.0, -4.0], 25.0, 20.0, sweep), allowed, |v| v).unwrap();
            assert!(distance(found.center_mm, [3.0, -4.0]) < 1e-9, "{sweep} {found:?}");
        }
    }

    #[test]
    fn an_ellipse_is_no_circle() {
        let allowed = Allowed { linear_mm: 1e-3, rotary_deg: 1e-4 };
        let arc = Arc { plane: Plane::Xy, center_mm: [0.0; 2], turns: 1, ccw: true };
        let mut ellipse = places([0.0; 2], 25.0, 0.0, 300.0);
        for place in &mut ellipse {
            place.at.0[0] *= 1.0 + 1e-4;
        }
        assert!(fit(&arc, &ellipse, allowed, |v| v).is_none());
    }
}
