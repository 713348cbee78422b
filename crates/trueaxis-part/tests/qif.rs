//! Drafts of part files from QIF files, which are written here by hand.

#[path = "qif/plate.rs"]
mod plate;

use plate::{INCH, MM, Style, plate};
use std::path::Path;
use trueaxis_input::{Diagnostics, SourceText};
use trueaxis_part::part::{Geometry, Part};
use trueaxis_part::qif::{Draft, draft};

fn drafted(text: &str) -> (Draft, Diagnostics) {
    let mut problems = Diagnostics::new();
    let draft = draft("plate.qif", text, &mut problems);
    (draft.unwrap_or_else(|| panic!("{problems:?}")), problems)
}

fn part(text: &str) -> Part {
    let source = SourceText::new("plate.toml", text);
    let part = source.read(|root| Part::read(root, Path::new("")));
    let problems = source.finish();
    part.unwrap_or_else(|| panic!("{problems:?}\n{text}"))
}

fn in_mm() -> String {
    plate(MM).write(Style::default())
}

/// The plate with one thing changed, and what the draft says about it.
fn changed(from: &str, to: &str) -> (Draft, Diagnostics) {
    let text = in_mm();
    assert!(text.contains(from), "the plate has no {from}");
    drafted(&text.replace(from, to))
}

/// Whether the draft names a characteristic or feature as left out for a reason, in its list and in its text.
fn is_left_out(draft: &Draft, id: &str, reason: &str) -> bool {
    let is_it = |l: &&trueaxis_part::qif::LeftOut| l.id == id && l.reason.contains(reason);
    draft.left_out().iter().find(is_it).is_some_and(|left| {
        let is_named = |line: &str| {
            let (before, after) = (format!("# {} ", left.what), format!(": {}", left.reason));
            let ids = line.strip_prefix(&before).and_then(|l| l.strip_suffix(&after));
            ids.is_some_and(|ids| ids.split(", ").any(|id| id == left.id))
        };
        left.place.line > 0 && draft.text().lines().any(is_named)
    })
}

#[test]
fn a_complete_draft_is_read_and_judged() {
    let (draft, problems) = drafted(&in_mm());
    assert_eq!(problems.iter().count(), 0, "{problems:?}");
    assert_eq!((draft.features(), draft.characteristics(), draft.unknown()), (8, 17, 0));
    let text = draft.text();
    let part = part(&text);
    let values = part.evaluate(&vec![0.0; part.points()]).expect("values");
    assert!(values.iter().all(|v| v.abs() < 1e-9), "{values:?}");
    for line in [
        "plane = { at = \"40 30 20 mm\", normal = \"0 0 1\", along = \"1 0 0\", size = \"80 60 mm\" }",
        "    { at = \"40 30 20 mm\", diameter = \"30 mm\" },",
        "    { at = \"40 30 0 mm\", size = \"10 20 mm\" },",
        "hole = { at = \"40 30 15 mm\", axis = \"0 0 -1\", diameter = \"20 mm\", length = \"15 mm\" }",
        "plane = { at = \"40 8 6 mm\", normal = \"0 -0.6 0.8\", along = \"1 0 0\", size = \"40 20 mm\" }",
        "diameter = [\"-10 um\", \"25 um\"]",
        // What both sides have: from x = 12 to 30 mm, from z = 10 to 20 mm.
        "slot = { at = \"21 51 15 mm\", across = \"0 1 0\", along = \"1 0 0\", width = \"6 mm\", size = \"18 10 mm\" }",
        "width = [\"-10 um\", \"25 um\"]",
        "line_straightness = \"20 um\"",
        "datum = \"A|B|C\"",
    ] {
        assert!(text.lines().any(|l| l == line), "no {line} in\n{text}");
    }
}

/// The largest difference of the numbers of two parts. Unit: mm.
fn farthest_mm(one: &Part, other: &Part) -> f64 {
    let points = |p: &Part| -> Vec<_> {
        p.features.iter().flat_map(|f| &f.points).map(|p| (p.point_mm, p.normal)).collect()
    };
    let (one, other) = (points(one), points(other));
    assert_eq!(one.len(), other.len());
    let off = |((p, n), (q, m)): (&(_, _), &(_, _))| -> f64 {
        let (p, q, n, m): (
            &trueaxis_geometry::Vec3,
            &trueaxis_geometry::Vec3,
            &trueaxis_geometry::Vec3,
            &trueaxis_geometry::Vec3,
        ) = (p, q, n, m);
        (p - q).norm().max((n - m).norm())
    };
    one.iter().zip(&other).map(off).fold(0.0, f64::max)
}

