//! All that one cutter passes through, and how low it comes on nails.

use crate::Cutter;
use crate::motion::{Entry, Motion, ToolPose, slack_mm};
use crate::nail::{Cut, Line, Nail, Reach};
use crate::tree::Tree;
use rayon::prelude::*;
use thiserror::Error;
use trueaxis_geometry::{Vec3, angle};

/// By how much a turning tool may be misjudged, unless another bound is asked for. Unit: mm.
pub const BOUND_MM: f64 = 1e-4;
/// Entries so close to each other count as equal: the first move is named.
const EQUAL_MM: f64 = 1e-9;
/// A face that stands steeper to the nail than this does not end it. Unit: 1.
const GRAZING: f64 = 1e-6;
/// Neighbours among so many nails help each other; the answer never depends on the number of threads.
const CHUNK: usize = 256;
/// A motion turns by no more than this: a straight change of the components of its axis is a constant rate to some nm.
const MOST_TURN_RAD: f64 = 0.02;
/// And is convex to this.
const MOST_SLACK_MM: f64 = 5e-3;
/// Motions that are tried one after the other beside the last one.
const MOST_CLIMBED: usize = 12;
/// Motions of one sweep.
const MOST_MOTIONS: usize = 1 << 26;

/// Why a path can't be swept.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SweepError {
    /// A pose with something that is no number, or an axis that is no unit vector.
    #[error("step {0}: the tip must be finite and the axis a unit vector")]
    NotAPose(usize),
    /// The axis turns by half a turn or more.
    #[error("step {0}: the axis turns by half a turn in one step, its way is unknown")]
    Turned(usize),
    /// Too many motions.
    #[error("the tool turns too much: more than {MOST_MOTIONS} motions")]
    TooMany,
}

/// A cutter and all of its moves.
///
/// ```
/// use trueaxis_cut::{Cutter, Nail, Reach, Sweep, ToolPose, cut};
/// use trueaxis_geometry::Vec3;
/// // A ball of radius 5 goes along X, its lowest point 0.02 mm above the plane.
/// let pose = |x| ToolPose { tip_mm: Vec3::new(x, 0.0, 0.02), axis: Vec3::z() };
/// let sweep = Sweep::new(Cutter::ball(10.0, 30.0).unwrap(), [[pose(-50.0), pose(50.0)]]).unwrap();
/// let nail = |y| Nail { foot_mm: Vec3::new(7.0, y, 0.0), normal: Vec3::z(), below_mm: 1.0, above_mm: 6.0 };
/// let left = cut(&[sweep], &[nail(0.0), nail(3.0), nail(5.5)]);
/// assert!((left[0].cut().unwrap().deviation_mm - 0.02).abs() < 1e-9);
/// // 3 mm to the side the ball is 5 − √(25 − 9) = 1 mm higher.
/// assert!((left[1].cut().unwrap().deviation_mm - 1.02).abs() < 1e-9);
/// assert_eq!(left[2], Reach::NotCut);
/// ```
#[derive(Debug, Clone)]
pub struct Sweep {
    cutter: Cutter,
    motions: Vec<Motion>,
    /// The number of each motion in the order of the program, and where each of that order stands in the list.
    numbers: Vec<u32>,
    places: Vec<u32>,
    tree: Tree,
    bound_mm: f64,
}

impl Sweep {
    /// Of these steps, each from one pose to the next: the tip goes straight, the axis turns at a constant rate.
    ///
    /// # Errors
    /// Poses that are none.
    pub fn new(
        cutter: Cutter,
        steps: impl IntoIterator<Item = [ToolPose; 2]>,
    ) -> Result<Self, SweepError> {
        Self::within(cutter, steps, BOUND_MM)
    }

    /// With another bound on what the turning of the tool may be misjudged by.
    ///
    /// # Errors
    /// Poses that are none.
    pub fn within(
        cutter: Cutter,
        steps: impl IntoIterator<Item = [ToolPose; 2]>,
        bound_mm: f64,
    ) -> Result<Self, SweepError> {
        let mut motions = Vec::new();
        for (i, step) in steps.into_iter().enumerate() {
            divide(&step, i, (&cutter, bound_mm), &mut motions)?;
        }
        let pivot_mm = cutter.pivot_mm();
        let numbers = in_space(&mut motions, pivot_mm);
        let mut places = vec![0; numbers.len()];
        for (place, number) in (0..).zip(&numbers) {
            places[*number as usize] = place;
        }
        let tree = Tree::over(&motions, pivot_mm);
        Ok(Self { cutter, motions, numbers, places, tree, bound_mm })
    }

