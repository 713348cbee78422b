//! CYCLE72 against the same contour with G41 or G42, and against the printed example of the manual.

mod support;

use support::radius::{Piece, path};
use trueaxis_nc::Control;

const SINUMERIK: Control = Control::Sinumerik840d;

/// Start points and contours that a cutter of radius 3 and an allowance of 1 fit into.
const CONTOURS: [&str; 4] = [
    "G1 G90 X0 Y0\nX40\nY30\nX0\nY0\n",
    "G1 G90 X0 Y0\nX40 RND=8\nY30 CHF=6\nX-5\n",
    "G1 G90 X10 Y0\nG91 X30 Y5\nG3 X20 Y20 CR=20\nG1 Y15\nG2 X-12 Y12 I0 J12\nG1 X-9\n",
    "G0 X5 Y5\nG1 X5 Y45\nX60 Y80\nG2 X90 Y50 I0 J-30\nG1 X70 Y5\n",
];

fn run(text: &str) -> (Vec<Piece>, Vec<(&'static str, usize)>) {
    path(SINUMERIK, text, 3.0)
}

fn sound(text: &str) -> Vec<Piece> {
    let (pieces, found) = run(text);
    assert!(found.is_empty(), "{found:?}\n{text}");
    pieces
}

fn near(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6
}

/// The places in the plane at a height that is cut, where they differ.
fn places(pieces: &[Piece], z: f64) -> Vec<([f64; 2], Option<[f64; 2]>)> {
    let mut found: Vec<([f64; 2], Option<[f64; 2]>)> = Vec::new();
    for p in pieces.iter().filter(|p| (p.z - z).abs() < 1e-9) {
        if p.arc.is_some() || found.last().is_none_or(|(last, _)| !near(*last, p.to)) {
            found.push((p.to, p.arc.map(|(center, _)| center)));
        }
    }
    found
}

fn assert_same(a: &[([f64; 2], Option<[f64; 2]>)], b: &[([f64; 2], Option<[f64; 2]>)], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}\n{a:?}\n{b:?}");
    for ((a, c), (b, d)) in a.iter().zip(b) {
        let centers = c.zip(*d).is_none_or(|(c, d)| near(c, d)) && c.is_some() == d.is_some();
        assert!(near(*a, *b) && centers, "{what}\n{a:?} {c:?} {b:?} {d:?}");
    }
}

