//! Points of cutter locations, and the table of the points to measure.

use std::fmt::Write;
use trueaxis_cl::ClFile;
use trueaxis_geometry::Vec3;
use trueaxis_geometry::surface::{Candidates, SurfacePoint};

/// The points of cutter locations, without those in rapid; the tool axis shows the outer side.
pub(super) fn points_of(file: &ClFile, are_normals: bool) -> Candidates {
    let points = file.points().filter(|(_, p)| !p.rapid).map(|(line, p)| SurfacePoint {
        point_mm: Vec3::from(p.tip_mm),
        normal: Vec3::from(p.axis),
        axis: Vec3::from(p.axis),
        line,
    });
    Candidates::Points { points: points.collect(), are_normals }
}

/// The table that is measured: `deviation` is empty until then.
pub fn nominal_table(points: &[SurfacePoint]) -> String {
    let mut text = "# nominal contact points (mm) and outward unit normals in the workpiece frame; deviation: \
                    measured offset along the normal, um, positive outside\n\
                    point,x_mm,y_mm,z_mm,i,j,k,deviation_um\n"
        .to_owned();
    for (i, p) in points.iter().enumerate() {
        let (x, n) = (p.point_mm, p.normal);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{:.6},{:.6},{:.6},{:.9},{:.9},{:.9},",
            i + 1,
            x.x,
            x.y,
            x.z,
            n.x,
            n.y,
            n.z
        );
    }
    text
}
