//! Clearances and collisions: judged by mathematics, by plain search, and by what machines are.

#![allow(clippy::print_stdout, reason = "tables for docs/validation.md")]

mod library;

use library::{Random, root};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::geometry::frame::{Pose, rotation};
use trueaxis::geometry::{Mat3, Vec3};
use trueaxis::input::Diagnostics;
use trueaxis::machine::Machine;
use trueaxis::machine::axis::{AxisKind, Command, Travel};
use trueaxis::machine::errors::ErrorValues;
use trueaxis::machine::file::NoTables;
use trueaxis::machine::models::ToolSegment;
use trueaxis::simulate::collide::{
    Allowed, BodyModel, Contact, Mesh, Nearest, Placed, Role, Scene, Scratch, Sweep, ToolShape,
    Triangle, cuboid, export, gap, load_models, load_stl, read_stl, revolve, write_stl,
};

const SHIPPED: [&str; 7] = [
    "xkas2525",
    "i5-engraver",
    "lei-hsu-mill",
    "head-table",
    "nutating-head",
    "wyxzcat-gantry",
    "three-axis-mill",
];

impl Random {
    fn vector(&mut self, size: f64) -> Vec3 {
        Vec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }

    fn turn(&mut self) -> Mat3 {
        let axis = self.vector(1.0) + Vec3::new(0.0, 0.0, 1e-3);
        rotation(axis.normalize(), TAU * self.unit())
    }
}

fn bumpy(random: &mut Random, radius_mm: f64, rings: usize, sectors: usize) -> Vec<Triangle> {
    let (bumps, waves) = (random.between(0.0, 0.3), random.between(1.0, 6.0));
    bumpy_ball(radius_mm, [rings, sectors], [bumps, waves])
}

