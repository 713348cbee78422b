//! The vocabulary: what each major word does, as tables.

/// What a major word is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Major {
    Goto,
    GoDelta,
    From,
    Circle,
    Rapid,
    Feed,
    Spindle,
    Coolant,
    LoadTool,
    Load,
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
    /// Without effect on the path here.
    Noted,
    /// It changes where the tool goes, and is left out: a warning.
    NotApplied(&'static str),
    /// It moves the tool in a way that is not read: an error.
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
        "LOADTL" => Major::LoadTool,
        "LOAD" => Major::Load,
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
        "CUTCOM" => Major::NotApplied("radius compensation: the points are taken as they are"),
        "ROTABL" | "ROTHED" | "ROTATE" => Major::NotApplied("a turn of a table or head by itself"),
        "TRACUT" | "TRANS" | "ORIGIN" | "COPY" => Major::NotApplied("another frame of the points"),
        "GOHOME" => Major::NotApplied("the way home: the safe end stands for it"),
        "CALSUB" | "DEFSUB" | "ENDSUB" => Major::NotApplied("subprograms"),
        "THREAD" | "PITCH" => Major::NotApplied("threading"),
        "GOFWD" | "GOLFT" | "GORGT" | "GOBACK" | "GOUP" | "GODOWN" | "GO" | "TLON" | "INDIRV"
        | "INDIRP" => Major::Motion("motion along surfaces"),
        "NURBS" | "SPLINE" | "ARC" | "PARAB" | "HELIX" => Major::Motion("a curve"),
        _ if NOTED.contains(&word) || word.starts_with("CSI_") => Major::Noted,
        _ => return None,
    })
}

/// Words of the language, and of the systems that write it, without effect on the path here.
const NOTED: [&str; 60] = [
    "PPWORD", "CAMERA", "CSYS", "TRNTYP", "SELECT", "SELCTL", "MACHIN", "SWITCH", "TOOLNO",
    "TURRET", "PPFUN", "REWIND", "INTOL", "OUTTOL", "TOLER", "LINTOL", "CLDIST", "MODE", "HEAD",
    "HED", "OPSKIP", "SEQNO", "CLRSRF", "CLEARP", "PREFUN", "AUXFUN", "NOPOST", "CLPRNT", "PLOT",
    "PLABEL", "TLLFT", "TLRGT", "PSIS", "DNTCUT", "CUT", "LOCKX", "CLAMP", "AIR", "OFSTNO",
    "FEATNO", "MFGNO", "PROCES", "SET", "CHIPS", "BREAK", "LEADER", "RESERV", "TMARK", "RETRCT",
    "ARCSLP", "TPFORM", "LPRINT", "TITLES", "SAFETY", "TOOLPATH", "MSYS", "PAINT", "STCK", "STOCK",
    "COMENT",
];
