//! The smallest range, the smallest upper end or the largest lower end of distances: sequential linear programmes,
//! then Newton's method where the contact points alone do not fix the element.
//!
//! Docs/model.md eq. 223 to 226. *Source:* Hald and Madsen 1981 (two stages); Anthony, Anthony, Bittner, Butler, Cox,
//! Drieschner et al. 1996 (Chebyshev elements with contact points and multipliers as proof).

use crate::linear::{Best, Linear, Row};
use crate::surface::{Family, Frame, MOST};
use crate::{Criterion, Element};
use nalgebra::{DMatrix, DVector};
use trueaxis_geometry::Vec3;

const MOST_STEPS: usize = 200;
/// Gains below this are rounding; the points have the size 1.
const ROUNDING: f64 = 2e-15;
/// The first radius of trust.
const FIRST_TRUST: f64 = 0.05;
/// Points that are searched at once; the others are checked afterwards.
const WORKING_SET: usize = 60;
/// Points that are added to the working set from each end at first, twice as many each time.
const ADDED: usize = 10;

/// A point that holds the element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Its index, from 0.
    pub index: usize,
    /// Whether it is at the outer end of the zone.
    pub is_outer: bool,
    /// Its multiplier: how much the result changes with this point. The multipliers of an end add up to 1. Unit: 1.
    pub weight: f64,
}

/// A minimum.
#[derive(Debug, Clone)]
pub(crate) struct Minimax {
    pub frame: Frame,
    pub half_angle: f64,
    pub low: f64,
    pub high: f64,
    pub contacts: Vec<Contact>,
    /// How steeply the result could still fall, per length of the size of the points; 0 at a minimum.
    pub slope: f64,
}

impl Minimax {
    /// What was made small.
    pub fn objective(&self, criterion: Criterion) -> f64 {
        objective(criterion, self.low, self.high)
    }
}

pub(crate) fn objective(criterion: Criterion, low: f64, high: f64) -> f64 {
    match criterion {
        Criterion::MinimumCircumscribed => high,
        Criterion::MaximumInscribed => -low,
        _ => high - low,
    }
}

pub(crate) fn ends(criterion: Criterion) -> [bool; 2] {
    match criterion {
        Criterion::MinimumCircumscribed => [true, false],
        Criterion::MaximumInscribed => [false, true],
        _ => [true, true],
    }
}

/// Distances of points about a frame, with their slopes.
pub(crate) struct Distances {
    pub values: Vec<f64>,
    pub slopes: Vec<[f64; MOST]>,
}

impl Distances {
    pub fn about(family: Family, frame: &Frame, half_angle: f64, points: &[Vec3]) -> Self {
        let x = [0.0, 0.0, 0.0, 0.0, half_angle];
        let mut slopes = Vec::with_capacity(points.len());
        let values = points.iter().map(|p| {
            let mut slope = [0.0; MOST];
            let value = family.value(&frame.local(p), &x, &mut slope);
            slopes.push(slope);
            value
        });
        let values = values.collect();
        Self { values, slopes }
    }

    pub fn range(&self) -> (f64, f64) {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        self.values.iter().fold(start, |(l, h), v| (l.min(*v), h.max(*v)))
    }

    /// The linear problem in a box of this half width.
    pub fn linear(&self, unknowns: usize, criterion: Criterion, trust: f64) -> Option<Best> {
        let (low, high) = self.range();
        let middle = match criterion {
            Criterion::MinimumCircumscribed => high,
            Criterion::MaximumInscribed => low,
            _ => 0.5 * (low + high),
        };
        let values: Vec<f64> = self.values.iter().map(|v| (v - middle) / trust).collect();
        let ends = ends(criterion);
        let problem = Linear { unknowns, values: &values, slopes: &self.slopes, ends };
        let mut best = problem.solve()?;
        best.step.iter_mut().for_each(|s| *s *= trust);
        best.ends.iter_mut().for_each(|e| *e = *e * trust + middle);
        Some(best)
    }
}

/// Where the search is.
#[derive(Clone, Copy)]
pub(crate) struct Start {
    pub frame: Frame,
    pub half_angle: f64,
}