#[test]
fn law_inches_and_millimetres_draft_the_same() {
    let (in_mm, in_inches) = (drafted(&in_mm()).0, drafted(&plate(INCH).write(Style::default())).0);
    let (one, other) = (part(&in_mm.text()), part(&in_inches.text()));
    assert!(farthest_mm(&one, &other) < 1e-9);
    assert_eq!(one.characteristics, other.characteristics);
    assert_eq!(in_mm.text(), in_inches.text());
}

/// The scale of the model divides its lengths and those of its features, not those of the drawing.
#[test]
fn law_the_scale_of_the_model_divides_it() {
    let half = plate::Unit { name: "mm", mm: 0.5 };
    let text = plate(half).write(Style::default());
    // Written with numbers twice as large, which the scale takes back; the drawing is in mm of its own.
    let text = text.replace("<ScaleCoefficient>1<", "<ScaleCoefficient>2<");
    let text = text.replace("<Factor>0.0005<", "<Factor>0.001<");
    let pmi = "<PMILinearUnit><SIUnitName>meter</SIUnitName><UnitName>half</UnitName><UnitConversion><Factor>0.0005</Factor></UnitConversion></PMILinearUnit></PrimaryUnits>";
    let text = text.replace("</PrimaryUnits>", pmi);
    assert_eq!(drafted(&text).0.text(), drafted(&in_mm()).0.text());
}

#[test]
fn law_order_prefix_and_white_space_do_not_matter() {
    let plain = drafted(&in_mm()).0;
    for prefix in ["", "q:"] {
        for spaced in [false, true] {
            for reversed in [false, true] {
                let text = plate(MM).write(Style { prefix, spaced, reversed });
                let text = match prefix {
                    "" => text,
                    _ => text.replacen("<q:QIFDocument", "<q:QIFDocument xmlns:q=\"urn:q\"", 1),
                };
                let found = drafted(&text).0;
                assert_eq!(found.text(), plain.text(), "{prefix} {spaced} {reversed}");
            }
        }
    }
}

#[test]
fn what_the_file_does_not_state_is_marked_on_its_line() {
    let text = in_mm();
    let without_faces =
        text.replace("<EntityInternalIds", "<Other").replace("</EntityInternalIds", "</Other");
    let (draft, _) = drafted(&without_faces);
    // Four planes and a slot without a size, two bores without a length.
    assert_eq!((draft.unknown(), draft.characteristics()), (7, 17));
    let text = draft.text();
    for line in text.lines().filter(|l| l.contains("\"?\"")) {
        assert!(
            line.contains("# size: the file does not state it") || line.contains("# length: the"),
            "{line}"
        );
    }
    let filled = text.replace("size = \"?\"", "size = \"20 20 mm\"").replace("\"?\"", "\"10 mm\"");
    part(&filled);
}

#[test]
fn a_face_that_is_no_rectangle_is_not_called_one() {
    // One corner of the front lies 5 mm lower; the first place is that of the top.
    let (corner, text) = ("<XYZ>80 0 20</XYZ>", in_mm());
    let front = text.rfind(corner).expect("a corner");
    assert_ne!(text.find(corner), Some(front));
    let lower = text[front..].replacen(corner, "<XYZ>80 0 15</XYZ>", 1);
    let (draft, _) = drafted(&format!("{}{lower}", &text[..front]));
    let text = draft.text();
    let line = text.lines().find(|l| l.contains("\"?\"")).expect("a mark");
    assert!(line.contains("is no rectangle; its corners fill 80 20 mm"), "{line}");
    assert_eq!(draft.unknown(), 1);
}

