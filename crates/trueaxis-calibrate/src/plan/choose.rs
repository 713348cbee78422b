//! From candidates to the poses that are measured, and a plain grid to compare with.

use super::expect::{Expectation, expect};
use super::file::{Candidates, Plan};
use super::planned_design;
use super::program::{check, program};
use nalgebra::DMatrix;
use rayon::prelude::*;
use trueaxis_geometry::exchange::{Candidate, Exchange, Selection};
use trueaxis_machine::axis::{AxisKind, Command};
use trueaxis_measure::measure::Readings;
use trueaxis_measure::measure::path::{Path, come_from};
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::fit::{LEAST_SINGULAR_VALUE, normal_matrix, sight_of};
use trueaxis_nc::Control;

/// What is known of a combination before anything is read, against all candidates together: so
/// little that it never counts, so much that the matrices stay regular.
const NEXT_TO_NOTHING: f64 = 1e-9;

/// A choice of poses.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The stations of the poses in the order in which they are measured.
    pub stations: Readings,
    /// How many poses.
    pub poses: usize,
    /// From how many.
    pub candidates: usize,
    /// How many of them were left out because the tool would run into something or leave the travel.
    pub blocked: usize,
    /// What they take, s.
    pub time_s: f64,
    /// The criterion from the greedy start through every swap. Unit: 1.
    pub history: Vec<f64>,
    /// What fixed paths and these poses will determine.
    pub expectation: Expectation,
    /// As many poses of a plain grid, and what they would determine.
    pub grid: Option<(usize, Expectation)>,
}

/// Chooses among the candidates of a plan.
///
/// # Errors
/// Where nothing of what is wanted can be seen at all, or nothing fits the limit.
pub fn choose(plan: &Plan, candidates: &Candidates) -> Result<Chosen, String> {
    let design = planned_design(&plan.campaign);
    let mut poses = poses_of(&candidates.stations);
    let all = poses.len();
    let mut fixed = Readings::default();
    plan.paths.iter().for_each(|path| fixed.append(&path.stations));
    // Only what is chosen is driven through; what runs into something is not offered again.
    let selection = loop {
        let selection = exchange(&design, &fixed, candidates, &poses)?.choose();
        if selection.poses.is_empty() {
            return Err("not one pose fits the limit, or all run into something".to_owned());
        }
        let blocked: Vec<usize> = selection
            .poses
            .par_iter()
            .copied()
            .filter(|k| !is_free(plan, &stations_of(candidates, &poses, &[*k])))
            .collect();
        if blocked.is_empty() {
            break selection;
        }
        let mut number = 0;
        poses.retain(|_| {
            number += 1;
            !blocked.contains(&(number - 1))
        });
    };
    let commands: Vec<Command> =
        poses.iter().map(|rows| candidates.stations.commands[rows[0]]).collect();
    let ordered = in_order(plan, &commands, &selection.poses);
    let measured = |numbers: &[usize]| measured(plan, candidates, &poses, numbers);
    let expected = |numbers: &[usize]| {
        let mut all = fixed.clone();
        all.append(&measured(numbers));
        expect(&plan.campaign, &design, &all)
    };
    let grid = plain_grid(plan, &commands, &selection);
    Ok(Chosen {
        stations: measured(&ordered),
        poses: ordered.len(),
        candidates: all,
        blocked: all - poses.len(),
        time_s: selection.cost_s,
        history: selection.history,
        expectation: expected(&ordered),
        grid: grid.map(|numbers| (numbers.len(), expected(&numbers))),
    })
}

/// Some poses in the order in which they are measured, with the sides from which the axes come then and the time that
/// the limit counts.
fn measured(
    plan: &Plan,
    candidates: &Candidates,
    poses: &[Vec<usize>],
    numbers: &[usize],
) -> Readings {
    let mut stations = stations_of(candidates, poses, numbers);
    if !candidates.states_sides(plan, &stations) {
        stations.approaches.fill([0.0; 6]);
        come_from(&mut stations);
    }
    let limit = &candidates.limit;
    let mut at_s = 0.0;
    for i in 0..stations.len() {
        let is_next = i == 0 || stations.groups[i] != stations.groups[i - 1];
        at_s += limit.per_hit_s + if is_next { limit.per_pose_s } else { 0.0 };
        stations.times_s[i] = at_s;
    }
    stations
}

