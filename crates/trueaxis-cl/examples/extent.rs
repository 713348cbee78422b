//! Reads a cutter-location file in inches and prints the range of its points and the length of the path:
//! `cargo run -p trueaxis-cl --example extent`.
#![allow(clippy::print_stdout)]

use trueaxis_cl::{ClFile, Reading};

const PATH: &str = "\
UNITS/INCHES
MULTAX/ON
FEDRAT/10,IPM
GOTO/0,0,1,0,0,1
GOTO/3,0,1,0,0,1
GOTO/3,4,1,0,0.6,0.8
FINI
";

fn main() {
    let (file, problems) = ClFile::read("demo.cls", PATH.into(), &Reading::default());
    for problem in problems.iter() {
        println!("{problem}");
    }
    // By hand: 3 in = 76.2 mm, 4 in = 101.6 mm, and the axis (0, 0.6, 0.8) is tilted by 36.87°.
    if let Some(extent) = file.extent() {
        let [x, y, _] = extent.max_mm;
        let tilt = extent.tilt_rad.to_degrees();
        println!("{} points, up to X{x:.1} Y{y:.1} mm, tilt {tilt:.2} deg", extent.points);
    }

    // The path is 76.2 + 101.6 = 177.8 mm long; 10 in/min = 254 mm/min, so that it takes 42 s.
    let points: Vec<_> = file.points().map(|(_, point)| point).collect();
    let length_mm: f64 = points
        .windows(2)
        .map(|w| (0..3).map(|i| (w[1].tip_mm[i] - w[0].tip_mm[i]).powi(2)).sum::<f64>().sqrt())
        .sum();
    let feed = points.last().and_then(|p| p.feed).map_or(f64::NAN, |f| f.value);
    println!("length {length_mm:.1} mm, {:.1} s", 60.0 * length_mm / feed);
}