#[test]
fn limits_of_a_size_count_from_the_diameter_of_the_feature() {
    let limits = |from: &str, to: &str| {
        let (draft, _) = changed(from, to);
        let text = draft.text();
        text.lines().find(|l| l.starts_with("diameter")).map(str::to_owned)
    };
    let target = "<TargetValue>20<";
    let moved = limits(target, "<TargetValue>20.002<").expect("a diameter");
    assert!(
        moved.starts_with("diameter = [\"-8 um\", \"27 um\"]  # the drawing has 20.002 mm"),
        "{moved}"
    );
    let inches = limits(">0.025<", " linearUnit=\"inch\">0.001<").expect("a diameter");
    assert_eq!(inches, "diameter = [\"-10 um\", \"25.4 um\"]");
    let sizes = "<MaxValue>0.025</MaxValue><MinValue>-0.01</MinValue><DefinedAsLimit>false<";
    let as_sizes = "<MaxValue>20.025</MaxValue><MinValue>19.99</MinValue><DefinedAsLimit>true<";
    assert_eq!(limits(sizes, as_sizes).expect("a diameter"), "diameter = [\"-10 um\", \"25 um\"]");
    let (draft, _) = changed(target, "<TargetValue>25<");
    assert!(is_left_out(&draft, "114", "the drawing has 25 mm, its feature 20 mm"));
    let (draft, _) = changed("<MinValue>-0.01</MinValue>", "");
    assert!(is_left_out(&draft, "114", "it has one limit only"));
}

/// A size that is asked by least squares is the one that is evaluated; between two points it is another one.
#[test]
fn a_size_is_drafted_by_least_squares_only() {
    let with = |modifier: &str| {
        let size = "<Tolerance>";
        let asked = format!("<DeterminationModifier>{modifier}</DeterminationModifier>");
        let to = format!("<DimensionModifiers>{asked}</DimensionModifiers>{size}");
        changed(size, &to).0
    };
    assert_eq!(with("GG").text(), drafted(&in_mm()).0.text());
    assert!(is_left_out(&with("LP"), "114", "its size is asked with LP, not GG"));
}

/// Nothing that a drawing asks beyond the part file is read as less.
#[test]
fn each_thing_that_is_left_out_is_named() {
    let position = "<MaterialCondition>NONE</MaterialCondition><DatumReferenceFrameId>53<";
    let with = |what: &str| position.replace("<Datum", &format!("{what}<Datum"));
    let tolerance = "<ToleranceValue>0.02</ToleranceValue>";
    let flatness = "<FlatnessCharacteristicDefinition id=\"2101\">";
    let cases: Vec<(&str, String, &str, &str)> = vec![
        (position, position.replace("NONE", "MAXIMUM"), "105", "maximum material condition"),
        (position, position.replace("NONE", "LEAST_RPR"), "105", "material condition LEAST_RPR"),
        (
            position,
            with("<ProjectedToleranceZoneValue>5</ProjectedToleranceZoneValue>"),
            "105",
            "projected tolerance zone value",
        ),
        (
            position,
            with(
                "<SecondCompositeSegmentPositionDefinition><A/></SecondCompositeSegmentPositionDefinition>",
            ),
            "105",
            "second composite segment",
        ),
        (
            position,
            with("<StatisticalCharacteristic>true</StatisticalCharacteristic>"),
            "105",
            "statistical characteristic",
        ),
        (position, with("<FreeState>true</FreeState>"), "105", "free state"),
        (position, with("<OrientationOnly>1</OrientationOnly>"), "105", "orientation only"),
        (position, with("<SomethingNew>2</SomethingNew>"), "105", "something new"),
        (position, position.replace("53<", "51<"), "105", "the datums leave free what moves it"),
        (flatness, format!("{flatness}<CommonZone>true</CommonZone>"), "101", "common zone"),
        (
            flatness,
            format!("{flatness}<NonTolerance>MEASURED</NonTolerance>"),
            "101",
            "it has no tolerance",
        ),
        ("Flatness", "SurfaceTexture".to_owned(), "101", "surface texture is not evaluated"),
        (
            "<CharacteristicDefinitionId>2106</CharacteristicDefinitionId>",
            "<CharacteristicDefinitionId>2106</CharacteristicDefinitionId><TargetValue>0.5</TargetValue>"
                .to_owned(),
            "106",
            "beside the nominal surface",
        ),
        (
            "SurfaceProfileCharacteristic",
            "LineProfileCharacteristic".to_owned(),
            "106",
            "it has no Vector",
        ),
        (
            "<DiametricalZone></DiametricalZone>",
            "<SphericalZone/>".to_owned(),
            "105",
            "its zone is a sphere",
        ),
        (
            "<DiametricalZone></DiametricalZone>",
            "<NonDiametricalZone/>".to_owned(),
            "105",
            "its zone lies between planes",
        ),
        (
            "<PlanarZone></PlanarZone>",
            "<DiametricalZone/>".to_owned(),
            "102",
            "its zone is a cylinder",
        ),
        (
            "<ZoneShape><DiametricalZone></DiametricalZone></ZoneShape>",
            String::new(),
            "107",
            "no shape of the zone",
        ),
        (
            "SimpleDatum",
            "MeasuredDatumFeature".to_owned(),
            "102",
            "a measured datum feature is not evaluated",
        ),
        ("SimpleDatum", "CompoundDatum".to_owned(), "102", "the compound datum has"),
        (
            "<MaterialModifier>NONE<",
            "<MaterialModifier>MAXIMUM<".to_owned(),
            "102",
            "datum A at maximum material condition",
        ),
        (
            "<DatumLabel>A</DatumLabel>",
            "<DatumLabel>A</DatumLabel><DatumTargetIds/>".to_owned(),
            "102",
            "datum A has datum target ids",
        ),
        (">PRIMARY<", ">OTHER<".to_owned(), "102", "neither primary, secondary nor tertiary"),
        (">SECONDARY<", ">TERTIARY<".to_owned(), "105", "leaves no order"),
        (
            "<DatumReferenceFrameId>53</DatumReferenceFrameId>",
            String::new(),
            "105",
            "without datums its zone has no place",
        ),
        (
            "<DatumReferenceFrameId>54</DatumReferenceFrameId>",
            String::new(),
            "110",
            "it names no datum",
        ),
        ("Plane", "Slot".to_owned(), "101", "a feature `slot` is no shape of a part file"),
        (
            "<Direction>",
            "<Whole/></Axis><Sweep><DomainAngle>0 3.1</DomainAngle></Sweep><Axis><Direction>"
                .to_owned(),
            "108",
            "177.6° of a turn only",
        ),
        (
            tolerance,
            "<ToleranceValue>-0.02</ToleranceValue>".to_owned(),
            "101",
            "expected a positive length",
        ),
        (tolerance, String::new(), "101", "no tolerance value"),
        (
            tolerance,
            "<ToleranceValue linearUnit=\"furlong\">1</ToleranceValue>".to_owned(),
            "101",
            "does not define the unit `furlong`",
        ),
    ];
    for (from, to, id, reason) in cases {
        let (draft, _) = changed(from, &to);
        assert!(is_left_out(&draft, id, reason), "{reason}: {:?}", draft.left_out());
    }
}

