//! Cutter radius compensation of FANUC, Haas, SINUMERIK and HEIDENHAIN: places by hand. LinuxCNC has its own
//! interpreter as judge (`linuxcnc_radius.rs`), laws over random contours are in `radius_laws.rs`.

mod support;

use support::radius::{Piece, Point, path, sound};
use trueaxis_nc::Control::{Fanuc, Haas, Heidenhain, LinuxCnc, Sinumerik840d};

fn near(a: Point, b: Point) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9
}

/// The ends of the pieces of the path.
#[track_caller]
fn assert_ends(pieces: &[Piece], ends: &[Point]) {
    let ours: Vec<Point> = pieces.iter().map(|p| p.to).collect();
    let same = ours.len() == ends.len() && ours.iter().zip(ends).all(|(a, b)| near(*a, *b));
    assert!(same, "ours {ours:?}\nby hand {ends:?}");
}

/// A tool of radius 3 to the left of a square of 20, clockwise: outside.
const OUTSIDE: &str =
    "G17 G90 G94 F500\nG0 X-10 Y-10\nG41 G1 X0 Y0\nY20\nX20\nY0\nX0\nG40 X-10 Y-10\nM30\n";

#[test]
fn a_square_outside() {
    let lines = [
        [-10.0, -10.0],
        [-3.0, 0.0],
        [-3.0, 23.0],
        [23.0, 23.0],
        [23.0, -3.0],
        [0.0, -3.0],
        [-10.0, -10.0],
    ];
    let fanuc = OUTSIDE.replace("G41 G1", "G41 D1 G1");
    assert_ends(&sound(Fanuc, &fanuc, 3.0), &lines);
    assert_ends(&sound(Haas, &fanuc, 3.0), &lines);
    let siemens = format!("T1 D1\nM6\n{OUTSIDE}");
    assert_ends(&sound(Sinumerik840d, &siemens.replace("G41", "G451 G41"), 3.0), &lines);
    let arcs = [
        [-10.0, -10.0],
        [-3.0, 0.0],
        [-3.0, 20.0],
        [0.0, 23.0],
        [20.0, 23.0],
        [23.0, 20.0],
        [23.0, 0.0],
        [20.0, -3.0],
        [0.0, -3.0],
        [-10.0, -10.0],
    ];
    let found = sound(Sinumerik840d, &siemens, 3.0);
    assert_ends(&found, &arcs);
    assert_eq!(found[3].arc, Some(([0.0, 20.0], false)), "about the corner, clockwise");
    let klartext = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L X-10 Y-10 R0 FMAX\n3 L X+0 Y+0 RL F500\n4 L Y+20\n\
                    5 L X+20\n6 L Y+0\n7 L X+0\n8 L X-10 Y-10 R0\n9 END PGM A MM\n";
    assert_ends(&sound(Heidenhain, klartext, 3.0), &arcs);
}

#[test]
fn a_square_inside() {
    let text =
        "G17 G90 G94 F500\nG0 X10 Y10\nG42 D1 G1 X0 Y10\nY20\nX20\nY0\nX0\nY10\nG40 X10 Y10\nM30\n";
    let ends = [
        [10.0, 10.0],
        [3.0, 10.0],
        [3.0, 17.0],
        [17.0, 17.0],
        [17.0, 3.0],
        [3.0, 3.0],
        [3.0, 10.0],
        [10.0, 10.0],
    ];
    assert_ends(&sound(Fanuc, text, 3.0), &ends);
    assert_ends(&sound(Sinumerik840d, &format!("T1\nM6\n{text}"), 3.0), &ends);
    // LinuxCNC enters perpendicular to its entry move, here below the side: the corner is the same.
    let linuxcnc = text.replace("G42", "M6 T1\nG42");
    assert!(near(sound(LinuxCnc, &linuxcnc, 3.0)[2].to, [3.0, 17.0]));
}

#[test]
fn a_pointed_corner_of_fanuc_is_cut_off_by_the_radius() {
    // The contour turns by 135 degrees at (20, 0): 2 further along X, then to the place that is 2 before the
    // second line begins. Its direction is (-1, 1)/√2 with the left normal (-1, -1)/√2, the tool to its right.
    let text = "G17 G90 G94 F500\nG0 X-10 Y-9\nG42 D1 G1 X0 Y0\nX20\nX0 Y20\nG40 X-20 Y20\nM30\n";
    let h = std::f64::consts::FRAC_1_SQRT_2;
    let ends = [
        [-10.0, -9.0],
        [0.0, -2.0],
        [22.0, -2.0],
        [20.0 + 2.0 * h + 2.0 * h, 2.0 * h - 2.0 * h],
        [2.0 * h, 20.0 + 2.0 * h],
        [-20.0, 20.0],
    ];
    assert_ends(&sound(Fanuc, text, 2.0), &ends);
}

