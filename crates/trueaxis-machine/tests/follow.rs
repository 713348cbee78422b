//! Paths that are followed in pieces.

mod library;

use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::axis::Command;
use trueaxis_machine::file::NoTables;
use trueaxis_machine::{FollowError, FollowedPath, Follower, Machine, Reached, Target};

type Outcome = Result<(Vec<Command>, Option<FollowError>), FollowError>;

/// Follows in pieces of these sizes, again and again; all points that were handed out, and how many of
/// them before the end.
fn in_pieces(
    machine: &Machine,
    path: &[Target],
    from: &Command,
    sizes: &[usize],
) -> (Outcome, usize) {
    let mut early = 0;
    let mut follow = || {
        let solver = machine.follow_solver(from)?;
        let (mut follower, mut reached) = (Follower::on(&solver), Reached::default());
        let (mut followed, mut rest) = (FollowedPath::default(), path);
        for size in sizes.iter().cycle() {
            let (piece, after) = rest.split_at((*size).min(rest.len()));
            solver.reach(piece.iter().copied(), &mut reached);
            let jump = follower.take(&mut reached, &mut followed)?;
            rest = after;
            if jump.is_some() || rest.is_empty() {
                break;
            }
        }
        early = followed.len();
        let jump = follower.finish(&mut followed)?;
        let points = path.iter().take(followed.len()).enumerate();
        Ok((points.map(|(i, target)| solver.command(&followed, i, target)).collect(), jump))
    };
    (follow(), early)
}

fn bits(outcome: &Outcome) -> Result<(Vec<[u64; 6]>, Option<FollowError>), FollowError> {
    let of = |command: &Command| command.map(f64::to_bits);
    outcome.clone().map(|(commands, jump)| (commands.iter().map(of).collect(), jump))
}

/// A path that winds round, comes to the pole now and then, and stays there for some points.
fn winding(points: usize, tilt: f64, rounds: f64, poles: usize, size: f64) -> Vec<Target> {
    let at = |i: usize| {
        let u = i as f64 / points as f64;
        let wave = if poles == 0 { 1.0 } else { (PI * poles as f64 * u).sin().abs() };
        let tilt = if wave < 0.02 { 0.0 } else { tilt * wave };
        let (sin, cos) = (TAU * rounds * (u + 0.1 * (9.0 * u).sin())).sin_cos();
        let axis = Vec3::new(tilt.sin() * cos, tilt.sin() * sin, tilt.cos());
        let tip = Point::new(size * cos, size * u, -size * sin * u);
        Target { tip, axis: Direction::of(axis).expect("a direction") }
    };
    (0..points).map(at).collect()
}

/// Chains with two tilts that aim alike, with one, endless and short.
const TRAVELS: [(&str, &str, &str); 6] = [
    ("w b X Y Z C A t", "[\"-360 deg\", \"360 deg\"]", "[\"-105 deg\", \"105 deg\"]"),
    ("w b X Y Z C A t", "\"unlimited\"", "[\"-105 deg\", \"105 deg\"]"),
    ("w C' A' b X Y Z t", "\"unlimited\"", "[\"-5 deg\", \"110 deg\"]"),
    ("w C' A' b X Y Z t", "[\"-190 deg\", \"900 deg\"]", "[\"-30 deg\", \"120 deg\"]"),
    ("w C' B' b X Y Z t", "[\"-170 deg\", \"200 deg\"]", "[\"-20 deg\", \"95 deg\"]"),
    ("w B' b X Y Z A t", "[\"-100 deg\", \"100 deg\"]", "[\"-80 deg\", \"80 deg\"]"),
];

fn machine_of((chain, first, second): (&str, &str, &str)) -> Machine {
    let mut rotary = chain.chars().filter(|c| "ABC".contains(*c));
    let (one, two) = (rotary.next().expect("an axis"), rotary.next().expect("an axis"));
    let text = format!(
        "[machine]\nname = \"m\"\nchain = \"{chain}\"\n[axis.{one}]\ntravel = {first}\n\
         [axis.{two}]\ntravel = {second}\n[tool]\nlength = \"80 mm\"\n"
    );
    Machine::check("m.toml", &text, &NoTables).0.expect("a machine")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// The same commands, jumps and faults in pieces of any size, to the last bit.
    #[test]
    fn law_pieces_of_a_path_are_followed_as_the_whole(
        which in 0..TRAVELS.len(), tilt in 0.2..1.9_f64, rounds in -3.0..3.0_f64, poles in 0..4_usize,
        points in 1..1500_usize, sizes in proptest::collection::vec(1..400_usize, 1..4),
        at in -4.0..4.0_f64,
    ) {
        let machine = machine_of(TRAVELS[which]);
        let path = winding(points, tilt, rounds, poles, 40.0);
        let mut from = Command::default();
        for (i, axis) in machine.axes().iter().enumerate() {
            if "ABC".contains(axis.name.letter()) {
                from[i] = at / (i + 1) as f64;
            }
        }
        let whole = machine.follow_on(&path, &from);
        for sizes in [&sizes[..], &[1], &[points]] {
            let (found, _) = in_pieces(&machine, &path, &from, sizes);
            prop_assert_eq!(bits(&found), bits(&whole));
        }
    }
}

/// Where only one branch lies within the travel, points are handed out on the way, and little is kept.
#[test]
fn what_is_decided_is_handed_out() {
    let machine = machine_of(TRAVELS[2]);
    let path = winding(5000, 1.0, 4.0, 0, 40.0);
    let tilted: Vec<Target> = path.into_iter().skip(200).take(4600).collect();
    let (found, early) = in_pieces(&machine, &tilted, &[0.0; 6], &[100]);
    assert_eq!(found, machine.follow_on(&tilted, &[0.0; 6]));
    assert!(found.is_ok_and(|(commands, jump)| commands.len() == 4600 && jump.is_none()));
    assert!(early > 4000, "{early}");
}

/// On a real machine with two branches to the end nothing is decided before.
#[test]
fn two_branches_to_the_end_are_kept() {
    let machine = library::machine("i5-engraver");
    let path: Vec<Target> = winding(3000, 1.0, 4.0, 0, 20.0).split_off(100);
    let (found, early) = in_pieces(&machine, &path[..2700], &[0.0; 6], &[100]);
    assert_eq!(found, machine.follow_on(&path[..2700], &[0.0; 6]));
    assert_eq!(early, 0);
}
