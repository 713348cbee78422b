//! Results as QIF and as a table, read back.

#[path = "qif/every.rs"]
mod every;
#[path = "qif/results_reader.rs"]
mod results_reader;

use every::{every, found, housing, odd};
use results_reader::{Line, key_of, lines};
use roxmltree::Document;
use trueaxis_part::Error;
use trueaxis_part::part::{Characteristic, Geometry, Kind, Limits, Part};
use trueaxis_part::qif::results::{Found, results, results_csv};
use trueaxis_part::tolerance::Outcome;

/// The decimals of QIF end here. Unit: mm.
const LAST_MM: f64 = 0.5e-12;

fn written(part: &Part, found: &[Found]) -> String {
    results(part, found, "a program 1.0").unwrap_or_else(|e| panic!("{e}"))
}

/// The names of ISO 1101 in QIF, which differ from the keys of a part file.
fn qif_kind(kind: Kind) -> String {
    match kind {
        Kind::Roundness => "Circularity".to_owned(),
        Kind::LineStraightness => "Straightness".to_owned(),
        Kind::Profile => "SurfaceProfile".to_owned(),
        Kind::LineProfile => "LineProfile".to_owned(),
        Kind::CircularRunOut => "CircularRunout".to_owned(),
        Kind::TotalRunOut => "TotalRunout".to_owned(),
        _ => kind.key()[..1].to_uppercase() + &kind.key()[1..],
    }
}

