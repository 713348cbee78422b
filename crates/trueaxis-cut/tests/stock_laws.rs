//! Stock: volumes by hand, nails as judge of every line, and whatever should not matter.

use proptest::prelude::*;
use std::f64::consts::PI;
use trueaxis_cut::stock::{Step, Stock, StockError};
use trueaxis_cut::{Apt, Cutter, Nail, Sweep, ToolPose, cut};
use trueaxis_geometry::Vec3;

fn pose(x: f64, y: f64, z: f64) -> ToolPose {
    ToolPose { tip_mm: Vec3::new(x, y, z), axis: Vec3::z() }
}

fn block(resolution_mm: f64) -> Stock {
    Stock::block(&Vec3::zeros(), &Vec3::new(40.0, 30.0, 10.0), resolution_mm).expect("a block")
}

/// The same bits on one thread and on several.
#[test]
fn law_threads_do_not_matter_to_stock() {
    let ball = Cutter::ball(12.0, 40.0).expect("a ball");
    let poses: Vec<ToolPose> = (0..=700).map(|k| pose(0.06 * f64::from(k), 15.0, 4.0)).collect();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut stock = block(0.5);
        let taken = pool.install(|| stock.cut(&ball, &poses));
        (taken, stock.volumes_mm3())
    };
    assert_eq!(on(1), on(3));
}

/// The twelve triangles of a box.
fn cuboid(low: Vec3, high: Vec3) -> Vec<[Vec3; 3]> {
    let corner =
        |k: usize| Vec3::from_fn(|axis, _| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let halves = |f: [usize; 4]| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]];
    faces.into_iter().flat_map(halves).map(|t| t.map(corner)).collect()
}

/// A bore by a ball: a hemisphere and a cylinder; by a drill: a cone and a cylinder. A slot by a flat end: a strip and two half discs.
#[test]
fn law_volumes_by_hand() {
    let volume = |cutter: &Cutter, poses: &[ToolPose]| {
        let mut stock = block(0.2);
        let before = stock.volume_mm3();
        assert!((before - 12_000.0).abs() < 1e-6);
        let taken: f64 = stock.cut(cutter, poses).iter().map(|t| t.mean_mm3()).sum();
        assert!((before - stock.volume_mm3() - taken).abs() < 1e-6);
        taken
    };
    let ball = Cutter::ball(10.0, 40.0).expect("a ball");
    let due = 2.0 / 3.0 * PI * 125.0 + PI * 25.0 * 3.0;
    let found = volume(&ball, &[pose(20.0, 15.0, 2.0)]);
    assert!((found / due - 1.0).abs() < 2e-3, "{found} {due}");
    let drill = Cutter::drill(8.0, PI / 2.0, 40.0).expect("a drill");
    let due = PI * 16.0 * 4.0 / 3.0 + PI * 16.0 * 3.0;
    let found = volume(&drill, &[pose(20.0, 15.0, 3.0)]);
    assert!((found / due - 1.0).abs() < 2e-3, "{found} {due}");
    let flat = Cutter::flat(10.0, 40.0).expect("a flat end");
    let slot: Vec<ToolPose> =
        (0..=200).map(|k| pose(10.0 + 0.1 * f64::from(k), 15.0, 6.0)).collect();
    let due = 4.0 * (20.0 * 10.0 + PI * 25.0);
    let found = volume(&flat, &slot);
    assert!((found / due - 1.0).abs() < 2e-3, "{found} {due}");
}

