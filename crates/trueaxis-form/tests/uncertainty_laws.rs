//! Uncertainties against random draws, filters and gross points.

use std::f64::consts::TAU;
use trueaxis_form::{Criterion, Element, Fitted, Known, Source, checks, fit, fit_by};
use trueaxis_geometry::Vec3;
use trueaxis_geometry::statistics::SplitMix64;

fn normal(random: &mut SplitMix64) -> f64 {
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (TAU * random.unit()).cos()
}

/// Points of an element without noise, with a form deviation of this size, and their outward normals.
fn ideal(element: Element, form: f64, count: u32) -> Vec<Vec3> {
    (0..count)
        .map(|i| {
            let t = f64::from(i) / f64::from(count);
            let a = TAU * t * 6.17 + 0.3;
            let e = form * (3.0 * a).cos();
            let h = 40.0 * (t - 0.5);
            match element {
                Element::Line => Vec3::new(100.0 * (t - 0.5), 0.0, e),
                Element::Plane => {
                    let (x, y) = (t * 7.0, (t * 7.0).fract());
                    Vec3::new(10.0 * x, 60.0 * y, form * (x + 5.0 * y).sin())
                }
                Element::Circle => Vec3::new((20.0 + e) * a.cos(), (20.0 + e) * a.sin(), 5.0),
                Element::Sphere => {
                    let z = 1.9 * t - 0.95;
                    let r = (1.0 - z * z).sqrt();
                    Vec3::new(r * a.cos(), r * a.sin(), z) * (25.0 + e)
                }
                Element::Cylinder => Vec3::new((15.0 + e) * a.cos(), (15.0 + e) * a.sin(), h),
                Element::Cone => {
                    let r = 30.0 + 0.25 * h + e;
                    Vec3::new(r * a.cos(), r * a.sin(), h)
                }
            }
        })
        .collect()
}

fn known(element: Element) -> Known {
    Known { normal: (element == Element::Line).then(Vec3::y), ..Known::default() }
}

fn noisy(points: &[Vec3], u: f64, random: &mut SplitMix64) -> Vec<Vec3> {
    points
        .iter()
        .map(|p| p + Vec3::new(normal(random), normal(random), normal(random)) * u)
        .collect()
}

/// Values of an element with their truth: position across, direction across, radius, half angle.
fn values(element: Element, f: &Fitted) -> Vec<(usize, f64)> {
    let s = f.shape();
    let truth = match element {
        Element::Cylinder => 15.0,
        Element::Sphere => 25.0,
        Element::Circle => 20.0,
        _ => 0.0,
    };
    match element {
        Element::Line => vec![(2, s.direction.z)],
        Element::Plane => vec![(3, s.direction.x), (4, s.direction.y)],
        Element::Circle => {
            vec![
                (0, s.point_mm.x),
                (2, s.point_mm.z - 5.0),
                (3, s.direction.x),
                (6, s.radius_mm - truth),
            ]
        }
        Element::Sphere => vec![(0, s.point_mm.x), (2, s.point_mm.z), (6, s.radius_mm - truth)],
        Element::Cylinder => {
            vec![(0, s.point_mm.x), (1, s.point_mm.y), (3, s.direction.x), (6, s.radius_mm - truth)]
        }
        Element::Cone => vec![
            (0, s.point_mm.x),
            (4, s.direction.y),
            (7, s.half_angle_rad - 0.25_f64.atan()),
            (6, s.radius_mm - 30.0 - 0.25 * s.point_mm.z),
        ],
    }
}

/// The share of draws whose U covers the truth, for each value.
fn coverage(element: Element, stated: Option<f64>, draws: u32, count: u32) -> Vec<f64> {
    let points = ideal(element, 0.0, count);
    let mut random = SplitMix64::new(17);
    let u = 0.002;
    let mut covered: Vec<f64> = Vec::new();
    for _ in 0..draws {
        let f = fit_by(element, &noisy(&points, u, &mut random), &known(element), &[]).unwrap();
        let found = f.uncertainty(stated).unwrap();
        let all = [&found.point_mm[..], &found.direction, &[found.radius_mm, found.half_angle_rad]];
        let all = all.concat();
        let values = values(element, &f);
        covered.resize(values.len(), 0.0);
        for (c, (k, error)) in covered.iter_mut().zip(values) {
            // A line has its slope in place of its third coordinate.
            let k = if element == Element::Line { 5 } else { k };
            let of = match element {
                Element::Circle if (2..6).contains(&k) => found.of_axial.unwrap(),
                _ => found.of_point,
            };
            *c += f64::from(u8::from(error.abs() <= of.coverage * all[k])) / f64::from(draws);
        }
    }
    covered
}

fn every_value_is_covered(draws: u32, within: std::ops::Range<f64>) {
    for element in Element::ALL {
        for (stated, count) in [(Some(0.002), 40), (None, 40), (None, 12)] {
            for share in coverage(element, stated, draws, count) {
                assert!(within.contains(&share), "{element:?} {stated:?} {count}: {share}");
            }
        }
    }
}

#[test]
fn law_u_of_every_value_covers_95_percent_of_random_draws() {
    // 95.45 %, four standard deviations of a share of 150 draws down.
    every_value_is_covered(150, 0.88..1.0);
}

/// `cargo nextest run -p trueaxis-form --run-ignored only -E 'test(thousands)'` (1 min): 95.45 ± 1.5 %.
#[test]
#[ignore = "a minute"]
fn law_u_of_every_value_covers_95_percent_of_thousands_of_draws() {
    every_value_is_covered(3000, 0.94..0.97);
}

