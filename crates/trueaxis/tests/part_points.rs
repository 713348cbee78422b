//! Points of a measured part: what stands between the centre of a stylus and the nominal surface.

use std::fmt::Write as _;
use std::path::Path;
use trueaxis::files::disk;
use trueaxis::geometry::Vec3;
use trueaxis::verify::part::{Measurements, read_part};

/// On the step of a cutting condition the surface stands out by its allowance, and the centre of a ball by its radius
/// more: both are subtracted along the normal, and the points lie on the nominal cone.
#[test]
fn law_stylus_and_allowance_are_both_subtracted() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testpieces");
    let (sin, cos) = 15_f64.to_radians().sin_cos();
    for (condition, allowance_mm) in
        [("condition 1", 0.0), ("condition 2", 0.5), ("condition 4", 1.5)]
    {
        let mut nominal = Vec::new();
        let mut table = "section,x_mm,y_mm,z_mm\n".to_owned();
        for (section, height) in [0.0, 25.0, 50.0, 60.0].into_iter().enumerate() {
            for k in 0..24 {
                let (s, c) = (15.0 * f64::from(k)).to_radians().sin_cos();
                let radius = 125.0 - height * sin / cos;
                let point = Vec3::new(radius * c, radius * s, height - 60.0);
                let seen = point + Vec3::new(cos * c, cos * s, sin) * (1.5 + allowance_mm);
                let _ = writeln!(table, "{},{},{},{}", section + 1, seen.x, seen.y, seen.z);
                nominal.push(point);
            }
        }
        let text = format!(
            "name = \"part\"\ntest_piece = \"nas979-gbt33150.toml\"\n[cmm]\npoints = \"points.csv\"\n\
             point_u = \"0.7 um\"\nprobe = \"centres\"\nstylus_diameter = \"3 mm\"\n\
             condition = \"{condition}\"\n"
        );
        let path = folder.join("part.toml");
        let texts = [(path.clone(), text), (folder.join("points.csv"), table)];
        let (study, problems) = read_part(&disk().with_texts(texts), &path);
        let study = study.unwrap_or_else(|| panic!("{condition}: {:?}", problems.sorted()));
        let Measurements::Points(points) = &study.measured else { panic!("points") };
        assert_eq!(points.parts[0].points.len(), nominal.len());
        for (point, nominal) in points.parts[0].points.iter().zip(&nominal) {
            let off = (point.place_mm - nominal).norm();
            assert!(off < 1e-9, "{condition}: {off} mm");
        }
    }
}
