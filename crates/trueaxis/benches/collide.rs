//! Clearance questions between two bodies of 20,000 and 82,000 triangles, as a ratio to plain
//! looking at every pair of triangles, in the same run.
//!
//! Two bumpy balls of 400 and 600 mm, 0 to 8 mm apart or just overlapping, turned at random; asked
//! is for the exact clearance below 5 mm. Target: 3,000 questions a second of one core.
//!
//! `cargo bench -p trueaxis --bench collide`

#![allow(clippy::print_stdout)] // a bench prints its figures

use std::f64::consts::{PI, TAU};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::geometry::frame::rotation;
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::models::ToolSegment;
use trueaxis::simulate::collide::{
    Allowed, Mesh, Placed, Scene, Scratch, Sweep, ToolShape, Triangle, gap, load_models,
};

const QUESTIONS: usize = 3000;
const ROUNDS: usize = 5;
/// Every so many of the triangles of the first body, so that the plain way ends in this life.
const SHARE: usize = 400;

/// A ball with bumps, of 2·rings·sectors triangles.
fn bumpy(radius_mm: f64, rings: usize, sectors: usize) -> Vec<Triangle> {
    let point = |i: usize, k: usize| {
        let (polar, around) =
            (PI * i as f64 / rings as f64, TAU * (k % sectors) as f64 / sectors as f64);
        let bump = 1.0 + 0.05 * (6.0 * polar).sin() * (5.0 * around).cos();
        let (sin, cos) = around.sin_cos();
        radius_mm * bump * Vec3::new(polar.sin() * cos, polar.sin() * sin, polar.cos())
    };
    let quads = (0..rings).flat_map(|i| (0..sectors).map(move |k| (i, k)));
    quads
        .flat_map(|(i, k)| {
            let [a, b, c, d] = [point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// Numbers in 0..1 that are the same in every run (splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn direction(&mut self) -> Vec3 {
        let z = 2.0 * self.unit() - 1.0;
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        Vec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    }
}

/// Places around touching: the second body turned at random, pushed to `apart` mm.
fn places(first: &Mesh, second: &Mesh, count: usize) -> Vec<Placed> {
    let mut random = Random(1);
    let mut scratch = Scratch::default();
    (0..count)
        .map(|_| {
            let turn = rotation(random.direction(), TAU * random.unit());
            let (way, apart_mm) = (random.direction(), 10.0 * random.unit() - 2.0);
            let mut distance_mm = 1100.0;
            for _ in 0..12 {
                let placed = Placed { turn, shift_mm: way * distance_mm };
                let near = first.nearest(second, &placed, 1e4, None, &mut scratch);
                distance_mm -= near.map_or(0.0, |n| n.distance_mm) - apart_mm.max(0.0);
            }
            distance_mm += apart_mm.min(0.0);
            Placed { turn, shift_mm: way * distance_mm }
        })
        .collect()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// CPU time of this thread where the system tells it (Linux), so that neighbours do not count;
/// else the clock.
fn seconds() -> f64 {
    use std::sync::OnceLock;
    static START: OnceLock<Instant> = OnceLock::new();
    let clock = START.get_or_init(Instant::now).elapsed().as_secs_f64();
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = stat.and_then(|t| t.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or(clock, |ns| ns * 1e-9)
}

fn per_second(count: usize, mut work: impl FnMut()) -> f64 {
    let times = (0..ROUNDS).map(|_| {
        let start = seconds();
        work();
        seconds() - start
    });
    count as f64 / median(times.collect())
}

/// Every pair of triangles; the answer to hold the fast one against.
fn plain(first: &[Triangle], second: &Mesh, placed: &Placed, below_mm: f64) -> Option<f64> {
    let mut best_mm2 = below_mm * below_mm;
    let mut found = false;
    for triangle in second.triangles() {
        let moved = triangle.map(|c| placed.turn * c + placed.shift_mm);
        for own in first {
            if let Some(gap) = gap(own, &moved, best_mm2) {
                best_mm2 = gap.squared_mm2;
                found = true;
            }
        }
    }
    found.then(|| best_mm2.sqrt())
}

fn main() {
    let first = Mesh::new(bumpy(400.0, 100, 100)).expect("a ball");
    let second = Mesh::new(bumpy(600.0, 200, 205)).expect("a ball");
    println!("{} against {} triangles", first.triangles().len(), second.triangles().len());
    let places = places(&first, &second, QUESTIONS);
    let mut scratch = Scratch::default();
    for (below_mm, what) in
        [(5.0, "clearance below 5 mm"), (1e4, "any clearance"), (1e-9, "overlap")]
    {
        let mut found = 0;
        let mut visits = 0;
        let rate = per_second(QUESTIONS, || {
            (found, visits) = (0, 0);
            for placed in &places {
                let near = first.nearest(&second, black_box(placed), below_mm, None, &mut scratch);
                found += usize::from(near.is_some());
                visits += scratch.visits;
            }
        });
        let visits = visits / QUESTIONS;
        println!("{what}: {rate:.0} questions/s, {visits} pairs of boxes each, {found} found");
    }
    let along = sliding(&places[0]);
    let rate = per_second(along.len(), || {
        let mut seed = None;
        for placed in &along {
            let near = first.nearest(&second, black_box(placed), 5.0, seed, &mut scratch);
            seed = near.map(|n| n.triangles).or(seed);
        }
    });
    println!("clearance below 5 mm along a path of 0.1 mm steps: {rate:.0} questions/s");
    let some: Vec<Triangle> = first.triangles().iter().step_by(SHARE).copied().collect();
    let start = seconds();
    black_box(plain(&some, &second, &places[0], 5.0));
    let plain_rate = 1.0 / ((seconds() - start) * SHARE as f64);
    let rate = per_second(QUESTIONS, || {
        for placed in &places {
            black_box(first.nearest(&second, black_box(placed), 5.0, None, &mut scratch));
        }
    });
    println!("ratio to every pair of triangles: {:.0}", rate / plain_rate);
    whole_machine();
}

/// All pairs of a shipped machine along a path near the table, a near miss now and then.
fn whole_machine() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/xkas2525/machine.toml");
    let (machine, mut problems) = files::machine(&path);
    let machine = machine.expect("a shipped machine");
    let models = load_models(&disk(), &machine, &path, &mut problems);
    let segment = |diameter_mm, length_mm| ToolSegment { diameter_mm, length_mm };
    let tool = ToolShape {
        tip_mm: machine.tip_mm(),
        segments: vec![segment(20.0, 60.0), segment(63.0, 40.0)],
        corner_radius_mm: 10.0,
    };
    let mut scene = Scene::new(&machine, models, &tool, Vec::new());
    let commands: Vec<_> = (0..20_000)
        .map(|i| {
            let turn = TAU * f64::from(i) / 5000.0;
            let (sin, cos) = turn.sin_cos();
            [3000.0 + 300.0 * cos, 1200.0 + 300.0 * sin, -897.0, turn, 0.4 * sin, 0.0]
        })
        .collect();
    let poses_at = |c: &_| machine.body_poses(c, &ErrorValues::default());
    let poses: Vec<_> = commands.iter().map(poses_at).collect();
    let mut contacts = Vec::new();
    let before = scene.questions();
    let rate = per_second(poses.len(), || {
        contacts.clear();
        for poses in &poses {
            scene.check(black_box(poses), 5.0, Allowed::default(), &mut contacts);
        }
    });
    let asked = (scene.questions() - before) as f64 / (ROUNDS * poses.len()) as f64;
    let pairs = scene.pair_count();
    println!(
        "{pairs} pairs of a gantry, 0.4 mm a step: {rate:.0} poses/s, {asked:.2} questions each"
    );
    let rate = per_second(commands.len(), || {
        contacts.clear();
        for way in commands.windows(2) {
            let sweep = Sweep {
                from: &way[0],
                to: &way[1],
                clearance_mm: 5.0,
                resolution_mm: 0.5,
                allowed: Allowed::default(),
            };
            scene.sweep(&poses_at, black_box(&sweep), &mut contacts);
        }
    });
    println!(
        "the same swept from pose to pose: {rate:.0} sweeps/s, {} near misses",
        contacts.len()
    );
}

/// A path across the surface, 0.1 mm a step.
fn sliding(from: &Placed) -> Vec<Placed> {
    let across = from.shift_mm.cross(&Vec3::new(0.3, 0.5, 0.8)).normalize();
    (0..2000)
        .map(|i| Placed {
            shift_mm: from.shift_mm + across * (0.1 * f64::from(i) - 100.0),
            ..*from
        })
        .collect()
}