/// The minimum near a start over all points; `None` if the search leaves the points.
pub(crate) fn minimise(
    element: Element,
    criterion: Criterion,
    points: &[Vec3],
    start: Start,
) -> Option<Minimax> {
    let family = Family::of(element);
    let mut working: Vec<usize> = match points.len() {
        n if n <= 2 * WORKING_SET => (0..n).collect(),
        n => spread(n),
    };
    let mut at = start;
    for round in 0..60 {
        let added = (ADDED << round.min(16)).min(points.len() / 2);
        add_ends(&mut working, family, points, (at, added));
        let few: Vec<Vec3> = working.iter().map(|i| points[*i]).collect();
        let mut found = Search { family, criterion, points: &few, at }.run()?;
        at = Start { frame: found.frame, half_angle: found.half_angle };
        let all = Distances::about(family, &at.frame, at.half_angle, points);
        let (low, high) = all.range();
        let missed = (found.low - low).max(high - found.high);
        if missed <= 0.0 || working.len() == points.len() {
            (found.low, found.high) = (low, high);
            found.contacts.iter_mut().for_each(|c| c.index = working[c.index]);
            found.contacts.sort_by_key(|c| c.index);
            return Some(found);
        }
    }
    None
}

/// Some of so many points, in step with no pattern: golden sections.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of the count, which is no larger"
)]
fn spread(count: usize) -> Vec<usize> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let share = |k: usize| (k as f64 * GOLDEN).fract();
    let mut some: Vec<usize> =
        (0..WORKING_SET).map(|k| (share(k) * count as f64) as usize).collect();
    some.sort_unstable();
    some.dedup();
    some
}

/// Adds the points at both ends.
fn add_ends(
    working: &mut Vec<usize>,
    family: Family,
    points: &[Vec3],
    (at, added): (Start, usize),
) {
    if working.len() == points.len() {
        return;
    }
    let all = Distances::about(family, &at.frame, at.half_angle, points);
    let mut order: Vec<usize> = (0..points.len()).collect();
    let by_value = |a: &usize, b: &usize| all.values[*a].total_cmp(&all.values[*b]);
    let last = points.len() - added;
    order.select_nth_unstable_by(added, by_value);
    working.extend(&order[..added]);
    order.select_nth_unstable_by(last, by_value);
    working.extend(&order[last..]);
    working.sort_unstable();
    working.dedup();
}

struct Search<'a> {
    family: Family,
    criterion: Criterion,
    points: &'a [Vec3],
    at: Start,
}

