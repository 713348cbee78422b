//! What a cutter leaves, by hand figures, by poses one by one, and whatever should not matter.

use proptest::prelude::*;
use trueaxis_cut::{Apt, Cut, Cutter, Nail, Reach, Sweep, ToolPose, cut};
use trueaxis_geometry::{Mat3, Vec3};

fn pose(x: f64, y: f64, z: f64, axis: Vec3) -> ToolPose {
    ToolPose { tip_mm: Vec3::new(x, y, z), axis: axis.normalize() }
}

fn nail(x: f64, y: f64, z: f64, normal: Vec3) -> Nail {
    Nail { foot_mm: Vec3::new(x, y, z), normal: normal.normalize(), below_mm: 1.0, above_mm: 2.0 }
}

fn one(sweeps: &[Sweep], nail: Nail) -> Cut {
    *cut(sweeps, &[nail])[0].cut().unwrap_or_else(|| panic!("{nail:?} is not cut"))
}

fn sweep(cutter: Cutter, steps: &[[ToolPose; 2]]) -> Sweep {
    Sweep::new(cutter, steps.iter().copied()).expect("a sweep")
}

/// Rows of a ball with radius R at a distance p leave ridges of s = R − √(R² − p²/4), whatever the chord of the rows.
#[test]
fn law_ridges_between_rows_of_a_ball() {
    let (radius, row) = (4.0_f64, 0.7);
    for chord in [100.0, 10.0, 0.3] {
        let mut steps = Vec::new();
        for k in -3..=3 {
            let count = (100.0_f64 / chord).round() as i32;
            let at = |i: i32| pose(f64::from(i) * chord - 50.0, f64::from(k) * row, 0.0, Vec3::z());
            steps.extend((0..count).map(|i| [at(i), at(i + 1)]));
        }
        let made = sweep(Cutter::ball(2.0 * radius, 30.0).expect("a ball"), &steps);
        let ridge = one(std::slice::from_ref(&made), nail(1.234, 0.5 * row, 0.0, Vec3::z()));
        let height = radius - (radius * radius - 0.25 * row * row).sqrt();
        assert!((ridge.deviation_mm - height).abs() < 1e-9, "{ridge:?} {height}");
        let groove = one(&[made], nail(1.234, row, 0.0, Vec3::z()));
        assert!(groove.deviation_mm.abs() < 1e-9, "{groove:?}");
    }
}

/// A flat end mill that leans by θ across its path leaves a wedge of slope tan θ; one that leans along its path leaves a hollow:
/// at y across, (R − √(R² − y²)) sin θ above its lowest line.
#[test]
fn law_a_flat_end_that_leans() {
    let (radius, lean) = (8.0_f64, 0.01_f64);
    let cutter = || Cutter::flat(2.0 * radius, 40.0).expect("a cutter");
    let across = Vec3::new(0.0, lean.sin(), lean.cos());
    let made = [sweep(cutter(), &[[pose(-20.0, 0.0, 0.0, across), pose(20.0, 0.0, 0.0, across)]])];
    for y in [-6.0, -1.0, 0.0, 3.3, 7.5] {
        let left = one(&made, nail(0.0, y, 0.0, Vec3::z()));
        assert!((left.deviation_mm + y * lean.tan()).abs() < 1e-9, "{y}: {left:?}");
    }
    // Leaning along the path towards +X it cuts with its edge at −X.
    let along = Vec3::new(lean.sin(), 0.0, lean.cos());
    let made = [sweep(cutter(), &[[pose(-40.0, 0.0, 0.0, along), pose(40.0, 0.0, 0.0, along)]])];
    for y in [0.0, 2.0, -5.0, 7.0_f64] {
        let left = one(&made, nail(0.0, y, 0.0, Vec3::z()));
        let edge = (radius * radius - y * y).sqrt();
        assert!((left.deviation_mm + edge * lean.sin()).abs() < 1e-9, "{y}: {left:?}");
    }
}

