//! QIF 3 (ISO 23952): the measured points of a circle as the points of a circular test.

use super::{Beside, Imported};
use crate::Standard;
use crate::conditions::Circle;
use roxmltree::{Document, Node, ParsingOptions};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use trueaxis_geometry::Vec3;
use trueaxis_input::{Diagnostics, Place};

/// A tree of more nodes than this is no measurement.
const MOST_NODES: u32 = 20_000_000;
/// A circle of more points than this names a set of them again and again.
const MOST_POINTS: usize = 2_000_000;
/// Points further from the plane of their circle than this share of its radius are another feature.
const FLAT: f64 = 0.05;

/// Points with the lines on which they are.
type Lined = Vec<(usize, Vec3)>;

/// A circle with everything that the file states about it.
struct MeasuredValue {
    name: String,
    points_mm: Lined,
    centre_mm: Option<Vec3>,
    normal: Vec3,
    radius_mm: Option<f64>,
    /// How far the touched points lie outside of the probe centres; none where they are corrected.
    probe_mm: Option<f64>,
    /// INTERNAL or EXTERNAL, where stated.
    internal: Option<bool>,
}

pub(super) fn read(
    standard: Standard,
    file: &str,
    text: &str,
    feature: Option<&str>,
    problems: &mut Diagnostics,
) -> Option<Imported<'static>> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = match Document::parse_with_options(text, options) {
        Ok(document) => document,
        Err(e) => {
            let at = e.pos();
            let place =
                Place { file: file.to_owned(), line: at.row as usize, column: at.col as usize };
            problems.error("bad-xml", place, e.to_string(), "a QIF 3 file is XML as UTF-8");
            return None;
        }
    };
    let reader = Reader::new(&document, file);
    let root = document.root_element();
    if root.tag_name().name() != "QIFDocument" {
        let message = format!("`{}` is no QIF document", root.tag_name().name());
        problems.error("not-qif", reader.place(root), message, "it begins with <QIFDocument>");
        return None;
    }
    if standard != Standard::Iso230_4 {
        let message = format!(
            "QIF points have no {}, which {} needs; the file has {}",
            lacking(standard),
            standard.key(),
            reader.inventory()
        );
        let hint = "its circles can be evaluated by iso230-4; write other readings as CSV";
        problems.error("no-such-readings", Place::whole(file), message, hint);
        return None;
    }
    let node = reader.choose(feature, problems)?;
    let unit_mm = reader.unit_mm(problems)?;
    let circle = reader.circle(node, unit_mm, problems)?;
    flatten(&circle, file, problems)
}

/// The readings that a standard needs and a QIF file cannot contain.
fn lacking(standard: Standard) -> &'static str {
    match standard {
        Standard::Iso230_3 => "times",
        Standard::Iso230_6 => "targets and runs along a diagonal, no directions of approach",
        Standard::Iso230_7 => "angles of a turning axis",
        _ => "target positions of an axis, no runs and no directions of approach",
    }
}

/// The nodes of a document by their id.
struct Reader<'d, 't> {
    document: &'d Document<'t>,
    file: &'d str,
    ids: BTreeMap<&'d str, Node<'d, 't>>,
}

impl<'d, 't> Reader<'d, 't> {
    fn new(document: &'d Document<'t>, file: &'d str) -> Self {
        let with_id = document.descendants().filter_map(|n| Some((n.attribute("id")?, n)));
        Self { document, file, ids: with_id.collect() }
    }

    fn place(&self, node: Node<'_, '_>) -> Place {
        let at = self.document.text_pos_at(node.range().start);
        Place { file: self.file.to_owned(), line: at.row as usize, column: at.col as usize }
    }

    fn measurements(&self, kind: &str) -> impl Iterator<Item = Node<'d, 't>> {
        // The word is Measurement in QIF 3, Actual in QIF 2.
        let names = [format!("{kind}FeatureMeasurement"), format!("{kind}FeatureActual")];
        self.document
            .descendants()
            .filter(move |n| names.iter().any(|name| n.has_tag_name(&**name)))
    }

    /// `3 circles, 2 planes`.
    fn inventory(&self) -> String {
        let kinds = ["Circle", "Plane", "Cylinder", "Line", "Point", "Sphere", "Cone"];
        let counted = kinds.iter().filter_map(|kind| {
            let count = self.measurements(kind).count();
            let plural = if count == 1 { "" } else { "s" };
            (count > 0).then(|| format!("{count} {}{plural}", kind.to_lowercase()))
        });
        let counted: Vec<String> = counted.collect();
        match counted.is_empty() {
            true => "no measured feature of a supported kind".to_owned(),
            false => counted.join(", "),
        }
    }