#[test]
fn arcs_and_lines_that_meet_on_circles() {
    // G451: line along X to (20, 0), then a circle about (20, -10): smooth outside, no piece between. Then a
    // corner from the circle at (30, -10) to a line along X: the circle of radius 12 goes on to y = -8,
    // which is 2 above its centre.
    let text = "T1\nM6\nG17 G90 G94 F500\nG0 X-10 Y5\nG451 G41 G1 X0 Y0\nX20\nG2 X30 Y-10 I0 J-10\nG1 X50\nG40 Y0\nM30\n";
    let x = 20.0 + (144.0_f64 - 4.0).sqrt();
    let ends = [[-10.0, 5.0], [0.0, 2.0], [20.0, 2.0], [x, -8.0], [50.0, -8.0], [50.0, 0.0]];
    let found = sound(Sinumerik840d, text, 2.0);
    assert_ends(&found, &ends);
    assert_eq!(found[3].arc, Some(([20.0, -10.0], false)));
}

#[test]
fn places_in_the_other_planes() {
    let text = "G90 G94 F500\nG18 G0 Z-10 X-10\nG41 D1 G1 Z0 X0\nX20\nZ20\nG40 Z30\nM30\n";
    // Z is the first axis of G18: X is to its left.
    let found = sound(Fanuc, text, 3.0);
    assert_ends(&found, &[[-10.0, 0.0], [0.0, 0.0], [23.0, 0.0], [23.0, 0.0], [20.0, 0.0]]);
    let heights: Vec<f64> = found.iter().map(|p| p.z).collect();
    assert_eq!(heights, [-10.0, -3.0, -3.0, 20.0, 30.0]);
}

#[test]
fn moves_across_the_plane_happen_at_the_end_of_the_element() {
    let text = "G17 G90 G94 F500\nG0 X10 Y10 Z5\nG42 D1 G1 X0 Y10\nY20\nZ1\nG4 P100\nZ-2\nX20\nY0\nG40 X10 Y10\nM30\n";
    let found = sound(Fanuc, text, 3.0);
    let corner: Vec<f64> = found.iter().filter(|p| near(p.to, [3.0, 17.0])).map(|p| p.z).collect();
    assert_eq!(corner, [5.0, 1.0, -2.0]);
}

#[test]
fn where_the_tool_does_not_fit() {
    let start = "G17 G90 G94 F500\nG0 X-10 Y-10\nG42 D1 G1 X0 Y0\n";
    for (contour, line) in [
        // The inside of an arc of radius 2, an inside step of 1.
        ("X20\nG2 X24 Y0 R2\nG1 X40\n", 5),
        ("X20\nY-1\nX40\nY-20\n", 5),
        // An inside corner of 170 degrees takes 34 mm.
        ("X20\nX0 Y-3.5265\n", 5),
    ] {
        let (_, found) = path(Fanuc, &format!("{start}{contour}G40 X60 Y20\nM30\n"), 3.0);
        assert_eq!(found, [("tool-too-large", line)], "{contour}");
    }
    for (text, code) in [
        ("G41 D1 G2 X10 Y0 I5 F500\n", "bad-compensation"),
        ("G41 D1 G1 X10 F500\nX20\nG40\nG2 X30 Y10 I10\n", "bad-compensation"),
        ("G41 D1 G1 X10 F500\nX20\nG18 X30\n", "bad-compensation"),
        ("G41 D1 G1 X10 F500\nX20\nG81 X30 Z-5 R1\n", "bad-compensation"),
    ] {
        assert_eq!(path(Fanuc, text, 3.0).1[0].0, code, "{text}");
    }
}