/// A letter that a part file would divide into two is not written as one.
#[test]
fn a_letter_never_names_another_feature() {
    let (draft, _) = changed("<DatumLabel>A</DatumLabel>", "<DatumLabel>C|B</DatumLabel>");
    let text = draft.text();
    assert!(text.contains("datum = \"face_11|B|C\"") && !text.contains("C|B"), "{text}");
    let (draft, _) = changed("<DatumLabel>B</DatumLabel>", "<DatumLabel>A</DatumLabel>");
    assert!(draft.text().contains("datum = \"A|face_12|C\""));
    // A name that is the letter of another feature.
    let (draft, _) = changed("<Name>bore 15</Name>", "<Name>A</Name>");
    assert!(draft.text().contains("[feature.A_2]"));
    part(&draft.text());
}

#[test]
fn a_group_stands_for_its_features_and_never_for_itself() {
    let asked = "<CharacteristicDefinitionId>2108</CharacteristicDefinitionId><FeatureNominalIds n=\"1\"><Id>15<";
    let group = |id: &str, members: &str| {
        format!(
            "<FeatureNominals><PatternFeatureCircleNominal id=\"{id}\"><FeatureNominalIds>{members}</FeatureNominalIds></PatternFeatureCircleNominal>"
        )
    };
    let text = in_mm().replace(asked, &asked.replace(">15<", ">18<"));
    let grouped = text.replace("<FeatureNominals>", &group("18", "<Id>15</Id><Id>16</Id>"));
    let (draft, problems) = drafted(&grouped);
    assert_eq!((draft.characteristics(), problems.iter().count()), (18, 0), "{problems:?}");
    assert_eq!(draft.text().matches("roundness = ").count(), 2);
    let cyclic = text.replace("<FeatureNominals>", &group("18", "<Id>15</Id><Id>18</Id>"));
    let (draft, problems) = drafted(&cyclic);
    assert!(is_left_out(&draft, "108", "contains itself"));
    let found = problems.iter().find(|p| p.code == "bad-reference").expect("a warning");
    assert_eq!((found.place.file.as_str(), found.place.line), ("plate.qif", 1));
    assert!(found.place.column > 1);
}

