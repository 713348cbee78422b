//! A plate with a bore, a counterbore and a slope, written as a QIF file in any unit.

/// An element of XML.
#[derive(Clone)]
pub struct Element {
    name: String,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Self>,
    text: String,
}

/// With these children.
pub fn e(name: &str, children: Vec<Element>) -> Element {
    Element { name: name.to_owned(), attributes: Vec::new(), children, text: String::new() }
}

/// With this text.
pub fn t(name: &str, text: &str) -> Element {
    Element { text: text.to_owned(), ..e(name, Vec::new()) }
}

/// A list of ids.
pub fn ids(name: &str, list: &[&str]) -> Element {
    e(name, list.iter().map(|id| t("Id", id)).collect()).with("n", &list.len().to_string())
}

/// How the same tree is written.
#[derive(Clone, Copy, Default)]
pub struct Style {
    pub prefix: &'static str,
    pub spaced: bool,
    pub reversed: bool,
}

/// Their order means something.
const ORDERED: [&str; 3] = ["CoEdges", "CharacteristicNominals", "FeatureNominalIds"];

impl Element {
    pub fn with(mut self, key: &'static str, value: &str) -> Self {
        self.attributes.push((key, value.to_owned()));
        self
    }

    pub fn write(&self, style: Style) -> String {
        let name = format!("{}{}", style.prefix, self.name);
        let attributes: String =
            self.attributes.iter().map(|(key, value)| format!(" {key}=\"{value}\"")).collect();
        let mut parts: Vec<String> = self.children.iter().map(|c| c.write(style)).collect();
        if style.reversed && !ORDERED.contains(&self.name.as_str()) {
            parts.reverse();
        }
        let gap = if style.spaced { "\n <!-- gap --> \t" } else { "" };
        let text = self.text.replace(' ', if style.spaced { "\n   " } else { " " });
        format!("<{name}{attributes}>{gap}{text}{}{gap}</{name}>", parts.concat())
    }
}

/// A unit of length and how many mm it is.
#[derive(Clone, Copy)]
pub struct Unit {
    pub name: &'static str,
    pub mm: f64,
}

pub const MM: Unit = Unit { name: "mm", mm: 1.0 };
pub const INCH: Unit = Unit { name: "inch", mm: 25.4 };

/// The geometry of the faces, as it grows.
struct Model {
    unit: Unit,
    sets: [Vec<Element>; 6],
    next: usize,
}

const SETS: [&str; 6] = ["PointSet", "Curve13Set", "VertexSet", "EdgeSet", "LoopSet", "FaceSet"];

impl Model {
    fn id(&mut self) -> String {
        self.next += 1;
        self.next.to_string()
    }

    fn vertex(&mut self, at_mm: [f64; 3]) -> String {
        let (point, vertex) = (self.id(), self.id());
        let at = self.unit.place(at_mm);
        self.sets[0].push(e("Point", vec![t("XYZ", &at)]).with("id", &point));
        self.sets[2].push(e("Vertex", vec![ids("Point", &[&point])]).with("id", &vertex));
        vertex
    }

    fn edge(&mut self, curve: Element, ends: [&str; 2]) -> String {
        let (id, edge) = (self.id(), self.id());
        self.sets[1].push(curve.with("id", &id));
        let parts =
            vec![ids("Curve", &[&id]), ids("VertexBeg", &[ends[0]]), ids("VertexEnd", &[ends[1]])];
        self.sets[3].push(e("Edge", parts).with("id", &edge));
        edge
    }

    fn straight(&mut self, ends: [&str; 2]) -> String {
        self.edge(e("Segment13", vec![e("Segment13Core", vec![])]), ends)
    }

    fn circle(&mut self, centre_mm: [f64; 3], radius_mm: f64) -> String {
        let [x, y, z] = centre_mm;
        let vertex = self.vertex([x + radius_mm, y, z]);
        let parts = vec![
            t("Radius", &self.unit.length(radius_mm)),
            t("Center", &self.unit.place(centre_mm)),
        ];
        let curve = e("ArcCircular13", vec![e("ArcCircular13Core", parts)]);
        self.edge(curve, [&vertex, &vertex])
    }