/// A name as a token of XML: without control characters and with single spaces.
fn token(name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    name.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn due(part: &Part, asked: &Characteristic, found: &Found) -> Line {
    let names = |of: &[usize]| of.iter().map(|f| token(&part.features[*f].name)).collect();
    let nominal_mm = match part.features[asked.features[0]].geometry {
        Geometry::Cylinder { radius_mm, .. } if asked.kind == Kind::Diameter => {
            Some(2.0 * radius_mm)
        }
        Geometry::Slot { width_mm, .. } if asked.kind == Kind::Width => Some(width_mm),
        _ => None,
    };
    let limits_mm = match asked.limits {
        Limits::Zone { tolerance_mm } => vec![tolerance_mm],
        Limits::Size { low_mm, high_mm } => vec![low_mm, high_mm],
    };
    let status = match found.outcome {
        Outcome::Pass => "PASS",
        Outcome::Fail => "FAIL",
        Outcome::Undecided => "INDETERMINATE",
    };
    Line {
        name: token(&asked.name),
        kind: qif_kind(asked.kind),
        features: names(&asked.features),
        datums: asked.datums.iter().map(|d| names(&d.features).join("-")).collect(),
        nominal_mm,
        limits_mm,
        value_mm: nominal_mm.unwrap_or(0.0) + found.value_mm,
        u_mm: found.u_mm,
        status: status.to_owned(),
    }
}

/// The same but for what lies beyond the decimals of QIF.
fn assert_same(mut line: Line, mut due: Line) {
    line.name = token(&line.name);
    for names in [&mut line.features, &mut line.datums] {
        names.iter_mut().for_each(|n| *n = token(n));
    }
    let numbers = |l: &Line| [&[l.value_mm, l.u_mm][..], &l.limits_mm].concat();
    for (a, b) in numbers(&line).into_iter().zip(numbers(&due)) {
        assert!((a - b).abs() <= LAST_MM * 1.01, "{a} {b} of {line:?}");
    }
    (due.value_mm, due.u_mm, due.limits_mm) = (line.value_mm, line.u_mm, line.limits_mm.clone());
    assert_eq!(line, due);
}

#[test]
fn what_is_written_is_read_back() {
    for part in [housing(), every(), odd()] {
        let found = found(&part);
        let lines = lines(&written(&part, &found));
        assert_eq!(lines.len(), part.characteristics.len());
        for ((line, asked), found) in lines.into_iter().zip(&part.characteristics).zip(&found) {
            assert_same(line, due(&part, asked, found));
        }
    }
}

#[test]
fn every_kind_and_every_shape_is_in_it() {
    let part = every();
    let document = written(&part, &found(&part));
    let kinds: Vec<String> = Kind::ALL.into_iter().map(qif_kind).collect();
    for kind in kinds {
        assert!(document.contains(&format!("<{kind}CharacteristicMeasurement ")), "{kind}");
    }
    for shape in [
        "Plane",
        "Cylinder",
        "Cone",
        "Sphere",
        "Torus",
        "OppositeParallelPlanes",
        "PointDefinedSurface",
        "OtherSurface",
    ] {
        assert!(document.contains(&format!("<{shape}FeatureItem ")), "{shape}");
    }
}

/// A bore of 30 mm that is 4 µm too wide, ±10 µm: the size, its limits as deviations, u as an attribute of the value.
#[test]
fn a_bore_by_hand() {
    let part = housing();
    let index = part.characteristics.iter().position(|c| c.kind == Kind::Diameter).unwrap();
    let mut found = found(&part);
    found[index] = Found { value_mm: 0.004, u_mm: 0.0015, outcome: Outcome::Pass };
    let document = written(&part, &found);
    for line in [
        "<Value combinedUncertainty=\"0.0015\" meanError=\"0\">30.004</Value>",
        "<TargetValue>30</TargetValue>",
        "<MaxValue>0.01</MaxValue>",
        "<MinValue>-0.01</MinValue>",
        "<DeterminationModifier>GG</DeterminationModifier>",
    ] {
        assert!(document.contains(line), "{line}");
    }
    let text = ["Predicted, not measured", "a program 1.0", "prediction, not a measurement"];
    assert!(text.iter().all(|t| document.contains(t)));
}

/// The text of a document from a name to the end of its element, without line ends and indents.
fn element(document: &str, name: &str) -> String {
    let (_, rest) = document.split_once(&format!("<Name>{name}</Name>")).unwrap();
    let (content, _) = rest.split_once("FeatureNominal>").unwrap();
    content.split_whitespace().collect::<Vec<_>>().join(" ").replace("> <", "><")
}

/// What no draft reads: a rounding of 24 mm ring and 4 mm section from 180° to 270°, a slot of 12 mm, a table of two points, a tip.
#[test]
fn other_shapes_by_hand() {
    let part = every();
    let document = written(&part, &found(&part));
    let plain = document.split_whitespace().collect::<Vec<_>>().join(" ").replace("> <", "><");
    let side = |name: &str| format!("<InternalExternal>{name}</InternalExternal>");
    for (side, size) in [
        (side("INTERNAL"), "<MinorDiameter>4</MinorDiameter><MajorDiameter>24</MajorDiameter>"),
        (side("EXTERNAL"), "<MinorDiameter>4</MinorDiameter><MajorDiameter>30</MajorDiameter>"),
        (side("INTERNAL"), "<Width>12</Width><Length>40</Length><EndType>"),
        (side("EXTERNAL"), "<Width>60</Width><Length>100</Length><EndType>"),
        // A tip has no small end.
        (
            side("EXTERNAL"),
            "<Diameter>0</Diameter><HalfAngle>0.540419500271</HalfAngle>\
             <LargeEndDistance>5</LargeEndDistance></Cone",
        ),
    ] {
        assert!(plain.contains(&format!("{side}{size}")), "{side}{size}");
    }
    assert!(plain.contains("</EndType><Depth>10</Depth>"));
    let fillet = element(&document, "fillet");
    assert!(fillet.contains("<Location>10 5 22</Location><AxisVector>0 0 1</AxisVector>"));
    let latitude = "<DomainLatitude>3.14159265359 4.712388980385</DomainLatitude>";
    assert!(fillet.contains(latitude) && !fillet.contains("DirNorthPole"), "{fillet}");
    let slot = element(&document, "slot");
    let middle = "<CenterPlane><Point>0 0 15</Point><Normal>0 1 0</Normal></CenterPlane>";
    assert!(slot.contains(middle) && slot.contains("<LengthVector>1 0 0</LengthVector>"), "{slot}");
    let second = "<Point>4 5 6.25</Point><Normal>0 0.6 0.8</Normal><SequenceNumber>2<";
    assert!(element(&document, "table").contains(second));
}

/// One verdict of all: fails with one, passes with all.
#[test]
fn the_verdict_of_the_part() {
    let part = housing();
    let status = |outcomes: [Outcome; 2]| {
        let mut found = found(&part);
        found.iter_mut().for_each(|f| f.outcome = outcomes[0]);
        found[3].outcome = outcomes[1];
        let text = written(&part, &found);
        let (_, rest) = text.split_once("<InspectionStatusEnum>").unwrap();
        rest.split('<').next().unwrap().to_owned()
    };
    use Outcome::{Fail, Pass, Undecided};
    assert_eq!(status([Pass, Pass]), "PASS");
    assert_eq!(status([Pass, Undecided]), "UNKNOWN");
    assert_eq!(status([Undecided, Fail]), "FAIL");
}

#[test]
fn odd_names_are_escaped() {
    let part = odd();
    let text = written(&part, &found(&part));
    let document = Document::parse(&text).unwrap();
    let names: Vec<&str> = document
        .descendants()
        .filter(|n| n.has_tag_name(key_of("FeatureName")))
        .filter_map(|n| n.text())
        .collect();
    assert_eq!(names, ["a<b & \"c\" 'd'", "Bohrung ü, 2", "É"]);
    let labels: Vec<&str> = document
        .descendants()
        .filter(|n| n.has_tag_name(key_of("DatumLabel")))
        .filter_map(|n| n.text())
        .collect();
    // Tokens that differ, with the letters of the drawing as attributes.
    assert_eq!(labels, ["___", "____2"]);
    assert!(text.contains("<AttributeStr name=\"label\" value=\"Ö&lt;&quot;\"/>"));
    assert!(!text.chars().any(|c| c.is_control() && c != '\n'));
}

#[test]
fn what_is_no_value_is_refused() {
    let part = housing();
    let good = found(&part);
    for (value_mm, u_mm) in [
        (f64::NAN, 0.001),
        (f64::INFINITY, 0.001),
        (-1e101, 0.001),
        (0.001, f64::NAN),
        (0.001, f64::INFINITY),
        (0.001, -1e-9),
    ] {
        let mut bad = good.clone();
        bad[2] = Found { value_mm, u_mm, outcome: Outcome::Pass };
        let due = Error::NotFinite { index: 2 };
        assert_eq!(results(&part, &bad, "x"), Err(due.clone()), "{value_mm} {u_mm}");
        assert_eq!(results_csv(&part, &bad), Err(due));
    }
    let due = Error::WrongLength { what: "found values", found: 10, expected: 11 };
    assert_eq!(results(&part, &good[1..], "x"), Err(due.clone()));
    assert_eq!(results_csv(&part, &good[1..]), Err(due));
}

#[test]
fn law_the_order_of_the_part_changes_no_value() {
    let part = every();
    let found = found(&part);
    let mut turned = part.clone();
    turned.characteristics.reverse();
    let back: Vec<Found> = found.iter().rev().copied().collect();
    let mut other = lines(&written(&turned, &back));
    other.reverse();
    assert_eq!(lines(&written(&part, &found)), other);
}

/// Ids and all before the results depend on the part alone, and the identity of the document on all of it.
#[test]
fn law_ids_are_those_of_the_part() {
    let part = every();
    let mut found = found(&part);
    let one = written(&part, &found);
    assert_eq!(one, written(&part, &found));
    found[0].value_mm += 0.001;
    let two = written(&part, &found);
    let halves = |text: &str| {
        let (identity, rest) = text.split_once("</QPId>").unwrap();
        let (nominal, _) = rest.split_once("<Results>").unwrap();
        (identity.to_owned(), nominal.to_owned())
    };
    assert_ne!(halves(&one).0, halves(&two).0);
    assert_eq!(halves(&one).1, halves(&two).1);
}

/// Rows and cells of RFC 4180.
fn cells(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut cell) = (Vec::new(), Vec::new(), String::new());
    let mut is_quoted = false;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if is_quoted && letters.peek() == Some(&'"') => cell.extend(letters.next()),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => row.push(std::mem::take(&mut cell)),
            '\n' if !is_quoted => {
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            c => cell.push(c),
        }
    }
    assert!(!is_quoted && row.is_empty() && cell.is_empty());
    rows
}