/// A bore by a drill that stands e beside its place: R₀ − (e cos φ + √(R² − e² sin² φ)) along the normal into the bore.
#[test]
fn law_a_bore_by_a_shifted_drill() {
    let (nominal, drilled, off) = (5.0, 5.01_f64, 0.03);
    let cutter = Cutter::drill(2.0 * drilled, 118_f64.to_radians(), 60.0).expect("a drill");
    let down = [pose(off, 0.0, 10.0, Vec3::z()), pose(off, 0.0, -40.0, Vec3::z())];
    let made = [sweep(cutter, &[down])];
    for k in 0..12 {
        let phi = f64::from(k) * 0.55;
        let normal = -Vec3::new(phi.cos(), phi.sin(), 0.0);
        let foot = -normal * nominal + Vec3::z() * -15.0;
        let left = one(&made, nail(foot.x, foot.y, foot.z, normal));
        let radius = off * phi.cos() + (drilled * drilled - (off * phi.sin()).powi(2)).sqrt();
        assert!((left.deviation_mm - (nominal - radius)).abs() < 1e-9, "{phi}: {left:?}");
    }
    // The point of the drill: 118° from edge to edge, so at 2 mm from its axis 2 tan 31° above its tip.
    let left = one(&made, nail(off + 2.0, 0.0, -39.0, Vec3::z()));
    assert!((left.deviation_mm - (2.0 * 31_f64.to_radians().tan() - 1.0)).abs() < 1e-9, "{left:?}");
}

/// A sphere by a ball that goes round it with its axis along the normal, its length wrong by ΔL: ΔL everywhere.
#[test]
fn law_a_sphere_by_a_ball_of_the_wrong_length() {
    let (sphere, longer) = (30.0, 0.025);
    let at = |phi: f64, theta: f64| {
        let out = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        ToolPose { tip_mm: out * (sphere - longer), axis: out }
    };
    let mut steps = Vec::new();
    for row in 1..40 {
        let theta = f64::from(row) * 0.02;
        steps.extend((0..720).map(|k| {
            let turn = f64::from(k).to_radians() * 0.5;
            [at(turn, theta), at(turn + 0.5_f64.to_radians(), theta)]
        }));
    }
    let made = [sweep(Cutter::ball(6.0, 30.0).expect("a ball"), &steps)];
    for (turn, row) in [(10, 5), (100, 20), (333, 39), (719, 12)] {
        let out = at(f64::from(turn).to_radians() * 0.5, f64::from(row) * 0.02).axis;
        let foot = out * sphere;
        let left = one(&made, nail(foot.x, foot.y, foot.z, out));
        // Where two chords meet at an angle φ a ball of radius R cuts deeper, by less than (φ/2)² R/2.
        let deeper = -longer - left.deviation_mm;
        let most = 0.5 * 3.0 * 0.25_f64.to_radians().powi(2);
        assert!((-1e-9..most).contains(&deeper), "{left:?}");
    }
}

/// Distance from a shape by its outline: the nearest of many points of it.
fn outline(apt: &Apt) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    let centre = [apt.corner_radial_mm, apt.corner_axial_mm];
    let begin = apt.bottom_rad - std::f64::consts::FRAC_PI_2;
    let end = -apt.side_rad;
    let on_arc =
        |a: f64| [centre[0] + apt.corner_mm * a.cos(), centre[1] + apt.corner_mm * a.sin()];
    let many = 4000;
    let line = |a: [f64; 2], b: [f64; 2], points: &mut Vec<[f64; 2]>| {
        points.extend((0..=many).map(|k| {
            let t = f64::from(k) / f64::from(many);
            [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
        }));
    };
    let (first, last) = (on_arc(begin), on_arc(end));
    let top = [last[0] + (apt.height_mm - last[1]) * apt.side_rad.tan(), apt.height_mm];
    line([0.0, 0.0], first, &mut points);
    points
        .extend((0..=many).map(|k| on_arc(begin + (end - begin) * f64::from(k) / f64::from(many))));
    line(last, top, &mut points);
    line(top, [0.0, apt.height_mm], &mut points);
    points
}

