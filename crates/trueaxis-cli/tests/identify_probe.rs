//! `trueaxis identify probe` as users call it, and with hits as users spoil them.

mod command;

use command::{Folder, trueaxis};

const STUDY: &str = "examples/05_identify/ring-60.toml";

/// Spindle positions of 60 hits within a ring of 62 mm about (10, 20), ball of 4 mm, three lobes;
/// `row` may change a line (angle in deg, x, y) or leave it out.
fn ring(heading: &str, row: impl Fn(usize, f64, f64, f64) -> Option<String>) -> String {
    let mut text = heading.to_owned() + "\n";
    for i in 0..60 {
        let angle = (6.0 * i as f64).to_radians();
        let noise = ((i * 7 % 11) as f64 - 5.0) * 2e-4;
        let reach = 29.0 + 0.02 + 0.01 * (3.0 * angle).cos() + noise;
        let (x, y) = (10.0 + reach * angle.cos(), 20.0 + reach * angle.sin());
        text.extend(row(i, 6.0 * i as f64, x, y).map(|line| line + "\n"));
    }
    text
}

const HEADING: &str = "angle_deg,x_mm,y_mm";

fn plain(_: usize, angle: f64, x: f64, y: f64) -> Option<String> {
    Some(format!("{angle},{x:.6},{y:.6}"))
}

fn study(more: &str) -> String {
    format!(
        "name = 'p'\n{more}\n[ring]\ndiameter = '62 mm'\ncentre = '10 20 mm'\n\
         [stylus.a]\nball_diameter = '4 mm'\nhits = ['h.csv']\n"
    )
}