#[test]
fn a_table_is_read_back() {
    for part in [housing(), every(), odd()] {
        let found = found(&part);
        let rows = cells(&results_csv(&part, &found).unwrap());
        let headings =
            "characteristic,kind,feature,datums,value_mm,u_mm,low_mm,high_mm,used,outcome";
        assert_eq!(rows[0].join(","), headings);
        assert_eq!(rows.len(), part.characteristics.len() + 1);
        for ((row, asked), found) in rows[1..].iter().zip(&part.characteristics).zip(&found) {
            let plain = |cell: &str| cell.strip_prefix('\'').unwrap_or(cell).to_owned();
            let labels: Vec<String> =
                asked.datums.iter().map(|d| d.label(&part.features)).collect();
            assert_eq!(plain(&row[0]), asked.name);
            assert_eq!(
                [&row[1], &row[2], &row[3]],
                [asked.kind.key(), &asked.of, &labels.join("|")]
            );
            let number = |i: usize| row[i].parse::<f64>().ok();
            let (low, high) = match asked.limits {
                Limits::Zone { tolerance_mm } => (None, tolerance_mm),
                Limits::Size { low_mm, high_mm } => (Some(low_mm), high_mm),
            };
            let due = [Some(found.value_mm), Some(found.u_mm), low, Some(high)];
            assert_eq!([4, 5, 6, 7].map(number), due);
            assert_eq!(number(8), Some(asked.limits.used(found.value_mm)));
            let outcome = match found.outcome {
                Outcome::Pass => "pass",
                Outcome::Fail => "fail",
                Outcome::Undecided => "undecided",
            };
            assert_eq!(row[9], outcome);
            // A cell that a spreadsheet calculates begins so; numbers are meant to be numbers.
            for cell in row.iter().filter(|c| c.parse::<f64>().is_err()) {
                assert!(!cell.starts_with(['=', '+', '-', '@']), "{cell}");
            }
        }
    }
}
