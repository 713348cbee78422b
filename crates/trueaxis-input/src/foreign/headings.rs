//! Headings and words of other languages and programs: what a column is, and in which unit.

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Holds {
    /// Numbers of the size of a machine: positions, radii.
    Large,
    /// Numbers of the size of an error.
    Small,
    /// Numbers without a unit: runs.
    Count,
    /// Words that name a direction.
    Direction,
    /// Words that are left as they are.
    Word,
}

/// A heading that was understood.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Heading {
    /// Our name without the unit: `target`, `up_1`.
    pub role: String,
    /// The unit by our name; `None` where the heading has none.
    pub unit: Option<&'static str>,
    pub holds: Holds,
    /// Understood, but another word says the same more clearly (`position` beside `target`).
    pub is_weak: bool,
}

/// Our name, what it holds, and the words for it: English, German, Chinese, French, Italian.
const ROLES: &[(&str, Holds, &[&str])] = &[
    (
        "target",
        Holds::Large,
        &[
            "target",
            "target position",
            "nominal",
            "nominal position",
            "command",
            "commanded position",
            "soll",
            "sollposition",
            "soll position",
            "sollwert",
            "zielposition",
            "ziel",
            "目标",
            "目标位置",
            "目标点",
            "名义位置",
            "理论位置",
            "指令位置",
            "cible",
            "position cible",
            "position nominale",
            "posizione nominale",
            "posizione target",
            "obiettivo",
        ],
    ),
    (
        "actual",
        Holds::Large,
        &[
            "actual",
            "actual position",
            "measured",
            "measured position",
            "ist",
            "istposition",
            "ist position",
            "istwert",
            "messwert",
            "实际位置",
            "实测位置",
            "测量值",
            "实测值",
            "position réelle",
            "position mesurée",
            "posizione reale",
            "posizione misurata",
        ],
    ),
    (
        "deviation",
        Holds::Small,
        &[
            "deviation",
            "error",
            "positioning error",
            "position error",
            "radial deviation",
            "abweichung",
            "positionsabweichung",
            "radiale abweichung",
            "radialabweichung",
            "fehler",
            "positionsfehler",
            "偏差",
            "误差",
            "定位误差",
            "位置偏差",
            "位置误差",
            "径向偏差",
            "半径偏差",
            "écart",
            "écart radial",
            "erreur",
            "scostamento",
            "scostamento radiale",
            "errore",
            "deviazione",
        ],
    ),
    (
        "run",
        Holds::Count,
        &[
            "run",
            "run no",
            "run number",
            "cycle",
            "lauf",
            "messlauf",
            "durchlauf",
            "zyklus",
            "laufnummer",
            "lauf nr",
            "次数",
            "循环",
            "测量次数",
            "测量序号",
            "passage",
            "ciclo",
            "corsa",
            "passata",
        ],
    ),
    (
        "direction",
        Holds::Direction,
        &[
            "direction",
            "sense",
            "richtung",
            "fahrtrichtung",
            "anfahrrichtung",
            "drehsinn",
            "drehrichtung",
            "方向",
            "旋转方向",
            "运动方向",
            "测量方向",
            "sens",
            "sens de rotation",
            "direzione",
            "senso",
            "senso di rotazione",
        ],
    ),
    ("angle", Holds::Large, &["angle", "winkel", "角度", "angolo", "polar angle", "polarwinkel"]),
    (
        "radius",
        Holds::Large,
        &[
            "radius",
            "measured radius",
            "radius measured",
            "length",
            "bar length",
            "halbmesser",
            "gemessener radius",
            "半径",
            "实测半径",
            "rayon",
            "raggio",
        ],
    ),
    ("x", Holds::Large, &["x", "x position", "position x", "x坐标", "posizione x"]),
    ("y", Holds::Large, &["y", "y position", "position y", "y坐标", "posizione y"]),
    ("z", Holds::Large, &["z", "z position", "position z", "z坐标", "posizione z"]),
    ("time", Holds::Large, &["time", "zeit", "时间", "temps", "tempo"]),
    (
        "temperature",
        Holds::Large,
        &["temperature", "temperatur", "温度", "température", "temperatura"],
    ),
    ("diagonal", Holds::Word, &["diagonal", "diagonale", "对角线"]),
];

/// These mean the target only where nothing else does.
const WEAK_TARGETS: [&str; 6] =
    ["position", "pos", "posizione", "位置", "achsposition", "axis position"];