/// A block as a mesh is the block, also where lines pass exactly through its edges and diagonals; a hollow one lacks its inside.
#[test]
fn law_a_mesh_is_what_it_encloses() {
    let (low, high) = (Vec3::zeros(), Vec3::new(40.0, 30.0, 10.0));
    for resolution in [10.0, 1.0, 0.37] {
        let mesh = Stock::of_mesh(&cuboid(low, high), resolution).expect("a mesh");
        let block = Stock::block(&low, &high, resolution).expect("a block");
        for along in 0..3 {
            assert!(mesh.lines(along).eq(block.lines(along)), "{resolution} {along}");
        }
        let mut hollow = cuboid(low, high);
        hollow.extend(cuboid(Vec3::new(10.0, 10.0, 2.0), Vec3::new(30.0, 20.0, 8.0)));
        let hollow = Stock::of_mesh(&hollow, resolution.min(1.0)).expect("a mesh");
        assert!((hollow.volume_mm3() / (12_000.0 - 1_200.0) - 1.0).abs() < 0.03);
    }
}

/// A corner that a plane cuts off a cube: a sixth of it; each of its lines along X ends on that plane.
#[test]
fn law_a_tetrahedron_by_hand() {
    let [o, x, y, z] =
        [[0.0; 3], [30.0, 0.0, 0.0], [0.0, 24.0, 0.0], [0.0, 0.0, 18.0]].map(Vec3::from);
    let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
    let stock = Stock::of_mesh(&faces, 0.25).expect("a mesh");
    for volume in stock.volumes_mm3() {
        assert!((volume / (30.0 * 24.0 * 18.0 / 6.0) - 1.0).abs() < 2e-3, "{volume}");
    }
    for (at, material) in stock.lines(0) {
        let due = 30.0 * (1.0 - at.y / 24.0 - at.z / 18.0);
        match material {
            [] => assert!(due < 1e-9, "{at}"),
            [[low, high]] => {
                assert!(low.abs() < 1e-9 && (high - due).abs() < 1e-9, "{at} {material:?}");
            }
            _ => panic!("{at} {material:?}"),
        }
    }
}

#[test]
fn what_is_no_stock_is_refused() {
    let (low, high) = (Vec3::zeros(), Vec3::new(40.0, 30.0, 10.0));
    let mut open = cuboid(low, high);
    open.pop();
    assert!(matches!(Stock::of_mesh(&open, 1.0), Err(StockError::Open(_))));
    assert_eq!(Stock::of_mesh(&[], 1.0).unwrap_err(), StockError::Empty);
    assert_eq!(Stock::block(&low, &low, 1.0).unwrap_err(), StockError::Empty);
    for resolution in [0.0, -1.0, f64::NAN] {
        assert!(matches!(Stock::block(&low, &high, resolution), Err(StockError::Resolution(_))));
    }
    assert!(matches!(Stock::block(&low, &high, 1e-6), Err(StockError::TooFine { .. })));
    assert!(matches!(block(1.0).with_part(&open), Err(StockError::Open(_))));
}

/// A part inside of the block: what goes 0.3 mm into its top is a gouge of that depth over the area of the cutter, what stays around it is excess.
#[test]
fn law_gouges_and_excess_by_hand() {
    let part = cuboid(Vec3::new(10.0, 5.0, 0.0), Vec3::new(30.0, 25.0, 6.0));
    let mut stock = block(0.25).with_part(&part).expect("a part");
    let excess = stock.excess_mm3().expect("a part");
    assert!((excess - (12_000.0 - 20.0 * 20.0 * 6.0)).abs() < 1e-6, "{excess}");
    let flat = Cutter::flat(8.0, 40.0).expect("a flat end");
    let above = stock.cut(&flat, &[pose(20.0, 15.0, 6.0)])[0];
    assert_eq!((above.gouge_mm, above.gouged_mm3), (0.0, [0.0; 3]));
    // A body counts as smaller by its inset.
    let asked =
        |inset_mm| Step { cutter: &flat, pose: pose(20.0, 15.0, 5.7), inset_mm, takes: false };
    let found = stock.work(&[asked(0.29), asked(0.31)]);
    assert!(found[0].longest_mm > 0.0 && found[1].longest_mm == 0.0, "{found:?}");
    let deep = stock.cut(&flat, &[pose(20.0, 15.0, 5.7)])[0];
    assert!((deep.gouge_mm - 0.3).abs() < 1e-9, "{}", deep.gouge_mm);
    let due = PI * 16.0 * 0.3;
    assert!((deep.gouged_mm3[2] / due - 1.0).abs() < 0.02, "{:?} {due}", deep.gouged_mm3);
}

