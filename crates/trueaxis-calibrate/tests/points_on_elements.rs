//! Points that lie on an element: the same element as another solver finds, the same errors as other instruments find,
//! whatever the frame, the order and the spacing of the points.

mod library;

use std::collections::BTreeMap;
use std::path::PathBuf;
use trueaxis_calibrate::identify::errors::{Identification, identify};
use trueaxis_calibrate::identify::records::{read_options, read_records};
use trueaxis_form::{Criterion, Known};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::{Files, Severity};
use trueaxis_measure::measure::virtual_campaign::{measure, read_virtual};
use trueaxis_measure::measure::{Campaign, Element, Readings, read_campaign};
use trueaxis_measure::unknowns::fit::fit;

fn machines() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../machines")
}

fn campaign_file() -> PathBuf {
    machines().join("points.toml")
}

/// A campaign with the readings of its one instrument, `own.csv`.
fn shelf(text: &str, table: &str) -> Files {
    let machine = "[machine]\nname = \"three axes\"\nchain = \"w b X Y Z t\"\n".to_owned();
    library::disk().with_texts([
        (campaign_file(), text.to_owned()),
        (machines().join("own.csv"), table.to_owned()),
        (machines().join("plain.toml"), machine),
    ])
}

/// The campaign with its readings, or what is wrong with them.
fn read(text: &str, table: &str) -> Result<(Campaign, Readings), Vec<(String, String)>> {
    let (campaign, mut problems) =
        read_campaign(&shelf(text, table), &campaign_file(), |_, _| Some(()));
    let readings = campaign.as_ref().and_then(|(c, ())| c.readings(&mut problems));
    match campaign.zip(readings) {
        Some(((campaign, ()), readings)) => Ok((campaign, readings)),
        None => {
            let errors = problems.iter().filter(|d| d.severity == Severity::Error);
            Err(errors.map(|d| (d.code.to_owned(), d.place.to_string())).collect())
        }
    }
}

/// The unknowns of a campaign and their standard uncertainties by the stated noise.
fn fitted(campaign: &Campaign, readings: &Readings) -> BTreeMap<String, (f64, f64)> {
    let design = campaign.design();
    let fit = fit(&design, readings, &[]).expect("a fit");
    let u = |k: usize| fit.covariance[(k, k)].max(0.0).sqrt();
    let seen = |k: &usize| fit.sight.is_seen[*k];
    let names = design.names();
    (0..names.len()).filter(seen).map(|k| (names[k].clone(), (fit.values[k], u(k)))).collect()
}

/// The readings of a campaign on its virtual machine.
fn virtual_readings(text: &str, seed: u64) -> (Campaign, Readings) {
    let (read, problems) = read_campaign(&shelf(text, ""), &campaign_file(), |root, campaign| {
        read_virtual(root, campaign, Some(seed))
    });
    let (campaign, real) = read.unwrap_or_else(|| panic!("{problems:?}\n{text}"));
    let readings = measure(&campaign, &real).expect("readings").readings;
    (campaign, readings)
}

fn identified(text: &str, table: &str) -> Identification {
    let (read, mut problems) =
        read_campaign(&shelf(text, table), &campaign_file(), |root, _| Some(read_options(root)));
    let (campaign, options) = read.unwrap_or_else(|| panic!("{problems:?}"));
    let records = read_records(&campaign, &mut problems).unwrap_or_else(|| panic!("{problems:?}"));
    let found = identify(&campaign, &options, &records, &mut problems);
    found.unwrap_or_else(|| panic!("{problems:?}"))
}

const DIRECTION: &str = "0.3 -0.5 0.8";