#[test]
fn the_radius_comes_from_the_table_the_program_and_the_wear() {
    let run = |before: &str, words: &str| {
        let text = format!(
            "G17 G90 G94 F500\n{before}G0 X-10 Y-10\n{words} G1 X0 Y0\nY20\nG40 X-10\nM30\n"
        );
        let (pieces, found) = path(Fanuc, &text, 3.0);
        (pieces[1].to[0], found.into_iter().map(|f| f.0).collect::<Vec<_>>())
    };
    assert_eq!(run("", "G41 D1"), (-3.0, vec![]));
    assert_eq!(run("", "G41 D2"), (-4.0, vec![]));
    assert_eq!(run("G10 L12 P1 R2.5\n", "G41 D1"), (-2.5, vec![]));
    assert_eq!(run("G10 L13 P1 R-0.25\n", "G41 D1"), (-2.75, vec![]));
    assert_eq!(run("#13001=5\n", "G41 D1"), (-5.0, vec![]));
    assert_eq!(run("", "G42 D1"), (3.0, vec![]));
    assert_eq!(run("G10 L12 P1 R-3\n", "G42 D1"), (-3.0, vec![]));
    assert_eq!(run("", "G41 D0"), (0.0, vec![]));
    assert_eq!(run("", "G41 D7"), (0.0, vec!["unknown-tool-radius"]));
    assert_eq!(run("", "G41"), (0.0, vec!["unknown-tool-radius"]));
    // $TC_DP6 counts from the next T or D on, and is read again as a value.
    let siemens = "T1 D1\nM6\nG17 G90 G94 F500\n$TC_DP6[1,1]=2*$TC_DP6[1,1]\nG0 X-10 Y-10\nD1\nG41 G1 X0 Y0\n\
                   X=-10+$P_TOOLR Y20\nG40 X-10\nM30\n";
    let found = sound(Sinumerik840d, siemens, 3.0);
    // To the left of the way from (0, 0) to (-4, 20), which is 20.396 long.
    let length = 416_f64.sqrt();
    assert!(near(found[1].to, [-6.0 * 20.0 / length, -6.0 * 4.0 / length]), "{found:?}");
    // Nominal radius in the program, oversize in the call.
    let klartext = "0 BEGIN PGM A MM\n1 TOOL DEF 5 L+0 R+4\n2 TOOL CALL 5 Z S1 DR+0.5\n3 L X-10 Y-10 R0 FMAX\n\
                    4 L X+0 Y+0 RL F500\n5 L Y+20\n6 L X-10 R0\n7 END PGM A MM\n";
    let found = sound(Heidenhain, klartext, 3.0);
    assert!(near(found[1].to, [-4.5, 0.0]));
}

#[test]
fn the_radius_and_the_side_change_on_the_way() {
    // D2 is 1 larger: reached at the end of the block. Then to the other side, perpendicular.
    let text =
        "G17 G90 G94 F500\nG0 X-10 Y-10\nG41 D1 G1 X0 Y0\nY20\nY40 D2\nY60\nG42 Y80\nG40 X9\nM30\n";
    let ends = [
        [-10.0, -10.0],
        [-3.0, 0.0],
        [-3.0, 20.0],
        [-4.0, 40.0],
        [-4.0, 60.0],
        [4.0, 60.0],
        [4.0, 80.0],
        [9.0, 80.0],
    ];
    assert_ends(&sound(Fanuc, text, 3.0), &ends);
}

#[test]
fn frames_on_the_way() {
    // The zero point moves by (100, 0): the contour goes on, and the tool stays at its distance. A scale does
    // not scale the tool, a mirror brings it to the other side with the part.
    let text = "G10 L2 P2 X100\nG17 G90 G94 F500\nG0 X-10 Y-10\nG41 D1 G1 X0 Y0\nY20\nG55 X-100 Y40\nG40 X-90\nM30\n";
    let found = sound(Fanuc, text, 3.0);
    assert_ends(
        &found,
        &[[-10.0, -10.0], [-3.0, 0.0], [-3.0, 20.0], [-103.0, 40.0], [-90.0, 40.0]],
    );
    let scaled =
        "G17 G90 G94 F500\nG51 X0 Y0 P2.\nG0 X-10 Y-10\nG41 D1 G1 X0 Y0\nY20\nG40 X-10\nM30\n";
    assert!(
        near(sound(Fanuc, scaled, 3.0)[1].to, [-1.5, 0.0]),
        "1.5 in the program is 3 on the part"
    );
}

#[test]
fn after_the_end_a_machine_place_does_not_begin_it_again() {
    let text =
        "G17 G90 G94 F500\nG0 X-10 Y-10\nG41 D1 G1 X0 Y0\nY20\nG40\nG53 G0 Z0\nX-10 Y50\nX0\nM30\n";
    let found = sound(Fanuc, text, 3.0);
    assert!(near(found[found.len() - 2].to, [-10.0, 50.0]), "{found:?}");
    assert!(near(found[found.len() - 1].to, [0.0, 50.0]), "{found:?}");
}