/// Two kinds of cutters, poses that lean anywhere within 50 degrees.
fn cutters() -> impl Strategy<Value = Cutter> {
    (0..4_usize, 3.0..9.0_f64).prop_map(|(kind, diameter)| {
        let height = 60.0;
        match kind {
            0 => Cutter::ball(diameter, height),
            1 => Cutter::flat(diameter, height),
            2 => Cutter::bull(diameter, 0.2 * diameter, height),
            _ => Cutter::new(&Apt {
                diameter_mm: diameter,
                corner_mm: 0.0,
                corner_radial_mm: 0.5 * diameter,
                corner_axial_mm: 0.25 * diameter,
                bottom_rad: 0.5_f64.atan(),
                side_rad: 0.1,
                height_mm: height,
            }),
        }
        .expect("a cutter")
    })
}

fn poses() -> impl Strategy<Value = Vec<ToolPose>> {
    let one = (0.0..40.0_f64, 0.0..30.0_f64, 0.5..11.0_f64, 0.0..0.87_f64, 0.0..2.0 * PI);
    let one = one.prop_map(|(x, y, z, lean, turn)| ToolPose {
        tip_mm: Vec3::new(x, y, z),
        axis: Vec3::new(lean.sin() * turn.cos(), lean.sin() * turn.sin(), lean.cos()),
    });
    prop::collection::vec(one, 1..12)
}