/// The share of draws whose U covers the form deviation without noise, at least over all elements: by least squares and
/// the minimum zone, and by the circumscribed and inscribed element.
fn least_coverage_of_form(draws: u32) -> [f64; 2] {
    let mut least = [1.0_f64; 2];
    for element in Element::ALL {
        let points = ideal(element, 0.02, 60);
        let truth = fit(element, &points, &known(element)).unwrap();
        let mut random = SplitMix64::new(5);
        let mut covered = vec![0.0; truth.references.len()];
        for _ in 0..draws {
            let moved = noisy(&points, 0.002, &mut random);
            let f = fit(element, &moved, &known(element)).unwrap();
            let noise = f.form_noise(&moved, 0.002);
            for (k, r) in truth.references.iter().enumerate() {
                let ours = f.reference(r.criterion).unwrap().form_mm();
                let (criterion, noise) = noise[k];
                assert_eq!(criterion, r.criterion);
                let inside = (ours - r.form_mm()).abs() <= noise.expanded_mm(2.0);
                covered[k] += f64::from(u8::from(inside)) / f64::from(draws);
            }
        }
        for (k, share) in covered.into_iter().enumerate() {
            least[k / 2] = least[k / 2].min(share);
        }
    }
    least
}

#[test]
fn law_u_of_the_form_deviation_covers_the_true_one() {
    assert!(least_coverage_of_form(15).into_iter().all(|share| share >= 0.8));
}

/// The noise of many points makes a range of 2 · 4.4 u, more than that of the 2000 that are drawn from (2 · 3.4 u).
#[test]
fn law_u_of_the_form_deviation_covers_that_of_many_points_without_one() {
    let points = noisy(&ideal(Element::Circle, 0.0, 100_000), 0.002, &mut SplitMix64::new(7));
    let found = fit(Element::Circle, &points, &Known::default()).unwrap();
    for (criterion, noise) in found.form_noise(&points, 0.002) {
        let form_mm = found.reference(criterion).unwrap().form_mm();
        assert!(
            form_mm > 8.0 * 0.002 && form_mm <= noise.expanded_mm(2.0),
            "{criterion:?}: {form_mm}"
        );
    }
}

/// `cargo nextest run -p trueaxis-form --run-ignored only -E 'test(hundreds)'` (1 min).
#[test]
#[ignore = "a minute"]
fn law_u_of_the_form_deviation_covers_the_true_one_in_hundreds_of_draws() {
    // The range about an inscribed sphere of few points is not smooth in the noise: 90 %.
    let [zone, contact] = least_coverage_of_form(400);
    assert!(zone >= 0.93 && contact >= 0.88, "{zone} {contact}");
}

#[test]
fn scatter_beyond_what_is_stated_counts() {
    let mut random = SplitMix64::new(3);
    let points = noisy(&ideal(Element::Circle, 0.02, 90), 0.001, &mut random);
    let f = fit(Element::Circle, &points, &Known::default()).unwrap();
    let of = |stated| f.uncertainty(stated).unwrap().of_point;
    assert_eq!(of(Some(0.001)).source, Source::LargerScatter);
    assert_eq!(of(Some(0.02)).source, Source::Stated);
    assert_eq!(of(None).source, Source::Scatter);
    assert!(of(Some(0.001)).u_mm > 0.01);
}

#[test]
fn a_gross_point_is_found_and_noise_is_none() {
    for element in Element::ALL {
        let mut random = SplitMix64::new(11);
        let mut alarms = 0;
        for round in 0..100 {
            let mut points = noisy(&ideal(element, 0.0, 30), 0.002, &mut random);
            let f = fit_by(element, &points, &known(element), &[]).unwrap();
            alarms += u32::from(checks::gross(&f, &points).is_some());
            if round < 20 {
                // 20 standard deviations along the normal.
                let s = f.shape();
                let d = |p: &Vec3| match element {
                    Element::Line => p.z,
                    _ => s.deviation_mm(p),
                };
                let slope = Vec3::from_fn(|k, _| {
                    let mut q = points[13];
                    q[k] += 1e-5;
                    (d(&q) - d(&points[13])) / 1e-5
                });
                points[13] += slope * 0.04;
                let f = fit_by(element, &points, &known(element), &[]).unwrap();
                let found = checks::gross(&f, &points).map(|g| g.index);
                assert_eq!(found, Some(13), "{element:?}");
            }
        }
        assert!(alarms <= 5, "{element:?}: {alarms} false alarms of 100, 1 expected");
    }
}

#[test]
fn a_short_arc_is_uncertain_and_known_to_be_short() {
    let arc: Vec<Vec3> = (0..21)
        .map(|i| f64::from(i).to_radians())
        .map(|a| Vec3::new(100.0 * a.cos(), 100.0 * a.sin(), 0.0))
        .collect();
    let f =
        fit(Element::Circle, &arc, &Known { normal: Some(Vec3::z()), ..Known::default() }).unwrap();
    let cover = checks::cover(&f, &arc).angle_rad.unwrap();
    assert!((cover.to_degrees() - 20.0).abs() < 1e-6);
    let u = f.uncertainty(Some(0.001)).unwrap();
    // Sagitta of the arc: 100 (1 − cos 10°) = 1.52 mm; its noise of about 1 µm moves the radius by 70 times that.
    assert!((0.02..0.1).contains(&u.radius_mm), "{}", u.radius_mm);
    assert!(f.reference(Criterion::MaximumInscribed).is_none());
}