/// A cutter whose bottom and side touch its corner circle.
fn touching(corner: f64, radial: f64, bottom: f64, side: f64) -> Apt {
    let axial = (corner + radial * bottom.sin()) / bottom.cos();
    // Where bottom and side meet: the side at a distance r from the centre of the corner.
    let far = radial * side.cos() - axial * side.sin() + corner;
    let meet = far / (side.cos() - bottom.tan() * side.sin());
    Apt {
        diameter_mm: 2.0 * meet,
        corner_mm: corner,
        corner_radial_mm: radial,
        corner_axial_mm: axial,
        bottom_rad: bottom,
        side_rad: side,
        height_mm: 40.0,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The distance from any cutter of APT is that from the nearest of many points of its outline; its gradient is that of
    /// differences.
    #[test]
    fn law_the_distance_is_that_from_the_outline(
        (corner, radial) in (0.0..5.0_f64, 0.5..6.0_f64), (bottom, side) in (0.0..0.6_f64, -0.1..0.4_f64),
        (r, z) in (0.0..20.0_f64, -10.0..50.0_f64),
    ) {
        prop_assume!(side >= 0.0 || corner + radial > 5.0);
        let apt = touching(corner, radial, bottom, side);
        let cutter = Cutter::new(&apt).expect("a cutter");
        let (distance, gradient) = cutter.distance(r, z);
        let points = outline(&apt);
        let nearest = points.iter().map(|p| (p[0] - r).hypot(p[1] - z)).fold(f64::MAX, f64::min);
        prop_assert!((distance.abs() - nearest).abs() < 0.01, "{distance} {nearest}");
        prop_assert!((gradient[0].hypot(gradient[1]) - 1.0).abs() < 1e-9);
        // Convex: nowhere below its tangent.
        for (dr, dz) in [(1.0, 0.0), (0.0, 1.0), (-0.3, 0.7), (5.0, -3.0)] {
            if r + dr >= 0.0 {
                let there = cutter.distance(r + dr, z + dz).0;
                prop_assert!(there >= distance + gradient[0] * dr + gradient[1] * dz - 1e-9);
            }
        }
    }

    /// Nails after five-axis moves are as long as a thousand poses of each move leave them.
    #[test]
    fn law_nails_are_those_of_many_poses(
        (which, seed) in (0..5_usize, 0..1_000_000_u64), count in 1..12_usize, turn in 0.0..0.4_f64,
    ) {
        let cutter = cutters()[which];
        let steps = random_steps(seed, count, turn);
        let made = [sweep(cutter, &steps)];
        for nail in random_nails(seed, 12) {
            let left = cut(&made, &[nail])[0];
            let sampled = sampled(&cutter, &steps, &nail, 1000);
            match (left.cut(), sampled) {
                (None, None) => {}
                (Some(cut), Some(at)) => {
                    // Poses a thousandth apart leave more, by little, and never less.
                    let steep = -cut.out.dot(&nail.normal);
                    prop_assert!(cut.deviation_mm <= at + 1e-4 / steep || grazes(cut, &nail), "{cut:?} {at}");
                    prop_assert!(cut.deviation_mm >= at - 0.01 / steep || grazes(cut, &nail), "{cut:?} {at}");
                }
                (Some(cut), None) => prop_assert!(cut.deviation_mm > 1.9 || grazes(cut, &nail), "{cut:?}"),
                (None, Some(at)) => prop_assert!(false, "not cut, but {at}"),
            }
        }
    }

    /// The order of the moves, their sense, dividing them, moving all of it rigidly, the company of other nails: none matters.
    #[test]
    fn law_what_should_not_matter_to_nails(
        (which, seed) in (0..5_usize, 0..1_000_000_u64), turn in 0.0..0.4_f64,
    ) {
        let cutter = cutters()[which];
        let steps = random_steps(seed, 20, turn);
        let nails = random_nails(seed, 40);
        let expected = cut(&[sweep(cutter, &steps)], &nails);
        let backwards: Vec<_> = steps.iter().rev().map(|[a, b]| [*b, *a]).collect();
        let halved: Vec<_> = steps.iter().flat_map(|[a, b]| {
            let middle = a.towards(b, 0.37);
            [[*a, middle], [middle, *b]]
        }).collect();
        let (turned, shift) = (rotation(seed), Vec3::new(100.0, -30.0, 7.0));
        let moved = |p: &ToolPose| ToolPose { tip_mm: turned * p.tip_mm + shift, axis: turned * p.axis };
        let elsewhere: Vec<_> = steps.iter().map(|[a, b]| [moved(a), moved(b)]).collect();
        let nails_elsewhere: Vec<_> = nails.iter().map(|n| Nail {
            foot_mm: turned * n.foot_mm + shift, normal: turned * n.normal, ..*n
        }).collect();
        let split: Vec<Sweep> = steps.iter().map(|s| sweep(cutter, &[*s])).collect();
        for (name, found) in [
            ("backwards", cut(&[sweep(cutter, &backwards)], &nails)),
            ("halved", cut(&[sweep(cutter, &halved)], &nails)),
            ("elsewhere", cut(&[sweep(cutter, &elsewhere)], &nails_elsewhere)),
            ("one sweep each", cut(&split, &nails)),
            ("alone", nails.iter().map(|n| cut(&[sweep(cutter, &steps)], &[*n])[0]).collect()),
        ] {
            for ((a, b), nail) in expected.iter().zip(&found).zip(&nails) {
                match (a.cut(), b.cut()) {
                    (Some(a), Some(b)) => {
                        // A nail that is met at a flat angle shows what the turn may be misjudged by magnified.
                        let most = 2e-4 / -a.out.dot(&nail.normal);
                        let near = (a.deviation_mm - b.deviation_mm).abs() < most;
                        prop_assert!(near || grazes(a, nail), "{name}: {a:?} {b:?}");
                    }
                    (None, None) => {}
                    (Some(c), None) | (None, Some(c)) => prop_assert!(grazes(c, nail), "{name}: {a:?} {b:?}"),
                }
            }
        }
    }
}

/// The cutter hardly goes into the nail: rounding decides whether it does.
fn grazes(cut: &Cut, nail: &Nail) -> bool {
    cut.out.dot(&nail.normal) > -0.02
}

fn cutters() -> [Cutter; 5] {
    [
        Cutter::ball(10.0, 30.0),
        Cutter::bull(12.0, 2.0, 30.0),
        Cutter::flat(10.0, 30.0),
        Cutter::drill(8.0, 2.0, 30.0),
        Cutter::new(&touching(3.0, 2.0, 0.1, 0.15)),
    ]
    .map(|c| c.expect("a cutter"))
}

/// A number in −1 … 1 that only depends on these two.
fn random(seed: u64, k: u64) -> f64 {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ k.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    for _ in 0..3 {
        x ^= x >> 29;
        x = x.wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^= x >> 32;
    }
    (x >> 11) as f64 / f64::from(1 << 30) / f64::from(1 << 22) - 1.0
}

fn vector(seed: u64, k: u64) -> Vec3 {
    Vec3::new(random(seed, 3 * k), random(seed, 3 * k + 1), random(seed, 3 * k + 2))
}

/// A path near the plane z = 0 with an axis that turns.
fn random_steps(seed: u64, count: usize, turn: f64) -> Vec<[ToolPose; 2]> {
    let at = |k: usize| {
        let v = vector(seed, k as u64);
        let lean = vector(seed, 1000 + k as u64) * turn;
        pose(8.0 * v.x, 8.0 * v.y, 0.5 * v.z, Vec3::new(lean.x, lean.y, 1.0))
    };
    (0..count).map(|k| [at(k), at(k + 1)]).collect()
}

fn random_nails(seed: u64, count: usize) -> Vec<Nail> {
    let at = |k: usize| {
        let (v, lean) = (vector(seed, 5000 + k as u64), vector(seed, 7000 + k as u64) * 0.5);
        nail(9.0 * v.x, 9.0 * v.y, 0.2 * v.z, Vec3::new(lean.x, lean.y, 1.0))
    };
    (0..count).map(at).collect()
}

fn rotation(seed: u64) -> Mat3 {
    let a = vector(seed, 77).normalize();
    let b = a.cross(&vector(seed, 78)).normalize();
    Mat3::from_columns(&[a, b, a.cross(&b)])
}

/// The lowest place of the nail that is inside the cutter in any of the poses, by halving.
fn sampled(cutter: &Cutter, steps: &[[ToolPose; 2]], nail: &Nail, poses: usize) -> Option<f64> {
    let mut best: Option<f64> = None;
    for [a, b] in steps {
        for k in 0..=poses {
            let pose = a.towards(b, k as f64 / poses as f64);
            let distance = |at: f64| {
                let arm = nail.foot_mm + nail.normal * at - pose.tip_mm;
                let axial = arm.dot(&pose.axis);
                cutter.distance((arm - pose.axis * axial).norm(), axial).0
            };
            // The least distance on the nail by golden section, then the entry by halving.
            let (mut low, mut high) = (-nail.below_mm, best.unwrap_or(nail.above_mm));
            if distance(high) > 0.0 {
                for _ in 0..40 {
                    let (p, q) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
                    if distance(p) < distance(q) { high = q } else { low = p }
                }
                if distance(low) > 0.0 {
                    continue;
                }
                high = low;
            }
            low = -nail.below_mm;
            if distance(low) <= 0.0 {
                return Some(low);
            }
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if distance(middle) > 0.0 { low = middle } else { high = middle }
            }
            best = Some(high);
        }
    }
    best
}

