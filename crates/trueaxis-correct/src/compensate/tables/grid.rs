//! What the positions of three linear axes add to the same three axes: a grid of equal distances.
//!
//! ```text
//!     c(x, y, z) = Σ over the eight corners of the cell: share_x·share_y·share_z · c(corner)
//! ```
//!
//! Trilinear inside, the value of the nearest place of the grid outside. docs/model.md eq. 329.

use trueaxis_machine::chain::CommandFault;

/// One axis of a grid, in counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Side {
    /// The axis, by its place in the machine.
    pub axis: usize,
    /// The first position.
    pub from: i64,
    /// The distance from one position to the next.
    pub step: i64,
    /// How many positions; 1 where the axis does not matter.
    pub count: usize,
}

/// A grid of values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    /// The three axes; the first runs fastest in `values`.
    pub sides: [Side; 3],
    /// What is added to each of the three axes, counts.
    pub values: Vec<[i64; 3]>,
}

/// What a control allows of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridRule {
    /// The most points of all.
    pub most_points: usize,
    /// The most points along one axis.
    pub most_along: usize,
    /// The least increment of a value, counts.
    pub increment: i64,
    /// Values are at most this large, counts.
    pub largest: i64,
    /// Distances are whole multiples of this, counts.
    pub interval: i64,
}

/// What is added at a place, counts, not yet whole.
pub type Wanted<'a> = dyn Fn([i64; 3]) -> Result<[f64; 3], CommandFault> + 'a;

/// A grid and what is lost between its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Gridded {
    /// The grid.
    pub grid: Grid,
    /// The most that interpolation and rounding lose of one axis. Unit: counts.
    pub loss: f64,
    /// The largest value, counts.
    pub largest: i64,
}

/// Why there is no grid.
#[derive(Debug, Clone, PartialEq)]
pub enum GridFault {
    /// The most points lose more than the bound; the loss in counts.
    TooMany(f64),
    /// A value is larger than the control takes; it in counts.
    TooLarge(i64),
    /// The errors are not known there.
    Machine(CommandFault),
}

impl From<CommandFault> for GridFault {
    fn from(fault: CommandFault) -> Self {
        Self::Machine(fault)
    }
}

impl Side {
    fn at(&self, index: usize) -> i64 {
        self.from + self.step * index as i64
    }

    /// The cell of a position and how far into it.
    fn cell(&self, at: f64) -> (usize, f64) {
        let last = self.count.saturating_sub(1);
        let cells = ((at - self.from as f64) / self.step as f64).clamp(0.0, last as f64);
        let index = (cells.floor() as usize).min(last.saturating_sub(1));
        (index, cells - index as f64)
    }
}

impl Grid {
    /// What is added to each of the three axes at a place, all in counts.
    pub fn at(&self, place: [f64; 3]) -> [f64; 3] {
        let cells: [(usize, f64); 3] = std::array::from_fn(|i| self.sides[i].cell(place[i]));
        let mut added = [0.0; 3];
        for corner in 0..8_usize {
            let mut share = 1.0;
            let index: [usize; 3] = std::array::from_fn(|i| {
                let (low, into) = cells[i];
                let upper = corner >> i & 1;
                share *= if upper == 1 { into } else { 1.0 - into };
                (low + upper).min(self.sides[i].count - 1)
            });
            if share == 0.0 {
                continue;
            }
            for (a, v) in added.iter_mut().zip(self.values[self.place(index)]) {
                *a += share * v as f64;
            }
        }
        added
    }

    /// The same with the other sign.
    pub fn negated(&self) -> Self {
        let values = self.values.iter().map(|v| v.map(|c| -c)).collect();
        Self { values, ..self.clone() }
    }

    /// Where the point of these indices stands in `values`.
    pub fn place(&self, [i, j, k]: [usize; 3]) -> usize {
        let [a, b, _] = self.sides.map(|s| s.count);
        i + a * (j + b * k)
    }

    /// The positions of the points in the order of `values`, counts.
    pub fn places(&self) -> impl Iterator<Item = [i64; 3]> + '_ {
        let [a, b, c] = self.sides;
        (0..c.count).flat_map(move |k| {
            (0..b.count).flat_map(move |j| (0..a.count).map(move |i| [a.at(i), b.at(j), c.at(k)]))
        })
    }

    fn filled(sides: [Side; 3], wanted: &Wanted<'_>, increment: i64) -> Result<Self, CommandFault> {
        let mut grid = Self { sides, values: Vec::new() };
        let whole = |v: f64| (v / increment as f64).round() as i64 * increment;
        let values = grid.places().map(|p| Ok(wanted(p)?.map(whole)));
        grid.values = values.collect::<Result<_, CommandFault>>()?;
        Ok(grid)
    }
}

/// Places are checked between the points, so many along each axis.
const LOOKS: i64 = 13;