impl Search<'_> {
    fn distances(&self, at: Start) -> Distances {
        Distances::about(self.family, &at.frame, at.half_angle, self.points)
    }

    fn moved(&self, x: &[f64]) -> Start {
        let frame = self.family.moved(&self.at.frame, x);
        let by = if self.family == Family::Cone { x[4] } else { 0.0 };
        Start { frame, half_angle: self.at.half_angle + by }
    }

    fn size(&self, d: &Distances) -> f64 {
        let (low, high) = d.range();
        objective(self.criterion, low, high)
    }

    fn run(mut self) -> Option<Minimax> {
        let mut trust = FIRST_TRUST;
        let home = self.at.frame.origin;
        let mut here = self.distances(self.at);
        for _ in 0..MOST_STEPS {
            let best = here.linear(self.family.unknowns(), self.criterion, trust)?;
            let before = self.size(&here);
            let predicted = before - best.objective(ends(self.criterion));
            if predicted <= ROUNDING || trust < 1e-14 {
                break;
            }
            let candidate = self.moved(&best.step);
            let there = self.distances(candidate);
            let gain = (before - self.size(&there)) / predicted;
            if gain > 0.05 {
                (self.at, here) = (candidate, there);
            }
            // Away from a full step the contact points alone do not fix the element.
            if gain < 0.75
                && let Some(x) = self.newton(&here, &best.rows)
            {
                let shorter = [1.0, 0.5, 0.2, 0.05].map(|part| x.map(|v| v * part));
                let there = shorter.iter().map(|x| (self.moved(x), self.distances(self.moved(x))));
                let mut better = there.filter(|(_, d)| self.size(d) < self.size(&here) - ROUNDING);
                if let Some((at, there)) = better.next() {
                    drop(better);
                    (self.at, here) = (at, there);
                }
            }
            trust *= if gain > 0.75 {
                2.0
            } else if gain < 0.25 {
                0.25
            } else {
                1.0
            };
            trust = trust.min(0.5);
            if (self.at.frame.origin - home).norm() > 20.0 {
                return None;
            }
        }
        Some(self.result(&here))
    }

    /// Contact points and multipliers of the place, and how steeply it could still fall.
    fn result(&self, here: &Distances) -> Minimax {
        const BOX: f64 = 1e-7;
        let (low, high) = here.range();
        let best = here.linear(self.family.unknowns(), self.criterion, BOX);
        let mut contacts = Vec::new();
        let mut slope = f64::INFINITY;
        if let Some(best) = best {
            let falls = self.size(here) - best.objective(ends(self.criterion));
            slope = (falls / BOX).max(0.0);
            contacts.extend(best.rows.iter().filter_map(|(row, weight)| contact(*row, *weight)));
        }
        let Start { frame, half_angle } = self.at;
        Minimax { frame, half_angle, low, high, contacts, slope }
    }

    /// Newton's method for the contact points of a linear solution: all of them at their ends, no slope. Points that
    /// would hold with a negative multiplier are left out, one after the other.
    fn newton(&self, here: &Distances, rows: &[(Row, f64)]) -> Option<[f64; MOST]> {
        let found = rows.iter().filter_map(|(row, weight)| contact(*row, *weight));
        let mut contacts: Vec<Contact> = found.collect();
        while !contacts.is_empty() {
            let mut x = [0.0, 0.0, 0.0, 0.0, self.at.half_angle];
            self.newton_steps(here, &mut contacts, &mut x)?;
            let least = (0..contacts.len())
                .min_by(|a, b| contacts[*a].weight.total_cmp(&contacts[*b].weight))?;
            if contacts[least].weight > -1e-9 {
                x[4] -= self.at.half_angle;
                return Some(x);
            }
            contacts.remove(least);
        }
        None
    }

    fn newton_steps(
        &self,
        here: &Distances,
        contacts: &mut [Contact],
        x: &mut [f64; MOST],
    ) -> Option<()> {
        let n = self.family.unknowns();
        let (low, high) = here.range();
        let mut level = [high, low];
        for _ in 0..12 {
            let (matrix, right) = self.conditions(x, contacts, level);
            let step = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
            (0..n).for_each(|k| x[k] -= step[k]);
            level = [level[0] - step[n], level[1] - step[n + 1]];
            for (i, c) in contacts.iter_mut().enumerate() {
                c.weight -= step[n + 2 + i];
            }
            let size = step.rows(0, n).amax();
            if !size.is_finite() || size > 0.5 {
                return None;
            }
            if size < 1e-15 {
                break;
            }
        }
        Some(())
    }

    /// The conditions of a minimum and their derivatives by unknowns, ends and multipliers.
    fn conditions(
        &self,
        x: &[f64; MOST],
        contacts: &[Contact],
        level: [f64; 2],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let (n, k) = (self.family.unknowns(), contacts.len());
        let size = n + 2 + k;
        let (mut matrix, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (i, c) in contacts.iter().enumerate() {
            let sign = if c.is_outer { 1.0 } else { -1.0 };
            let end = n + usize::from(!c.is_outer);
            let q = self.at.frame.local(&self.points[c.index]);
            let mut slope = [0.0; MOST];
            let value = self.family.value(&q, x, &mut slope);
            let row = n + 2 + i;
            for a in 0..n {
                right[a] += sign * c.weight * slope[a];
                matrix[(a, row)] = sign * slope[a];
                matrix[(row, a)] = sign * slope[a];
            }
            right[row] = sign * (value - level[end - n]);
            matrix[(row, end)] = -sign;
            matrix[(end, row)] = 1.0;
            right[end] += c.weight;
            self.bend(&q, x, sign * c.weight, &mut matrix);
        }
        for end in 0..2 {
            if contacts.iter().any(|c| c.is_outer == (end == 0)) {
                right[n + end] -= 1.0;
            } else {
                matrix[(n + end, n + end)] = 1.0;
            }
        }
        (matrix, right)
    }

    /// Adds the second derivatives of one point, from differences of its slopes.
    fn bend(&self, q: &Vec3, x: &[f64; MOST], weight: f64, matrix: &mut DMatrix<f64>) {
        let h = 1e-4 * self.family.bend(q, x).clamp(1e-9, 1.0);
        for a in 0..self.family.unknowns() {
            let slope_at = |by: f64| {
                let (mut moved, mut slope) = (*x, [0.0; MOST]);
                moved[a] += by;
                self.family.value(q, &moved, &mut slope);
                slope
            };
            let (up, down) = (slope_at(h), slope_at(-h));
            for b in 0..self.family.unknowns() {
                matrix[(b, a)] += weight * (up[b] - down[b]) / (2.0 * h);
            }
        }
    }
}

fn contact(row: Row, weight: f64) -> Option<Contact> {
    let (index, is_outer) = match row {
        Row::Upper(index) => (index, true),
        Row::Lower(index) => (index, false),
        Row::Box(..) => return None,
    };
    (weight > 1e-9).then_some(Contact { index, is_outer, weight })
}

/// The contact points with their multipliers at a place that is known to be the best.
pub(crate) fn contacts_of(here: &Distances, family: Family, criterion: Criterion) -> Vec<Contact> {
    let best = here.linear(family.unknowns(), criterion, 1e-7);
    let rows = best.map(|b| b.rows).unwrap_or_default();
    let mut found: Vec<Contact> =
        rows.iter().filter_map(|(row, weight)| contact(*row, *weight)).collect();
    found.sort_by_key(|c| c.index);
    found
}