/// A contradiction is a warning with its place, and all that needs it is left out.
#[test]
fn contradictions_are_named_with_their_places() {
    for (from, to, code, id) in [
        ("<Id>15</Id>", "<Id>77</Id>", "bad-reference", "108"),
        ("<FeatureDefinitionId>902<", "<FeatureDefinitionId>901<", "bad-reference", "108"),
        (
            "<CharacteristicDefinitionId>2101<",
            "<CharacteristicDefinitionId>2102<",
            "bad-reference",
            "101",
        ),
        (
            "<DatumLabel>A</DatumLabel><FeatureNominalIds n=\"1\"><Id>11</Id></FeatureNominalIds>",
            "<DatumLabel>A</DatumLabel>",
            "bad-datum",
            "102",
        ),
        ("<Diameter>20<", "<Diameter>-20<", "not-positive", "108"),
        ("<Diameter>20<", "<Diameter>NaN<", "not-a-number", "108"),
        ("<Diameter>20<", "<Diameter>1e300<", "not-a-number", "108"),
        ("<Direction>0 0 -1<", "<Direction>0 0 0<", "bad-direction", "108"),
        ("<Normal>0 0 1<", "<Normal>0 0<", "not-a-number", "101"),
        ("<InternalExternal>INTERNAL<", "<InternalExternal>NEITHER<", "missing-value", "108"),
        ("<MaxValue>0.025<", "<MaxValue>-0.025<", "bad-limits", "114"),
    ] {
        let (draft, problems) = changed(from, to);
        assert!(is_left_out(&draft, id, ""), "{to}: {:?}", draft.left_out());
        let found = problems.iter().find(|p| p.code == code);
        let found = found.unwrap_or_else(|| panic!("{to}: {problems:?}"));
        assert!(found.place.line == 1 && found.place.column > 1, "{found}");
        assert!(!found.hint.is_empty());
    }
}

#[test]
fn hostile_files_are_refused_by_name() {
    let refused = |text: &str, code: &str| {
        let mut problems = Diagnostics::new();
        assert!(draft("x.qif", text, &mut problems).is_none(), "{code}");
        let found = problems.iter().find(|p| p.code == code);
        assert!(found.is_some_and(|p| p.place.file == "x.qif"), "{code}: {problems:?}");
    };
    let text = in_mm();
    refused("ISO-10303-21;", "bad-xml");
    refused("", "bad-xml");
    refused(&text[..text.len() / 2], "bad-xml");
    refused("<Part/>", "not-qif");
    refused("<QIFDocument/>", "missing-unit");
    refused(&text.replace("LinearUnit", "MassUnit"), "missing-unit");
    refused(&text.replace(">meter<", ">gram<"), "unknown-unit");
    // Of what is a unit a multiple that says no SI unit? An inch was read as a metre.
    refused(&text.replacen("<SIUnitName>meter</SIUnitName>", "", 1), "unknown-unit");
    let degrees = "<AngularUnit><UnitName>degree</UnitName></AngularUnit></PrimaryUnits>";
    refused(&text.replace("</PrimaryUnits>", degrees), "unknown-unit");
    refused(&text.replace("<Factor>0.001<", "<Factor>-1<"), "unknown-unit");
    refused(&text.replace("<Factor>0.001<", "<Factor>NaN<"), "not-a-number");
    refused(&text.replace("<UnitName>inch<", "<UnitName>mm<"), "unknown-unit");
    refused(&text.replace("<ScaleCoefficient>1<", "<ScaleCoefficient>0<"), "unknown-unit");
    refused(&text.replace("id=\"12\"", "id=\"11\""), "duplicate-id");
    refused(
        &text.replace("CharacteristicNominal", "CharacteristicMeasurement"),
        "no-characteristic",
    );
    let deep = 1_000_000;
    refused(&format!("{}{}", "<a>".repeat(deep), "</a>".repeat(deep)), "not-qif");
    let inside = format!("<FileUnits>{}{}", "<a>".repeat(deep), "</a>".repeat(deep));
    let (deep_draft, _) = drafted(&text.replacen("<FileUnits>", &inside, 1));
    assert_eq!(deep_draft.characteristics(), 17);
}