    fn closed(&mut self, edges: &[(String, bool)], form: &str) -> String {
        let id = self.id();
        let coedge = |(edge, turned): &(String, bool)| {
            let turned = if *turned { "true" } else { "0" };
            e("CoEdge", vec![ids("EdgeOriented", &[edge]).with("turned", turned)])
        };
        let coedges = e("CoEdges", edges.iter().map(coedge).collect());
        self.sets[4].push(e("Loop", vec![coedges]).with("id", &id).with("form", form));
        id
    }

    fn polygon(&mut self, corners_mm: &[[f64; 3]], form: &str) -> String {
        let vertices: Vec<String> = corners_mm.iter().map(|c| self.vertex(*c)).collect();
        let count = vertices.len();
        let mut edges = Vec::new();
        for k in 0..count {
            // Every other edge runs against its loop.
            let ends = [&*vertices[k], &*vertices[(k + 1) % count]];
            let turned = k % 2 == 1;
            let ends = if turned { [ends[1], ends[0]] } else { ends };
            edges.push((self.straight(ends), turned));
        }
        self.closed(&edges, form)
    }

    fn face(&mut self, loops: &[&str]) -> String {
        let id = self.id();
        self.sets[5].push(e("Face", vec![ids("LoopIds", loops)]).with("id", &id));
        id
    }

    /// A cylinder along Z between two heights, with a seam.
    fn cylinder(&mut self, centre_mm: [f64; 2], radius_mm: f64, heights_mm: [f64; 2]) -> String {
        let [x, y] = centre_mm;
        let [low, high] = heights_mm.map(|z| self.circle([x, y, z], radius_mm));
        let ends = heights_mm.map(|z| self.vertex([x + radius_mm, y, z]));
        let seam = self.straight([&ends[0], &ends[1]]);
        let round = [(low, false), (seam.clone(), false), (high, true), (seam, true)];
        let border = self.closed(&round, "OUTER");
        self.face(&[&border])
    }
}

impl Unit {
    pub fn length(self, mm: f64) -> String {
        format!("{}", mm / self.mm)
    }

    pub fn place(self, mm: [f64; 3]) -> String {
        mm.map(|c| self.length(c)).join(" ")
    }

    fn definition(self, key: &str) -> Element {
        let factor = format!("{}", self.mm / 1e3);
        let conversion = e("UnitConversion", vec![t("Factor", &factor)]);
        e(key, vec![t("SIUnitName", "meter"), t("UnitName", self.name), conversion])
    }
}

fn plane(unit: Unit, id: &str, at_mm: [f64; 3], normal: &str, face: Option<&str>) -> Element {
    let mut parts = vec![t("Name", &format!("face {id}")), t("FeatureDefinitionId", "901")];
    parts.extend(face.map(|f| ids("EntityInternalIds", &[f])));
    parts.extend([t("Location", &unit.place(at_mm)), t("Normal", normal)]);
    e("PlaneFeatureNominal", parts).with("id", id)
}

fn cylinder(unit: Unit, id: &str, definition: &str, at_mm: [f64; 3], face: &str) -> Element {
    let axis = vec![t("AxisPoint", &unit.place(at_mm)), t("Direction", "0 0 -1")];
    let parts = vec![
        t("Name", &format!("bore {id}")),
        t("FeatureDefinitionId", definition),
        ids("EntityInternalIds", &[face]),
        e("Axis", axis),
    ];
    e("CylinderFeatureNominal", parts).with("id", id)
}

/// What the drawing asks: kind, id, feature, frame, zone.
const ASKED: [(&str, &str, &str, &str, &str); 17] = [
    ("Flatness", "101", "11", "", ""),
    ("Perpendicularity", "102", "12", "51", "PlanarZone"),
    ("Parallelism", "103", "14", "51", "PlanarZone"),
    ("Angularity", "104", "17", "51", "PlanarZone"),
    ("Position", "105", "15", "53", "DiametricalZone"),
    ("SurfaceProfile", "106", "17", "53", ""),
    ("Straightness", "107", "15", "", "DiametricalZone"),
    ("Circularity", "108", "15", "", ""),
    ("Cylindricity", "109", "15", "", ""),
    ("Coaxiality", "110", "16", "54", "DiametricalZone"),
    ("CircularRunout", "111", "16", "54", ""),
    ("TotalRunout", "112", "16", "54", ""),
    ("Perpendicularity", "113", "15", "51", "DiametricalZone"),
    ("Diameter", "114", "15", "", ""),
    ("Width", "115", "31", "", ""),
    ("Straightness", "116", "16", "", "NonDiametricalZone"),
    ("Perpendicularity", "117", "31", "51", "PlanarZone"),
];

