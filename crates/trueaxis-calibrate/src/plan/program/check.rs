//! What the machine would do with a program: how long it takes, and what is in its way.

use super::ProgramSettings;
use trueaxis_geometry::frame::Pose;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_input::{Diagnostics, Severity};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, AxisKind, Command};
use trueaxis_machine::chain::Link;
use trueaxis_machine::models::{Shape, ToolSegment};
use trueaxis_measure::measure::path::Path;
use trueaxis_measure::measure::{Campaign, Kind};
use trueaxis_motion::collide::{BodyModel, Mesh, Role, load_models, triangles_of};
use trueaxis_motion::report::issue_text;
use trueaxis_motion::{
    AxisWatch, Batch, Collisions, IssueList, Observer, Options, SetUp, SetUpTool, Summary, simulate,
};
use trueaxis_nc::{Control, Program};

/// A ball is hit and held; collisions are checked with what lies inside its surface.
const INSIDE: f64 = 0.6;

/// What came of a program.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramCheck {
    /// How long it runs, s.
    pub duration_s: f64,
    /// How far from its station the machine would stand at worst: what the decimals of
    /// the program leave. Infinite if a station is not reached. Unit: mm or rad.
    pub off_station: f64,
    /// What would go wrong, in words.
    pub critical: Vec<String>,
    /// What costs only time, or comes near.
    pub minor: Vec<String>,
    /// Errors of the program itself.
    pub errors: Vec<String>,
}

impl ProgramCheck {
    /// Whether nothing is in its way.
    pub fn is_sound(&self) -> bool {
        self.critical.is_empty() && self.errors.is_empty()
    }
}

/// A stand farther from its station than this is another one, mm or rad.
const SAME_PLACE: f64 = 1e-3;
/// Less is no motion, mm or rad.
const REST: f64 = 1e-7;

/// Watches how near the machine comes to its stations, and where it waits.
#[derive(Default)]
struct Visits {
    /// Where the blocks end.
    ends: Vec<Command>,
    /// Where the axes were last, and from which side each has come.
    last: Option<(Command, Approach)>,
    /// Where the machine waited, and from which sides it had come.
    waits: Vec<(Command, Approach)>,
}

impl Observer for Visits {
    fn path(&mut self, batch: &Batch<'_>) {
        for node in batch.nodes {
            let (before, mut came) = self.last.unwrap_or((node.command, Approach::default()));
            for ((side, to), from) in came.iter_mut().zip(&node.command).zip(&before) {
                if (to - from).abs() > REST {
                    *side = (to - from).signum();
                }
            }
            self.last = Some((node.command, came));
            if node.dwell_s > 0.0 {
                self.waits.push((node.command, came));
            }
        }
        self.ends.extend(batch.nodes.iter().filter(|n| n.last).map(|n| n.command));
    }
}

impl Visits {
    /// How far the farthest station is from the nearest end of a block, by its worst axis; 0 without stations.
    fn off_stations(&self, stations: &[Command]) -> f64 {
        // Along the axis that is busiest, the search from a station ends soon.
        let way = |k: usize| {
            let at = || stations.iter().map(|s| s[k]);
            at().fold(f64::NEG_INFINITY, f64::max) - at().fold(f64::INFINITY, f64::min)
        };
        let axes = 0..Command::default().len();
        let along = axes.max_by(|a, b| way(*a).total_cmp(&way(*b))).unwrap_or(0);
        let mut ends = self.ends.clone();
        ends.sort_by(|a, b| a[along].total_cmp(&b[along]));
        ends.dedup();
        let off = |station: &Command| {
            let from = ends.partition_point(|end| end[along] < station[along]);
            let (below, above) = ends.split_at(from);
            let apart =
                |a: &Command| a.iter().zip(station).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let nearest = |nearest: f64, end: &Command| {
                let farther = (end[along] - station[along]).abs() >= nearest;
                if farther { Err(nearest) } else { Ok(nearest.min(apart(end))) }
            };
            let up = above.iter().try_fold(f64::INFINITY, nearest).unwrap_or_else(|n| n);
            below.iter().rev().try_fold(up, nearest).unwrap_or_else(|n| n)
        };
        stations.iter().map(off).fold(0.0, f64::max)
    }