/// The grid with few points that loses at most `bound` (counts): along each axis as many as its own curvature
/// needs, then more along all until the whole holds.
///
/// # Errors
/// [`GridFault`]
pub fn place(
    wanted: &Wanted<'_>,
    ends: Ends,
    rule: GridRule,
    bound: f64,
) -> Result<Gridded, GridFault> {
    let looks = looks(wanted, ends)?;
    let mut counts = [2_usize; 3];
    let mut best = f64::INFINITY;
    loop {
        let sides = std::array::from_fn(|i| side(ends[i], counts[i], rule.interval));
        let grid = Grid::filled(sides, wanted, rule.increment)?;
        let largest = grid.values.iter().flatten().map(|v| v.abs()).max().unwrap_or(0);
        if largest > rule.largest {
            return Err(GridFault::TooLarge(largest));
        }
        let loss = looks.iter().map(|look| difference(&grid, look)).fold(0.0, f64::max);
        best = best.min(loss);
        if loss <= bound {
            return Ok(Gridded { grid, loss, largest });
        }
        // The axis along which the points lie too far apart gets a quarter more.
        let worst = worst_axis(&grid, wanted, (ends, &looks))?;
        let more = |n: usize| (n + n.div_ceil(4)).min(rule.most_along);
        let mut grown = counts;
        grown[worst] = more(counts[worst]);
        let points: usize = grown.iter().product();
        if grown == counts || points > rule.most_points {
            return Err(GridFault::TooMany(best));
        }
        counts = grown;
    }
}

/// Positions from end to end; the last one may lie beyond the end by less than an interval of each.
fn side((axis, from, to): (usize, i64, i64), count: usize, interval: i64) -> Side {
    let cells = (count as i64 - 1) * interval;
    let step = (to - from + cells - 1) / cells * interval;
    Side { axis, from, step, count }
}

/// A place in between, and what is wanted there.
type Look = ([i64; 3], [f64; 3]);
/// From end to end of the three axes.
type Ends = [(usize, i64, i64); 3];
/// Of so many looks one tells along which axis most is lost.
const EVERY: usize = 7;

fn looks(wanted: &Wanted<'_>, ends: Ends) -> Result<Vec<Look>, CommandFault> {
    // Golden steps along each axis fall between the points of any even spacing.
    let at = |i: usize, n: i64| {
        let (_, from, to) = ends[i];
        let share = (0.5 + n as f64 * GOLDEN).fract();
        from + ((to - from) as f64 * share) as i64
    };
    let places = (0..LOOKS.pow(3)).map(|n| {
        let place = [at(0, n % LOOKS), at(1, n / LOOKS % LOOKS), at(2, n / LOOKS / LOOKS)];
        Ok((place, wanted(place)?))
    });
    places.collect()
}

/// The axis along which most is lost.
fn worst_axis(
    grid: &Grid,
    wanted: &Wanted<'_>,
    (ends, looks): (Ends, &[Look]),
) -> Result<usize, CommandFault> {
    let mut along = [0.0_f64; 3];
    for (place, _) in looks.iter().step_by(EVERY) {
        for (i, along) in along.iter_mut().enumerate() {
            // Moved onto the points of the other axes, only this axis interpolates.
            let mut on = *place;
            for other in (0..3).filter(|o| *o != i) {
                let side = grid.sides[other];
                let (index, into) = side.cell(place[other] as f64);
                on[other] = side.at(index + usize::from(into > 0.5)).min(ends[other].2);
            }
            *along = along.max(difference(grid, &(on, wanted(on)?)));
        }
    }
    Ok((0..3).max_by(|a, b| along[*a].total_cmp(&along[*b])).unwrap_or(0))
}

/// The golden section: its multiples are never near a point of an even spacing for long.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

fn difference(grid: &Grid, (place, want): &Look) -> f64 {
    let have = grid.at(place.map(|p| p as f64));
    have.iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULE: GridRule = GridRule {
        most_points: 15_625,
        most_along: 128,
        increment: 1,
        largest: 1_000_000,
        interval: 1000,
    };
    const ENDS: [(usize, i64, i64); 3] =
        [(0, 0, 1_000_000_000), (1, -200_000_000, 300_000_000), (2, -400_000_000, 0)];

    /// x·y is trilinear: eight points hold it exactly; at 500 and 100 it is 50 000.
    #[test]
    fn trilinear_functions_need_eight_points() {
        let product = |[x, y, _]: [i64; 3]| Ok([x as f64 * 1e-6 * (y as f64 * 1e-6), 0.0, 1e4]);
        let done = place(&product, ENDS, RULE, 1.0).unwrap();
        assert_eq!(done.grid.values.len(), 8);
        let there = done.grid.at([5e8, 1e8, -1e8]);
        assert!((there[0] - 50_000.0).abs() < 1.0 && (there[2] - 1e4).abs() < 1e-6, "{there:?}");
        // Held outside.
        assert_eq!(done.grid.at([2e9, 5e8, 1e9]), done.grid.at([1e9, 3e8, 0.0]));
    }

    #[test]
    fn only_the_axis_that_bends_gets_more_points() {
        let bow = |[_, y, _]: [i64; 3]| Ok([0.0, 4e4 * (y as f64 / 5e8).powi(2), 0.0]);
        let done = place(&bow, ENDS, RULE, 1000.0).unwrap();
        assert_eq!([done.grid.sides[0].count, done.grid.sides[2].count], [2, 2]);
        // 10 000 counts of sag over the whole, a quarter of it with every half.
        assert!((4..=6).contains(&done.grid.sides[1].count), "{:?}", done.grid.sides);
        let rule = GridRule { most_points: 8, ..RULE };
        assert!(matches!(place(&bow, ENDS, rule, 1000.0), Err(GridFault::TooMany(_))));
        let rule = GridRule { largest: 5000, ..RULE };
        assert!(matches!(place(&bow, ENDS, rule, 1000.0), Err(GridFault::TooLarge(_))));
    }
}