/// The contour by CYCLE72 is the one with G41 or G42 and a tool that is larger by the allowance; in a subprogram,
/// between labels, and named by CYCLE62; with outside corners on arcs and where the paths meet.
#[test]
fn law_contours_are_those_of_radius_compensation() {
    let mut compared = 0;
    for contour in CONTOURS {
        for (side, rl) in [("G41", 41), ("G42", 42)] {
            for corners in ["G450", "G451"] {
                let head = format!("T1 D1 M6\nS1000 M3 F200\n{corners}\nG0 X-50 Y-60 Z50\n");
                let (start, rest) = contour.split_once('\n').unwrap();
                let by_hand = format!(
                    "T2 D1 M6\nS1000 M3 F200\n{corners}\nG0 X-50 Y-60 Z-5\n{side} {start}\n{rest}G40 G0 X200 Y200\nM30\n"
                );
                let (wanted, refused) = run(&by_hand);
                let call =
                    |name: &str| format!("CYCLE72({name},10,0,2,-5,5,1,0,300,100,11,{rl})\n");
                let sub = format!(
                    "%_N_MAIN_MPF\n{head}{}M30\n%_N_PART_SPF\n{contour}M17\n",
                    call("\"PART\"")
                );
                let (pieces, found) = run(&sub);
                if let Some((code, _)) = refused.first() {
                    assert_eq!(found[0].0, *code, "{sub}");
                    continue;
                }
                assert!(found.is_empty(), "{found:?} {sub}");
                let mut wanted = places(&wanted, -5.0);
                wanted.pop();
                // By hand the first place is the start of the program.
                assert_same(&places(&pieces, -5.0), &wanted[1..], &sub);
                let labels = format!(
                    "{head}{}M30\nPART:\n{contour}PART_E: G4 F0\nM30\n",
                    call("\"PART:PART_E\"")
                );
                assert_same(&places(&sound(&labels), -5.0), &wanted[1..], &labels);
                let named = format!(
                    "{head}CYCLE62(\"PART\",1,,)\n{}M30\nE_LAB_A_PART:\n{contour}E_LAB_E_PART:\nM30\n",
                    call("\"\"")
                );
                assert_same(&places(&sound(&named), -5.0), &wanted[1..], &named);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 16);
}

/// The printed example: retraction plane 250, surface 200, safety 3, depth 175 in steps of 10, allowances 1 and 1.5,
/// feeds 800 and 400, between the layers with G1 and 1000 to 3 above the surface, a quarter circle of 20.
#[test]
fn printed_contour() {
    let main = "T1 D1 M6\nS500 M3 F3000\nG17 G0 G90 X100 Y200 Z250 G94\n\
        CYCLE72(\"EX72CONTOUR\",250,200,3,175,10,1,1.5,800,400,111,41,2,20,1000,2,20)\nG0 X100 Y200\nM30\n";
    let contour = "%_N_EX72CONTOUR_SPF\nG1 G90 X150 Y160\nX230 CHF=10\nY80 CHF=10\nX125\nY135\nG2 X150 Y160 CR=25\nM2\n";
    let pieces = sound(&format!("%_N_MAIN_MPF\n{main}{contour}"));
    // 25 - 1.5 in three layers of 7.8333; the last at 176.5.
    let lowest = pieces.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    assert!((lowest - 176.5).abs() < 1e-9);
    let places = places(&pieces, 176.5);
    // Outside, 4 from the contour: to Y164 along X; the quarter circle of 20 ends at (150, 164), tangent to +X.
    assert!(near(places[0].0, [130.0, 184.0]), "{places:?}");
    assert!(near(places[1].0, [150.0, 164.0]) && near(places[1].1.unwrap(), [150.0, 184.0]));
    let far = places.iter().map(|(p, _)| p[0]).fold(f64::MIN, f64::max);
    assert!((far - 234.0).abs() < 1e-9, "{far}");
    assert!(near(places.last().unwrap().0, [170.0, 184.0]), "{places:?}");
    // Over the way in it stands at the end, at the retraction plane; the feed between the layers is 1000.
    assert!(pieces.iter().any(|p| p.feed == 1000.0 && p.z == 203.0 && near(p.to, [130.0, 184.0])));
    let last = &pieces[pieces.len() - 2];
    assert!(last.z == 250.0 && near(last.to, [130.0, 184.0]), "{last:?}");
}

/// The ways to the contour: a tangential line, a half circle, in space; in space the way goes down as well.
#[test]
fn ways_to_the_contour() {
    let call = |more: &str| {
        let text = format!(
            "%_N_MAIN_MPF\nT1 D1 M6\nM3 F200\nG0 X0 Y0 Z50\nCYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,{more})\nM30\n\
             %_N_L_SPF\nG1 X0 Y0\nX50\nM17\n"
        );
        sound(&text)
    };
    let at = |p: &Piece, x: f64, y: f64, z: f64| near(p.to, [x, y]) && (p.z - z).abs() < 1e-9;
    let line = call("41,1,10,600");
    assert!(line.windows(2).any(|w| at(&w[0], -10.0, 3.0, -5.0) && at(&w[1], 0.0, 3.0, -5.0)));
    assert!(line.windows(2).any(|w| at(&w[0], 50.0, 3.0, -5.0) && at(&w[1], 60.0, 3.0, -5.0)));
    let half = call("42,3,6,600,4,7");
    assert!(half.windows(2).any(|w| at(&w[0], 0.0, -15.0, -5.0) && at(&w[1], 0.0, -3.0, -5.0)));
    assert!(half.iter().any(|p| at(p, 50.0, -10.0, -5.0) && p.feed == 600.0));
    let space = call("41,12,6");
    assert!(space.windows(2).any(|w| at(&w[0], -6.0, 9.0, 2.0) && at(&w[1], 0.0, 3.0, -5.0)));
    let plain = call("40,2,6");
    assert!(
        plain.iter().any(|p| at(p, 0.0, 0.0, -5.0)) && plain.iter().any(|p| at(p, 50.0, 0.0, -5.0))
    );
}

/// After the cycle everything but variables is as before it; incremental words count from its end.
#[test]
fn a_contour_changes_no_modes() {
    let text = "%_N_MAIN_MPF\nT1 D1 M6\nM3 F200\nG0 G90 X0 Y0 Z50\nCYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)\n\
        X7 Y8\nG91 X1 Z5\nM30\n%_N_L_SPF\nG1 F77 X10 Y0\nG91 X50\nG3 X10 Y10 CR=10\nM17\n";
    let pieces = sound(text);
    let [.., a, b] = &pieces[..] else { panic!() };
    assert!(near(a.to, [7.0, 8.0]) && a.z == 10.0 && a.arc.is_none());
    assert!(near(b.to, [8.0, 8.0]) && b.z == 15.0);
}

#[test]
fn contours_that_are_not_possible_are_refused() {
    let cases = [
        ("CYCLE72(\"NONE\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0\n", "missing-subprogram"),
        ("CYCLE72(\"A:B\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0\n", "missing-label"),
        ("CYCLE72(\"\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0\n", "bad-contour"),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0\n", "bad-contour"),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0 Y0\nTRANS X5\nX9\n", "bad-contour"),
        (
            "CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)",
            "G1 X0 Y0\nG18\nG2 X9 CR=9\n",
            "bad-contour",
        ),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)", "G1 X0 Y0\nG41 X9\nX20\n", "bad-contour"),
        (
            "CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)",
            "G1 X0 Y0\nX5\nG3 X7 CR=1\n",
            "tool-too-large",
        ),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,43)", "G1 X0 Y0\nX5\n", "missing-value"),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,15,41)", "G1 X0 Y0\nX5\n", "not-executed"),
        ("CYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,10011,41)", "G1 X0 Y0\nX5\n", "not-executed"),
        (
            "CYCLE72(\"L\",10,0,2,-5,1E-9,0,0,300,100,11,41)",
            "G1 X0 Y0\nX5\n",
            "unbalanced-brackets",
        ),
        ("CYCLE72(\"L\",10,0,2,-5,0.000000001,0,0,300,100,11,41)", "G1 X0 Y0\nX5\n", "not-applied"),
    ];
    for (call, contour, code) in cases {
        let text = format!(
            "%_N_MAIN_MPF\nT1 D1 M6\nM3 F200\nG0 X0 Y0 Z50\n{call}\nM30\n%_N_L_SPF\n{contour}M17\n"
        );
        let (_, found) = run(&text);
        assert_eq!(found.first().map(|(code, _)| *code), Some(code), "{text}");
    }
    // A mistake in the contour is reported in its own line, then that of the cycle.
    let text = "%_N_MAIN_MPF\nT1 D1 M6\nM3 F200\nCYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)\nM30\n\
        %_N_L_SPF\nG1 X0\nG1 X=)\nM17\n";
    let (_, found) = run(text);
    assert_eq!((found[0].1, found[1]), (8, ("bad-contour", 4)), "{found:?}");
    // An endless contour ends.
    let text = "%_N_MAIN_MPF\nT1 D1 M6\nM3 F200\nCYCLE72(\"L\",10,0,2,-5,9,0,0,300,100,11,41)\nM30\n\
        %_N_L_SPF\nG1 X0\nLOOP\nG91 X1\nENDLOOP\nM17\n";
    let (_, found) = run(text);
    assert_eq!(found.last().unwrap().0, "bad-contour", "{found:?}");
}