fn characteristics(unit: Unit) -> Element {
    let (mut definitions, mut nominals) = (Vec::new(), Vec::new());
    for (kind, id, feature, frame, zone) in ASKED {
        let definition = format!("2{id}");
        let mut parts = match kind {
            "Diameter" | "Width" => {
                let limits = vec![
                    t("MaxValue", &unit.length(0.025)),
                    t("MinValue", &unit.length(-0.01)),
                    t("DefinedAsLimit", "false"),
                ];
                vec![e("Tolerance", limits)]
            }
            _ => vec![
                t("StatisticalCharacteristic", "false"),
                t("ToleranceValue", &unit.length(0.02)),
            ],
        };
        if matches!(kind, "Perpendicularity" | "Parallelism" | "Angularity" | "Position") {
            parts.push(t("MaterialCondition", "NONE"));
        }
        if !frame.is_empty() {
            parts.push(t("DatumReferenceFrameId", frame));
        }
        if !zone.is_empty() {
            parts.push(e("ZoneShape", vec![e(zone, vec![])]));
        }
        let name = format!("{kind}CharacteristicDefinition");
        definitions.push(e(&name, parts).with("id", &definition));
        let mut parts = vec![
            t("CharacteristicDefinitionId", &definition),
            ids("FeatureNominalIds", &[feature]),
        ];
        if let Some(size_mm) = [("Diameter", 20.0), ("Width", 6.0)].iter().find(|k| k.0 == kind) {
            parts.push(t("TargetValue", &unit.length(size_mm.1)));
        }
        nominals.push(e(&format!("{kind}CharacteristicNominal"), parts).with("id", id));
    }
    let sets =
        vec![e("CharacteristicDefinitions", definitions), e("CharacteristicNominals", nominals)];
    e("Characteristics", sets)
}

fn frames() -> [Element; 2] {
    let datum = |(id, letter, feature): (&str, &str, &str)| {
        let parts = vec![t("DatumLabel", letter), ids("FeatureNominalIds", &[feature])];
        e("DatumDefinition", parts).with("id", id)
    };
    let letters = [("41", "A", "11"), ("42", "B", "12"), ("43", "C", "13"), ("44", "D", "15")];
    let simple = |(rank, id): (usize, &&str)| {
        let parts = vec![
            t("DatumDefinitionId", id),
            t("MaterialModifier", "NONE"),
            t("ReferencedComponent", "NOMINAL"),
        ];
        let rank = ["PRIMARY", "SECONDARY", "TERTIARY"][rank];
        let precedence = e("Precedence", vec![t("PrecedenceEnum", rank)]);
        e("Datum", vec![e("SimpleDatum", parts), precedence])
    };
    let frame = |(id, datums): (&str, &[&str])| {
        let datums = datums.iter().enumerate().map(simple).collect();
        e("DatumReferenceFrame", vec![e("Datums", datums)]).with("id", id)
    };
    let all: [(&str, &[&str]); 3] = [("51", &["41"]), ("53", &["41", "42", "43"]), ("54", &["44"])];
    [
        e("DatumDefinitions", letters.map(datum).to_vec()),
        e("DatumReferenceFrames", all.map(frame).to_vec()),
    ]
}