/// Whether nothing is in the way of one pose; not known where no program can be written.
fn is_free(plan: &Plan, stations: &Readings) -> bool {
    let path = Path {
        name: "pose".to_owned(),
        stations: stations.clone(),
        feed_mm_per_s: None,
        dwell_s: 1.0,
        overrun: 0.0,
    };
    // Any control is sufficient; this one knows probing.
    let control = Control::LinuxCnc;
    program(&plan.campaign, &path, &plan.program, control)
        .map_or(true, |text| check(&plan.campaign, &path, &plan.program, &text, control).is_sound())
}

/// The rows of each pose: stations of one group.
fn poses_of(stations: &Readings) -> Vec<Vec<usize>> {
    let mut poses: Vec<Vec<usize>> = Vec::new();
    for (i, group) in stations.groups.iter().enumerate() {
        match poses.last_mut().filter(|rows| stations.groups[rows[0]] == *group) {
            Some(rows) => rows.push(i),
            None => poses.push(vec![i]),
        }
    }
    poses
}

/// Some poses, one after the other; a group each.
fn stations_of(candidates: &Candidates, poses: &[Vec<usize>], numbers: &[usize]) -> Readings {
    let mut stations = Readings::default();
    for (group, number) in numbers.iter().enumerate() {
        for i in &poses[*number] {
            let group = u32::try_from(group).unwrap_or(u32::MAX);
            let row = candidates.stations.row(*i);
            stations.push(trueaxis_measure::measure::Reading { group, ..row });
        }
    }
    stations
}

/// The question in columns of length 1, so that mm and rad weigh alike.
fn exchange(
    design: &Design,
    fixed: &Readings,
    candidates: &Candidates,
    poses: &[Vec<usize>],
) -> Result<Exchange, String> {
    let n = design.unknowns();
    let before = normal_matrix(design, fixed, &[]);
    // Priors are in both; once is enough.
    let none = normal_matrix(design, &Readings::default(), &[]);
    let all = normal_matrix(design, &candidates.stations, &[]) + &before - none;
    let sight = sight_of(design, &all, LEAST_SINGULAR_VALUE);
    let want = &candidates.want;
    let seen: Vec<usize> = want.terms.iter().copied().filter(|k| sight.is_seen[*k]).collect();
    if seen.is_empty() {
        return Err("not one of the wanted errors can be seen from these candidates".to_owned());
    }
    let length: Vec<f64> = (0..n).map(|k| sight.column_length(k)).collect();
    let scaled = DMatrix::from_fn(n, n, |i, j| before[(i, j)] / (length[i] * length[j]));
    let wanted = DMatrix::from_fn(seen.len(), n, |row, k| {
        let allowed = match design.unknown(k) {
            Some(u) if u.is_angle() => want.angle_rad,
            _ => want.length_mm,
        };
        if seen[row] == k { 1.0 / (length[k] * allowed) } else { 0.0 }
    });
    let limit = &candidates.limit;
    let candidate = |rows: &Vec<usize>| {
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        let mut columns = design.columns(&candidates.stations, first..last + 1);
        for (mut row, length) in columns.row_iter_mut().zip(&length) {
            row /= *length;
        }
        let cost_s = limit.per_pose_s + limit.per_hit_s * rows.len() as f64;
        Candidate { columns, cost_s }
    };
    Ok(Exchange {
        candidates: poses.iter().map(candidate).collect(),
        before: scaled + DMatrix::identity(n, n) * NEXT_TO_NOTHING,
        wanted,
        criterion: want.criterion,
        limit_s: limit.time_s.unwrap_or(f64::INFINITY),
        most: limit.poses.unwrap_or(usize::MAX).min(poses.len()),
    })
}

impl Candidates {
    /// The choice as a question, for those who want to ask it themselves.
    ///
    /// # Errors
    /// As [`choose`].
    pub fn exchange(&self, design: &Design, fixed: &Readings) -> Result<Exchange, String> {
        exchange(design, fixed, self, &poses_of(&self.stations))
    }

    /// Whether a station has its sides whatever stands before it: those of a hit and of targets with their overrun.
    pub(super) fn states_sides(&self, plan: &Plan, stations: &Readings) -> bool {
        let own = stations.instruments.first().map(|i| &plan.campaign.instruments[*i as usize]);
        self.overrun > 0.0 || own.is_some_and(|i| i.kind.triggers())
    }

    /// The stations of some of the poses.
    pub fn stations_of(&self, numbers: &[usize]) -> Readings {
        stations_of(self, &poses_of(&self.stations), numbers)
    }
}

/// Mm of a linear axis that take as long as a radian of a rotary one, roughly.
const MM_PER_RAD: f64 = 200.0;