#[test]
fn the_document_has_the_agreed_keys() {
    let folder = Folder::new("probe");
    let (page, table) = (folder.path("p.html"), folder.path("t.csv"));
    let arguments = ["identify", "probe", STUDY, "--format", "json", "--report", &page];
    let ran = trueaxis(&[&arguments[..], &["--table", &table]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = ran.json();
    assert_eq!(found["schema"], "trueaxis/identify-probe/1");
    let um = |key: &str| found[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert!(um("range_before_um") > 25.0 && um("range_before_um") < 35.0);
    assert!(um("range_after_um") < um("range_held_out_um") && um("range_held_out_um") < 8.0);
    assert!(found["offset_mm"].as_array().is_some_and(|o| o.len() == 2));
    assert!(found["harmonics"].as_array().is_some_and(|h| h.len() > 2));
    let table = std::fs::read_to_string(table).expect("a table");
    assert_eq!(table.lines().filter(|l| !l.starts_with('#')).count(), 61);
    // What a person has edited is not replaced.
    let edited = std::fs::read_to_string(&page).expect("a page") + "<!-- seen -->";
    std::fs::write(&page, edited).expect("written");
    let ran = trueaxis(&["identify", "probe", STUDY, "--table", &page]);
    assert!(ran.status == 2 && ran.err.contains("unwritable-file"), "{}", ran.err);
}

#[test]
fn raw_hits_are_corrected_onto_the_surface() {
    let folder = Folder::new("probe-correct");
    folder.file("h.csv", ring(HEADING, plain));
    let file = folder.file("s.toml", study(""));
    // The same probe in another ring at another place, of 40 mm: the hits come to lie on it.
    let mut raw = HEADING.to_owned() + "\n";
    for i in 0..7 {
        let angle = 0.3 + 0.8 * f64::from(i);
        let reach = 18.0 + 0.02 + 0.01 * (3.0 * angle).cos();
        let (x, y) = (200.0 + reach * angle.cos(), -50.0 + reach * angle.sin());
        raw += &format!("{},{x:.6},{y:.6}\n", angle.to_degrees());
    }
    let raw = folder.file("raw.csv", raw);
    let out = folder.path("out.csv");
    let ran = trueaxis(&["identify", "probe", &file, "--correct", &raw, "-o", &out]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let text = std::fs::read_to_string(out).expect("corrected hits");
    let mut lines = text.lines();
    assert!(lines.next().is_some_and(|l| l.starts_with("point_x_mm,point_y_mm")));
    for line in lines {
        let v: Vec<f64> = line.split(',').map(|f| f.parse().expect("a number")).collect();
        let radius = (v[0] - 200.0).hypot(v[1] + 50.0);
        assert!((radius - 20.0).abs() < 1e-3, "{radius}");
    }
    let up = folder.file("up.csv", "x_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,-1\n");
    let ran =
        trueaxis(&["identify", "probe", &file, "--correct", &up, "-o", &folder.path("u.csv")]);
    assert!(ran.status == 2 && ran.err.contains("[direction-beyond-calibration]"), "{}", ran.err);
    assert!(ran.err.contains("up.csv:2:"), "{}", ran.err);
    let bare = folder.file("bare.csv", "x_mm,y_mm\n0,0\n");
    let ran =
        trueaxis(&["identify", "probe", &file, "--correct", &bare, "-o", &folder.path("u.csv")]);
    assert!(ran.status == 2 && ran.err.contains("[missing-column]"), "{}", ran.err);
}

/// The hits are reported with `code`, at a line, with the words.
#[track_caller]
fn reported(name: &str, hits: &str, status: i32, code: &str, place: &str, words: &str) {
    let folder = Folder::new(&format!("probe-{name}"));
    folder.file("h.csv", hits);
    let file = folder.file("s.toml", study(""));
    let ran = trueaxis(&["identify", "probe", &file, "--format", "json"]);
    assert_eq!(ran.status, status, "{name}\n{}", ran.err);
    if status == 2 {
        assert!(ran.has_no_answer(), "{name}");
    }
    let block = ran.err.split("\n\n").find(|b| b.contains(&format!("[{code}]")));
    let block = block.unwrap_or_else(|| panic!("{name}: {code} is not reported:\n{}", ran.err));
    assert!(block.contains(words), "{name}: `{words}` is not in\n{block}");
    let colon = if place.is_empty() { "" } else { ":" };
    assert!(block.contains(&format!("h.csv{colon}{place}")), "{name}: not at {place}\n{block}");
}

#[test]
fn spoiled_positions_are_named_with_their_line() {
    let at = |k: usize, change: &dyn Fn(f64, f64, f64) -> String| {
        ring(HEADING, |i, a, x, y| if i == k { Some(change(a, x, y)) } else { plain(i, a, x, y) })
    };
    let all = |change: &dyn Fn(f64, f64, f64) -> String| {
        ring(HEADING, |_, a, x, y| Some(change(a, x, y)))
    };
    let far = |a: f64, x: f64, y: f64, by: f64| {
        let (s, c) = a.to_radians().sin_cos();
        format!("{a},{:.6},{:.6}", x + by * c, y + by * s)
    };
    let gap = ring(HEADING, |i, a, x, y| plain(i, a, x, y).filter(|_| !(20..30).contains(&i)));
    reported("gap", &gap, 2, "gap-in-directions", "22:", "no hit between 114.0 deg and 180.0 deg");
    let two = ring(HEADING, |i, a, x, y| plain(i, a, x, y).filter(|_| !(20..22).contains(&i)));
    reported("two", &two, 0, "gap-in-directions", "22:", "a gap of 18.0 deg");
    let outside = all(&|a, x, y| far(a, x, y, 4.0));
    reported("outside", &outside, 2, "wrong-side", "2:", "33.0");
    let one = at(10, &|a, x, y| far(a, x, y, 4.0));
    reported("one-outside", &one, 2, "wrong-side", "12:", "other side of the surface");
    let slip = at(10, &|a, x, y| far(a, x, y, -2.0));
    reported("slip", &slip, 2, "far-hit", "12:", "stands -1.9");
    let points = all(&|a, x, y| far(a, x, y, 2.0));
    reported("points", &points, 2, "wrong-reading", "2:", "reading = \"point\"");
    let turned = at(10, &|a, x, y| format!("{},{x},{y}", a + 12.0));
    reported("turned", &turned, 2, "direction-mismatch", "12:", "differ by 12.0 deg");
    let back = all(&|a, x, y| format!("{},{x},{y}", a + 180.0));
    reported("back", &back, 2, "wrong-side", "2:", "away from the surface");
    let from_y = all(&|a, x, y| format!("{},{x},{y}", a - 90.0));
    reported("from-y", &from_y, 2, "direction-mismatch", "2:", "from which axis");
    let nan = at(10, &|a, x, _| format!("{a},{x},NaN"));
    reported("nan", &nan, 2, "not-a-number", "12:", "`NaN` is not a finite number");
    let degrees = ring("angle_mm,x_mm,y_mm", plain);
    reported("unit", &degrees, 2, "wrong-unit", "1:1", "angle");
    let inches = ring("angle_deg,x_mm,y_mm", |_, a, x, y| {
        Some(format!("{a},{:.6},{:.6}", 10.0 + (x - 10.0) / 25.4, 20.0 + (y - 20.0) / 25.4))
    });
    reported("inches", &inches, 2, "wrong-unit", "2:", "x_in");
    let copies = ring(HEADING, |i, a, x, y| {
        plain(i, a, x, y).map(|l| if i == 10 { format!("{l}\n{l}") } else { l })
    });
    reported("copies", &copies, 0, "duplicate-row", "13:", "same as line 12");
    let few = ring(HEADING, |i, a, x, y| plain(i, a, x, y).filter(|_| i % 20 == 0));
    reported("few", &few, 2, "too-few-hits", "2:", "has 3 hits");
    let radians = ring(HEADING, |_, a, x, y| Some(format!("{},{x},{y}", a.to_radians())));
    reported("radians", &radians, 2, "direction-mismatch", "2:", "unit of their heading");
    let wild = at(10, &|a, x, y| far(a, x, y, 0.03));
    reported("wild", &wild, 0, "outlier", "12:", "off what its neighbours say");
    reported("heading", "a;b\n1;2\n", 2, "bad-separator", "1:1", "semicolons");
    reported("nothing", "", 2, "empty-table", "", "no row");
}

/// Hits that lie 0.05 mm nearer than those of a sound probe: it would trigger before it touches. What is stated without its
/// uncertainty is said to count as exact.
#[test]
fn a_probe_that_triggers_too_early_is_named() {
    let folder = Folder::new("probe-early");
    let told = |by: f64| {
        let row = |_: usize, a: f64, x: f64, y: f64| {
            let (s, c) = a.to_radians().sin_cos();
            Some(format!("{a},{:.6},{:.6}", x - by * c, y - by * s))
        };
        folder.file("h.csv", ring(HEADING, row));
        let file = folder.file("s.toml", study(""));
        let ran = trueaxis(&["identify", "probe", &file]);
        assert_eq!(ran.status, 0, "{}", ran.err);
        assert!(ran.err.contains("note[no-uncertainty]"), "{}", ran.err);
        ran.err.contains("the mean pre-travel is -30.00") && ran.err.contains("warning[wrong-size]")
    };
    assert!(told(0.05) && !told(0.0));
}

#[test]
fn swapped_x_and_y_are_seen_by_their_directions() {
    let folder = Folder::new("probe-swapped");
    folder.file(
        "h.csv",
        ring(HEADING, |_, a, x, y| Some(format!("{a},{:.6},{:.6}", y - 10.0, x + 10.0))),
    );
    let file = folder.file("s.toml", study(""));
    let ran = trueaxis(&["identify", "probe", &file]);
    assert!(ran.status == 2 && ran.err.contains("[swapped-columns]"), "{}", ran.err);
}

#[test]
fn spoiled_radii_are_named_with_their_line() {
    let rows = |heading: &str, row: &dyn Fn(usize, f64, f64) -> String| {
        ring(heading, |i, a, x, y| {
            let radius = (x - 10.0).hypot(y - 20.0) + 2.0;
            Some(row(i, a, radius))
        })
    };
    let heads = "angle_deg,radius_mm";
    let mixed = rows(heads, &|i, a, r| format!("{a},{}", if i % 30 == 7 { -r } else { r }));
    reported("mixed", &mixed, 2, "negative-radius", "9:", "is not positive");
    let swapped = rows(heads, &|_, a, r| format!("{r},{a}"));
    reported("swap", &swapped, 2, "swapped-columns", "1:1", "swapped?");
    let diameter = rows(heads, &|_, a, r| format!("{a},{}", 2.0 * r));
    reported("diameter", &diameter, 2, "wrong-size", "2:", "radius and diameter");
    let um = rows("angle_deg,radius_um", &|_, a, r| format!("{a},{r}"));
    reported("um", &um, 2, "wrong-unit", "2:", "unit in the heading");
    let radians = rows(heads, &|_, a, r| format!("{},{r}", a.to_radians()));
    reported("rad", &radians, 2, "gap-in-directions", "2:", "are the angles radians");
}

#[test]
fn studies_that_cannot_be_are_refused() {
    let folder = Folder::new("probe-studies");
    folder.file("h.csv", ring(HEADING, plain));
    folder.file("copy.csv", ring(HEADING, plain));
    folder.file("dial.csv", "angle_deg,reading_um\n0,1\n90,2\n");
    for (text, code) in [
        (study("").replace("[ring]", "[hole]"), "missing-gauge"),
        (study("").replace("62 mm", "62"), "missing-unit"),
        (study("").replace("4 mm", "64 mm"), "wrong-size"),
        (study("").replace("'10 20 mm'", "'10 20 30 mm'"), "bad-vector"),
        (study("").replace("['h.csv']", "['h.csv', 'h.csv']"), "duplicate-table"),
        (study("").replace("['h.csv']", "['h.csv', 'copy.csv']"), "duplicate-table"),
        (study("").replace("['h.csv']", "['no.csv']"), "unreadable-file"),
        (study("modle = 'spline'"), "unknown-key"),
        (study("model = 'linear'"), "unknown-word"),
        (study("most_harmonics = 1e9"), "bad-count"),
        (study("[eccentricity]\ntable = 'dial.csv'"), "too-few-hits"),
        (
            study(
                "xy_datum = { x_plus = '1 mm', x_minus = '2 mm', y_plus = '3 mm', y_minus = '1 mm' }",
            ),
            "wrong-side",
        ),
        (study("").replace("centre = ", "side = 'left'\ncentre = "), "unknown-word"),
        (study("").replace("hits = ", "reading = 'ball'\nhits = "), "unknown-word"),
    ] {
        let file = folder.file("s.toml", &text);
        let ran = trueaxis(&["identify", "probe", &file]);
        assert_eq!(ran.status, 2, "{text}\n{}", ran.err);
        assert!(ran.err.contains(&format!("[{code}]")), "{code}: {text}\n{}", ran.err);
    }
    let file = folder.file("s.toml", study("").replace("centre = '10 20 mm'\n", ""));
    let ran = trueaxis(&["identify", "probe", &file, "--format", "json"]);
    assert!(ran.status == 0 && ran.err.contains("[offset-unknown]"), "{}", ran.err);
    assert!(ran.json()["offset_mm"].is_null());
    let ran =
        trueaxis(&["identify", "probe", &file, "--stylus", "b", "--table", &folder.path("t.csv")]);
    assert!(ran.status == 2 && ran.err.contains("[unknown-stylus]"), "{}", ran.err);
}