    /// What an element of that name below refers to.
    fn follow(&self, node: Node<'d, 't>, name: &str) -> Option<Node<'d, 't>> {
        self.ids.get(text_of(node, name)?.trim()).copied()
    }

    /// The name of the feature in text output.
    fn name(&self, node: Node<'d, 't>) -> String {
        let item = self.follow(node, "FeatureItemId");
        let name = item.and_then(|i| text_of(i, "FeatureName")).unwrap_or_default().trim();
        match name {
            "" => format!("id {}", node.attribute("id").unwrap_or("?")),
            name => name.to_owned(),
        }
    }

    fn choose(&self, feature: Option<&str>, problems: &mut Diagnostics) -> Option<Node<'d, 't>> {
        let mut circles: Vec<_> = self.measurements("Circle").collect();
        // Without points there is nothing to evaluate.
        circles.retain(|c| c.descendants().any(|n| n.tag_name().name().ends_with("PointSetId")));
        let names: Vec<String> = circles.iter().map(|c| self.name(*c)).collect();
        let mut refuse = |code, message: String, hint: &str| {
            problems.error(code, Place::whole(self.file), message, hint);
        };
        if circles.is_empty() {
            let message = format!("no circle with its points; the file has {}", self.inventory());
            let hint = "iso230-4 needs the measured points of a circle (CircleFeatureMeasurement with \
                        a PointList)";
            refuse("no-circle", message, hint);
            return None;
        }
        let hint = format!("--feature \"{}\"; there are {}", names[0], names.join(", "));
        match (feature, &circles[..]) {
            (None, [one]) => Some(*one),
            (None, _) => {
                let message = format!("which of the {} circles?", circles.len());
                refuse("which-feature", message, &hint);
                None
            }
            (Some(wanted), _) => {
                let wanted = wanted.trim();
                let is = |(name, node): &(&String, &Node<'_, '_>)| {
                    **name == wanted || node.attribute("id") == Some(wanted)
                };
                let found = names.iter().zip(&circles).find(is).map(|(_, node)| *node);
                if found.is_none() {
                    let message = format!("there is no circle `{wanted}` with points");
                    refuse("unknown-feature", message, &hint);
                }
                found
            }
        }
    }

    /// How long the unit of the file is.
    fn unit_mm(&self, problems: &mut Diagnostics) -> Option<f64> {
        let unit = self.document.descendants().find(|n| n.has_tag_name("LinearUnit"));
        let Some(unit) = unit else {
            let message = "the file does not state its unit of length".to_owned();
            let hint = "expected <FileUnits><PrimaryUnits><LinearUnit>";
            problems.error("missing-unit", Place::whole(self.file), message, hint);
            return None;
        };
        let base = text_of(unit, "SIUnitName").unwrap_or_default().trim();
        let factor = match unit.descendants().any(|n| n.has_tag_name("Factor")) {
            true => text_of(unit, "Factor").and_then(|t| t.trim().parse::<f64>().ok()),
            // Without a conversion the unit is the metre itself.
            false => Some(1.0),
        };
        let factor = factor.filter(|f| f.is_finite() && *f > 0.0 && *f < 1e6);
        match (base, factor) {
            ("meter" | "metre", Some(factor)) => Some(factor * 1e3),
            _ => {
                let message = "the unit of length is not given by the metre".to_owned();
                let hint = "expected <SIUnitName>meter</SIUnitName> with a positive <Factor>";
                problems.error("unknown-unit", self.place(unit), message, hint);
                None
            }
        }
    }

    fn circle(
        &self,
        node: Node<'d, 't>,
        unit_mm: f64,
        problems: &mut Diagnostics,
    ) -> Option<MeasuredValue> {
        let item = self.follow(node, "FeatureItemId");
        let nominal = item.and_then(|n| self.follow(n, "FeatureNominalId"));
        let definition = nominal.and_then(|n| self.follow(n, "FeatureDefinitionId"));
        let vector = |n: Node<'_, '_>, name| vector(text_of(n, name)?);
        let direction =
            nominal.and_then(|n| vector(n, "Normal")).or_else(|| vector(node, "Normal"));
        let diameter = definition.and_then(|d| text_of(d, "Diameter")?.trim().parse::<f64>().ok());
        let internal = definition.and_then(|d| match text_of(d, "InternalExternal")?.trim() {
            "INTERNAL" => Some(true),
            "EXTERNAL" => Some(false),
            _ => None,
        });
        let (points, probe) = self.points(node, problems)?;
        let normal = direction.and_then(|v| v.try_normalize(1e-9));
        let Some(normal) = normal else {
            let message = "the circle has no normal".to_owned();
            problems.error("missing-normal", self.place(node), message, "<Normal>0 0 1</Normal>");
            return None;
        };
        Some(MeasuredValue {
            name: self.name(node),
            points_mm: points.into_iter().map(|(line, p)| (line, p * unit_mm)).collect(),
            centre_mm: nominal.and_then(|n| vector(n, "Location")).map(|c| c * unit_mm),
            normal,
            radius_mm: diameter.map(|d| 0.5 * d * unit_mm).filter(|r| *r > 0.0 && r.is_finite()),
            probe_mm: probe.map(|p| p * unit_mm),
            internal,
        })
    }

