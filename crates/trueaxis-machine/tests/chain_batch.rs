//! The chain of groups of commands against the chain of one.

mod library;

use library::{Random, SHIPPED, machine};
use trueaxis_geometry::Vec3;
use trueaxis_machine::Machine;
use trueaxis_machine::batch::{
    CompiledChain, Frames, GROUP, Group, InstructionSet, Station, sines_and_cosines,
};
use trueaxis_machine::chain::Link;
use trueaxis_machine::errors::{Component, ErrorIndex, ErrorKind, ErrorValues};
use trueaxis_machine::twist::Reference;
use trueaxis_machine::{ErrorModel, Squareness, errors::Rotation};

const REFERENCES: [Reference; 2] = [Reference::Workpiece, Reference::Bed];

fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_available())
}

/// Location errors of every body, error motions of those that move.
fn every_station(machine: &Machine) -> Vec<Station> {
    let all = machine.bodies().iter().enumerate().flat_map(|(i, body)| {
        let motion = body.axis.map(|_| ErrorKind::Motion);
        let kinds = [Some(ErrorKind::Location), motion].into_iter().flatten();
        kinds.map(move |kind| Station { body: i, kind })
    });
    all.collect()
}

/// Commands and errors of a group.
struct Case {
    commands: [[f64; 6]; GROUP],
    errors: [ErrorValues; GROUP],
}

impl Case {
    fn new(machine: &Machine, stations: &[Station], random: &mut Random) -> Self {
        let commands = std::array::from_fn(|_| random.command(machine));
        let mut errors = [ErrorValues::default(); GROUP];
        for errors in &mut errors {
            for Station { body, kind } in stations {
                for component in Component::ALL {
                    let size = if component.is_rotation() { 3e-3 } else { 0.5 };
                    let index = ErrorIndex { body: *body, kind: *kind, component };
                    errors.set(index, size * (2.0 * random.unit() - 1.0));
                }
            }
        }
        Self { commands, errors }
    }

    fn columns(&self) -> [Group; 6] {
        std::array::from_fn(|axis| self.commands.map(|command| command[axis]))
    }

    fn errors_of(&self, stations: &[Station]) -> Vec<[Group; 6]> {
        let of = |s: &Station| {
            std::array::from_fn(|k| {
                std::array::from_fn(|lane| self.errors[lane].bodies[s.body].six(s.kind).0[k])
            })
        };
        stations.iter().map(of).collect()
    }
}

fn apart(a: &Link, b: &Link) -> f64 {
    (a.linear() - b.linear()).amax() * 1e3 + (a.shift_mm() - b.shift_mm()).amax()
}