    /// How the stands differ from those that are planned, in their order: an error, and what is only less
    /// good.
    fn compare(&self, machine: &Machine, path: &Path) -> (Option<String>, Vec<String>) {
        let stations = &path.stations;
        let same = |(a, b): (&Command, &(Command, Approach))| {
            a.iter().zip(&b.0).all(|(a, b)| (a - b).abs() < SAME_PLACE)
        };
        let met = stations.commands.iter().zip(&self.waits).filter(|pair| same(*pair)).count();
        if self.waits.len() != stations.len() || met != stations.len() {
            let message = format!(
                "the program stands {} times, {met} of them where it is planned in that order; planned: {}",
                self.waits.len(),
                stations.len()
            );
            return (Some(message), Vec::new());
        }
        let mut wrong: Vec<String> = Vec::new();
        let mut count = 0;
        for (i, (command, came)) in self.waits.iter().enumerate() {
            for (k, axis) in machine.axes().iter().enumerate() {
                let stated = stations.approaches[i][k];
                if stated != 0.0 && came[k] != stated {
                    count += 1;
                    let (unit, scale) = match axis.kind {
                        AxisKind::Linear => ("mm", 1.0),
                        AxisKind::Rotary => ("deg", 1f64.to_degrees()),
                    };
                    let place = format!("{} = {:.3} {unit}", axis.name, command[k] * scale);
                    if !wrong.contains(&place) {
                        wrong.push(place);
                    }
                }
            }
        }
        let line = format!(
            "{count} of {} stands are approached from the other side: there is no room for an overrun at {}",
            stations.len(),
            wrong.join(", ")
        );
        (None, if count > 0 { vec![line] } else { Vec::new() })
    }
}

/// Runs a program on the machine with probe, ball and stem.
pub fn check(
    campaign: &Campaign,
    path: &Path,
    settings: &ProgramSettings,
    text: &[u8],
    control: Control,
) -> ProgramCheck {
    let machine = &campaign.machine;
    let own = path.stations.instruments.first().map_or(0, |i| *i as usize);
    let own = &campaign.instruments[own];
    let tool = SetUpTool {
        name: own.kind.name().to_owned(),
        tip_mm: own.tool_point_mm,
        shape: stated_shape(settings, own.kind, -own.tool_point_mm.z),
        ..SetUpTool::default()
    };
    let setup = SetUp {
        given: true,
        files: campaign.files.clone(),
        tools: [(1, tool)].into_iter().collect(),
        bodies: bodies(settings, own.kind, own.reference_point_mm),
        start: super::start(campaign, path, settings),
        ..SetUp::default()
    };
    // Words that no interpreter has are read back as the motions that stand for them.
    let stand_in = (control == Control::Heidenhain && own.kind == Kind::TouchProbeBall)
        .then(|| super::written(campaign, path, settings, (control, true)).ok());
    let text = stand_in.flatten().unwrap_or_else(|| text.to_vec());
    let program = Program::new(&path.name, text, control);
    // A probe never comes to the nominal place of a hit by a block of its own.
    let stations = match own.kind {
        Kind::TouchProbeBall => &[][..],
        _ => &path.stations.commands[..],
    };
    let (mut check, visits) = watch(machine, &campaign.machine_path, &setup, &program, stations);
    // A program that ends early was reported already.
    let waits = path.feed_mm_per_s.is_none() && path.dwell_s > 0.0 && !stations.is_empty();
    if waits && check.errors.is_empty() {
        let (error, minor) = visits.compare(machine, path);
        check.errors.extend(error);
        check.minor.extend(minor);
    }
    check
}

