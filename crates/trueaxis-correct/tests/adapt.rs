//! Laws of paths moved onto probed blanks: of the nominal surface, of the field, and of the wall.

use std::f64::consts::TAU;
use trueaxis_cl::{ClFile, Reading};
use trueaxis_correct::compensate::adapt::{
    AdaptStudy, Bounds, Cutter, Field, FieldOptions, Follow, Inner, NominalSurface, PathAt,
    SurfacePoint, Wall, adapt, read_points,
};
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::NoTables;

fn point(at_mm: Vec3, normal: Vec3, deviation_mm: f64) -> SurfacePoint {
    SurfacePoint { line: 1, number: 1.0, at_mm, normal, deviation_mm, u_mm: None }
}

/// So many points along each side of a plane, about its zero; the form by their numbers.
fn plane(count: u32, pitch_mm: f64, form: &dyn Fn(f64, f64) -> f64) -> Vec<SurfacePoint> {
    let middle = 0.5 * f64::from(count - 1);
    let each = |k: u32| {
        let (i, j) = (f64::from(k % count), f64::from(k / count));
        let at_mm = Vec3::new((i - middle) * pitch_mm, (j - middle) * pitch_mm, 0.0);
        point(at_mm, Vec3::z(), form(i, j))
    };
    (0..count * count).map(each).collect()
}

/// A ball of 20 mm, the same ball 64 times as large and 64 times as small: the foot of a point goes with it.
#[test]
fn law_a_foot_scales_with_the_part() {
    let foot = |scale: f64, out: &Vec3| {
        let each = |k: u32| {
            let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 400.0;
            let (r, a) = ((1.0 - z * z).sqrt(), f64::from(k) * 2.399_963_23);
            let normal = Vec3::new(r * a.cos(), r * a.sin(), z);
            point(normal * (20.0 * scale), normal, 0.0)
        };
        let points: Vec<SurfacePoint> = (0..400).map(each).collect();
        NominalSurface::of(&points).foot(&(out * (24.0 * scale)))
    };
    let out =
        [Vec3::new(0.48, -0.6, 0.64), Vec3::new(0.6, 0.64, -0.48), Vec3::new(-0.36, 0.48, 0.8)];
    for out in out {
        let one = foot(1.0, &out);
        assert!((one.height_mm - 4.0).abs() < 2e-3, "{one:?}");
        for scale in [1.0 / 64.0, 64.0] {
            let other = foot(scale, &out);
            let apart = (other.at_mm / scale - one.at_mm).norm();
            let higher = other.height_mm / scale - one.height_mm;
            assert!(apart < 1e-5 && higher.abs() < 1e-6, "{scale}: {apart} {higher}");
        }
    }
}

/// The same readings, 1/32 mm and 8 mm apart: the form stays alike over as many distances of neighbours (3.8).
#[test]
fn law_the_length_of_the_form_scales_with_the_part() {
    let form = |i: f64, j: f64| 0.05 * (1.3 * i).cos() * (1.1 * j + 0.4).sin();
    let options = FieldOptions { noise_mm: 1e-3, length_mm: None, form_mm: None };
    let [small, large] = [0.03125, 8.0].map(|pitch_mm| {
        let field = Field::fit(&plane(7, pitch_mm, &form), &options).expect("a field");
        field.covariance.length_mm / pitch_mm
    });
    assert!((small - large).abs() < 1e-6 * large, "{small} {large}");
}

/// Standard uncertainty of a reading.
const NOISE_MM: f64 = 1e-3;

/// 40 × 3 readings on a strip of a cylinder, radius 30 mm, that is oval by 0.05 mm.
fn strip() -> Vec<SurfacePoint> {
    let each = |k: u32| {
        let angle = TAU * f64::from(k % 40) / 40.0;
        let z = 10.0 * (f64::from(k / 40) + 0.5) / 3.0;
        let normal = Vec3::new(angle.cos(), angle.sin(), 0.0);
        point(normal * 30.0 + Vec3::z() * z, normal, 0.05 * (2.0 * angle + 0.2 * z).cos())
    };
    (0..120).map(each).collect()
}