#[test]
fn law_a_group_of_tools_is_the_chain_of_each() {
    for name in SHIPPED {
        let machine = machine(name).with_model(ErrorModel::default());
        let stations = every_station(&machine);
        let mut random = Random(7);
        for reference in REFERENCES {
            let chain = CompiledChain::new(&machine, reference, &stations).expect("a chain");
            for _ in 0..200 {
                let case = Case::new(&machine, &stations, &mut random);
                let (columns, errors) = (case.columns(), case.errors_of(&stations));
                for set in sets() {
                    let mut tools = [Frames::ZERO; 2];
                    for (tool, errors) in tools.iter_mut().zip([&errors[..], &[]]) {
                        assert_eq!(chain.walk(set, &columns, errors, &mut [], tool), 0);
                    }
                    for lane in 0..GROUP {
                        for (tool, errors) in
                            tools.iter().zip([case.errors[lane], ErrorValues::default()])
                        {
                            let judge: Link = match reference {
                                Reference::Workpiece => {
                                    machine.pose(&case.commands[lane], &errors).relabel()
                                }
                                Reference::Bed => {
                                    machine.tool_on_bed(&case.commands[lane], &errors).relabel()
                                }
                            };
                            let off = apart(&tool.at(lane), &judge);
                            assert!(off < 1e-10, "{name} {reference:?} {set:?}: {off}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn law_the_frames_of_a_group_lead_to_the_twists_of_each_error() {
    for name in SHIPPED {
        let machine = machine(name).with_model(ErrorModel::default());
        let stations = every_station(&machine);
        let mut random = Random(11);
        for reference in REFERENCES {
            let chain = CompiledChain::new(&machine, reference, &stations).expect("a chain");
            let case = Case::new(&machine, &[], &mut random);
            for set in sets() {
                let mut frames = vec![Frames::ZERO; stations.len()];
                let mut tool = Frames::ZERO;
                assert_eq!(chain.walk(set, &case.columns(), &[], &mut frames, &mut tool), 0);
                for (lane, command) in case.commands.iter().enumerate() {
                    let judge = machine.error_frames(command, reference);
                    assert!(apart(&tool.at(lane), judge.reference_from_tool()) < 1e-10);
                    for (station, Station { body, kind }) in stations.iter().enumerate() {
                        let (frame, side) = (frames[station].at(lane), chain.side(station));
                        for component in Component::ALL {
                            let index = ErrorIndex { body: *body, kind: *kind, component };
                            let twist = judge.twist(index);
                            let along: Vec3 = frame.linear().column(component as usize % 3) * side;
                            let (shift, turn) = match component.is_rotation() {
                                true => (frame.shift_mm().cross(&along), along),
                                false => (along, Vec3::zeros()),
                            };
                            let off = (shift - twist.shift_mm).amax()
                                + (turn - twist.turn_rad).amax() * 1e3;
                            assert!(off < 1e-9, "{name} {reference:?} {set:?} {index:?}: {off}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn what_a_group_does_not_cover_is_said_of_its_lane_alone() {
    let machine = machine("lei-hsu-mill");
    let stations = every_station(&machine);
    let chain = CompiledChain::new(&machine, Reference::Workpiece, &stations).expect("a chain");
    let case = Case::new(&machine, &stations, &mut Random(3));
    for set in sets() {
        let (mut columns, mut errors) = (case.columns(), case.errors_of(&stations));
        columns[0][1] = f64::NAN;
        columns[3][2] = 1e13;
        errors[4][4][6] = -5e-3;
        errors[5][3][7] = f64::NAN;
        let mut tool = Frames::ZERO;
        let undecided = chain.walk(set, &columns, &errors, &mut [], &mut tool);
        assert_eq!(undecided, 0b1100_0110, "{set:?}");
        for lane in [0, 3, 4, 5] {
            let judge = machine.pose(&case.commands[lane], &case.errors[lane]).relabel();
            assert!(apart(&tool.at(lane), &judge) < 1e-10, "{set:?} {lane}");
        }
    }
}

#[test]
fn the_small_angle_model_and_tilted_directions_have_no_groups() {
    let exact = machine("lei-hsu-mill");
    let direction = ErrorModel { squareness: Squareness::Direction, ..exact.model() };
    let small = ErrorModel { rotation: Rotation::SmallAngle, ..exact.model() };
    for model in [direction, small] {
        let other = exact.clone().with_model(model);
        assert!(CompiledChain::new(&other, Reference::Bed, &[]).is_none());
    }
}

#[test]
fn sines_of_a_group_are_those_of_the_library_however_large() {
    let mut random = Random(5);
    for size in [1e-9, 1.0, 300.0, 9e4, 1e6, 1e12] {
        for _ in 0..1000 {
            let angles: Group = std::array::from_fn(|_| size * (2.0 * random.unit() - 1.0));
            let [sines, cosines] = sines_and_cosines(&angles);
            for (lane, angle) in angles.iter().enumerate() {
                let (sin, cos) = angle.sin_cos();
                let off = (sines[lane] - sin).abs().max((cosines[lane] - cos).abs());
                assert!(off < 3e-16, "{angle}: {off}");
            }
        }
    }
}
