//! The same readings in every notation give the same figures to the byte; damaged files never bring a panic.

use trueaxis_geometry::statistics::SplitMix64;
use trueaxis_input::Diagnostics;
use trueaxis_input::foreign::{Mapping, decode};
use trueaxis_standards::conditions::Conditions;
use trueaxis_standards::import::Import;
use trueaxis_standards::report::{Evaluation, EvaluationDocument};
use trueaxis_standards::{Readings, Standard, evaluate_text};

/// The document of a text, without what names the file; or the codes of what was wrong.
fn figures(
    standard: Standard,
    import: Import,
    bytes: &[u8],
    mapping: Option<&Mapping>,
) -> Result<String, Vec<String>> {
    let decoded = mapping.map_or_else(|| decode(bytes), |m| m.decode(bytes));
    let mut conditions = Conditions::default();
    conditions.circle.radius_mm = Some(150.0);
    let readings = Readings {
        standard,
        file: "f",
        text: &decoded.text,
        import,
        feature: None,
        mapping,
        conditions: &conditions,
        conditions_file: "",
        window_s: 3600.0,
    };
    let mut problems = Diagnostics::new();
    let (evaluated, conditions) = evaluate_text(&readings, &mut problems);
    let Some(evaluated) = evaluated.filter(|_| !problems.has_errors()) else {
        return Err(problems.iter().map(|d| format!("{}: {}", d.code, d.message)).collect());
    };
    let (evaluated, conditions) = (&evaluated, &conditions);
    let evaluation =
        Evaluation { standard, file: "f", conditions, evaluated, remarks: &[], judged: &[] };
    Ok(serde_json::to_string(&EvaluationDocument::of(&evaluation)).unwrap())
}

/// A decimal number as digits and the place of its point, so that it can be written in any way.
#[derive(Clone, Copy)]
struct Decimal {
    digits: i64,
    /// Digits after the point.
    places: i32,
}

impl Decimal {
    /// The number times a power of ten, with this sign between whole and fraction.
    fn text(self, shift: i32, sign: char, thousands: Option<char>) -> String {
        let places = (self.places - shift).max(0);
        let digits = self.digits.unsigned_abs() * 10_u64.pow((places - self.places + shift) as u32);
        let divisor = 10_u64.pow(places as u32);
        let mut whole = (digits / divisor).to_string();
        if let Some(separator) = thousands.filter(|_| whole.len() > 3) {
            whole.insert(whole.len() - 3, separator);
        }
        let minus = if self.digits < 0 { "-" } else { "" };
        match places {
            0 => format!("{minus}{whole}"),
            _ => {
                format!("{minus}{whole}{sign}{:0width$}", digits % divisor, width = places as usize)
            }
        }
    }
}

/// One reading: target in mm, run, direction, deviation in µm.
struct Row {
    target: Decimal,
    run: usize,
    up: bool,
    deviation: Decimal,
}

fn rows(random: &mut SplitMix64) -> Vec<Row> {
    let mut draw = |n: u64| (random.unit() * n as f64) as i64;
    let mut rows = Vec::new();
    for run in 1..=5 {
        for up in [true, false] {
            for k in 0..6 {
                let target = Decimal { digits: 2505 * k, places: 1 };
                let deviation = Decimal { digits: draw(40_001) - 20_000, places: 3 };
                rows.push(Row { target, run, up, deviation });
            }
        }
    }
    rows
}