    /// The cutter.
    pub fn cutter(&self) -> &Cutter {
        &self.cutter
    }

    /// The motion so many after this one in the order of the program.
    fn after(&self, motion: usize, by: i64) -> Option<usize> {
        let number = i64::from(self.numbers[motion]) + by;
        Some(*self.places.get(usize::try_from(number).ok()?)? as usize)
    }
}

/// Motions in which the tool turns little enough to be treated as a whole.
fn divide(
    step: &[ToolPose; 2],
    i: usize,
    (cutter, bound_mm): (&Cutter, f64),
    motions: &mut Vec<Motion>,
) -> Result<(), SweepError> {
    let sound =
        |p: &ToolPose| p.tip_mm.iter().all(|c| c.is_finite()) && (p.axis.norm() - 1.0).abs() < 1e-6;
    let of = u32::try_from(i).map_err(|_| SweepError::TooMany)?;
    if !step.iter().all(sound) {
        return Err(SweepError::NotAPose(i));
    }
    let turn = angle(&step[0].axis, &step[1].axis);
    if turn > 3.1 {
        return Err(SweepError::Turned(i));
    }
    let count = (slack_mm(cutter, step) / MOST_SLACK_MM).sqrt().max(turn / MOST_TURN_RAD);
    let count = count.ceil().max(1.0);
    if count > MOST_MOTIONS as f64 || motions.len() + count as usize > MOST_MOTIONS {
        return Err(SweepError::TooMany);
    }
    let count = count as usize;
    let at = |k: usize| match k {
        0 => step[0],
        k if k == count => step[1],
        k => step[0].towards(&step[1], k as f64 / count as f64),
    };
    let part = |k: usize| k as f32 / count as f32;
    let bounds = (cutter, bound_mm);
    motions.extend(
        (0..count).map(|k| Motion::new(bounds, &[at(k), at(k + 1)], (of, part(k), part(k + 1)))),
    );
    Ok(())
}

/// Motions that are near each other in space come near each other in the list, by Morton's order of their pivots; which numbers they
/// had before.
fn in_space(motions: &mut Vec<Motion>, pivot_mm: f64) -> Vec<u32> {
    let middles: Vec<Vec3> = motions.iter().map(|p| p.middle(pivot_mm).0).collect();
    let low = middles.iter().fold(Vec3::repeat(f64::MAX), |a, b| a.inf(b));
    let high = middles.iter().fold(Vec3::repeat(f64::MIN), |a, b| a.sup(b));
    let size = (high - low).max().max(1e-9);
    let key = |p: &Vec3| {
        let cell = (p - low) * (f64::from(1 << 21) - 1.0) / size;
        [0, 1, 2].map(|k| spaced(cell[k] as u64) << k).into_iter().fold(0, |a, b| a | b)
    };
    let mut order: Vec<(u64, u32)> = (0..).zip(&middles).map(|(i, p)| (key(p), i)).collect();
    order.par_sort_unstable();
    *motions = order.iter().map(|(_, i)| motions[*i as usize]).collect();
    order.into_iter().map(|(_, i)| i).collect()
}

/// The lowest 21 bits with two empty ones after each.
fn spaced(x: u64) -> u64 {
    let mut x = x & 0x1f_ffff;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        x = (x | (x << shift)) & mask;
    }
    x
}

/// What these sweeps leave of the nails, in the order of the nails.
pub fn cut(sweeps: &[Sweep], nails: &[Nail]) -> Vec<Reach> {
    let chunk = |nails: &[Nail]| {
        let mut search = Search { sweeps, found: Vec::new(), last: None, tried: Vec::new() };
        nails.iter().map(|nail| search.reach(nail)).collect::<Vec<_>>()
    };
    nails.par_chunks(CHUNK).flat_map_iter(chunk).collect()
}