/// A campaign without unknown errors: points of an element in the space of three axes.
fn bare(element: Element) -> String {
    let kind = format!("{element:?}").to_lowercase();
    let radius = if element.is_round() { "radius = \"40 mm\"\n" } else { "" };
    format!(
        "name = \"bare\"\nmachine = \"plain.toml\"\n[instrument.own]\nkind = \"points-on-{kind}\"\n\
         direction = \"{DIRECTION}\"\n{radius}stylus = \"0 0 0 mm\"\n{} = \"5 -7 11 mm\"\n\
         noise = \"1 um\"\nreadings = \"own.csv\"\n",
        match element {
            Element::Circle | Element::Sphere => "centre",
            _ => "point",
        }
    )
}

fn direction() -> Vec3 {
    Vec3::new(0.3, -0.5, 0.8).normalize()
}

/// Points near an element that lies otherwise than stated by 0.4 mm, 1 mrad and 0.2 mm of the radius.
fn real_points(element: Element, count: usize, seed: u64) -> Vec<Vec3> {
    let mut random = SplitMix64::new(seed);
    let mut noise = move || 2e-3 * (random.unit() + random.unit() + random.unit() - 1.5);
    let n = (direction() + Vec3::new(1e-3, 0.7e-3, -0.4e-3)).normalize();
    let origin = Vec3::new(5.3, -7.2, 11.1);
    let points = element.points_mm(count, n, 40.2, [90.0, 60.0]);
    points.iter().map(|d| origin + d + Vec3::new(noise(), noise(), noise())).collect()
}

fn table(points: &[Vec3]) -> String {
    let rows = points.iter().map(|p| format!("{},{},{}\n", p.x, p.y, p.z));
    format!("X,Y,Z\n{}", rows.collect::<String>())
}

/// Where the element lies that a fit has found: point, direction, radius.
fn lies(campaign: &Campaign, found: &BTreeMap<String, (f64, f64)>) -> (Vec3, Vec3, f64) {
    let own = &campaign.instruments[0];
    let value = |name: &str| found.get(&format!("own.{name}")).map_or(0.0, |v| v.0);
    // e₁ and e₂ of the largest component of the direction, Z: X and Y without their parts along it.
    let n = own.direction;
    let first = (Vec3::x() - n * n.x).normalize();
    let second = n.cross(&first);
    let at = own.reference_point_mm
        + Vec3::new(value("centre_x"), value("centre_y"), value("centre_z"))
        + first * value("shift_1")
        + second * value("shift_2")
        + n * value("shift_n");
    let tilt = first * value("tilt_1") + second * value("tilt_2");
    let turned = match tilt.norm() {
        0.0 => n,
        // Rodrigues: the tilt is across n.
        angle => n * angle.cos() + tilt.cross(&n) * (angle.sin() / angle),
    };
    (at, turned, own.length_mm + value("radius"))
}

#[test]
fn oracle_without_unknown_errors_it_is_the_element_of_least_squares_of_form() {
    for element in Element::ALL {
        let points = real_points(element, 40, 3);
        let (mut campaign, readings) = read(&bare(element), &table(&points)).expect("a campaign");
        let first = lies(&campaign, &fitted(&campaign, &readings));
        // The chord method has the slopes of the stated element, 0.4 mm beside this one: 1 % of the noise. With those
        // of the element that was found it is least squares to rounding.
        let own = &mut campaign.instruments[0];
        (own.reference_point_mm, own.direction, own.length_mm) = first;
        let (at, turned, radius) = lies(&campaign, &fitted(&campaign, &readings));
        let moved = (at - first.0).norm() + (radius - first.2).abs();
        assert!(moved < 5e-6, "{element:?}: {moved:e} mm");
        let other = match element {
            Element::Plane => trueaxis_form::Element::Plane,
            Element::Line => trueaxis_form::Element::Line,
            Element::Circle => trueaxis_form::Element::Circle,
            Element::Sphere => trueaxis_form::Element::Sphere,
            Element::Cylinder => trueaxis_form::Element::Cylinder,
        };
        let form = trueaxis_form::fit(other, &points, &Known::default()).expect("an element");
        let shape = form.reference(Criterion::LeastSquares).expect("least squares").shape;
        let between = at - shape.point_mm;
        let n = shape.direction;
        let off = match element {
            Element::Circle | Element::Sphere => between.norm(),
            Element::Plane => between.dot(&n).abs(),
            Element::Line | Element::Cylinder => between.cross(&n).norm(),
        };
        assert!(off < 1e-9, "{element:?}: {off:e} mm");
        assert!((radius - if element.is_round() { shape.radius_mm } else { 0.0 }).abs() < 1e-9);
        if element != Element::Sphere {
            assert!(turned.cross(&n).norm() < 1e-9, "{element:?}: {turned} {n}");
        }
    }
}