fn fitted(points: &[SurfacePoint]) -> Field {
    let options = FieldOptions { noise_mm: NOISE_MM, length_mm: Some(30.0), form_mm: Some(0.05) };
    Field::fit(points, &options).expect("a field")
}

/// Where a reading was taken, the field is more certain than that reading alone; far from all of them it knows
/// nothing of the form.
#[test]
fn law_the_field_is_certain_where_it_was_probed() {
    let points = strip();
    let field = fitted(&points);
    for p in &points {
        let u_mm = field.at(&p.at_mm, &p.normal).u_mm;
        assert!(u_mm < field.raised * NOISE_MM, "{u_mm} of {NOISE_MM}, raised by {}", field.raised);
    }
    let far = field.at(&Vec3::new(0.0, 0.0, 2000.0), &Vec3::x());
    assert!(far.u_mm > 0.0499 && far.form_mm.abs() < 1e-9, "{far:?}");
}

/// Of two wrong readings the worse counts for nearly nothing before the other is examined: as if it had stated its
/// own residual as its uncertainty.
#[test]
fn law_an_outlier_counts_as_if_it_were_so_uncertain() {
    let mut points = strip();
    points[50].deviation_mm += 0.09;
    points[62].deviation_mm -= 0.06;
    let both = fitted(&points).outliers;
    let indices: Vec<usize> = both.iter().map(|o| o.index).collect();
    assert_eq!(indices, [50, 62], "{both:?}");
    points[50].u_mm = Some(NOISE_MM.hypot(both[0].residual_mm));
    let other = fitted(&points).outliers;
    let indices: Vec<usize> = other.iter().map(|o| o.index).collect();
    assert_eq!(indices, [62], "{other:?}");
    assert!((both[1].residual_mm - other[0].residual_mm).abs() < 1e-9, "{both:?} {other:?}");
}

/// A layer of 0.15 mm off a plane wall of 0.25 mm that is as flat as can be, with a ball of 4 mm.
fn flat_study() -> AdaptStudy {
    let text = "machine = { name = 'm', chain = 'w b X Y Z t' }";
    let (machine, problems) = Machine::check("m.toml", text, &NoTables);
    let path = (0..13).map(|k| format!("GOTO/{},0,-0.15\n", 0.5 * f64::from(k) - 3.0));
    let path = format!("FEDRAT/100\n{}", path.collect::<String>());
    AdaptStudy {
        name: "a plane".to_owned(),
        machine: machine.unwrap_or_else(|| panic!("{problems:?}")),
        path: ClFile::read("plane.cls", path.into_bytes(), &Reading::default()).0,
        table: "plane.csv".to_owned(),
        points: plane(9, 1.0, &|_, _| 0.0),
        cutter: Cutter { radius_mm: 2.0, corner_mm: 2.0 },
        wall: Wall {
            layer_mm: 0.15,
            path_at: PathAt::Finished,
            thickness_mm: 0.25,
            u_thickness_mm: 0.01,
            least_mm: 0.05,
            inner: Inner::Follows,
        },
        noise_mm: 1e-3,
        length_mm: Some(5.0),
        follow: Follow::Normals,
        bounds: Bounds {
            shift_mm: 0.2,
            turn_rad: 0.0035,
            form_mm: 0.3,
            reach_mm: 3.0,
            air_mm: 1.0,
            gouge_mm: 0.005,
        },
        blank: None,
    }
}

/// The wall may be as thin as 0.25 − 0.15 − 2·0.01 = 0.08 mm (U, k = 2; the field adds less than 1 µm): a least wall of
/// 0.079 mm is kept, one of 0.081 mm is not.
#[test]
fn a_wall_is_thin_by_its_expanded_uncertainty() {
    for (least_mm, expected) in [(0.079, 0), (0.081, 13)] {
        let mut study = flat_study();
        study.wall.least_mm = least_mm;
        let (adaptation, problems) = adapt(&study);
        let findings = adaptation.unwrap_or_else(|| panic!("{problems:?}")).findings;
        let thin = findings.iter().filter(|f| f.code == "thin-wall");
        let places: usize = thin.map(|f| f.places).sum();
        assert_eq!(places, expected, "{least_mm}: {findings:?}");
    }
}