/// A change of the tool length stops the tool at the end of an element; the corner after it is the same.
#[test]
fn an_interrupted_contour_keeps_its_outside_corners() {
    let (fanuc, siemens) = ("G10 L2 P1 Z1\nG54\n", "TRANS Z1\n");
    for (control, start, rule, d, change) in [
        (Fanuc, "", "", "D1", fanuc),
        (Sinumerik840d, "T1 D1\nM6\n", "G450", "", siemens),
        (Sinumerik840d, "T1 D1\nM6\n", "G451", "", siemens),
    ] {
        let program = |change: &str| {
            format!(
                "{start}G17 G90 G94 F500 {rule}\nG0 X-10 Y-10\nG41 {d} G1 X0 Y0\nY20\n{change}G2 X20 Y20 I10 J0\n\
                 {change}G1 Y0\nX0\nG40 X-10 Y-10\nM30\n"
            )
        };
        let corners = |text: &str| {
            let ends: Vec<Point> = sound(control, text, 3.0).iter().map(|p| p.to).collect();
            ends.into_iter().filter(|p| p[1] > 20.1 || p[0] > 20.1).collect::<Vec<_>>()
        };
        let (plain, interrupted) = (corners(&program("")), corners(&program(change)));
        for p in &plain {
            assert!(
                interrupted.iter().any(|q| near(*p, *q)),
                "{control:?} {rule}: {p:?} {interrupted:?}"
            );
        }
    }
    // Inside, the tool has gone too far already: that is a warning.
    let inside = "G17 G90 G94 F500\nG0 X10 Y10\nG42 D1 G1 X0 Y10\nY20\nG10 L2 P1 Z1\nX20\nG40 X10 Y10\nM30\n";
    assert_eq!(path(Fanuc, inside, 3.0).1, [("not-applied", 6)]);
}

#[test]
fn places_of_the_machine_interrupt_it() {
    // Perpendicular to the end, to the place of the machine, and in again perpendicular to the next element.
    let text = "G17 G90 G94 F500\nG0 X-10 Y-10\nG41 D1 G1 X0 Y0\nY20\nG53 G0 X-50 Y0\nG1 X0 Y40\nY60\nG28 X-9 Y60\n\
                G40 X5 Y5\nM30\n";
    let ends = [
        [-10.0, -10.0],
        [-3.0, 0.0],
        [-3.0, 20.0],
        [-50.0, 0.0],
        [-3.0, 40.0],
        [-3.0, 60.0],
        [-9.0, 60.0],
        [0.0, 0.0],
        [5.0, 5.0],
    ];
    assert_ends(&sound(Fanuc, text, 3.0), &ends);
    let linuxcnc = "G90 F500\nG41.1 D6 G1 X0 Y-10\nY20\nG53 G0 X0\nM2\n";
    assert_eq!(path(LinuxCnc, linuxcnc, 3.0).1, [("bad-compensation", 4)]);
}

#[test]
fn feeds_at_the_centre_and_on_the_contour() {
    let text = |code: &str| {
        format!(
            "T1\nM6\n{code} G17 G90 G94 F500\nG0 X-10 Y5\nG41 G1 X0 Y0\nX20\nG2 X30 Y-10 I0 J-10\nG3 X40 Y-20 I10 J0\n\
             G1 X60\nG40 Y0\nM30\n"
        )
    };
    let feeds = |code: &str| {
        let found = sound(Sinumerik840d, &text(code), 2.0);
        let arcs = found.iter().filter(|p| p.arc.is_some()).map(|p| p.feed);
        arcs.collect::<Vec<_>>()
    };
    // Outside an arc of 10 the centre has 12, inside 8 (808D manual: F · (r ± r tool) / r).
    assert_eq!(feeds("CFTCP"), [500.0, 500.0]);
    assert_eq!(feeds("CFC"), [600.0, 400.0]);
    assert_eq!(feeds("CFIN"), [500.0, 400.0]);
    assert_eq!(feeds(""), [500.0, 500.0]);
}

