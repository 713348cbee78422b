//! Which centres and angles of a machine are independent: a matter of its chain, not of its travels.

use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;
use trueaxis_rtcp::rtcp::{Angles, Centres};

fn machine(rest: &str) -> Machine {
    let text = format!("[machine]\nname = \"m\"\nchain = \"w C' b X Y Z B t\"\n{rest}");
    let (machine, problems) = Machine::check("m.toml", &text, &NoTables);
    machine.unwrap_or_else(|| panic!("{:?}", problems.sorted()))
}

/// A shift of the head is a shift of the table the other way, whatever part of a turn the table can make: four offsets are left.
#[test]
fn law_a_table_of_short_travel_has_the_same_centres() {
    for travel in ["\"unlimited\"", "[\"-60 deg\", \"60 deg\"]", "[\"0 deg\", \"40 deg\"]"] {
        let tool = "[tool]\nplacement = \"0 0 -150 mm\"\n";
        let machine = machine(&format!("[axis.C]\ntravel = {travel}\n{tool}"));
        let centres = Centres::of(&machine).expect("two rotary axes");
        let names: Vec<String> = centres.terms.iter().map(|t| t.error.to_string()).collect();
        assert_eq!(names, ["EX0C", "EY0C", "EX0t", "EZ0t"], "{travel}");
    }
}

/// On a head that nutates about (0, 1, 1) a turn about this axis before the head is the same turn of the spindle after
/// it, which is its tilt about Y and a turn about itself; that moves no tip. So of EB0B, EC0B and EB0t two are
/// independent, and six angles of seven.
#[test]
fn law_a_turn_of_the_spindle_about_itself_is_seen_by_no_tip() {
    for tip in [100.0, 150.0, 300.0] {
        let tool = format!("[tool]\ntip = \"0 0 -{tip} mm\"\n");
        let machine = machine(&format!("[axis.B]\ndirection = \"0 1 1\"\n{tool}"));
        let centres = Centres::of(&machine).expect("two rotary axes");
        let angles = Angles::of(&machine, &centres);
        let names: Vec<String> = angles.terms.iter().map(|t| t.error.to_string()).collect();
        assert_eq!(names, ["EA0C", "EB0C", "EA0B", "EB0B", "EC0B", "EA0t"], "{tip} mm");
    }
}
