//! Tool-centre-point control against the inverse that it shortens.

mod library;

use library::{FIVE_AXIS, Random, machine};
use trueaxis_geometry::frame::{Direction, Point};
use trueaxis_machine::axis::Travel;
use trueaxis_machine::tcp::TipControl;
use trueaxis_machine::{Machine, Target};

#[test]
fn law_a_placed_tip_is_where_it_shall_be() {
    for name in FIVE_AXIS {
        let machine = machine(name);
        let control = TipControl::of(&machine).expect("three linear axes");
        let mut random = Random(7);
        for _ in 0..10_000 {
            let command = random.command(&machine);
            let (tip, _) = control.tip_and_axis(&command);
            let mut placed = command;
            for (q, axis) in placed.iter_mut().zip(machine.axes()) {
                if "XYZ".contains(axis.name.letter()) {
                    *q = 0.0;
                }
            }
            assert!(control.place(tip, &mut placed), "{name} {command:?}");
            let (again, _) = control.tip_and_axis(&placed);
            assert!((again - tip).norm() < 1e-10, "{name} {:e}", (again - tip).norm());
            let off = command.iter().zip(&placed).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "{name} {command:?} {placed:?}");
        }
    }
}

#[test]
fn law_the_aim_is_the_best_solution_of_the_inverse() {
    // Without a stated travel `solve` offers one turn only, the aim the nearest one.
    let known = |m: &Machine| {
        m.axes().iter().all(|a| "XYZ".contains(a.name.letter()) || a.travel != Travel::Unknown)
    };
    let machines = FIVE_AXIS.map(machine).into_iter().filter(known).collect::<Vec<_>>();
    assert!(machines.len() >= 3);
    for machine in machines {
        let name = machine.name();
        let control = TipControl::of(&machine).expect("three linear axes");
        let mut random = Random(11);
        for _ in 0..2_000 {
            let (from, goal) = (random.command(&machine), random.command(&machine));
            let (tip, axis) = control.tip_and_axis(&goal);
            let axis = Direction::of(axis).expect("a direction");
            let aimed = control.aim(axis, &from).expect("reachable")[0];
            assert_eq!(control.aim_nearest(axis, &from).expect("reachable"), aimed, "{name}");
            let found = machine.solve(&Target { tip: Point::from_vector(tip), axis }, &from);
            let found = found.expect("reachable").solutions;
            // The linear axes may rule a solution out; the aim does not look at them.
            let rotary = |c: &[f64; 6]| {
                let turns = |i: &usize| "ABC".contains(machine.axes()[*i].name.letter());
                (0..machine.axes().len()).filter(turns).map(|i| c[i]).collect::<Vec<_>>()
            };
            let travel = |c: &[f64; 6]| {
                rotary(c).iter().zip(rotary(&from)).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
            };
            let inside = |c: &[f64; 6]| {
                let axes = machine.axes().iter().enumerate();
                axes.filter(|(_, a)| "ABC".contains(a.name.letter()))
                    .all(|(i, a)| a.travel.contains(c[i]))
            };
            let best = found.iter().map(|s| s.command).filter(inside).map(|c| travel(&c));
            let best = best.fold(f64::INFINITY, f64::min);
            assert!(
                (travel(&aimed.command) - best).abs() < 1e-6,
                "{name} {from:?} {aimed:?} {found:?}"
            );
            let (_, reached) = control.tip_and_axis(&aimed.command);
            assert!((reached - axis.vector()).norm() < 1e-11);
        }
    }
}