#[test]
fn law_frame_and_order_of_measured_points_do_not_matter() {
    // 30° about (1, −1, 0.2), and 1 m away: the form of the points is all that counts.
    let axis = nalgebra::Unit::new_normalize(Vec3::new(1.0, -1.0, 0.2));
    let turn = nalgebra::Rotation3::from_axis_angle(&axis, 0.52);
    let far = nalgebra::Rotation3::from_axis_angle(&axis, 2.9);
    let shift = Vec3::new(1000.0, -300.0, 50.0);
    for element in [Element::Plane, Element::Circle, Element::Sphere, Element::Cylinder] {
        // Where the axes stood, and where the points were: 3 µm away.
        let stood = real_points(element, 25, 5);
        let were: Vec<Vec3> =
            stood.iter().zip(real_points(element, 25, 6)).map(|(_, p)| p).collect();
        let rows = |seen: &dyn Fn(&Vec3) -> Vec3, order: &[usize], unit: (&str, f64)| {
            let mut text = format!("X,Y,Z,x_{0},y_{0},z_{0}\n", unit.0);
            for k in order {
                let (c, p) = (stood[*k], seen(&were[*k]) * unit.1);
                text += &format!("{},{},{},{},{},{}\n", c.x, c.y, c.z, p.x, p.y, p.z);
            }
            text
        };
        let order: Vec<usize> = (0..25).collect();
        let turned: Vec<usize> = (0..25).rev().collect();
        let tables = [
            rows(&|p| *p, &order, ("mm", 1.0)),
            rows(&|p| turn * p + shift, &order, ("mm", 1.0)),
            rows(&|p| far * (p - shift), &turned, ("um", 1e3)),
        ];
        let found = tables.map(|table| {
            let (campaign, readings) = read(&bare(element), &table).expect("a campaign");
            fitted(&campaign, &readings)
        });
        assert!(!found[0].is_empty());
        for other in &found[1..] {
            assert_eq!(other.len(), found[0].len(), "{element:?}");
            for (name, (x, u)) in &found[0] {
                let (y, w) = other[name];
                assert!(
                    (x - y).abs() < 1e-9 && (u / w - 1.0).abs() < 1e-6,
                    "{element:?} {name}: {x:e} {y:e}"
                );
            }
        }
    }
}

/// A ring or another artefact on the table of the Lei-Hsu mill, touched at turned poses.
fn on_mill(kind: &str, keys: &str, path: &str) -> String {
    format!(
        "name = \"mill\"\nmachine = \"lei-hsu-mill/machine.toml\"\n\
         [unknown]\nlocation = [\"EX0C\", \"EY0C\", \"EA0C\", \"EB0C\", \"EY0A\", \"EZ0A\", \"EB0A\", \"EC0A\"]\n\
         [truth.errors]\nEX0C = \"31 um\"\nEY0C = \"-22 um\"\nEA0C = \"40 urad\"\nEB0C = \"-55 urad\"\n\
         EY0A = \"17 um\"\nEZ0A = \"-12 um\"\nEB0A = \"33 urad\"\nEC0A = \"-28 urad\"\n\
         [instrument.own]\nkind = \"{kind}\"\nnoise = \"1 um\"\nreadings = \"own.csv\"\n{keys}\n\
         [[path]]\n{path}\nA = [\"-60 deg\", \"60 deg\", 4]\nC = [\"-120 deg\", \"150 deg\", 4]\n"
    )
}