/// One nail after the other; the motion that cut the last one is tried first on the next.
struct Search<'s> {
    sweeps: &'s [Sweep],
    /// Entries that are not higher than the lowest: sweep, motion.
    found: Vec<(Entry, usize, usize)>,
    last: Option<(usize, usize)>,
    /// Motions that were tried before the tree is asked.
    tried: Vec<(usize, usize)>,
}

impl Search<'_> {
    fn reach(&mut self, nail: &Nail) -> Reach {
        let line = Line::of(nail);
        self.found.clear();
        let mut lowest_mm = nail.above_mm;
        self.tried.clear();
        if let Some(last) = self.last {
            self.climb_down(&line, last, &mut lowest_mm);
        }
        let sweeps = self.sweeps;
        for (s, sweep) in sweeps.iter().enumerate() {
            let from_mm = lowest_mm + EQUAL_MM;
            let mut offer = |motion: usize| {
                if !self.tried.contains(&(s, motion)) {
                    self.offer(&line, (s, motion), &mut lowest_mm);
                }
                lowest_mm + EQUAL_MM
            };
            let count = sweep.motions.len();
            sweep.tree.visit((&sweep.cutter, &line), from_mm, count, &mut offer);
        }
        self.named(nail)
    }

    /// First the motion that cut the last nail; then those before or after it, as long as they come lower.
    fn climb_down(&mut self, line: &Line, last: (usize, usize), lowest_mm: &mut f64) {
        self.tried.push(last);
        self.offer(line, last, lowest_mm);
        for by in [1, -1] {
            let (mut next, begin_mm) = (last, *lowest_mm);
            for _ in 0..MOST_CLIMBED {
                let Some(motion) = self.sweeps[next.0].after(next.1, by) else { break };
                next.1 = motion;
                let before_mm = *lowest_mm;
                self.tried.push(next);
                self.offer(line, next, lowest_mm);
                if *lowest_mm >= before_mm {
                    break;
                }
            }
            if *lowest_mm < begin_mm {
                break;
            }
        }
    }

    fn offer(&mut self, line: &Line, (s, motion): (usize, usize), lowest_mm: &mut f64) {
        let sweep = &self.sweeps[s];
        let below = *lowest_mm + EQUAL_MM;
        let entry = sweep.motions[motion].entry(&sweep.cutter, line, below, sweep.bound_mm);
        let Some(entry) = entry else { return };
        if entry.at_mm < *lowest_mm {
            *lowest_mm = entry.at_mm;
            self.found.retain(|(e, ..)| e.at_mm <= entry.at_mm + EQUAL_MM);
        }
        if entry.at_mm <= *lowest_mm + EQUAL_MM {
            self.found.push((entry, s, motion));
        }
    }

    fn named(&mut self, nail: &Nail) -> Reach {
        let key = |(entry, s, motion): &(Entry, usize, usize)| {
            let motion = &self.sweeps[*s].motions[*motion];
            (*s, motion.of, motion.place_of_move(entry.place))
        };
        // Where a move ends with an edge on the nail, the next one comes equally low with its face.
        let faces = |(entry, ..): &&(Entry, usize, usize)| entry.out.dot(&nail.normal) < -GRAZING;
        let is_faced = self.found.iter().any(|found| faces(&found));
        let faced = self.found.iter().filter(|found| !is_faced || faces(found));
        let first = faced.min_by(|a, b| {
            let (a, b) = (key(a), key(b));
            (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
        });
        let Some((entry, s, motion)) = first else { return Reach::NotCut };
        self.last = Some((*s, *motion));
        let sweep = &self.sweeps[*s];
        let motion = &sweep.motions[*motion];
        let pose = motion.pose_at(entry.place);
        let out = match is_faced {
            true => entry.out,
            false => motion.out_of_edge(&sweep.cutter, &Line::of(nail), entry),
        };
        let cut = Cut {
            deviation_mm: entry.at_mm,
            sweep: *s,
            step: motion.of as usize,
            place: motion.place_of_move(entry.place),
            tip_mm: pose.tip_mm,
            axis: pose.axis,
            out,
        };
        if entry.at_mm <= -nail.below_mm { Reach::Deeper(cut) } else { Reach::Cut(cut) }
    }
}