#[test]
fn kont_goes_round_the_ends_of_the_contour() {
    // From the other side of the line to (-2, 0) on the circle about its start, and back round its end.
    let text = "T1\nM6\nG17 G90 G94 F500\nG0 X-2 Y-9\nG41 KONT G1 X0 Y0\nX20\nG40 X22 Y-9\nM30\n";
    let found = sound(Sinumerik840d, text, 2.0);
    let ends = [[-2.0, -9.0], [-2.0, 0.0], [0.0, 2.0], [20.0, 2.0], [22.0, 0.0], [22.0, -9.0]];
    assert_ends(&found, &ends);
    assert_eq!(found[2].arc, Some(([0.0, 0.0], false)));
    assert_eq!(found[4].arc, Some(([20.0, 0.0], false)));
    assert_eq!(sound(Sinumerik840d, &text.replace("KONT", "NORM"), 2.0).len(), 4);
    // The polynomials of KONTC and KONTT are not known: the way of KONT, and a word about it.
    for smooth in ["KONTC", "KONTT"] {
        let (found, problems) = path(Sinumerik840d, &text.replace("KONT", smooth), 2.0);
        assert_ends(&found, &ends);
        assert_eq!(problems, [("not-applied", 5)]);
    }
}

#[test]
fn approach_and_departure_of_heidenhain() {
    let program = |approach: &str, depart: &str| {
        format!(
            "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1\n2 L X-30 Y+30 R0 FMAX\n3 APPR {approach} RL F500\n4 L X+20\n\
             5 DEP {depart}\n6 L X+50 Y+50 R0 FMAX\n7 END PGM A MM\n"
        )
    };
    let start = [-30.0, 30.0];
    let (begin, end, away) = ([0.0, 2.0], [20.0, 2.0], [50.0, 50.0]);
    for (approach, depart, first, last) in [
        ("LT X+0 Y+0 LEN5", "LT LEN5", [-5.0, 2.0], [25.0, 2.0]),
        ("LN X+0 Y+0 LEN5", "LN LEN5", [0.0, 7.0], [20.0, 7.0]),
        ("CT X+0 Y+0 CCA90 R+3", "CT CCA90 R+3", [-3.0, 5.0], [23.0, 5.0]),
        ("CT X+0 Y+0 CCA90 R-3", "CT CCA90 R-3", [-3.0, -1.0], [23.0, -1.0]),
    ] {
        let found = sound(Heidenhain, &program(approach, depart), 2.0);
        assert_ends(&found, &[start, first, begin, end, last, away]);
    }
    // LCT: the line touches the circle about (0, 5) and (20, 5).
    let found = sound(Heidenhain, &program("LCT X+0 Y+0 R3", "LCT X+50 Y+30 R3"), 2.0);
    for (arc, touch, outer) in [(2, 1, start), (4, 4, [50.0, 30.0])] {
        let (center, ccw) = found[arc].arc.unwrap();
        let arm = [found[touch].to[0] - center[0], found[touch].to[1] - center[1]];
        let way = [found[touch].to[0] - outer[0], found[touch].to[1] - outer[1]];
        assert!(ccw && near(center, [if arc == 2 { 0.0 } else { 20.0 }, 5.0]));
        assert!(
            (arm[0].hypot(arm[1]) - 3.0).abs() < 1e-9
                && (arm[0] * way[0] + arm[1] * way[1]).abs() < 1e-9
        );
    }
    // R0: as with RR and the radius 0.
    let found = sound(Heidenhain, &program("LN X+0 Y+0 LEN5", "LN LEN5").replace("RL", "R0"), 2.0);
    assert_ends(&found, &[start, [0.0, -5.0], [0.0, 0.0], [20.0, 0.0], [20.0, -5.0], away]);
}

/// M126 is for the rotary axes: contours, their approaches and corners are those of M127.
#[test]
fn law_the_way_of_rotary_axes_is_no_matter_of_a_contour() {
    for (approach, corner, depart) in [
        ("APPR CT X+0 Y+0 CCA90 R+3 RL F500", "RND R4", "DEP LCT X+50 Y+30 R3"),
        ("APPR LN X+0 Y+0 LEN5 RR F500", "CHF 2", "DEP LT LEN5"),
        ("L X+0 Y+0 R0 F500", "RND R3", "L X+9 R0"),
        ("L X+0 Y+0 RL F500", "CT X+20 Y+9", "L X+40 R0"),
    ] {
        let program = |mode: &str| {
            format!(
                "BEGIN PGM A MM\nTOOL CALL 1 Z S1\nL X-30 Y+30 R0 FMAX {mode}\n{approach}\nL X+20\n{corner}\n\
                 L Y+30\nCC X+20 Y+40\nC X+10 Y+40 DR-\n{depart}\nL C+270 FMAX\nL X+50 Y+50 R0 FMAX\nEND PGM A MM\n"
            )
        };
        let [with, without] = ["M126", "M127"].map(|mode| sound(Heidenhain, &program(mode), 2.0));
        assert!(with.len() > 7, "{with:?}");
        assert_eq!(with, without, "{approach}, {corner}, {depart}");
    }
}