    /// The points of a feature with their lines, and the radius of the probe if they are its centres.
    fn points(
        &self,
        node: Node<'d, 't>,
        problems: &mut Diagnostics,
    ) -> Option<(Lined, Option<f64>)> {
        let mut points = Vec::new();
        let mut probes = Vec::new();
        let mut sets = BTreeMap::new();
        for reference in node.descendants().filter(|n| n.tag_name().name().ends_with("PointSetId"))
        {
            let set = self.ids.get(reference.text().unwrap_or_default().trim()).copied();
            let Some(set) = set else {
                let message = "the points that the circle names are not in the file".to_owned();
                let hint = "expected a MeasuredPointSet with that id";
                problems.error("missing-points", self.place(reference), message, hint);
                return None;
            };
            if let Entry::Vacant(entry) = sets.entry(set.id().get()) {
                entry.insert(self.point_set(set, problems)?);
            }
            let all = &sets[&set.id().get()];
            let (from, to) = range(reference, all.len());
            points.extend_from_slice(all.get(from..to).unwrap_or_default());
            if points.len() > MOST_POINTS {
                let message = format!("the circle has more than {MOST_POINTS} points");
                let hint = "does it name a set of points many times?";
                problems.error("too-many-points", self.place(node), message, hint);
                return None;
            }
            let corrected = text_of(set, "Compensated").is_none_or(|t| t.trim() == "true");
            let radius = text_of(set, "ProbeRadius").and_then(|t| t.trim().parse::<f64>().ok());
            probes.push(radius.filter(|r| !corrected && r.is_finite() && *r > 0.0));
        }
        if probes.windows(2).any(|w| w[0] != w[1]) {
            let message = "the points of the circle were taken with different probes".to_owned();
            problems.error("mixed-probes", self.place(node), message, "evaluate them one by one");
            return None;
        }
        Some((points, probes.first().copied().flatten()))
    }

    fn point_set(&self, set: Node<'d, 't>, problems: &mut Diagnostics) -> Option<Lined> {
        let mut points = Vec::new();
        let points_of = set.children().find(|n| n.has_tag_name("Points"));
        let texts = points_of.into_iter().flat_map(|p| p.children().filter(|n| n.is_text()));
        let mut numbers = Vec::new();
        for text in texts {
            let first = self.document.text_pos_at(text.range().start).row as usize;
            for (i, line) in text.text().unwrap_or_default().lines().enumerate() {
                for word in line.split_whitespace() {
                    let Some(number) = word.parse::<f64>().ok().filter(|v| v.is_finite()) else {
                        let place =
                            Place { file: self.file.to_owned(), line: first + i, column: 1 };
                        let message = format!("`{word}` is not a finite number");
                        problems.error("not-a-number", place, message, "x y z of each point");
                        return None;
                    };
                    numbers.push(number);
                    if let [x, y, z] = numbers[..] {
                        points.push((first + i, Vec3::new(x, y, z)));
                        numbers.clear();
                    }
                }
            }
        }
        if !numbers.is_empty() || points.is_empty() {
            let message = format!("{} points and {} numbers more", points.len(), numbers.len());
            problems.error("bad-points", self.place(set), message, "x y z of each point");
            return None;
        }
        Some(points)
    }
}

/// Which points of a set are meant: all, a range "3 8" or one index, from 1.
fn range(reference: Node<'_, '_>, count: usize) -> (usize, usize) {
    let number = |t: &str| t.parse::<usize>().ok().filter(|n| *n > 0);
    if let Some(index) = reference.attribute("index").and_then(number) {
        return (index - 1, index);
    }
    let ends = reference.attribute("range").map(|r| r.split_whitespace().filter_map(number));
    match ends.map(Iterator::collect::<Vec<_>>).as_deref() {
        Some([from, to]) => (from - 1, *to),
        _ => (0, count),
    }
}

fn text_of<'d>(node: Node<'d, '_>, name: &str) -> Option<&'d str> {
    node.descendants().find(|n| n.has_tag_name(name))?.text()
}