/// Wherever a file is cut, or one of its words replaced, there is a draft or an error, and what a draft marks as complete is read.
#[test]
fn law_no_change_of_a_file_is_a_panic() {
    let text = in_mm();
    let words = ["NaN", "-1", "1e308", "", "11", "15", "0 0 0", "MAXIMUM", "\u{0}é", "true"];
    let starts: Vec<usize> = text.match_indices('>').map(|(i, _)| i + 1).collect();
    for (k, start) in starts.iter().enumerate() {
        let word = words[k % words.len()];
        let end = text[*start..].find('<').map_or(text.len(), |by| start + by);
        if end == *start {
            continue;
        }
        let changed = format!("{}{word}{}", &text[..*start], &text[end..]);
        let mut problems = Diagnostics::new();
        match draft("x.qif", &changed, &mut problems) {
            Some(found) if found.unknown() == 0 && found.characteristics() > 0 => {
                part(&found.text());
            }
            Some(_) => {}
            None => assert!(problems.has_errors()),
        }
    }
    for cut in (0..text.len()).step_by(211) {
        let mut problems = Diagnostics::new();
        assert!(draft("x.qif", &text[..cut], &mut problems).is_none());
        assert!(problems.has_errors());
    }
}

/// The face of the model that a feature names.
fn face_of<'t>(text: &'t str, feature: &str) -> &'t str {
    let start = text.find(&format!("Nominal id=\"{feature}\"")).expect("a feature");
    let rest = text[start..].split_once("<EntityInternalIds n=\"1\"><Id>").expect("a face").1;
    rest.split_once('<').expect("an end").0
}

#[test]
fn a_bore_begins_where_its_faces_do() {
    let plain = drafted(&in_mm()).0.text();
    // The axis begins above the plate.
    let (above, _) = changed("<AxisPoint>40 30 20<", "<AxisPoint>40 30 22<");
    assert_eq!(above.text(), plain);
    // A face around its end belongs to it in some exports.
    let text = in_mm();
    let own = format!("<EntityInternalIds n=\"1\"><Id>{}</Id>", face_of(&text, "15"));
    let both = format!("{own}<Id>{}</Id>", face_of(&text, "11"));
    assert_eq!(drafted(&text.replace(&own, &both)).0.text(), plain);
    // A length that the feature states otherwise.
    let stated = "<Diameter>20</Diameter><Length>12</Length>";
    let (draft, _) = changed("<Diameter>20</Diameter>", stated);
    assert!(draft.text().contains("# length by its faces; the feature states 12 mm"));
}

#[test]
fn a_face_elsewhere_or_from_the_other_side_is_not_believed() {
    let (draft, _) = changed("<Location>1 2 0<", "<Location>1 2 5<");
    let text = draft.text();
    let line = text.lines().find(|l| l.contains("\"?\"")).expect("a mark");
    assert!(line.contains("at = \"1 2 5 mm\"") && line.contains("outside of its plane"), "{line}");
    // DirU x DirV points down; the face that is turned is out of the material upwards, as its feature says.
    let text = in_mm();
    let face = format!("<Face id=\"{}\"", face_of(&text, "11"));
    let surface = "<SurfaceSet><Plane23 id=\"9001\"><Plane23Core><DirU>1 0 0</DirU><DirV>0 -1 0</DirV></Plane23Core></Plane23></SurfaceSet></GeometrySet>";
    let of = |turned: &str| {
        let with = text.replace(
            &format!("{face}>"),
            &format!("{face} turned=\"{turned}\"><Surface><Id>9001</Id></Surface>"),
        );
        drafted(&with.replace("</GeometrySet>", surface)).0
    };
    assert_eq!((of("true").unknown(), of("true").text()), (0, drafted(&text).0.text()));
    let marked = of("false").text();
    assert!(
        marked.contains("normal = \"?\"") && marked.contains("the feature has 0 0 1"),
        "{marked}"
    );
}

