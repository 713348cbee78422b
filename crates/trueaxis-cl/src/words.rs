//! The vocabulary: the meaning of each major word, as tables.

/// The meaning of a major word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Major {
    Goto,
    GoDelta,
    From,
    Circle,
    /// INDIRV: where the next circle begins to.
    Direction,
    /// A motion along a circle up to a line.
    Along,
    Rapid,
    Feed,
    Spindle,
    Coolant,
    LoadTool,
    Load,
    /// Chooses a tool, and loads none.
    Select,
    /// The coordinate system of the points.
    Frame,
    Cutter,
    ToolAxis,
    MultiAxis,
    Units,
    Cycle,
    Delay,
    Stop(bool),
    Insert,
    Comment,
    End,
    Synonym,
    /// Without effect on the path.
    Noted,
    /// TRANS: the following points are displaced.
    Translation,
    /// It can change motion, spindle or coolant and is not applied: a warning.
    NotApplied(&'static str),
    /// It is not applied, and changes none of them: a note.
    Replaced(&'static str),
    /// It changes where the points are, and is not applied: an error unless it is off.
    Refused(&'static str),
    /// A kind of motion that is not read: an error.
    Motion(&'static str),
}

pub(super) fn major(word: &str) -> Option<Major> {
    Some(match word {
        "GOTO" => Major::Goto,
        "GODLTA" => Major::GoDelta,
        "FROM" => Major::From,
        "CIRCLE" | "MOVARC" => Major::Circle,
        "RAPID" => Major::Rapid,
        "FEDRAT" => Major::Feed,
        "SPINDL" => Major::Spindle,
        "COOLNT" => Major::Coolant,
        "LOADTL" | "TURRET" => Major::LoadTool,
        "LOAD" => Major::Load,
        "TOOLNO" | "SELECT" | "SELCTL" => Major::Select,
        "MSYS" => Major::Frame,
        "CUTTER" => Major::Cutter,
        "TLAXIS" => Major::ToolAxis,
        "MULTAX" => Major::MultiAxis,
        "UNITS" | "UNIT" => Major::Units,
        "CYCLE" => Major::Cycle,
        "DELAY" | "DWELL" => Major::Delay,
        "STOP" => Major::Stop(false),
        "OPSTOP" => Major::Stop(true),
        "INSERT" => Major::Insert,
        "PARTNO" | "REMARK" | "PPRINT" | "TPRINT" | "LETTER" | "DISPLY" => Major::Comment,
        "FINI" | "END" => Major::End,
        "SYN" => Major::Synonym,
        "CUTCOM" => Major::NotApplied("radius compensation; the points are used unchanged"),
        "TRANS" => Major::Translation,
        "ROTABL" | "ROTHED" | "ROTATE" => Major::Refused("a table or head turns by itself"),
        "TRACUT" | "COPY" => Major::Refused("the points are transformed or repeated"),
        "ORIGIN" => Major::Refused("the points are displaced, by postprocessors in either sense"),
        "GOHOME" => Major::Replaced(
            "the motion to the home position; the safe end of the program is used instead",
        ),
        "CALSUB" | "DEFSUB" | "ENDSUB" => Major::NotApplied("subprograms"),
        "THREAD" | "PITCH" => Major::NotApplied("threading"),
        "AUXFUN" | "PREFUN" => Major::NotApplied("a function of the control"),
        "OPSKIP" => Major::NotApplied("optional blocks"),
        "RETRCT" => Major::NotApplied("a retraction of the tool"),
        "CLAMP" | "LOCKX" => Major::Replaced("a clamp"),
        "AIR" => Major::NotApplied("air"),
        "DNTCUT" | "NOPOST" => Major::NotApplied("a part of the file that is left out"),
        "INDIRV" => Major::Direction,
        "TLON" | "GOFWD" => Major::Along,
        "GOLFT" | "GORGT" | "GOBACK" | "GOUP" | "GODOWN" | "GO" | "INDIRP" => {
            Major::Motion("motion along surfaces")
        }
        "NURBS" | "SPLINE" | "ARC" | "PARAB" | "HELIX" => Major::Motion("a curve"),
        _ if NOTED.contains(&word) || word.starts_with("CSI_") => Major::Noted,
        _ => return None,
    })
}

/// Words of the language, and of the systems that write it, without effect on the path.
const NOTED: [&str; 49] = [
    "AUTOPS", "PPWORD", "CAMERA", "CSYS", "TRNTYP", "MACHIN", "SWITCH", "PPFUN", "REWIND", "INTOL",
    "OUTTOL", "TOLER", "LINTOL", "CLDIST", "MODE", "HEAD", "HED", "SEQNO", "CLRSRF", "CLEARP",
    "CLPRNT", "PLOT", "PLABEL", "TLLFT", "TLRGT", "PSIS", "CUT", "OFSTNO", "FEATNO", "MFGNO",
    "PROCES", "SET", "CHIPS", "BREAK", "LEADER", "RESERV", "TMARK", "ARCSLP", "TPFORM", "LPRINT",
    "TITLES", "SAFETY", "TOOLPATH", "PAINT", "STCK", "STOCK", "COMENT", "TLDATA", "TOOL",
];