/// 80 x 60 x 20 mm from the corner at the zero; bore Ø 20 through its middle, counterbore Ø 30 to a depth of 5 mm.
pub fn plate(unit: Unit) -> Element {
    let mut model = Model { unit, sets: Default::default(), next: 1000 };
    let [a, b, c, d] = [[0.0, 0.0], [80.0, 0.0], [80.0, 60.0], [0.0, 60.0]];
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    let around = |z: f64| [at(a, z), at(b, z), at(c, z), at(d, z)];
    let top = model.polygon(&around(20.0), "OUTER");
    let circle = model.circle([40.0, 30.0, 20.0], 15.0);
    let hole = model.closed(&[(circle, false)], "INNER");
    let top = model.face(&[&top, &hole]);
    let bottom = model.polygon(&around(0.0), "OUTER");
    let corners = [[35.0, 20.0], [45.0, 20.0], [45.0, 40.0], [35.0, 40.0]].map(|p| at(p, 0.0));
    let window = model.polygon(&corners, "INNER");
    let bottom = model.face(&[&bottom, &window]);
    let front = model.polygon(&[at(b, 0.0), at(b, 20.0), at(a, 20.0), at(a, 0.0)], "UNKNOWN");
    let front = model.face(&[&front]);
    let left = model.polygon(&[at(d, 0.0), at(a, 0.0), at(a, 20.0), at(d, 20.0)], "OUTER");
    let left = model.face(&[&left]);
    let bore = model.cylinder([40.0, 30.0], 10.0, [0.0, 15.0]);
    let counterbore = model.cylinder([40.0, 30.0], 15.0, [15.0, 20.0]);
    // The sides of a slot of 6 mm; one is longer and deeper than the other.
    let sides =
        [(48.0, [10.0, 30.0], 10.0), (54.0, [12.0, 34.0], 8.0)].map(|(y, [from, to], low)| {
            let corners = [[from, y, low], [to, y, low], [to, y, 20.0], [from, y, 20.0]];
            let border = model.polygon(&corners, "OUTER");
            model.face(&[&border])
        });
    let middle = vec![t("Point", &unit.place([20.0, 51.0, 20.0])), t("Normal", "0 1 0")];
    let slot = vec![
        t("Name", "slot 31"),
        t("FeatureDefinitionId", "931"),
        ids("EntityInternalIds", &[&sides[0], &sides[1]]),
        e("CenterPlane", middle),
        t("LengthVector", "1 0 0"),
    ];
    let rectangle = vec![
        t("Length", &unit.length(40.0)),
        t("CornerPoint", &unit.place([20.0, 0.0, 0.0])),
        t("Width", &unit.length(20.0)),
        t("WidthDirection", "0 0.8 0.6"),
        t("LengthDirection", "1 0 0"),
    ];
    let mut slope = plane(unit, "17", [20.0, 0.0, 0.0], "0 -0.6 0.8", None);
    slope.children.push(e("Rectangle", rectangle));
    let nominals = vec![
        plane(unit, "11", [1.0, 2.0, 20.0], "0 0 1", Some(&top)),
        plane(unit, "12", [1.0, 0.0, 2.0], "0 -1 0", Some(&front)),
        plane(unit, "13", [0.0, 1.0, 2.0], "-1 0 0", Some(&left)),
        plane(unit, "14", [1.0, 2.0, 0.0], "0 0 -1", Some(&bottom)),
        cylinder(unit, "15", "902", [40.0, 30.0, 15.0], &bore),
        cylinder(unit, "16", "903", [40.0, 30.0, 20.0], &counterbore),
        slope,
        e("OppositeParallelPlanesFeatureNominal", slot).with("id", "31"),
    ];
    let round = |id: &str, mm: f64| {
        let parts = vec![t("InternalExternal", "INTERNAL"), t("Diameter", &unit.length(mm))];
        e("CylinderFeatureDefinition", parts).with("id", id)
    };
    let definitions = vec![
        e("PlaneFeatureDefinition", vec![]).with("id", "901"),
        round("902", 20.0),
        round("903", 30.0),
        e(
            "OppositeParallelPlanesFeatureDefinition",
            vec![t("InternalExternal", "INTERNAL"), t("Width", &unit.length(6.0))],
        )
        .with("id", "931"),
    ];
    let features = vec![e("FeatureDefinitions", definitions), e("FeatureNominals", nominals)];
    let [points, curves, vertices, edges, loops, faces] = model.sets;
    let set = |k: usize, list: Vec<Element>| e(SETS[k], list);
    let geometry = e("GeometrySet", vec![set(0, points), set(1, curves)]);
    let topology =
        e("TopologySet", vec![set(2, vertices), set(3, edges), set(4, loops), set(5, faces)]);
    let [definitions, references] = frames();
    let primary = e("PrimaryUnits", vec![unit.definition("LinearUnit")]);
    let other =
        e("OtherUnits", vec![MM, INCH].into_iter().map(|u| u.definition("LinearUnit")).collect());
    let sections = vec![
        e("FileUnits", vec![primary, other]),
        definitions,
        references,
        e("Product", vec![e("Header", vec![t("ScaleCoefficient", "1")]), geometry, topology]),
        e("Features", features),
        characteristics(unit),
    ];
    e("QIFDocument", sections).with("versionQIF", "3.0.0")
}