const TRUE: [(&str, f64); 8] = [
    ("EX0C", 31e-3),
    ("EY0C", -22e-3),
    ("EA0C", 40e-6),
    ("EB0C", -55e-6),
    ("EY0A", 17e-3),
    ("EZ0A", -12e-3),
    ("EB0A", 33e-6),
    ("EC0A", -28e-6),
];

/// An element on the mill whose set-up is off, too.
fn element_on_mill(element: Element, points: usize) -> String {
    let (place, off, tilt) = match element {
        Element::Plane => ("point", "shift_n = \"0.2 mm\"", true),
        Element::Line | Element::Cylinder => {
            ("point", "shift_1 = \"0.2 mm\", shift_2 = \"-0.1 mm\"", true)
        }
        Element::Circle => ("centre", "centre_x = \"0.2 mm\", centre_z = \"-0.1 mm\"", true),
        Element::Sphere => ("centre", "centre_x = \"0.2 mm\", centre_z = \"-0.1 mm\"", false),
    };
    let round = element.is_round();
    let radius = if round { "radius = \"40 mm\"" } else { "" };
    let tilts = if tilt { ", tilt_1 = \"0.8 mrad\", tilt_2 = \"-0.5 mrad\"" } else { "" };
    let larger = if round { ", radius = \"0.05 mm\"" } else { "" };
    let kind = format!("{element:?}").to_lowercase();
    let keys = format!(
        "direction = \"0 0 1\"\n{radius}\n{place} = \"10 20 5 mm\"\n\
         [truth.setup]\n# as it stands\nown = {{ {off}{tilts}{larger} }}"
    );
    on_mill(&format!("points-on-{kind}"), &keys, &format!("kind = \"element\"\npoints = {points}"))
}

#[test]
fn law_the_errors_of_the_machine_are_within_their_uncertainty() {
    for element in Element::ALL {
        let text = element_on_mill(element, 8);
        let (mut within, mut all, mut seen) = (0, 0, std::collections::BTreeSet::new());
        for seed in 1..=200 {
            let (campaign, readings) = virtual_readings(&text, seed);
            let found = fitted(&campaign, &readings);
            for (name, due) in TRUE {
                // What rests on the length of the tool, 50 µm, is known by that and not by the points.
                let Some((value, u)) = found.get(name).filter(|v| v.1 < 5e-3) else { continue };
                all += 1;
                within += usize::from((value - due).abs() <= 2.0 * u);
                seen.insert(name);
            }
        }
        let share = within as f64 / f64::from(all.max(1));
        assert!(seen.len() >= 5, "{element:?}: {seen:?}");
        assert!((0.93..=0.97).contains(&share), "{element:?}: {share} of {all}");
    }
}

/// Nothing at random: what does not matter changes nothing.
#[test]
fn law_spacing_order_and_number_of_points_do_not_matter_without_noise() {
    for element in Element::ALL {
        let values = [5, 9, 14].map(|points| {
            // Across a tilted face errors that no reading sees would be seen by 0.8 µm/mm: 0.02 µm.
            let text = element_on_mill(element, points).replace("mrad", "urad");
            let text = text + "[disturb]\nnoise = 0\n";
            let (campaign, mut readings) = virtual_readings(&text, 1);
            if points == 9 {
                // The other way round.
                let mut turned = Readings::default();
                (0..readings.len()).rev().for_each(|i| turned.push(readings.row(i)));
                readings = turned;
            }
            fitted(&campaign, &readings)
        });
        for found in &values {
            for (name, due) in TRUE {
                let Some((value, u)) = found.get(name) else { continue };
                assert!((value - due).abs() < 1e-3 * u, "{element:?} {name}: {value:e}");
            }
            assert_eq!(found.len(), values[0].len(), "{element:?}");
        }
    }
}