/// A tool that is displaced by so little displaces the surface by what the normal of the cutter says.
#[test]
fn law_a_displaced_tool_displaces_the_surface() {
    for (cutter, seed) in cutters().into_iter().zip(10..) {
        let steps = random_steps(seed, 15, 0.2);
        let (shift, lean) = (vector(seed, 501) * 1e-4, vector(seed, 502) * 1e-5);
        let off = |p: &ToolPose| {
            let lean = lean - p.axis * p.axis.dot(&lean);
            ToolPose { tip_mm: p.tip_mm + shift, axis: (p.axis + lean).normalize() }
        };
        let moved: Vec<_> = steps.iter().map(|[a, b]| [off(a), off(b)]).collect();
        let (before, after) = (sweep(cutter, &steps), sweep(cutter, &moved));
        let nails = random_nails(seed, 200);
        let (mut compared, mut far) = (0, 0);
        let pairs = cut(&[before], &nails).into_iter().zip(cut(&[after], &nails));
        for ((a, b), nail) in pairs.zip(&nails) {
            let (Reach::Cut(a), Reach::Cut(b)) = (a, b) else { continue };
            let lean = lean - a.axis * a.axis.dot(&lean);
            let expected = a.shift_mm(nail, &shift, &lean);
            compared += 1;
            // Another move, or another edge of the cutter, may cut now: few.
            far += usize::from((b.deviation_mm - a.deviation_mm - expected).abs() > 2e-6);
        }
        assert!(compared > 60 && far * 15 < compared, "{far} of {compared}");
    }
}