fn way(a: &Command, b: &Command, kinds: &[AxisKind]) -> f64 {
    let part = |i: usize| match kinds.get(i) {
        Some(AxisKind::Rotary) => MM_PER_RAD * (a[i] - b[i]).abs(),
        _ => (a[i] - b[i]).abs(),
    };
    (0..a.len()).map(part).fold(0.0, f64::max)
}

/// From pose to the nearest one that is left.
fn in_order(plan: &Plan, commands: &[Command], chosen: &[usize]) -> Vec<usize> {
    let kinds = kinds(plan);
    let mut left = chosen.to_vec();
    left.sort_unstable();
    let mut ordered: Vec<usize> = Vec::new();
    let mut at = Command::default();
    while !left.is_empty() {
        let distance = |place: &usize| way(&at, &commands[left[*place]], &kinds);
        let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(nearest) = nearest else { break };
        let next = left.remove(nearest);
        at = commands[next];
        ordered.push(next);
    }
    ordered
}

fn kinds(plan: &Plan) -> Vec<AxisKind> {
    plan.campaign.machine.axes().iter().map(|a| a.kind).collect()
}

/// As many poses as were chosen, evenly over the rotary (else all) axes of the candidates.
fn plain_grid(plan: &Plan, commands: &[Command], selection: &Selection) -> Option<Vec<usize>> {
    let kinds = kinds(plan);
    let range = |i: usize| {
        let values = commands.iter().map(|c| c[i]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| (a.min(q), b.max(q)))
    };
    let moved = |i: &usize| {
        let (from, to) = range(*i);
        to - from > 1e-9
    };
    let rotary: Vec<usize> =
        (0..kinds.len()).filter(|i| kinds[*i] == AxisKind::Rotary).filter(moved).collect();
    let over: Vec<usize> =
        if rotary.is_empty() { (0..kinds.len()).filter(moved).collect() } else { rotary };
    let ranges: Vec<(f64, f64)> = over.iter().map(|axis| range(*axis)).collect();
    let mut taken: Vec<usize> = Vec::new();
    for place in lattice(&ranges, &steps(selection.poses.len(), over.len())) {
        let mut wanted = Command::default();
        over.iter().zip(place).for_each(|(axis, q)| wanted[*axis] = q);
        let distance = |k: &usize| {
            let mut at = Command::default();
            over.iter().for_each(|i| at[*i] = commands[*k][*i]);
            way(&at, &wanted, &kinds)
        };
        let free = (0..commands.len()).filter(|k| !taken.contains(k));
        let nearest = free.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        taken.push(nearest);
    }
    Some(taken).filter(|t| !t.is_empty())
}

/// Every combination of so many even steps over these ranges, the first axis fastest; a single step stays at the beginning.
fn lattice(ranges: &[(f64, f64)], steps: &[usize]) -> Vec<Vec<f64>> {
    let place = |mut rest: usize| {
        let of = |((from, to), count): (&(f64, f64), &usize)| {
            let t = (rest % count) as f64 / (count.max(&2) - 1) as f64;
            rest /= count;
            from + (to - from) * t
        };
        ranges.iter().zip(steps).map(of).collect()
    };
    (0..steps.iter().product()).map(place).collect()
}

/// At most `poses` combinations over some axes, as even as it goes.
fn steps(poses: usize, axes: usize) -> Vec<usize> {
    let mut steps = vec![1; axes];
    loop {
        // The first axis of the fewest steps gets one more, if that still fits.
        let total: usize = steps.iter().product();
        let fits = (0..axes).filter(|i| total / steps[*i] * (steps[*i] + 1) <= poses);
        let Some(next) = fits.min_by_key(|i| steps[*i]) else { return steps };
        steps[next] += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fifteen_poses_are_five_by_three() {
        // 4·3 = 12, 4·4 = 16 is too many, 5·3 = 15 fits.
        assert_eq!(steps(15, 2), [5, 3]);
        assert_eq!(steps(15, 0), Vec::<usize>::new());
    }

    #[test]
    fn a_lattice_goes_from_end_to_end() {
        let found = lattice(&[(-30.0, 30.0), (100.0, 50.0)], &[3, 2]);
        let due =
            [[-30.0, 100.0], [0.0, 100.0], [30.0, 100.0], [-30.0, 50.0], [0.0, 50.0], [30.0, 50.0]];
        assert_eq!(found, due);
        assert_eq!(lattice(&[(7.0, 9.0)], &[1]), [[7.0]]);
    }
}