#[test]
fn law_slopes_are_those_of_the_readings() {
    for element in Element::ALL {
        let (campaign, readings) = virtual_readings(&element_on_mill(element, 6), 1);
        let design = campaign.design();
        let n = design.unknowns();
        let mut slopes = vec![0.0; 3 * n];
        for i in (0..readings.len()).step_by(7) {
            let channels = design.slopes(&readings, i, &mut slopes);
            for k in 0..n {
                let at = |step: f64| {
                    let mut values = vec![0.0; n];
                    values[k] = step;
                    design.read(&readings, i, &values).expect("within the tables")
                };
                let (more, less) = (at(1e-5), at(-1e-5));
                for c in 0..channels {
                    let slope = (more[c] - less[c]) / 2e-5;
                    let due = slopes[c * n + k];
                    // The machine of the file is off the nominal one by up to 100 µrad.
                    let angle = design.unknown(k).is_some_and(|u| u.is_angle());
                    let size = due.abs().max(if angle { 100.0 } else { 1.0 });
                    assert!(
                        (slope - due).abs() < 1e-3 * size,
                        "{element:?} {} {c}: {slope} {due}",
                        design.names()[k]
                    );
                }
            }
        }
    }
}

/// A bar of one length about a joint is a sphere.
#[test]
fn law_a_sphere_of_known_radius_is_a_ball_bar() {
    for (bar, sphere) in
        [("length = \"free\"", "radius = \"free\""), ("length = \"0.5 um\"", "radius = \"0.5 um\"")]
    {
        let path = "kind = \"grid\"";
        let bar = on_mill(
            "ball-bar",
            &format!(
                "length = \"60 mm\"\ntable_ball = \"10 20 5 mm\"\nspindle_ball = \"0 0 -330 mm\"\nunknown = {{ table_ball = \"free\", {bar}, spindle_ball = \"2 um\" }}"
            ),
            path,
        );
        let sphere = on_mill(
            "points-on-sphere",
            &format!(
                "radius = \"60 mm\"\ncentre = \"10 20 5 mm\"\nstylus = \"0 0 -330 mm\"\nunknown = {{ centre = \"free\", {sphere}, stylus = \"2 um\" }}"
            ),
            "kind = \"element\"",
        );
        let (campaign, readings) = virtual_readings(&bar, 4);
        let machine = &campaign.machine;
        let table = readings.table(machine, &campaign.instruments[0], 0);
        // The same numbers as deviations from the radius.
        let mut rows = table.lines();
        let heads = rows.next().expect("heads").replace("length_mm", "deviation_um");
        let column = heads.split(',').position(|h| h == "deviation_um").expect("it is there");
        let changed = rows.map(|row| {
            let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
            let length: f64 = cells[column].parse().expect("a number");
            cells[column] = format!("{:e}", (length - 60.0) * 1e3);
            cells.join(",")
        });
        let changed = format!("{heads}\n{}\n", changed.collect::<Vec<_>>().join("\n"));
        let one = fitted(&campaign, &readings);
        let (campaign, readings) = read(&sphere, &changed).expect("a campaign");
        let two = fitted(&campaign, &readings);
        for (name, (x, u)) in &one {
            let sign = if name == "own.length" { -1.0 } else { 1.0 };
            let other = name.replace("table_ball", "centre").replace("spindle_ball", "stylus");
            let other = other.replace("own.length", "own.radius");
            let (y, w) = two[&other];
            // A longer bar reads more; on a larger sphere a point is less far out.
            assert!(
                (sign * x - y).abs() < 1e-6 * u && (u / w - 1.0).abs() < 1e-6,
                "{name}: {x:e} {y:e}"
            );
        }
    }
}

