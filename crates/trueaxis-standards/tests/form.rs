//! Form from tables of points: columns, filters, warnings, decisions, bad input.

use std::f64::consts::TAU;
use trueaxis_input::Diagnostics;
use trueaxis_standards::form::{
    Criterion, Decision, Element, Filter, FormEvaluation, FormRequest, evaluate_form, filter_named,
    reference_named,
};

fn asked(request: &FormRequest<'_>) -> (Option<FormEvaluation>, Vec<&'static str>) {
    let mut problems = Diagnostics::new();
    let found = evaluate_form(request, &mut problems);
    let found = found.filter(|_| !problems.has_errors());
    (found, problems.iter().map(|d| d.code).collect())
}

fn request(element: Element, text: &str) -> FormRequest<'_> {
    FormRequest { u_mm: Some(1e-4), ..FormRequest::new(element, "p.csv", text) }
}

/// A section of radius 50 mm with lobes, at so many angles.
fn section(count: u32, radial: impl Fn(f64) -> f64) -> String {
    let mut text = "x_mm,y_mm,z_mm\n".to_owned();
    for i in 0..count {
        let a = TAU * f64::from(i) / f64::from(count);
        let r = 50.0 + radial(a);
        text += &format!("{},{},12\n", 3.0 + r * a.cos(), r * a.sin() - 1.0);
    }
    text
}

#[test]
fn units_order_and_other_columns_change_nothing() {
    let mm = section(60, |a| 0.01 * (3.0 * a).cos());
    let (base, _) = asked(&request(Element::Circle, &mm));
    let base = base.unwrap();
    assert!((base.form_mm() - 0.02).abs() < 1e-5);
    let rows =
        mm.lines().skip(1).map(|l| l.split(',').map(|v| v.parse::<f64>().unwrap()).collect());
    let rows: Vec<Vec<f64>> = rows.collect();
    let mut inches = "name,z_in,x_in,y_in\n".to_owned();
    let mut um = "y_um,x_um,z_um\n".to_owned();
    for r in rows.iter().rev() {
        inches += &format!("P,{},{},{}\n", r[2] / 25.4, r[0] / 25.4, r[1] / 25.4);
        um += &format!("{},{},{}\n", r[1] * 1e3, r[0] * 1e3, r[2] * 1e3);
    }
    for text in [inches, um] {
        let (other, _) = asked(&request(Element::Circle, &text));
        let other = other.unwrap();
        assert!((other.form_mm() - base.form_mm()).abs() < 1e-11);
        let u = |e: &FormEvaluation| e.expanded_mm(Criterion::LeastSquares).unwrap();
        // Equal values by symmetry change places by rounding; their draws with them.
        assert!((u(&other) - u(&base)).abs() < 0.15 * u(&base));
    }
    let polar: String =
        (0..60).map(|i| format!("{},{}\n", 6 * i, 50.0 + 0.001 * f64::from(i % 2))).collect();
    let (found, _) = asked(&request(Element::Circle, &format!("angle_deg,radius_mm\n{polar}")));
    assert!((found.unwrap().form_mm() - 0.001).abs() < 1e-9);
}

#[test]
fn a_filter_passes_half_at_its_cut_off() {
    let text = section(360, |a| 0.01 * (15.0 * a).cos());
    let filter = Some(Filter::Undulations(15.0));
    let (found, codes) = asked(&FormRequest { filter, ..request(Element::Circle, &text) });
    assert!((found.unwrap().form_mm() - 0.01).abs() < 2e-5, "{codes:?}");
    let wave = |i: i32| 3.0 * (TAU * f64::from(i) / 20.0).sin();
    let line: String = (0..400).map(|i| format!("{},{}\n", 0.04 * f64::from(i), wave(i))).collect();
    let line = format!("x_mm,z_um\n{line}");
    let filter = Some(Filter::CutOff(0.8));
    let (found, codes) = asked(&FormRequest { filter, ..request(Element::Line, &line) });
    assert!((found.unwrap().form_mm() - 0.003).abs() < 3e-5, "{codes:?}");
}