/// Directions by our words.
const DIRECTIONS: &[(&str, &[&str])] = &[
    (
        "up",
        &[
            "up",
            "+",
            "1",
            "+1",
            "↑",
            "forward",
            "fwd",
            "positive",
            "rising",
            "vorwärts",
            "vor",
            "auf",
            "aufwärts",
            "steigend",
            "hin",
            "positiv",
            "正",
            "正向",
            "去程",
            "前进",
            "avant",
            "aller",
            "positif",
            "avanti",
            "andata",
            "positivo",
        ],
    ),
    (
        "down",
        &[
            "down",
            "-",
            "-1",
            "↓",
            "backward",
            "reverse",
            "rev",
            "bwd",
            "negative",
            "falling",
            "rückwärts",
            "rück",
            "ab",
            "abwärts",
            "fallend",
            "zurück",
            "negativ",
            "负",
            "反",
            "反向",
            "负向",
            "回程",
            "后退",
            "arrière",
            "retour",
            "négatif",
            "indietro",
            "ritorno",
            "negativo",
        ],
    ),
    (
        "ccw",
        &[
            "ccw",
            "g3",
            "g03",
            "counter clockwise",
            "counterclockwise",
            "anticlockwise",
            "anti clockwise",
            "gegen den uhrzeigersinn",
            "gegenuhrzeigersinn",
            "im gegenuhrzeigersinn",
            "逆时针",
            "逆时针方向",
            "antihoraire",
            "sens antihoraire",
            "antiorario",
        ],
    ),
    (
        "cw",
        &[
            "cw",
            "g2",
            "g02",
            "clockwise",
            "im uhrzeigersinn",
            "uhrzeigersinn",
            "顺时针",
            "顺时针方向",
            "horaire",
            "sens horaire",
            "orario",
        ],
    ),
];

/// Units by our name and the spellings of others.
const UNITS: &[(&str, &[&str])] = &[
    ("mm", &["mm", "millimeter", "millimetre", "毫米"]),
    (
        "um",
        &["um", "µm", "μm", "micron", "microns", "mikrometer", "micrometer", "micrometre", "微米"],
    ),
    ("nm", &["nm", "nanometer", "纳米"]),
    ("cm", &["cm"]),
    ("m", &["m"]),
    ("in", &["in", "inch", "inches", "zoll", "pouce", "英寸"]),
    ("deg", &["deg", "°", "degree", "degrees", "grad", "度", "degré", "gradi"]),
    ("arcmin", &["arcmin", "′", "角分", "winkelminuten"]),
    ("arcsec", &["arcsec", "″", "''", "\"", "sec of arc", "winkelsekunden", "角秒", "arcseconds"]),
    ("rad", &["rad", "弧度"]),
    ("mrad", &["mrad", "mm/m", "毫弧度"]),
    ("urad", &["urad", "µrad", "μrad", "um/m", "µm/m", "μm/m", "微弧度"]),
    ("s", &["s", "sec", "seconds", "sek", "秒"]),
    ("ms", &["ms", "毫秒"]),
    ("min", &["min", "分钟"]),
    ("h", &["h", "std", "小时"]),
    ("degC", &["degc", "°c", "℃", "摄氏度", "grad c"]),
];

/// A unit by our name.
pub(super) fn unit_named(text: &str) -> Option<&'static str> {
    let text = text.trim().to_lowercase();
    UNITS.iter().find(|(_, all)| all.contains(&text.as_str())).map(|(name, _)| *name)
}

/// A unit that stands alone in its cell, perhaps in brackets: the row of units below the headings.
pub(super) fn unit_in_cell(cell: &str) -> Option<&'static str> {
    unit_named(without_brackets(cell.trim()))
}

fn without_brackets(text: &str) -> &str {
    let pairs = [('[', ']'), ('(', ')'), ('（', '）'), ('<', '>')];
    let inside = |(open, close): &(char, char)| text.strip_prefix(*open)?.strip_suffix(*close);
    pairs.iter().find_map(inside).unwrap_or(text).trim()
}

/// Our word for a direction.
pub(super) fn direction_named(word: &str) -> Option<&'static str> {
    let word = plain(word).replace('−', "-");
    DIRECTIONS.iter().find(|(_, all)| all.contains(&word.as_str())).map(|(name, _)| *name)
}

/// Whether a Chinese word for one of our columns occurs in a text.
pub(super) fn has_chinese_word(text: &str) -> bool {
    let is_chinese =
        |word: &&&str| word.chars().count() > 1 && word.chars().all(|c| c >= '\u{4e00}');
    ROLES.iter().flat_map(|(.., words)| words.iter()).filter(is_chinese).any(|w| text.contains(*w))
}