#[test]
fn law_a_known_radius_adds_knowledge() {
    let stated = element_on_mill(Element::Circle, 8);
    let known = |u: &str| {
        stated.replace("centre = ", &format!("unknown = {{ centre = \"free\", tilt = \"free\", radius = \"{u}\", stylus = \"2 um\" }}\ncentre = "))
    };
    let of = |text: &str| {
        let (campaign, readings) = virtual_readings(text, 3);
        fitted(&campaign, &readings)
    };
    let (unknown, vague, exact) = (
        of(&known("free")),
        of(&known("3 mm")),
        of(&known("0.1 um").replace(", radius = \"0.05 mm\"", "")),
    );
    for (name, due) in TRUE {
        let (Some(a), Some(b), Some(c)) = (unknown.get(name), vague.get(name), exact.get(name))
        else {
            continue;
        };
        assert!((a.1 / b.1 - 1.0).abs() < 1e-3 && c.1 <= a.1 * 1.0001, "{name}: {a:?} {b:?} {c:?}");
        assert!((c.0 - due).abs() < 4.0 * c.1, "{name}: {c:?}");
    }
}

#[test]
fn what_is_read_is_identified_with_the_verdict_that_it_fits() {
    let text = element_on_mill(Element::Circle, 8);
    let (campaign, readings) = virtual_readings(&text, 9);
    let table = readings.table(&campaign.machine, &campaign.instruments[0], 0);
    assert!(table.lines().next().is_some_and(|heads| heads.contains("radial_um,axial_um")));
    let found = identified(&text, &table);
    for (name, due) in TRUE {
        let (value, u) =
            found.found.iter().find(|f| f.name == name).and_then(|f| f.value).expect(name);
        assert!((value - due).abs() < 4.0 * u, "{name}: {value:e} ± {u:e}");
    }
}

#[test]
fn points_that_cannot_be_read_are_named() {
    let codes = |element: Element, table: &str| match read(&bare(element), table) {
        Ok(_) => Vec::new(),
        Err(problems) => problems,
    };
    let circle = real_points(Element::Circle, 12, 1);
    let with = |rows: &dyn Fn(usize) -> Vec3| {
        let row = |(k, c): (usize, &Vec3)| {
            let p = rows(k);
            format!("{},{},{},{},{},{}\n", c.x, c.y, c.z, p.x, p.y, p.z)
        };
        let rows: String = circle.iter().enumerate().map(row).collect();
        format!("X,Y,Z,x_mm,y_mm,z_mm\n{rows}")
    };
    let as_they_are = with(&|k| circle[k]);
    assert!(read(&bare(Element::Circle), &as_they_are).is_ok());
    let first = |table: &str, element| codes(element, table).first().cloned().unwrap_or_default();
    // The fifth point is 80 mm off: line 6 of the file.
    let far = with(&|k| circle[k] + Vec3::new(if k == 4 { 80.0 } else { 0.0 }, 0.0, 0.0));
    let (code, place) = first(&far, Element::Circle);
    assert!(code == "far-from-points" && place.ends_with(":6:1"), "{code} {place}");
    assert_eq!(first(&as_they_are, Element::Line).0, "frame-not-seen");
    let on_a_line = with(&|k| Vec3::new(k as f64, 0.0, 0.0));
    assert_eq!(first(&on_a_line, Element::Circle).0, "frame-not-seen");
    assert_eq!(first(&as_they_are.replace(",z_mm", ",other"), Element::Circle).0, "missing-column");
    assert_eq!(first(&as_they_are.replace("z_mm", "z_inch_"), Element::Circle).0, "missing-column");
    assert_eq!(first(&as_they_are.replace("z_mm", "z_urad"), Element::Circle).0, "wrong-unit");
    let both = as_they_are.replace("X,Y,Z,", "radial_um,axial_um,Z,");
    assert_eq!(first(&both, Element::Circle).0, "place-twice");
    let radial = as_they_are.replace("x_mm,y_mm,z_mm", "radial_um,a,b");
    assert_eq!(first(&radial, Element::Circle).0, "missing-column");
    for (from, to) in [
        ("radius = \"40 mm\"\n", ""),
        ("radius = \"40 mm\"", "radius = \"0 mm\""),
        ("direction", "# direction"),
    ] {
        let text = bare(Element::Circle).replace(from, to);
        let problems = read(&text, &as_they_are).expect_err("incomplete");
        assert_eq!(problems[0].0, "missing-key", "{from}");
    }
}