/// How a table is written.
struct Notation {
    headings: [&'static str; 4],
    words: [&'static str; 2],
    /// Powers of ten of target and deviation from mm and µm.
    shifts: [i32; 2],
    separator: char,
    decimal: char,
    thousands: Option<char>,
    head: &'static str,
    units: Option<&'static str>,
    ending: &'static str,
    quotes: bool,
}

const NOTATIONS: [Notation; 6] = [
    Notation {
        headings: ["target_mm", "run", "direction", "deviation_um"],
        words: ["up", "down"],
        shifts: [0, 0],
        separator: ',',
        decimal: '.',
        thousands: None,
        head: "",
        units: None,
        ending: "\n",
        quotes: false,
    },
    Notation {
        headings: ["Sollposition [mm]", "Lauf", "Fahrtrichtung", "Abweichung [µm]"],
        words: ["Vorwärts", "Rückwärts"],
        shifts: [0, 0],
        separator: ';',
        decimal: ',',
        thousands: Some('.'),
        head: "Prüfling;Fräsmaschine 3\r\nDatum;24.11.2026\r\n\r\n",
        units: None,
        ending: "\r\n",
        quotes: false,
    },
    Notation {
        headings: ["目标位置", "次数", "方向", "偏差"],
        words: ["正向", "反向"],
        shifts: [0, -3],
        separator: '\t',
        decimal: '.',
        thousands: None,
        head: "机床\t立式加工中心\n",
        units: Some("(毫米)\t\t\t(毫米)"),
        ending: "\n",
        quotes: false,
    },
    Notation {
        headings: ["Position cible (m)", "Passage", "Sens", "Écart (nm)"],
        words: ["aller", "retour"],
        shifts: [-3, 3],
        separator: ';',
        decimal: ',',
        thousands: Some('\u{a0}'),
        head: "",
        units: None,
        ending: "\n",
        quotes: true,
    },
    Notation {
        headings: ["Posizione nominale, mm", "Ciclo", "Senso", "Scostamento, mm"],
        words: ["andata", "ritorno"],
        shifts: [0, -3],
        separator: '|',
        decimal: ',',
        thousands: None,
        head: "# laser\n",
        units: None,
        ending: "\n",
        quotes: false,
    },
    Notation {
        headings: ["Target Position (mm)", "Run No.", "Direction", "Error (microns)"],
        words: ["+", "-"],
        shifts: [0, 0],
        separator: ',',
        decimal: '.',
        thousands: Some(','),
        head: "Machine,\"Mill, large\"\nDate,2026-11-24\n",
        units: None,
        ending: "\n",
        quotes: true,
    },
];

impl Notation {
    fn write(&self, rows: &[Row], order: &[usize]) -> String {
        let separator = self.separator.to_string();
        let quoted = |cell: String| if self.quotes { format!("\"{cell}\"") } else { cell };
        let line = |cells: [String; 4]| cells.map(quoted).join(&separator) + self.ending;
        let mut text = self.head.to_owned() + &line(self.headings.map(str::to_owned));
        text += &self.units.map_or(String::new(), |units| units.to_owned() + self.ending);
        for row in order.iter().map(|i| &rows[*i]) {
            let [target, deviation] = self.shifts;
            text += &line([
                row.target.text(target, self.decimal, self.thousands),
                row.run.to_string(),
                self.words[usize::from(!row.up)].to_owned(),
                row.deviation.text(deviation, self.decimal, self.thousands),
            ]);
        }
        text
    }
}

/// The text in every encoding that has its letters.
fn encoded(text: &str) -> Vec<Vec<u8>> {
    let utf_16 = |big: bool| -> Vec<u8> {
        let units = std::iter::once(0xFEFF).chain(text.encode_utf16());
        units.flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    };
    let marked = format!("\u{feff}{text}").into_bytes();
    let mut all = vec![text.as_bytes().to_vec(), marked, utf_16(false), utf_16(true)];
    for encoding in [encoding_rs::WINDOWS_1252, encoding_rs::GBK] {
        let (bytes, _, unmappable) = encoding.encode(text);
        // GBK has the letters of German and French too, but such files are western ones.
        let is_likely = encoding == encoding_rs::WINDOWS_1252 || text.contains('机');
        if !unmappable && is_likely {
            all.push(bytes.into_owned());
        }
    }
    all
}

fn shuffled(count: usize, random: &mut SplitMix64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        order.swap(i, (random.unit() * (i + 1) as f64) as usize % (i + 1));
    }
    order
}

#[test]
fn law_every_notation_of_the_same_readings_gives_the_same_bytes() {
    let mut random = SplitMix64::new(20_261_124);
    for _ in 0..20 {
        let rows = rows(&mut random);
        let plain: Vec<usize> = (0..rows.len()).collect();
        let expected = figures(
            Standard::Iso230_2,
            Import::Csv,
            NOTATIONS[0].write(&rows, &plain).as_bytes(),
            None,
        )
        .unwrap();
        for notation in &NOTATIONS {
            let order = shuffled(rows.len(), &mut random);
            let text = notation.write(&rows, &order);
            for bytes in encoded(&text) {
                let found = figures(Standard::Iso230_2, Import::Csv, &bytes, None);
                assert_eq!(found.as_ref(), Ok(&expected), "{text}");
            }
        }
    }
}

/// The same by a mapping file, where no heading is understood; and as a laser file.
#[test]
fn law_a_mapping_and_a_laser_file_give_the_same_bytes_as_the_table() {
    let mut random = SplitMix64::new(7);
    let rows = rows(&mut random);
    let plain: Vec<usize> = (0..rows.len()).collect();
    let expected = figures(
        Standard::Iso230_2,
        Import::Csv,
        NOTATIONS[0].write(&rows, &plain).as_bytes(),
        None,
    );
    let strange = Notation {
        headings: ["p1", "n", "way", "e*10^6"],
        words: ["hin & vor", "heim"],
        shifts: [-3, 3],
        ..NOTATIONS[1]
    };
    let mapping = "separator = ';'\ndecimal = ','\nthousands = '.'\nskip_rows = 3\n\
        [columns.target]\ncolumn = 'p1'\nunit = 'm'\n[columns.run]\ncolumn = 2\n\
        [columns.direction]\ncolumn = 'way'\nwords = { up = 'hin & vor', down = ['heim'] }\n\
        [columns.deviation]\ncolumn = 4\nunit = 'nm'\n";
    let (mapping, problems) = Mapping::parse("m.toml", mapping);
    assert!(!problems.has_errors(), "{problems:?}");
    let order = shuffled(rows.len(), &mut random);
    let text = strange.write(&rows, &order);
    let found = figures(Standard::Iso230_2, Import::Csv, text.as_bytes(), mapping.as_ref());
    assert_eq!(found, expected);

    let mut laser = "HEADER::\nTARGET DATA::\nTarget-count: 6\nTargets :\n".to_owned();
    let targets: Vec<String> = (0..6).map(|k| rows[k].target.text(0, '.', None)).collect();
    laser += &(targets.join("  ") + "\nFlags: 0 0 2 0\n\nDEVIATIONS::\nRun Target Data:\n");
    for (i, pass) in rows.chunks(6).enumerate() {
        let way = |k: usize| if pass[0].up { k } else { 5 - k };
        for k in (0..6).map(way) {
            laser += &format!("{}   {}  {}\n", i + 1, k + 1, pass[k].deviation.text(0, '.', None));
        }
    }
    let laser = laser + "EOF::\n";
    assert_eq!(figures(Standard::Iso230_2, Import::RenishawRtl, laser.as_bytes(), None), expected);
}

#[test]
fn law_circles_in_every_notation_give_the_same_bytes() {
    let mut random = SplitMix64::new(3);
    let mut tables = [
        "angle_deg,deviation_um,direction\n".to_owned(),
        "Winkel [°];radiale Abweichung [mm];Drehrichtung\n".to_owned(),
        "角度\t径向偏差\t旋转方向\n(度)\t(微米)\t\n".to_owned(),
    ];
    let words = [["ccw", "cw"], ["Gegenuhrzeigersinn", "im Uhrzeigersinn"], ["逆时针", "顺时针"]];
    for (way, sign) in [(0, 1), (1, -1)] {
        for k in 0..=360 {
            let angle = Decimal { digits: 10 * (sign * k + 360 * i64::from(sign < 0)), places: 1 };
            let error = Decimal { digits: (random.unit() * 9000.0) as i64 - 4500, places: 3 };
            let cells = |angle_sign, shift, sign| {
                (angle.text(0, angle_sign, None), error.text(shift, sign, None))
            };
            let (a, d) = cells('.', 0, '.');
            tables[0] += &format!("{a},{d},{}\n", words[0][way]);
            let (a, d) = cells(',', -3, ',');
            tables[1] += &format!("{a};{d};{}\n", words[1][way]);
            let (a, d) = cells('.', 0, '.');
            tables[2] += &format!("{a}\t{d}\t{}\n", words[2][way]);
        }
    }
    let of = |text: &str| figures(Standard::Iso230_4, Import::Csv, text.as_bytes(), None);
    let expected = of(&tables[0]);
    assert!(expected.is_ok(), "{expected:?}");
    assert_eq!(of(&tables[1]), expected);
    assert_eq!(of(&tables[2]), expected);
}

/// Bytes changed, left out, doubled and cut off at random: an answer or an error, never a panic.
#[test]
fn law_damaged_files_never_panic() {
    let mut random = SplitMix64::new(11);
    let rows = rows(&mut random);
    let order: Vec<usize> = (0..rows.len()).collect();
    let mut sources: Vec<(Import, Vec<u8>)> = Vec::new();
    for notation in &NOTATIONS {
        sources.extend(
            encoded(&notation.write(&rows[..12], &order[..12]))
                .into_iter()
                .map(|b| (Import::Csv, b)),
        );
    }
    let laser = "TARGET DATA::\r\nTarget-count: 2\r\nTargets :\r\n0.0 1.0\r\nFlags: 0 1 2 0\r\nDEVIATIONS::\r\n\
        Run Target Data:\r\n1 1 0.1\r\n1 2 0.3\r\n2 2 0\r\n2 1 0\r\nEOF::\r\n";
    sources.push((Import::RenishawRtl, laser.as_bytes().to_vec()));
    let mapping = "separator = ';'\nskip_rows = 2\n[columns.target]\ncolumn = 1\nunit = 'm'\n\
        [columns.run]\ncolumn = 2\n[columns.direction]\ncolumn = 3\n[columns.deviation]\ncolumn = 4\nunit = 'mm'\n";
    let mapping = Mapping::parse("m.toml", mapping).0;
    let pick = |random: &mut SplitMix64, n: usize| (random.unit() * n as f64) as usize % n.max(1);
    let special = b"\0;,.\t|\"-+eE:\n\r#0\xff\xb5\xfe";
    for round in 0..6000 {
        let (import, source) = &sources[round % sources.len()];
        let mut bytes = source.clone();
        for _ in 0..=pick(&mut random, 6) {
            if bytes.is_empty() {
                break;
            }
            let at = pick(&mut random, bytes.len());
            match pick(&mut random, 5) {
                0 => bytes[at] = special[pick(&mut random, special.len())],
                1 => bytes[at] = pick(&mut random, 256) as u8,
                2 => drop(bytes.remove(at)),
                3 => bytes.insert(at, special[pick(&mut random, special.len())]),
                _ => bytes.truncate(at),
            }
        }
        let standard = Standard::ALL[pick(&mut random, Standard::ALL.len())];
        let mapping = mapping.as_ref().filter(|_| round % 3 == 0);
        let _ = figures(standard, *import, &bytes, mapping);
    }
}