/// Runs a program with all that stands on the machine.
pub(in crate::plan) fn run(
    machine: &Machine,
    machine_path: &std::path::Path,
    setup: &SetUp,
    program: &Program,
    stations: &[Command],
) -> ProgramCheck {
    watch(machine, machine_path, setup, program, stations).0
}

/// The same with where the machine stood.
fn watch(
    machine: &Machine,
    machine_path: &std::path::Path,
    setup: &SetUp,
    program: &Program,
    stations: &[Command],
) -> (ProgramCheck, Visits) {
    let mut summary = Summary::of(machine);
    let mut watch = AxisWatch::on(machine);
    let mut visits = Visits::default();
    let mut found = Diagnostics::new();
    let models = load_models(&setup.files, machine, machine_path, &mut found);
    let mut collisions = Collisions::watch(machine, models, setup);
    let mut observers: Vec<&mut dyn Observer> = vec![&mut summary, &mut watch, &mut visits];
    if let Some(collisions) = &mut collisions {
        observers.push(collisions);
    }
    let run = simulate(machine, program, setup, &Options::default(), &mut observers);
    if let Some(collisions) = &collisions {
        found.append(collisions.problems(&run.programs));
    }
    let logs = [Some(watch.log), collisions.map(|c| c.log)];
    let issues = IssueList::of(logs.into_iter().flatten());
    let told = |critical: bool| {
        let mut texts: Vec<String> = issues
            .list
            .iter()
            .filter(|t| t.critical == critical)
            .map(|t| format!("line {}: {}", t.first.line, issue_text(machine, t)))
            .collect();
        texts.dedup_by(|a, b| a.split_once(": ").map(|x| x.1) == b.split_once(": ").map(|x| x.1));
        texts
    };
    let errors = run.problems.iter().chain(found.iter()).filter(|d| d.severity == Severity::Error);
    let check = ProgramCheck {
        duration_s: summary.time_s,
        off_station: visits.off_stations(stations),
        critical: told(true),
        minor: told(false),
        errors: errors.map(|d| d.message.clone()).collect(),
    };
    (check, visits)
}

/// The stated probe, or a slim one: stylus, body, holder.
fn stated_shape(settings: &ProgramSettings, kind: Kind, length_mm: f64) -> Vec<ToolSegment> {
    if !settings.probe.is_empty() {
        return settings.probe.clone();
    }
    match kind {
        Kind::TouchProbeBall | Kind::TouchProbeFace => probe_shape(3.0, length_mm),
        _ => slim(8.0, 50.0, length_mm),
    }
}

/// A slim touch probe.
pub(in crate::plan) fn probe_shape(stylus_mm: f64, length_mm: f64) -> Vec<ToolSegment> {
    slim(stylus_mm, 40.0, length_mm)
}

fn slim(stylus: f64, body: f64, length_mm: f64) -> Vec<ToolSegment> {
    if length_mm <= 1.0 {
        return Vec::new();
    }
    let slim = (0.45 * length_mm).min(150.0);
    let segment = |diameter_mm, length_mm| ToolSegment { diameter_mm, length_mm };
    vec![segment(stylus, slim), segment(body, length_mm - slim)]
}

/// The ball and its stem on the workpiece.
fn bodies(settings: &ProgramSettings, kind: Kind, ball_mm: Vec3) -> Vec<BodyModel> {
    if !kind.holds_a_ball() {
        return Vec::new();
    }
    let radius = 0.5 * settings.ball_diameter_mm;
    let along = settings.stem;
    let mut bodies = Vec::new();
    // The socket of a probe-ball encloses the ball; a stylus does not.
    if kind == Kind::TouchProbeBall {
        let size = 2.0 * radius * INSIDE;
        let from = ball_mm - along * (0.5 * size);
        bodies.extend(cylinder("ball", size, size, from, along));
    }
    bodies.extend(stem(
        radius,
        ball_mm,
        along,
        (settings.stem_diameter_mm, settings.stem_length_mm),
    ));
    bodies
}