#[test]
fn a_filter_without_its_profile_is_refused() {
    let text = section(60, |_| 0.0);
    let with =
        |element, filter| asked(&FormRequest { filter: Some(filter), ..request(element, &text) }).1;
    assert_eq!(with(Element::Cylinder, Filter::Undulations(15.0)).last(), Some(&"filter-element"));
    assert_eq!(with(Element::Circle, Filter::CutOff(1.0)), ["filter-element"]);
    assert_eq!(with(Element::Circle, Filter::Undulations(15.0)), ["filter-points"]);
    assert_eq!(with(Element::Circle, Filter::Undulations(50.0)), ["filter-points"]);
    let half: String = text.lines().take(40).map(|l| format!("{l}\n")).collect();
    let filter = Some(Filter::Undulations(2.0));
    let (found, codes) = asked(&FormRequest { filter, ..request(Element::Circle, &half) });
    assert!(found.is_none() && codes.contains(&"filter-element"), "{codes:?}");
}

#[test]
fn a_profile_shorter_than_the_cut_off_is_told_its_length() {
    // 20 points are 19 steps.
    let line: String = (0..20).map(|i| format!("{i},{}\n", 3 * (i % 2))).collect();
    let text = format!("x_mm,z_um\n{line}");
    let filter = Some(Filter::CutOff(19.5));
    let mut problems = Diagnostics::new();
    evaluate_form(&FormRequest { filter, ..request(Element::Line, &text) }, &mut problems);
    let told = problems.iter().find(|d| d.code == "filter-points").unwrap();
    assert!(told.message.contains("19.000 mm is not longer"), "{}", told.message);
}

#[test]
fn uneven_points_are_filtered_with_a_warning() {
    let mut text = "x_mm,y_mm\n".to_owned();
    for i in 0..300 {
        let a = TAU * (f64::from(i) + 0.3 * (f64::from(i)).sin()) / 300.0;
        let r = 50.0 + 0.01 * (5.0 * a).cos();
        text += &format!("{},{}\n", r * a.cos(), r * a.sin());
    }
    let filter = Some(Filter::Undulations(15.0));
    let (found, codes) = asked(&FormRequest { filter, ..request(Element::Circle, &text) });
    let passed = 0.02 * trueaxis_form::filter::transmission(5.0 / 15.0);
    assert!((found.unwrap().form_mm() - passed).abs() < 5e-5);
    assert!(codes.contains(&"filter-uneven"), "{codes:?}");
}

#[test]
fn decisions_respect_u() {
    let text = section(60, |a| 0.01 * (3.0 * a).cos());
    let with = |tolerance, u| {
        let base = request(Element::Circle, &text);
        let r = FormRequest { tolerance_mm: Some(tolerance), u_mm: u, ..base };
        asked(&r).0.unwrap().decision().unwrap()
    };
    assert_eq!(with(0.021, Some(1e-4)), Decision::Pass);
    assert_eq!(with(0.02005, Some(1e-4)), Decision::Undecided);
    assert_eq!(with(0.015, Some(1e-4)), Decision::Fail);
    let plane = "x_mm,y_mm,z_mm\n0,0,0\n10,0,0\n0,10,0\n10,10,0.004\n";
    let r =
        FormRequest { tolerance_mm: Some(1.0), ..FormRequest::new(Element::Plane, "p.csv", plane) };
    // Without U nothing is decided.
    assert_eq!(asked(&r).0.unwrap().decision(), Some(Decision::Undecided));
}

#[test]
fn what_speaks_against_points_is_said() {
    let of = |element, text: &str| asked(&request(element, text)).1;
    let arc: String = section(360, |_| 0.0).lines().take(21).map(|l| format!("{l}\n")).collect();
    assert!(of(Element::Circle, &arc).contains(&"form-cover"));
    let twice = section(40, |_| 0.0) + "53,-1,12\n";
    assert!(of(Element::Circle, &twice).contains(&"copied-rows"));
    let spike = section(40, |a| if a == 0.0 { 0.05 } else { 1e-4 * (17.0 * a).sin() });
    assert!(of(Element::Circle, &spike).contains(&"form-gross-point"));
    let cloud = "x_mm,y_mm,z_mm\n0,0,0\n9,1,3\n2,8,1\n7,7,9\n1,2,8\n5,5,5\n9,9,0\n";
    assert!(of(Element::Plane, cloud).contains(&"form-wrong-element"));
    let r = FormRequest { u_mm: None, ..request(Element::Plane, cloud) };
    assert!(asked(&r).1.contains(&"form-no-uncertainty"));
}