/// The rows of a table in any order: the same field to the last bit, also where its length is chosen on every so many of them.
#[test]
fn law_the_order_of_the_rows_does_not_matter() {
    let form = |i: f64, j: f64| 0.03 * (0.7 * i + 0.1 * i * i).cos() * (1.1 * j + 0.4).sin();
    let mut points = plane(19, 2.0, &form);
    for (k, p) in points.iter_mut().enumerate() {
        p.number = k as f64;
        p.deviation_mm += 2e-3 * (1e3 * (k as f64).sin()).sin();
    }
    points[77].deviation_mm += 0.2;
    let options = FieldOptions { noise_mm: 1e-3, length_mm: None, form_mm: None };
    let of = |points: &[SurfacePoint]| {
        let field = Field::fit(points, &options).expect("a field");
        let outliers: Vec<f64> = field.outliers.iter().map(|o| points[o.index].number).collect();
        let at = field.at(&Vec3::new(3.3, 4.1, 0.0), &Vec3::z());
        let mut z: Vec<(f64, f64)> =
            points.iter().map(|p| p.number).zip(field.left_out_z.iter().copied()).collect();
        z.sort_by(|a, b| a.0.total_cmp(&b.0));
        let surface = NominalSurface::of(points).foot(&Vec3::new(3.3, 4.1, 1.0));
        (field.covariance, outliers, at, z, surface)
    };
    let whole = of(&points);
    assert_eq!(whole.1, [77.0]);
    // 361 points; 7 and 100 have no divisor in common with them.
    for step in [7, 100] {
        let shuffled: Vec<SurfacePoint> = (0..361).map(|k| points[k * step % 361]).collect();
        assert!(of(&shuffled) == whole, "every {step}th");
    }
}

/// A table that was pasted twice is the table: its copies are named, and no point counts twice.
#[test]
fn law_copied_rows_count_once() {
    let rows: Vec<String> =
        (0..30).map(|k| format!("{k},{},{},0,0,0,1,{}.25\n", k % 6, k / 6, k * k % 11)).collect();
    let read = |rows: &[String]| {
        let head = "point,x_mm,y_mm,z_mm,i,j,k,deviation_um\n".to_owned();
        let mut problems = Diagnostics::new();
        let points = read_points("t.csv", &(head + &rows.concat()), &mut problems);
        let told: Vec<String> =
            problems.iter().map(|d| format!("{}:{}", d.code, d.place.line)).collect();
        let points = points.unwrap_or_default();
        (points.into_iter().map(|p| SurfacePoint { line: 0, ..p }).collect::<Vec<_>>(), told)
    };
    let (once, silent) = read(&rows);
    assert_eq!((once.len(), silent.len()), (30, 0));
    let (pasted, told) = read(&[&rows[..], &rows].concat());
    assert_eq!(pasted, once);
    assert_eq!(told, ["copied-rows:32", "copied-rows:33", "copied-rows:34", "copied-rows:0"]);
    let each_twice: Vec<String> = rows.iter().map(|r| r.repeat(2)).collect();
    assert_eq!(read(&each_twice).0, once);
    // Another number, another reading.
    let mut again = rows.clone();
    again.push(rows[3].replacen("3,", "103,", 1));
    assert_eq!((read(&again).0.len(), read(&again).1.len()), (31, 0));
    // Copies make no surface of too few points.
    assert!(
        read(&[&rows[..6], &rows[..6], &rows[..6]].concat())
            .1
            .iter()
            .any(|t| t.starts_with("too-few-points"))
    );
}

/// A path that cuts through is never good, whatever least wall is wanted.
#[test]
fn a_wall_that_is_cut_through_is_never_good() {
    for least_mm in [-1.0, 0.0, 0.01] {
        let mut study = flat_study();
        study.wall = Wall { thickness_mm: 0.12, u_thickness_mm: 0.0, least_mm, ..study.wall };
        let (adaptation, problems) = adapt(&study);
        let adaptation = adaptation.unwrap_or_else(|| panic!("{problems:?}"));
        assert!(adaptation.map.iter().any(|cell| cell.after.wall_mm <= 0.0));
        assert!(adaptation.findings.iter().any(|f| f.code == "thin-wall"), "least {least_mm} mm");
    }
}
