//! The tip of a tool that is tilted by 30° about x: `cargo run -p trueaxis-geometry --example tilted_tool`.
#![allow(clippy::print_stdout)]

use trueaxis_geometry::Vec3;
use trueaxis_geometry::frame::{Direction, Point, Pose, Tool, Workpiece};

fn main() {
    // The pivot is 150 mm above part zero; the tool is tilted about x at the pivot.
    let lift = Pose::<Workpiece, Tool>::shift(Vec3::new(0.0, 0.0, 150.0));
    let tilt = Pose::<Tool, Tool>::turn(Vec3::x(), 30_f64.to_radians());
    let workpiece_from_tool = lift * tilt;

    // A tool of 100 mm: by hand, the tip is at y = 100 · sin 30° = 50 mm and
    // z = 150 − 100 · cos 30° = 63.397 mm.
    let tip = workpiece_from_tool * Point::<Tool>::new(0.0, 0.0, -100.0);
    println!("tip: y = {:.3} mm, z = {:.3} mm", tip.vector().y, tip.vector().z);

    // The tool axis points from the tip to the spindle: (0, −0.5, 0.866).
    let axis = workpiece_from_tool * Direction::<Tool>::Z;
    println!("tool axis: y = {:.3}, z = {:.3}", axis.vector().y, axis.vector().z);

    // Adding the point of one frame to that of another does not compile; the inverse pose leads back.
    let back = workpiece_from_tool.inverse() * tip;
    println!("tip in the tool frame: z = {:.3} mm", back.vector().z);
}