/// The surface of what remains is closed, and encloses the volume of it to the coarseness of its lattice.
#[test]
fn law_the_surface_encloses_what_remains() {
    let mut stock = block(0.5);
    let ball = Cutter::ball(12.0, 40.0).expect("a ball");
    let poses: Vec<ToolPose> = (0..=100).map(|k| pose(0.4 * f64::from(k), 15.0, 4.0)).collect();
    stock.cut(&ball, &poses);
    for most in [usize::MAX, 20_000] {
        let surface = stock.surface(most);
        let mut edges = std::collections::BTreeMap::new();
        let key = |p: &Vec3| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
        let mut six_volumes = 0.0;
        for [a, b, c] in &surface {
            six_volumes += a.dot(&b.cross(c));
            for (p, q) in [(a, b), (b, c), (c, a)] {
                *edges.entry((key(p), key(q))).or_insert(0) += 1;
                *edges.entry((key(q), key(p))).or_insert(0) -= 1;
            }
        }
        assert!(edges.values().all(|count| *count == 0), "{most}: open");
        let part = six_volumes / 6.0 / stock.volume_mm3();
        assert!((part - 1.0).abs() < 0.03, "{most}: {part}, {} triangles", surface.len());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Where the lowest entry of any cutter lies on a line along Z, by nails, ends the lowest stretch of it.
    #[test]
    fn law_lines_are_cut_as_nails_are(cutter in cutters(), poses in poses()) {
        let mut stock = block(2.3);
        stock.cut(&cutter, &poses);
        let sweep = Sweep::new(cutter, poses.iter().map(|p| [*p, *p])).expect("a sweep");
        let lines: Vec<(Vec3, Vec<[f64; 2]>)> =
            stock.lines(2).map(|(at, material)| (at, material.to_vec())).collect();
        let nails: Vec<Nail> = lines
            .iter()
            .map(|(at, _)| Nail { foot_mm: *at, normal: Vec3::z(), below_mm: 0.0, above_mm: 10.0 })
            .collect();
        for ((at, material), reach) in lines.iter().zip(cut(&[sweep], &nails)) {
            let left = material.first().filter(|s| s[0] == 0.0).map_or(0.0, |s| s[1]);
            let due = reach.cut().map_or(10.0, |c| c.deviation_mm.clamp(0.0, 10.0));
            prop_assert!((left - due).abs() < 1e-6, "{at} {left} {due}");
        }
    }

    /// Poses that come together take the same bits as each alone: what is skipped as out of reach was out of reach. Small ways and
    /// large ones, leaning, narrow cutters and wide ones, two of them in turns.
    #[test]
    fn law_poses_together_take_what_each_takes_alone(
        cutters in [cutters(), cutters()],
        wide in 10.0..90.0_f64,
        poses in poses(),
        parts in 1..60_usize,
    ) {
        let wide = Cutter::flat(wide, 60.0).expect("a cutter");
        let between = |p: &[ToolPose]| {
            (0..parts).map(|k| p[0].towards(&p[1], k as f64 / parts as f64)).collect::<Vec<_>>()
        };
        let path: Vec<ToolPose> = poses.windows(2).flat_map(between).collect();
        let step = |(k, pose): (usize, &ToolPose)| {
            let cutter = [&cutters[0], &cutters[1], &wide][k % 3];
            let takes = k % 4 != 1;
            let lifted_mm = if k % 3 == 2 { 6.0 } else { 0.0 };
            let tip_mm = pose.tip_mm + pose.axis * lifted_mm;
            Step { cutter, pose: ToolPose { tip_mm, ..*pose }, inset_mm: if takes { 0.0 } else { 0.02 }, takes }
        };
        let steps: Vec<Step<'_>> = path.iter().enumerate().map(step).collect();
        let (mut together, mut alone) = (block(1.1), block(1.1));
        let all = together.work(&steps);
        let each: Vec<_> = steps.iter().flat_map(|s| alone.work(std::slice::from_ref(s))).collect();
        prop_assert_eq!(all, each);
        for along in 0..3 {
            prop_assert!(together.lines(along).eq(alone.lines(along)));
        }
    }

    /// The order of the poses, a second pass, the division into chunks, the sense of the axes of the frame: nothing changes what remains.
    #[test]
    fn law_what_should_not_matter_to_stock(cutter in cutters(), poses in poses()) {
        let mut once = block(1.1);
        let taken: f64 = once.cut(&cutter, &poses).iter().map(|t| t.mean_mm3()).sum();
        prop_assert!((12_000.0 - once.volume_mm3() - taken).abs() < 1e-6);
        prop_assert!(once.cut(&cutter, &poses).iter().all(|t| t.mean_mm3() < 1e-3));
        let mut backwards = block(1.1);
        let reversed: Vec<ToolPose> = poses.iter().rev().copied().collect();
        for pose in &reversed {
            // What is asked first is what is taken then.
            let asked = Step { cutter: &cutter, pose: *pose, inset_mm: 0.0, takes: false };
            let found = backwards.work(&[asked, Step { takes: true, ..asked }, asked]);
            prop_assert_eq!(found[0].volume_mm3, found[1].volume_mm3);
            prop_assert!(found[2].mean_mm3() < 1e-3);
        }
        for along in 0..3 {
            for ((at, a), (_, b)) in once.lines(along).zip(backwards.lines(along)) {
                let length = |s: &[[f64; 2]]| s.iter().map(|s| s[1] - s[0]).sum::<f64>();
                prop_assert!((length(a) - length(b)).abs() < 1e-5, "{} {:?} {:?}", at, a, b);
            }
        }
        // X becomes Y, Y becomes Z, Z becomes X.
        let turned = |v: &Vec3| Vec3::new(v.z, v.x, v.y);
        let corner = turned(&Vec3::new(40.0, 30.0, 10.0));
        let mut other = Stock::block(&Vec3::zeros(), &corner, 1.1).expect("a block");
        let turned: Vec<ToolPose> =
            poses.iter().map(|p| ToolPose { tip_mm: turned(&p.tip_mm), axis: turned(&p.axis) }).collect();
        other.cut(&cutter, &turned);
        let [x, y, z] = once.volumes_mm3();
        for (a, b) in other.volumes_mm3().into_iter().zip([z, x, y]) {
            prop_assert!((a - b).abs() < 1e-6, "{} {}", a, b);
        }
    }
}