/// What is said of cutters and paths that are none.
#[test]
fn bad_cutters_and_paths_are_refused_by_name() {
    let good = touching(1.0, 4.0, 0.1, 0.0);
    assert!(Cutter::new(&good).is_ok());
    for (bad, words) in [
        (Apt { diameter_mm: f64::NAN, ..good }, "diameter"),
        (Apt { height_mm: 0.0, ..good }, "height"),
        (Apt { bottom_rad: -0.1, ..good }, "hollow"),
        (Apt { side_rad: 2.0, ..good }, "angle of the side"),
        (Apt { corner_axial_mm: 3.0, ..good }, "bottom passes the corner circle"),
        (Apt { diameter_mm: 20.0, ..good }, "side passes the corner circle"),
        (Apt { side_rad: -0.5, diameter_mm: 9.0, ..good }, "side"),
    ] {
        let error = Cutter::new(&bad).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    }
    let ball = Cutter::ball(10.0, 30.0).expect("a ball");
    let z = pose(0.0, 0.0, 0.0, Vec3::z());
    for (step, words) in [
        ([z, pose(f64::NAN, 0.0, 0.0, Vec3::z())], "step 0: the tip must be finite"),
        ([z, ToolPose { axis: Vec3::zeros(), ..z }], "unit vector"),
        ([z, ToolPose { axis: -Vec3::z(), ..z }], "half a turn"),
    ] {
        let error = Sweep::new(ball, [step]).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    }
    // No moves cut nothing.
    let none = Sweep::new(ball, []).expect("an empty path");
    assert_eq!(cut(&[none], &[nail(0.0, 0.0, 0.0, Vec3::z())]), [Reach::NotCut]);
}

/// A flat end that plunges in four steps: where a step ends at the very height of a nail its corner lies on the nail, and the side that comes next
/// is what cuts it. A tool that is displaced by 1 µm towards the wall takes 1 µm of it, whatever it does across and along.
#[test]
fn law_a_corner_on_a_nail_cuts_with_its_side() {
    let steps: Vec<[ToolPose; 2]> = (0..4)
        .map(|k| [k, k + 1].map(|k| pose(9.0, 0.0, -4.0 * f64::from(k), Vec3::z())))
        .collect();
    let sweep = sweep(Cutter::flat(12.0, 30.0).expect("a cutter"), &steps);
    for height in [-2.0, -4.0, -7.9, -8.0, -12.0, -16.0] {
        for hair in [0.0, 1e-13, -1e-13, 1e-12, -1e-12, 1e-9, 1e-6] {
            if height + hair < -16.0 {
                // Below the end of the last step nothing is cut.
                continue;
            }
            let wall = nail(15.0, 0.0, height + hair, -Vec3::x());
            let cut = one(std::slice::from_ref(&sweep), wall);
            assert!(cut.deviation_mm.abs() < 1e-9, "{height} {hair}: {cut:?}");
            let shift = cut.shift_mm(&wall, &Vec3::new(1e-3, 2e-3, 3e-3), &Vec3::zeros());
            assert!((shift + 1e-3).abs() < 1e-8, "{height} {hair}: {shift} {cut:?}");
        }
    }
}