/// Small letters, one space between words.
fn plain(text: &str) -> String {
    // A lone sign is a direction, not a dash between words.
    let text = text.trim().trim_matches('"').trim();
    if matches!(text, "+" | "-" | "−" | "+1" | "-1" | "−1") {
        return text.to_owned();
    }
    let spaced: String =
        text.to_lowercase()
            .chars()
            .map(|c| {
                if matches!(c, '_' | '-' | '.' | ':' | '#' | '\u{a0}' | '\u{3000}') {
                    ' '
                } else {
                    c
                }
            })
            .collect();
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What a heading says; `None` if it is none of ours.
pub(super) fn understand(text: &str) -> Option<Heading> {
    let (name, unit) = split_unit(text);
    let name = plain(name);
    let (role, holds, is_weak) = role_of(&name)?;
    Some(Heading { role, unit, holds, is_weak })
}

fn role_of(name: &str) -> Option<(String, Holds, bool)> {
    if let Some((role, holds, _)) = ROLES.iter().find(|(.., words)| words.contains(&name)) {
        return Some(((*role).to_owned(), *holds, false));
    }
    if WEAK_TARGETS.contains(&name) {
        return Some(("target".to_owned(), Holds::Large, true));
    }
    one_run(name)
}

/// `forward 1`, `run 2 reverse`, `actual up 3`, `第1次正向`: one run of a table with a column for each.
fn one_run(name: &str) -> Option<(String, Holds, bool)> {
    let mut number = String::new();
    let mut words = String::new();
    for c in name.chars() {
        match c {
            '0'..='9' => {
                // A second number would be something else.
                if !number.is_empty() && !words.ends_with('\u{1}') {
                    return None;
                }
                if number.is_empty() {
                    words.push('\u{1}');
                }
                number.push(c);
            }
            '第' | '次' => words.push(' '),
            c => words.push(c),
        }
    }
    let run: u32 = number.parse().ok().filter(|n| *n > 0)?;
    let words = words.replace('\u{1}', " ");
    let known = |word: &str, role: &str| {
        ROLES.iter().any(|(name, _, all)| *name == role && all.contains(&word))
    };
    let mut is_actual = false;
    let mut direction = None;
    for word in words.split_whitespace() {
        match direction_named(word) {
            Some(found @ ("up" | "down")) if direction.is_none() => direction = Some(found),
            _ if known(word, "actual") => is_actual = true,
            _ if known(word, "deviation") || known(word, "run") => {}
            _ => return None,
        }
    }
    let direction = direction?;
    Some(match is_actual {
        true => (format!("actual_{direction}_{run}"), Holds::Large, false),
        false => (format!("{direction}_{run}"), Holds::Small, false),
    })
}

/// A heading without its unit: `Position [mm]`, `error (µm)`, `deviation_um`, `Weg in mm`, `x, mm`.
pub(super) fn split_unit(text: &str) -> (&str, Option<&'static str>) {
    let text = text.trim().trim_matches('"').trim();
    for (open, close) in [('[', ']'), ('(', ')'), ('（', '）'), ('<', '>')] {
        if let Some(inside) = text.strip_suffix(close)
            && let Some((name, unit)) = inside.rsplit_once(open)
            && let Some(unit) = unit_named(unit)
        {
            return (name, Some(unit));
        }
    }
    for between in [" in ", " / ", ", ", "_", " ", "/"] {
        if let Some((name, unit)) = text.rsplit_once(between)
            && let Some(unit) = unit_named(unit)
            && !name.trim().is_empty()
        {
            return (name.trim_end_matches([',', ' ']), Some(unit));
        }
    }
    (text, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is(text: &str, role: &str, unit: Option<&str>) {
        let found = understand(text).unwrap_or_else(|| panic!("{text} is not understood"));
        assert_eq!((found.role.as_str(), found.unit), (role, unit), "{text}");
    }

    #[test]
    fn headings_of_five_languages() {
        is("Target position (mm)", "target", Some("mm"));
        is("Sollposition [mm]", "target", Some("mm"));
        is("目标位置（毫米）", "target", Some("mm"));
        is("Position cible, mm", "target", Some("mm"));
        is("Posizione nominale / mm", "target", Some("mm"));
        is("Abweichung in µm", "deviation", Some("um"));
        is("偏差(μm)", "deviation", Some("um"));
        is("Écart [µm]", "deviation", Some("um"));
        is("deviation_um", "deviation", Some("um"));
        is("Winkel [°]", "angle", Some("deg"));
        is("Richtung", "direction", None);
        is("Position", "target", None);
        assert!(understand("Position").unwrap().is_weak);
        is("Forward 1 [um]", "up_1", Some("um"));
        is("Lauf 2 rückwärts (µm)", "down_2", Some("um"));
        is("第3次反向(μm)", "down_3", Some("um"));
        is("up_1_um", "up_1", Some("um"));
        is("actual_down_12_mm", "actual_down_12", Some("mm"));
        for other in ["operator", "run 1 2 up", "machine_id", "1", "mm", ""] {
            assert_eq!(understand(other), None, "{other}");
        }
    }

    #[test]
    fn directions_of_five_languages() {
        let of = |word| direction_named(word);
        for word in ["Up", "+", "vorwärts", "正向", "aller", "andata"] {
            assert_eq!(of(word), Some("up"), "{word}");
        }
        for word in ["-", "−", "Rückwärts", "反向", "retour", "ritorno"] {
            assert_eq!(of(word), Some("down"), "{word}");
        }
        for word in ["CCW", "Counter-clockwise", "gegen den Uhrzeigersinn", "逆时针", "antiorario"]
        {
            assert_eq!(of(word), Some("ccw"), "{word}");
        }
        assert_eq!((of("im Uhrzeigersinn"), of("sideways")), (Some("cw"), None));
    }
}