fn vector(text: &str) -> Option<Vec3> {
    let numbers = text.split_whitespace().map(|w| w.parse::<f64>().ok().filter(|v| v.is_finite()));
    match numbers.collect::<Option<Vec<f64>>>()?[..] {
        [x, y, z] => Some(Vec3::new(x, y, z)),
        _ => None,
    }
}

/// The points in the plane of the circle, and its nominal circle.
fn flatten(
    circle: &MeasuredValue,
    file: &str,
    problems: &mut Diagnostics,
) -> Option<Imported<'static>> {
    let place = Place::whole(file);
    let (across, up, names) = plane(circle.normal);
    let centre = circle.centre_mm.map(|c| [across.dot(&c), up.dot(&c)]);
    let flat = |p: &Vec3| [across.dot(p), up.dot(p)];
    let heights = circle.points_mm.iter().map(|(_, p)| circle.normal.dot(p));
    let (low, high) =
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
    let points: Vec<[f64; 2]> = circle.points_mm.iter().map(|(_, p)| flat(p)).collect();
    let fitted = trueaxis_form::circle::least_squares(&points);
    let Ok(fitted) = fitted else {
        let message = format!("no circle through the {} points of {}", points.len(), circle.name);
        problems.error("no-circle", place, message, "at least three different points, all around");
        return None;
    };
    if high - low > FLAT * fitted.radius_mm {
        let message = format!(
            "the points of {} lie up to {:.3} mm apart along its normal",
            circle.name,
            high - low
        );
        let hint = "are they of a cylinder? they are evaluated as seen along the normal";
        problems.warn("not-flat", place.clone(), message, hint);
    }
    let message = format!(
        "{}: {} points touched on a feature of a part, not a path of the machine",
        circle.name,
        points.len()
    );
    let hint = "G is the roundness of the feature (least squares); direction and causes of a machine \
                need a circular test";
    problems.note("feature-points", place.clone(), message, hint);
    let outward_mm = probe_correction(circle, fitted.radius_mm, &place, problems);
    let heading = format!("{}_mm,{}_mm", names[0], names[1]);
    let mut table = Beside::default();
    table.row(1, &heading);
    let middle = fitted.center_mm;
    for ((line, _), [x, y]) in circle.points_mm.iter().zip(&points) {
        // The probe's centre, moved along the radius onto the touched surface.
        let (dx, dy) = (x - middle[0], y - middle[1]);
        let stretch = outward_mm / dx.hypot(dy).max(f64::MIN_POSITIVE);
        table.row(*line, &format!("{},{}", x + dx * stretch, y + dy * stretch));
    }
    let nominal = Circle { centre_mm: centre, radius_mm: circle.radius_mm, ..Circle::default() };
    let table = Cow::Owned(table.into_text());
    Some(Imported { table, circle: nominal, of_a_part: true, ..Imported::default() })
}

/// How far outward the touched points lie of those in the file, mm.
fn probe_correction(
    circle: &MeasuredValue,
    radius_mm: f64,
    place: &Place,
    problems: &mut Diagnostics,
) -> f64 {
    let Some(probe_mm) = circle.probe_mm else { return 0.0 };
    let off = |outward: f64| circle.radius_mm.map(|r| (radius_mm + outward - r).abs());
    let (internal, why) = match (circle.internal, off(probe_mm).zip(off(-probe_mm))) {
        (Some(internal), _) => (internal, "as the file states"),
        (None, Some((hole, boss))) => (hole <= boss, "so it comes nearer to the nominal diameter"),
        (None, None) => {
            let message = format!("{} is not stated to be a hole or a boss", circle.name);
            let hint =
                "the points remain at the centres of the probe: G is valid, the radius is not";
            problems.warn("unknown-side", place.clone(), message, hint);
            return 0.0;
        }
    };
    let (kind, sign) = if internal { ("hole", 1.0) } else { ("boss", -1.0) };
    let message = format!(
        "{}: the points are probe centres; moved {:.4} mm onto the surface of a {kind}, {why}",
        circle.name, probe_mm
    );
    problems.note("probe-radius", place.clone(), message, "");
    sign * probe_mm
}

/// Two directions of the plane across a normal, and the names of the axes that they are nearest to.
fn plane(normal: Vec3) -> (Vec3, Vec3, [&'static str; 2]) {
    let main = normal.iamax();
    let (first, names) = match main {
        0 => (Vec3::y(), ["y", "z"]),
        1 => (Vec3::x(), ["x", "z"]),
        _ => (Vec3::x(), ["x", "y"]),
    };
    let across = (first - normal * normal.dot(&first)).normalize();
    let up = normal.cross(&across);
    // The second name rises with its axis, whatever the direction of the normal.
    let second = if main == 2 { Vec3::y() } else { Vec3::z() };
    (across, up * up.dot(&second).signum(), names)
}