#[test]
fn bad_input_is_named() {
    let refused = |element, text: &str| {
        let (found, codes) = asked(&request(element, text));
        assert!(found.is_none(), "{text}: {codes:?}");
        codes.into_iter().find(|c| *c != "copied-rows").unwrap()
    };
    use Element::{Circle, Cone, Cylinder, Line, Plane, Sphere};
    assert_eq!(refused(Circle, "x_mm,y_mm\n1,2\n"), "no-element");
    assert_eq!(refused(Circle, "x_mm,y_mm\n1,1\n2,2\n3,3\n4,4\n"), "no-element");
    assert_eq!(refused(Plane, "x_mm,y_mm,z_mm\n1,1,1\n2,2,2\n3,3,3\n"), "no-element");
    for element in [Circle, Line, Plane, Sphere, Cylinder, Cone] {
        let same = "x_mm,y_mm,z_mm\n".to_owned() + &"5,6,7\n".repeat(20);
        assert_eq!(refused(element, &same), "no-element");
        let far = "x_mm,y_mm,z_mm\n".to_owned() + &"4e5,4e5,4e5\n".repeat(20);
        assert_eq!(refused(element, &far), "no-element");
        assert_eq!(refused(element, "x_mm,y_mm,z_mm\n1,nan,2\n"), "not-a-number");
        assert_eq!(refused(element, "x_mm,y_mm,z_mm\n"), "empty-table");
        assert_eq!(refused(element, ""), "empty-table");
    }
    assert_eq!(refused(Circle, "x,y\n1,2\n2,3\n4,1\n"), "missing-unit");
    assert_eq!(refused(Circle, "x_mm\n1\n"), "missing-column");
    assert_eq!(refused(Circle, "a_mm,b_mm\n1,2\n"), "missing-column");
    let text = section(20, |_| 0.0);
    let r = FormRequest { reference: Criterion::MaximumInscribed, ..request(Plane, &text) };
    assert!(asked(&r).0.is_none());
}

#[test]
fn a_far_origin_costs_nothing_that_the_numbers_have() {
    let near = section(60, |a| 0.01 * (3.0 * a).cos());
    let far: String = near
        .lines()
        .enumerate()
        .map(|(i, l)| {
            if i == 0 {
                return format!("{l}\n");
            }
            let v: Vec<f64> = l.split(',').map(|v| v.parse().unwrap()).collect();
            format!("{},{},{}\n", v[0] + 4e5, v[1] - 4e5, v[2])
        })
        .collect();
    let (found, _) = asked(&request(Element::Circle, &far));
    // Doubles at 4·10⁵ mm have steps of 6e-11 mm.
    assert!((found.unwrap().form_mm() - 0.02).abs() < 2e-5);
}

#[test]
fn names_of_references_and_filters() {
    for (name, criterion) in [
        ("LSCI", Criterion::LeastSquares),
        ("mzpl", Criterion::MinimumZone),
        ("MCC", Criterion::MinimumCircumscribed),
        ("MICY", Criterion::MaximumInscribed),
    ] {
        assert_eq!(reference_named(name), Some(criterion));
    }
    assert_eq!(reference_named("MZXX"), None);
    assert_eq!(filter_named("gauss 50 upr"), Ok(Filter::Undulations(50.0)));
    assert_eq!(filter_named("Gauss 0.8 mm"), Ok(Filter::CutOff(0.8)));
    assert_eq!(filter_named("gauss 800um"), Ok(Filter::CutOff(0.8)));
    for bad in
        ["", "gauss", "gauss 50", "gauss -1 upr", "spline 3 mm", "gauss nan mm", "gauss 0 mm"]
    {
        assert!(filter_named(bad).is_err(), "{bad}");
    }
}