#[test]
fn cones_and_spheres_by_hand() {
    // A countersink of 90° around the point where it is 20 mm wide: 2 mm on it is 24 mm wide.
    let cone = "<ConeFeatureDefinition id=\"904\"><InternalExternal>INTERNAL</InternalExternal><Diameter>20</Diameter>\
        <FullAngle>1.5707963267948966</FullAngle><LargeEndDistance>2</LargeEndDistance><SmallEndDistance>-1</SmallEndDistance></ConeFeatureDefinition>";
    let sphere = "<SphereFeatureDefinition id=\"905\"><InternalExternal>EXTERNAL</InternalExternal><Diameter>8</Diameter></SphereFeatureDefinition>";
    let nominals = "<FeatureNominals><ConeFeatureNominal id=\"21\"><FeatureDefinitionId>904</FeatureDefinitionId><Axis><AxisPoint>1 2 3</AxisPoint>\
        <Direction>0 0 2</Direction></Axis></ConeFeatureNominal><SphereFeatureNominal id=\"22\"><FeatureDefinitionId>905</FeatureDefinitionId>\
        <Location>5 5 5</Location><LatitudeLongitudeSweep><DirNorthPole>0 0 1</DirNorthPole><DomainLatitude>0.5235987755982988 1.5707963267948966</DomainLatitude>\
        <DomainLongitude>0 6.283185307179586</DomainLongitude></LatitudeLongitudeSweep></SphereFeatureNominal>";
    let of = "<CharacteristicDefinitionId>2108</CharacteristicDefinitionId><FeatureNominalIds n=\"1\"><Id>15<";
    let profile = "<CharacteristicDefinitionId>2106</CharacteristicDefinitionId><FeatureNominalIds n=\"1\"><Id>17<";
    let profile_of_sphere = &*profile.replace(">17<", ">22<");
    let text = in_mm()
        .replace("<FeatureDefinitions>", &format!("<FeatureDefinitions>{cone}{sphere}"))
        .replace("<FeatureNominals>", nominals)
        .replace(of, &of.replace(">15<", ">21<"))
        .replace(profile, profile_of_sphere);
    let (draft, _) = drafted(&text);
    let part = part(&draft.text());
    let named = |name: &str| {
        part.features.iter().find(|f| f.name == name).map(|f| f.geometry).expect("a feature")
    };
    let Geometry::Cone { at_mm, radii_mm, length_mm, is_hole, .. } = named("cone_21") else {
        panic!("no cone");
    };
    assert!((at_mm.z - 2.0).abs() < 1e-9 && (length_mm - 3.0).abs() < 1e-9 && is_hole);
    assert!((radii_mm[0] - 9.0).abs() < 1e-6 && (radii_mm[1] - 12.0).abs() < 1e-6);
    let Geometry::Sphere { opening_rad, radius_mm, .. } = named("sphere_22") else {
        panic!("no sphere");
    };
    assert!((opening_rad.to_degrees() - 60.0).abs() < 1e-6 && (radius_mm - 4.0).abs() < 1e-9);
    // Without a small end it is pointed, 10 mm below the point; from the other pole the cap has 120°.
    let pointed = text.replace("<SmallEndDistance>-1</SmallEndDistance>", "");
    let pointed = drafted(&pointed).0.text();
    assert!(pointed.contains("at = \"1 2 -7 mm\"") && pointed.contains("\"0 24 mm\""), "{pointed}");
    let below = "<DomainLatitude>-1.5707963267948966 0.5235987755982988<";
    let below = text.replace("<DomainLatitude>0.5235987755982988 1.5707963267948966<", below);
    let below = drafted(&below).0.text();
    assert!(
        below.contains("axis = \"0 0 -1\", diameter = \"8 mm\", opening = \"120 deg\""),
        "{below}"
    );
    // What the reader of part files refuses takes its feature with it, and nothing else.
    let flat = "<CharacteristicDefinitionId>2101</CharacteristicDefinitionId><FeatureNominalIds n=\"1\"><Id>11<";
    let flat =
        text.replace(profile_of_sphere, profile).replace(flat, &flat.replace(">11<", ">22<"));
    let (found, _) = drafted(&flat);
    assert!(is_left_out(&found, "101", "flatness is not asked of a sphere"));
    assert_eq!((found.features(), found.characteristics()), (9, 16));
    assert!(found.text().contains("parallelism = \"20 um\"\nof = \"face_14\"\ndatum = \"A\""));
    assert!(found.text().contains("position = \"20 um\"\nof = \"bore_15\"\ndatum = \"A|B|C\""));
}