/// As `oracles/collide.py` makes it.
fn bumpy_ball(
    radius_mm: f64,
    [rings, sectors]: [usize; 2],
    [bumps, waves]: [f64; 2],
) -> Vec<Triangle> {
    let point = |i: usize, k: usize| {
        let (polar, around) =
            (PI * i as f64 / rings as f64, TAU * (k % sectors) as f64 / sectors as f64);
        let size = radius_mm * (1.0 + bumps * (waves * polar).sin() * (3.0 * around).cos());
        size * Vec3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos())
    };
    let quads = (0..rings).flat_map(|i| (0..sectors).map(move |k| (i, k)));
    quads
        .flat_map(|(i, k)| {
            let [a, b, c, d] = [point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// FCL, the library that robots plan with: `oracles/collide.py`.
#[test]
fn oracle_fcl_finds_the_same_distances() {
    let table = include_str!("data/fcl_distances.csv");
    let rows = table.lines().filter(|l| !l.starts_with('#')).skip(1);
    let (mut apart, mut overlapping) = (0, 0);
    for row in rows {
        let v: Vec<f64> = row.split(',').map(|n| n.parse().expect("a number")).collect();
        let count = |i: usize| v[i] as usize;
        let first = bumpy_ball(v[0], [count(2), count(3)], [v[6], v[8]]);
        let second = bumpy_ball(v[1], [count(4), count(5)], [v[7], v[9]]);
        let (first, second) =
            (Mesh::new(first).expect("a ball"), Mesh::new(second).expect("a ball"));
        let turn = rotation(Vec3::new(v[10], v[11], v[12]).normalize(), v[13]);
        let placed = Placed { turn, shift_mm: Vec3::new(v[14], v[15], v[16]) };
        let found = nearest(&first, &second, &placed, 1e6).expect("below").distance_mm;
        assert!((found - v[17]).abs() < 1e-6, "{found}, FCL {}", v[17]);
        if v[17] > 0.0 { apart += 1 } else { overlapping += 1 }
    }
    assert!(apart >= 40 && overlapping >= 10, "{apart} apart, {overlapping} overlapping");
}

fn nearest(a: &Mesh, b: &Mesh, placed: &Placed, below_mm: f64) -> Option<Nearest> {
    a.nearest(b, placed, below_mm, None, &mut Scratch::default())
}

/// The nearest point of a triangle, by trying its face and its edges.
fn project(t: &Triangle, p: Vec3) -> Vec3 {
    let normal = (t[1] - t[0]).cross(&(t[2] - t[0])).normalize();
    let foot = p - normal * (p - t[0]).dot(&normal);
    let left_of = |k: usize| (t[(k + 1) % 3] - t[k]).cross(&(foot - t[k])).dot(&normal) >= 0.0;
    if (0..3).all(left_of) {
        return foot;
    }
    let on_edge = |k: usize| {
        let edge = t[(k + 1) % 3] - t[k];
        t[k] + edge * ((p - t[k]).dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0)
    };
    let ends = [on_edge(0), on_edge(1), on_edge(2)];
    let nearer = |a: Vec3, b: Vec3| if (b - p).norm() < (a - p).norm() { b } else { a };
    nearer(nearer(ends[0], ends[1]), ends[2])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Going to and fro between two convex sets ends at their nearest points (von Neumann;
    /// Cheney and Goldstein 1959): another way to the same number.
    #[test]
    fn law_triangles_by_alternating_projections(seed in any::<u64>()) {
        let mut random = Random(seed);
        let mut triangle = |shift: f64| {
            let place = random.vector(shift);
            [(); 3].map(|()| random.vector(5.0) + place)
        };
        let (a, b) = (triangle(1.0), triangle(9.0));
        let found = gap(&a, &b, f64::INFINITY).expect("finite").squared_mm2.sqrt();
        let (mut p, mut other) = (a[0], f64::INFINITY);
        // Between edges that are nearly parallel it goes slowly: until it is there, or long enough.
        for _ in 0..1_000_000 {
            p = project(&a, project(&b, p));
            other = (project(&b, p) - p).norm();
            if other - found < 1e-4 {
                break;
            }
        }
        prop_assert!(found <= other + 1e-9, "{found} {other}");
        prop_assert!(other - found < 1e-4, "{found} {other}");
        let back = gap(&b, &a, f64::INFINITY).expect("finite").squared_mm2.sqrt();
        prop_assert!((found - back).abs() < 1e-9);
    }

    #[test]
    fn law_tree_equals_every_pair_of_triangles(seed in any::<u64>()) {
        let mut random = Random(seed);
        let first = Mesh::new(bumpy(&mut random, 10.0, 6, 7)).expect("a ball");
        let second = Mesh::new(bumpy(&mut random, 20.0, 7, 9)).expect("a ball");
        let placed = Placed { turn: random.turn(), shift_mm: random.vector(40.0) };
        let moved = |t: &Triangle| t.map(|c| placed.turn * c + placed.shift_mm);
        let mut every = f64::INFINITY;
        for b in second.triangles().iter().map(moved) {
            for a in first.triangles() {
                every = gap(a, &b, f64::INFINITY).map_or(every, |g| g.squared_mm2.sqrt().min(every));
            }
        }
        let found = nearest(&first, &second, &placed, 1e6).expect("below a kilometre");
        prop_assert!((found.distance_mm - every).abs() < 1e-9);
        prop_assert!(((found.on_second - found.on_first).norm() - every).abs() < 1e-9 || every == 0.0);
        prop_assert_eq!(nearest(&first, &second, &placed, every * 0.999), None);
        // The same from the other side, and after both were moved together.
        let back = nearest(&second, &first, &placed.inverse(), 1e6).expect("below");
        prop_assert!((back.distance_mm - every).abs() < 1e-9);
        let (turn, shift) = (random.turn(), random.vector(1e3));
        let both = |mesh: &Mesh| {
            let moved = mesh.triangles().iter().map(|t| t.map(|c| turn * c + shift));
            Mesh::new(moved).expect("a ball")
        };
        let placed = Placed {
            turn: turn * placed.turn * turn.transpose(),
            shift_mm: turn * placed.shift_mm + shift - turn * placed.turn * turn.transpose() * shift,
        };
        let moved = nearest(&both(&first), &both(&second), &placed, 1e6).expect("below");
        prop_assert!((moved.distance_mm - every).abs() < 1e-8);
    }

    /// No panic, no endless loop, a diagnostic whenever nothing came out.
    #[test]
    fn law_the_stl_reader_survives_any_bytes(
        bytes in proptest::collection::vec(any::<u8>(), 0..400),
        cut in 0_usize..700,
        at in 0_usize..700,
        text in any::<bool>(),
    ) {
        let whole = match text {
            true => b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                      vertex 0 1 0\nendloop\nendfacet\nendsolid a\n".to_vec(),
            false => write_stl("box", &cuboid(Vec3::new(1.0, 2.0, 3.0))),
        };
        let mut broken = whole.clone();
        broken.truncate(cut);
        let mut mixed = whole;
        for (i, byte) in bytes.iter().enumerate() {
            if let Some(slot) = mixed.get_mut(at + i) {
                *slot = *byte;
            }
        }
        for bytes in [bytes, broken, mixed] {
            let mut problems = Diagnostics::new();
            let read = read_stl("m.stl", &bytes, 1.0, &mut problems);
            prop_assert_eq!(read.is_none(), problems.has_errors());
            prop_assert!(problems.iter().count() <= 21);
        }
    }
}

#[test]
fn spheres_are_as_far_apart_as_their_radii_say() {
    let ball = |radius: f64| {
        let profile: Vec<[f64; 2]> = (0..=180)
            .map(|i| (PI * f64::from(i) / 180.0).sin_cos())
            .map(|(sin, cos)| [radius * sin, -radius * cos])
            .collect();
        Mesh::new(revolve(&profile)).expect("a ball")
    };
    let (first, second) = (ball(30.0), ball(50.0));
    let mut random = Random(3);
    for _ in 0..100 {
        let way = random.vector(1.0).normalize();
        let placed = Placed { turn: random.turn(), shift_mm: way * random.between(81.0, 200.0) };
        let found = nearest(&first, &second, &placed, 1e4).expect("near").distance_mm;
        // Chords inside, polygons outside: 0.02 mm and 50 (1 − cos 0.5°) = 0.002 mm.
        assert!((found - (placed.shift_mm.norm() - 80.0)).abs() < 0.05);
    }
}

const HEAD: &str = r#"
    [machine]
    name = "five axes"
    chain = "w b X Y Z C A t"
    [axis.A]
    placement = "0 0 -50 mm"
    [tool]
    placement = "0 0 -100 mm"
    length = "60 mm"
"#;

fn five_axes() -> Machine {
    let (machine, problems) = Machine::check("m.toml", HEAD, &NoTables);
    machine.unwrap_or_else(|| panic!("{problems:?}"))
}

fn tool(tip_mm: Vec3) -> ToolShape {
    let segment = |diameter_mm, length_mm| ToolSegment { diameter_mm, length_mm };
    let length = tip_mm.norm();
    let segments = vec![segment(10.0, 0.5 * length), segment(30.0, 0.5 * length)];
    ToolShape { tip_mm, segments, corner_radius_mm: 0.0 }
}

fn body(name: &str, node: Option<usize>, role: Role, triangles: Vec<Triangle>) -> BodyModel {
    let mesh = Mesh::new(triangles).expect("a surface");
    BodyModel { name: name.to_owned(), node, placement: Pose::identity(), role, mesh }
}

fn nominal(
    machine: &Machine,
) -> impl Fn(&Command) -> Vec<Pose<trueaxis::geometry::frame::Bed, trueaxis::geometry::frame::Body>> + '_
{
    |c| machine.body_poses(c, &ErrorValues::default())
}

/// A wall of a tenth of a micrometre anywhere on the path of the tool: plain sampling of the same
/// path, thousands of poses, finds no approach that the sweep has not reported.
#[test]
fn law_no_wall_is_jumped_over() {
    let machine = five_axes();
    let poses_at = nominal(&machine);
    let mut random = Random(7);
    let (mut hits, mut clear) = (0, 0);
    for _ in 0..60 {
        let mut wall = body("wall", None, Role::Machine, cuboid(Vec3::new(400.0, 300.0, 1e-4)));
        wall.placement = Pose::new(random.turn(), random.vector(150.0));
        let wall_mesh = wall.mesh.clone();
        let bed_from_wall = wall.placement;
        let shape = tool(machine.tip_mm());
        let mut scene = Scene::new(&machine, vec![wall], &shape, Vec::new());
        let mut command = |size: f64| {
            let v = random.vector(size);
            [v.x, v.y, v.z, random.between(-3.0, 3.0), random.between(-2.0, 2.0), 0.0]
        };
        let (from, to) = (command(200.0), command(200.0));
        let (clearance_mm, resolution_mm) = (0.5, 1.0);
        let sweep = Sweep {
            from: &from,
            to: &to,
            clearance_mm,
            resolution_mm,
            allowed: Allowed::default(),
        };
        let mut contacts = Vec::new();
        scene.sweep(&poses_at, &sweep, &mut contacts);
        let reported = contacts.iter().map(|c| c.clearance_mm).fold(f64::INFINITY, f64::min);
        let least = sampled_clearance(&machine, &shape, &wall_mesh, bed_from_wall, (&from, &to));
        if least > clearance_mm {
            clear += 1;
            // The samples lie up to half a millimetre apart.
            assert!(reported >= least - 0.5, "{reported} for {least}");
        } else {
            hits += 1;
            assert!(reported <= least + 0.5 * resolution_mm, "{reported} for {least}");
        }
    }
    assert!(hits > 10 && clear > 10, "{hits} hits, {clear} clear");
}

fn sampled_clearance(
    machine: &Machine,
    shape: &ToolShape,
    wall: &Mesh,
    bed_from_wall: Pose<trueaxis::geometry::frame::Body, trueaxis::geometry::frame::Body>,
    (from, to): (&Command, &Command),
) -> f64 {
    let cutter_and_holder =
        [revolve(&[[5.0, 0.0], [5.0, 30.0]]), revolve(&[[15.0, 30.0], [15.0, 60.0]])];
    let inner = Mesh::new(cutter_and_holder.into_iter().flatten()).expect("a tool");
    let mut least = f64::INFINITY;
    let mut seed = None;
    for i in 0..=1500 {
        let t = f64::from(i) / 1500.0;
        let mut command = *from;
        command.iter_mut().zip(to).for_each(|(q, to)| *q += t * (to - *q));
        let poses = machine.body_poses(&command, &ErrorValues::default());
        let bed_from_tool = poses[poses.len() - 1].relabel::<(), ()>();
        let wall_from_tool = bed_from_wall.relabel::<(), ()>().inverse() * bed_from_tool;
        let placed = Placed {
            turn: *wall_from_tool.linear(),
            shift_mm: wall_from_tool.linear() * shape.tip_mm + wall_from_tool.shift_mm(),
        };
        let near = wall.nearest(&inner, &placed, least.min(1e4), seed, &mut Scratch::default());
        least = near.map_or(least, |n| n.distance_mm.min(least));
        seed = near.map(|n| n.triangles).or(seed);
    }
    least
}

fn shipped(name: &str) -> (Machine, Vec<BodyModel>) {
    let path = root().join("machines").join(name).join("machine.toml");
    let (machine, mut problems) = files::machine(&path);
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}"));
    let models = load_models(&disk(), &machine, &path, &mut problems);
    assert!(!problems.has_errors(), "{problems:?}");
    (machine, models)
}

/// Anywhere within the travel; what the file leaves open is taken to be ±300 mm and ±100 deg.
fn anywhere(machine: &Machine, random: &mut Random) -> Command {
    let mut command = Command::default();
    for (q, axis) in command.iter_mut().zip(machine.axes()) {
        let (from, to) = match (axis.travel, axis.kind) {
            (Travel::Between(from, to), _) => (from, to),
            (Travel::Unlimited, _) => (-PI, PI),
            (Travel::Unknown, AxisKind::Linear) => (-300.0, 300.0),
            (Travel::Unknown, AxisKind::Rotary) => (-1.745, 1.745),
        };
        *q = random.between(from, to);
    }
    command
}

fn names(contacts: &[Contact]) -> Vec<String> {
    contacts.iter().map(|c| format!("{} / {}", c.first, c.second)).collect()
}

/// Looking at a path step by step, with all that is remembered, gives what a fresh look gives.
#[test]
fn law_memory_changes_no_answer() {
    for name in SHIPPED {
        let (machine, models) = shipped(name);
        let shape = tool(machine.tip_mm());
        let mut scene = Scene::new(&machine, models.clone(), &shape, Vec::new());
        let mut random = Random(5);
        let mut at = anywhere(&machine, &mut random);
        for step in 0..60 {
            let goal = anywhere(&machine, &mut random);
            let share = if step % 20 == 0 { 1.0 } else { 0.02 };
            at.iter_mut().zip(goal).for_each(|(q, to)| *q += share * (to - *q));
            let poses = machine.body_poses(&at, &ErrorValues::default());
            let (mut known, mut fresh) = (Vec::new(), Vec::new());
            scene.check(&poses, 20.0, Allowed::default(), &mut known);
            let mut other = Scene::new(&machine, models.clone(), &shape, Vec::new());
            other.check(&poses, 20.0, Allowed::default(), &mut fresh);
            assert_eq!(names(&known), names(&fresh), "{name}, step {step}");
            for (a, b) in known.iter().zip(&fresh) {
                assert!((a.clearance_mm - b.clearance_mm).abs() < 1e-9, "{name}, step {step}");
            }
        }
    }
}

/// Sweeping a path way by way finds what each way alone finds, within the resolution.
#[test]
fn law_memory_changes_no_sweep() {
    let mut reported = 0;
    for name in SHIPPED {
        let (machine, models) = shipped(name);
        let shape = tool(machine.tip_mm());
        let mut scene = Scene::new(&machine, models.clone(), &shape, Vec::new());
        let mut random = Random(9);
        let mut from = anywhere(&machine, &mut random);
        for _ in 0..40 {
            let goal = anywhere(&machine, &mut random);
            let mut to = from;
            to.iter_mut().zip(goal).for_each(|(q, goal)| *q += 0.05 * (goal - *q));
            let sweep = Sweep {
                from: &from,
                to: &to,
                clearance_mm: 20.0,
                resolution_mm: 1.0,
                allowed: Allowed::default(),
            };
            let (mut known, mut fresh) = (Vec::new(), Vec::new());
            scene.sweep(&nominal(&machine), &sweep, &mut known);
            let mut other = Scene::new(&machine, models.clone(), &shape, Vec::new());
            other.sweep(&nominal(&machine), &sweep, &mut fresh);
            for (some, others) in [(&known, &fresh), (&fresh, &known)] {
                for c in some.iter().filter(|c| c.clearance_mm < 19.5) {
                    let same = |o: &&Contact| o.first == c.first && o.second == c.second;
                    let found = others.iter().find(same).expect("the other way, too");
                    assert!((found.clearance_mm - c.clearance_mm).abs() <= 0.5, "{c:?} {found:?}");
                    reported += 1;
                }
            }
            from = to;
        }
    }
    assert!(reported > 100, "{reported}");
}

/// The shipped machines stand free at home; within their travel what carries the tool meets only
/// the bed and what carries the workpiece, never itself.
#[test]
fn shipped_machines_are_free_to_move() {
    for name in SHIPPED {
        let (machine, models) = shipped(name);
        assert!(models.len() >= 6, "{name} has a body to look at");
        let carries_tool = |name: &str| {
            let model = models.iter().find(|m| m.name == name);
            model.is_none_or(|m| m.node.is_some_and(|i| i >= machine.workpiece_side()))
        };
        let mut scene = Scene::new(&machine, models.clone(), &tool(machine.tip_mm()), Vec::new());
        assert!(scene.excluded().is_empty(), "{name}: {:?}", scene.excluded());
        let mut contacts = Vec::new();
        let home = machine.body_poses(&Command::default(), &ErrorValues::default());
        scene.check(&home, 0.0, Allowed::default(), &mut contacts);
        println!("{name}: {} pairs, at home {:?}", scene.pair_count(), names(&contacts));
        let machine_parts = contacts.iter().filter(|c| c.roles == (Role::Machine, Role::Machine));
        assert_eq!(machine_parts.count(), 0, "{name} at home: {:?}", names(&contacts));
        let mut random = Random(11);
        let mut count: BTreeMap<String, usize> = BTreeMap::new();
        for _ in 0..2000 {
            contacts.clear();
            let poses =
                machine.body_poses(&anywhere(&machine, &mut random), &ErrorValues::default());
            scene.check(&poses, 0.0, Allowed::default(), &mut contacts);
            for contact in &contacts {
                let sides = [&contact.first, &contact.second].map(|name| carries_tool(name));
                assert_ne!(sides, [true, true], "{name}: {contact:?}");
                *count.entry(format!("{} / {}", contact.first, contact.second)).or_default() += 1;
            }
        }
        for (pair, count) in &count {
            println!("    {pair}: {count} of 2000");
        }
    }
}

/// The cutter may be in the stock while it feeds, and never in rapid; the holder never.
#[test]
fn rapid_through_stock_is_an_issue() {
    let machine = five_axes();
    let stock =
        |size: f64| body("stock", Some(0), Role::Stock, cuboid(Vec3::new(size, size, size)));
    let mut scene = Scene::new(&machine, Vec::new(), &tool(machine.tip_mm()), vec![stock(20.0)]);
    // The tip is 210 mm below Z: at Z = 215 it stands 5 mm deep in the stock that ends at 10 mm.
    let poses = machine.body_poses(&[0.0, 0.0, 215.0, 0.0, 0.0, 0.0], &ErrorValues::default());
    let mut contacts = Vec::new();
    scene.check(
        &poses,
        1.0,
        Allowed { cutter_in_stock: true, tool_in_stock: false },
        &mut contacts,
    );
    assert_eq!(names(&contacts), Vec::<String>::new());
    scene.check(&poses, 1.0, Allowed::default(), &mut contacts);
    assert_eq!(names(&contacts), ["cutter / stock"]);
    assert_eq!(contacts[0].clearance_mm, 0.0);
    // Wholly inside a large one: no surfaces meet, yet both are in it.
    let mut scene = Scene::new(&machine, Vec::new(), &tool(machine.tip_mm()), vec![stock(900.0)]);
    contacts.clear();
    scene.check(
        &poses,
        0.0,
        Allowed { cutter_in_stock: true, tool_in_stock: false },
        &mut contacts,
    );
    assert_eq!(names(&contacts), ["holder / stock"]);
}

#[test]
fn a_near_miss_states_its_clearance_and_place() {
    let machine = five_axes();
    let mut block = body("block", None, Role::Machine, cuboid(Vec3::new(10.0, 10.0, 10.0)));
    block.placement = Pose::shift(Vec3::new(0.0, 0.0, -217.0));
    let mut scene = Scene::new(&machine, vec![block], &tool(machine.tip_mm()), Vec::new());
    let mut contacts = Vec::new();
    // Tip at z = −210, the block ends at −212; X goes past it.
    let (from, to) = ([-80.0, 0.0, 0.0, 0.0, 0.0, 0.0], [80.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let sweep = Sweep {
        from: &from,
        to: &to,
        clearance_mm: 3.0,
        resolution_mm: 0.1,
        allowed: Allowed::default(),
    };
    scene.sweep(&nominal(&machine), &sweep, &mut contacts);
    assert_eq!(names(&contacts), ["block / cutter"]);
    let contact = &contacts[0];
    assert!((contact.clearance_mm - 2.0).abs() < 1e-9, "{contact:?}");
    assert!((contact.point_mm.z + 211.0).abs() < 1e-9 && (contact.at - 0.5).abs() < 0.1);
}

#[test]
fn models_go_out_as_stl_and_come_back() {
    for name in SHIPPED {
        let (machine, models) = shipped(name);
        let files = export(&machine);
        assert_eq!(files.len(), models.len());
        for ((file, bytes), model) in files.iter().zip(&models) {
            let mut problems = Diagnostics::new();
            let read = read_stl(file, bytes, 1.0, &mut problems).expect("our own file");
            assert_eq!(problems.iter().count(), 0, "{problems:?}");
            let mesh = Mesh::new(read).expect("a surface");
            assert_eq!(mesh.triangles().len(), model.mesh.triangles().len());
            assert!(mesh.is_closed() && mesh.piece_count() == 1, "{name} {file}");
            assert!((mesh.radius_mm() - model.mesh.radius_mm()).abs() < 1e-3);
        }
    }
}

/// Real machines of others, where they are available: every file is read.
#[test]
fn oracle_outside_machines_are_read() {
    let folder = root().join("../shared/data/outside/machines");
    let mut found = Vec::new();
    stl_files(&folder, &mut found);
    if found.is_empty() {
        println!("skipped: {} is not here", folder.display());
        return;
    }
    let mut total = 0;
    for path in &found {
        let mut problems = Diagnostics::new();
        let mesh = load_stl(&disk(), path, 1.0, &mut problems);
        let mesh = mesh.unwrap_or_else(|| panic!("{path:?}: {problems:?}"));
        let notes: Vec<&str> = problems.iter().map(|d| d.code).collect();
        let (count, pieces) = (mesh.triangles().len(), mesh.piece_count());
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        println!("{name}: {count} triangles, {pieces} pieces {notes:?}");
        total += count;
    }
    println!("{} files, {total} triangles", found.len());
    assert!(found.len() >= 20, "{} files", found.len());
}

fn stl_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()) {
        if path.is_dir() {
            stl_files(&path, found);
        } else if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("stl")) {
            found.push(path);
        }
    }
}