/// The stem of a ball, from just outside of it: what touches the ball is not in its way.
fn stem(
    radius_mm: f64,
    ball_mm: Vec3,
    along: Vec3,
    (diameter_mm, length_mm): (f64, f64),
) -> Option<BodyModel> {
    let from = ball_mm + along * (radius_mm * 1.2);
    let length_mm = (length_mm - radius_mm).max(1.0);
    cylinder("stem of the ball", diameter_mm, length_mm, from, along)
}

fn cylinder(
    name: &str,
    diameter_mm: f64,
    length_mm: f64,
    from_mm: Vec3,
    along: Vec3,
) -> Option<BodyModel> {
    let shape =
        Shape::Cone { base_diameter_mm: diameter_mm, top_diameter_mm: diameter_mm, length_mm };
    let mesh = triangles_of(&shape).and_then(Mesh::new)?;
    let any = if along.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
    let x = along.cross(&any).normalize();
    let turn = Mat3::from_columns(&[x, along.cross(&x), along]);
    let placement: Link = Pose::new(turn, from_mm);
    Some(BodyModel { name: name.to_owned(), node: Some(0), placement, role: Role::Fixture, mesh })
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueaxis_geometry::frame::Point;

    /// The stem begins outside of the ball and near it, wherever it points.
    #[test]
    fn law_the_stem_is_no_part_of_the_ball() {
        for along in [-Vec3::z(), Vec3::x(), Vec3::new(0.3, -0.5, -0.8).normalize()] {
            for radius_mm in [5.0, 12.7] {
                let ball_mm = Vec3::new(40.0, -70.0, 90.0);
                let stem = stem(radius_mm, ball_mm, along, (6.0, 80.0)).expect("a body");
                let corners = stem.mesh.triangles().iter().flatten();
                let off =
                    corners.map(|c| (stem.placement * Point::from_vector(*c)).vector() - ball_mm);
                let off: Vec<Vec3> = off.collect();
                assert!(off.iter().all(|off| off.norm() > radius_mm));
                let nearest = off.iter().map(|off| off.dot(&along)).fold(f64::INFINITY, f64::min);
                assert!(nearest > radius_mm && nearest < 1.3 * radius_mm, "{nearest}");
                // Stated from the centre of the ball, 80 mm end some of the gap beyond that.
                let farthest = off.iter().map(|off| off.dot(&along)).fold(0.0, f64::max);
                assert!((80.0..80.0 + 0.3 * radius_mm).contains(&farthest), "{farthest}");
            }
        }
    }

    /// Poses on a lattice, so that many share coordinates, with a share that is not on it.
    fn poses(count: u64, seed: u64) -> Vec<Command> {
        let number = |i: u64, k: u64| {
            let mixed = (i * 7 + k + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let spread = (mixed >> 40) % 9;
            spread as f64 + if mixed.is_multiple_of(5) { 1e-4 } else { 0.0 }
        };
        (0..count).map(|i| std::array::from_fn(|k| number(i, k as u64))).collect()
    }

    #[test]
    fn the_nearest_end_is_that_of_a_search_through_all() {
        for (ends, stations) in [(300, 40), (7, 90), (1, 1), (5, 0)] {
            let visits = Visits { ends: poses(ends, 3), ..Visits::default() };
            let stations = poses(stations, 11);
            let apart = |a: &Command, b: &Command| {
                a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let off = |s: &Command| {
                visits.ends.iter().map(|end| apart(s, end)).fold(f64::INFINITY, f64::min)
            };
            let through_all = stations.iter().map(off).fold(0.0, f64::max);
            assert_eq!(visits.off_stations(&stations), through_all);
        }
        assert_eq!(Visits::default().off_stations(&poses(1, 2)), f64::INFINITY);
    }
}
