//! What the words of this control do, as tables.

use trueaxis_moves::{CompensationSide as Side, FeedMode, PathControl, Plane};

/// How a motion is programmed; it lasts until another one comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// G0.
    Rapid,
    /// G1.
    Linear,
    /// G2 and G3.
    Arc {
        /// Whether it turns to the left: G3.
        ccw: bool,
    },
    /// CIP.
    ThroughPoint,
    /// CT.
    Tangent,
    /// G33, G34, G35, G331, G332.
    Thread,
    /// G63, in one block.
    FreeTap,
}

/// The definition of the tool axis by angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Angles {
    /// A2 about Z, B2 about X', C2 about Z''.
    Euler,
    /// C2 about Z, B2 about Y', A2 about X''.
    Rpy,
    /// A2 about X, B2 about Y', C2 about Z''.
    RpyReversed,
}

/// The interpolation of the tool axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrientationMode {
    /// ORIAXES.
    Axes,
    /// ORIVECT, ORIPLANE.
    Vector,
    /// ORICONCW.
    ConeClockwise,
    /// ORICONCCW.
    ConeCounterClockwise,
    /// ORICONIO.
    ConeThrough,
    /// ORICONTO.
    ConeTangential,
    /// ORIMKS.
    Machine,
    /// ORIWKS.
    Workpiece,
}

/// One thing that a word does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Code {
    /// G17, G18, G19.
    Plane(Plane),
    /// A code of the user's dictionary, with the words of its block.
    Own,
    /// TOROT: Z of the programmable frame is along the tool; TOROTOF.
    AlongTool(bool),
    /// G70/G71 and G700/G710; `feed` with the feeds as well.
    Inches {
        /// Whether lengths are in inches.
        inches: bool,
        /// Whether feeds are, too.
        feed: bool,
    },
    /// G91, or G90.
    Incremental(bool),
    /// DIAMON, or DIAMOF.
    Diameter(bool),
    /// G93, G94, G95.
    Feed(FeedMode),
    /// G96 and its relatives: the feed that comes with it.
    SurfaceSpeed(bool, FeedMode),
    /// G500, G54 …
    Offset(u32),
    /// TRANS, AROT … by name.
    Frame(&'static str),
    /// G58, G59.
    Shift {
        /// Whether it is G59.
        fine: bool,
    },
    /// G53, SUPA, G153: coordinates of the machine in this block.
    Machine,
    /// TRAORI, or TRAFOOF.
    ToolCentre(bool),
    /// ORIEULER, ORIRPY, ORIRPY2.
    Angles(Angles),
    /// The interpolation of the tool axis.
    Orientation(OrientationMode),
    /// G40, G41, G42.
    Compensation(Side),
    /// The way along the contour.
    Contour(ContourRule),
    /// G60, G64 and their relatives; whether ADIS counts, as with G641.
    Path(PathControl, bool),
    /// G9.
    ExactOnce,
    /// G4.
    Dwell,
    /// G110 (0), G111 (1), G112 (2).
    Pole(u8),
    /// G74, G75.
    Reference,
    /// G25, G26.
    Limits,
    /// A kind of motion.
    Motion(Motion),
    /// Known, and without effect on the path.
    Note(&'static str),
    /// Known, and its effect is not executed.
    NotApplied(&'static str),
}

/// How the contour is followed with radius compensation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContourRule {
    /// G450.
    OutsideOnArc,
    /// G451.
    OutsideToMeeting,
    /// NORM: straight to the first place of the contour.
    Norm,
    /// KONT: round the first place of the contour.
    Kont,
    /// KONTC and KONTT: the same with a polynomial whose curvature or tangent is continuous.
    KontSmooth,
    /// CFTCP.
    FeedAtCentre,
    /// CFC.
    FeedOnContour,
    /// CFIN: on the contour, but not faster.
    FeedOnInside,
}

impl Code {
    /// The place in the order of execution within a block.
    pub fn rank(self) -> u8 {
        match self {
            Self::Plane(_) | Self::Inches { .. } | Self::Incremental(_) | Self::Diameter(_) => 0,
            Self::Feed(_) | Self::SurfaceSpeed(..) => 1,
            Self::Note(_) | Self::NotApplied(_) | Self::Contour(_) => 3,
            Self::Compensation(_) | Self::Path(..) | Self::ExactOnce => 4,
            Self::Offset(_) | Self::Shift { .. } => 5,
            Self::Frame(_) | Self::AlongTool(_) => 6,
            Self::ToolCentre(_) | Self::Angles(_) | Self::Orientation(_) => 7,
            Self::Machine => 8,
            Self::Dwell | Self::Pole(_) | Self::Reference | Self::Limits | Self::Own => 9,
            Self::Motion(_) => 10,
        }
    }

    /// Whether the words of axes in its block are its own.
    pub fn takes_axes(self) -> bool {
        self.rank() == 9 || matches!(self, Self::Frame(_) | Self::Shift { .. })
    }
}

/// What a G number does.
pub fn g_code(number: u32) -> Option<Code> {
    let motion = |m| Some(Code::Motion(m));
    match number {
        0 => motion(Motion::Rapid),
        1 => motion(Motion::Linear),
        2 => motion(Motion::Arc { ccw: false }),
        3 => motion(Motion::Arc { ccw: true }),
        33..=35 | 331 | 332 => motion(Motion::Thread),
        63 => motion(Motion::FreeTap),
        4 => Some(Code::Dwell),
        5 => Some(Code::NotApplied("G5 oblique plunge-cutting")),
        7 => Some(Code::NotApplied("G7 oblique plunge-cutting")),
        9 => Some(Code::ExactOnce),
        17 => Some(Code::Plane(Plane::Xy)),
        18 => Some(Code::Plane(Plane::Zx)),
        19 => Some(Code::Plane(Plane::Yz)),
        25 | 26 => Some(Code::Limits),
        40 => Some(Code::Compensation(Side::Off)),
        41 => Some(Code::Compensation(Side::Left)),
        42 => Some(Code::Compensation(Side::Right)),
        53 | 153 => Some(Code::Machine),
        500 => Some(Code::Offset(0)),
        54..=57 => Some(Code::Offset(number - 53)),
        58 => Some(Code::Shift { fine: false }),
        59 => Some(Code::Shift { fine: true }),
        505..=599 => Some(Code::Offset(number - 500)),
        60 => Some(Code::Path(PathControl::ExactStop, false)),
        64 | 642..=645 => Some(Code::Path(PathControl::Continuous, false)),
        641 => Some(Code::Path(PathControl::Continuous, true)),
        70 => Some(Code::Inches { inches: true, feed: false }),
        71 => Some(Code::Inches { inches: false, feed: false }),
        700 => Some(Code::Inches { inches: true, feed: true }),
        710 => Some(Code::Inches { inches: false, feed: true }),
        74 | 75 => Some(Code::Reference),
        90 => Some(Code::Incremental(false)),
        91 => Some(Code::Incremental(true)),
        93 => Some(Code::Feed(FeedMode::InverseTime)),
        94 => Some(Code::Feed(FeedMode::PerMinute)),
        95 => Some(Code::Feed(FeedMode::PerRevolution)),
        96 => Some(Code::SurfaceSpeed(true, FeedMode::PerRevolution)),
        961 => Some(Code::SurfaceSpeed(true, FeedMode::PerMinute)),
        97 => Some(Code::SurfaceSpeed(false, FeedMode::PerRevolution)),
        971 | 973 => Some(Code::SurfaceSpeed(false, FeedMode::PerMinute)),
        110..=112 => Some(Code::Pole((number - 110) as u8)),
        140..=143 | 147 | 148 | 247 | 248 | 347 | 348 | 340 | 341 => {
            Some(Code::NotApplied("soft approach and retraction"))
        }
        450 => Some(Code::Contour(ContourRule::OutsideOnArc)),
        451 => Some(Code::Contour(ContourRule::OutsideToMeeting)),
        _ => g_note(number).map(Code::Note),
    }
}

fn g_note(number: u32) -> Option<&'static str> {
    Some(match number {
        290 => "G290 Siemens language",
        460 => "G460 collision detection",
        461 => "G461 extension by an arc",
        462 => "G462 extension by a line",
        601 => "G601 exact stop fine",
        602 => "G602 exact stop coarse",
        603 => "G603 end of interpolation",
        621 => "G621 corner deceleration",
        62 => "G62 corner deceleration",
        810..=829 => "G810 to G829 of the machine builder",
        962 => "G962 surface speed, feed as before",
        972 => "G972 speed, feed as before",
        _ => return None,
    })
}

/// What a word of several letters does.
pub fn code(word: &str) -> Option<Code> {
    Some(match word {
        "CIP" => Code::Motion(Motion::ThroughPoint),
        "CT" => Code::Motion(Motion::Tangent),
        "SUPA" => Code::Machine,
        "TRANS" => Code::Frame("TRANS"),
        "ATRANS" => Code::Frame("ATRANS"),
        "ROT" => Code::Frame("ROT"),
        "AROT" => Code::Frame("AROT"),
        "ROTS" => Code::Frame("ROTS"),
        "AROTS" => Code::Frame("AROTS"),
        "SCALE" => Code::Frame("SCALE"),
        "ASCALE" => Code::Frame("ASCALE"),
        "MIRROR" => Code::Frame("MIRROR"),
        "AMIRROR" => Code::Frame("AMIRROR"),
        "TRAORI" => Code::ToolCentre(true),
        "TRAFOOF" => Code::ToolCentre(false),
        "DIAMON" | "DIAM90" => Code::Diameter(true),
        "DIAMOF" => Code::Diameter(false),
        "ORIEULER" => Code::Angles(Angles::Euler),
        "ORIRPY" => Code::Angles(Angles::Rpy),
        "ORIRPY2" => Code::Angles(Angles::RpyReversed),
        "ORIAXES" => Code::Orientation(OrientationMode::Axes),
        "ORIVECT" | "ORIPLANE" => Code::Orientation(OrientationMode::Vector),
        "ORICONCW" => Code::Orientation(OrientationMode::ConeClockwise),
        "ORICONCCW" => Code::Orientation(OrientationMode::ConeCounterClockwise),
        "ORICONIO" => Code::Orientation(OrientationMode::ConeThrough),
        "ORICONTO" => Code::Orientation(OrientationMode::ConeTangential),
        "ORIMKS" => Code::Orientation(OrientationMode::Machine),
        "ORIWKS" => Code::Orientation(OrientationMode::Workpiece),
        "INVCW" | "INVCCW" => Code::NotApplied("the involute"),
        "ASPLINE" | "BSPLINE" | "CSPLINE" => Code::NotApplied("spline interpolation"),
        "POLY" => Code::NotApplied("polynomial interpolation"),
        "ORIVIRT1" | "ORIVIRT2" => Code::NotApplied("ORIVIRT"),
        "ORICURVE" => Code::NotApplied("ORICURVE"),
        "ORIPATH" | "ORIPATHS" => Code::NotApplied("ORIPATH"),
        "ORIROTA" | "ORIROTR" | "ORIROTT" | "ORIROTC" => Code::NotApplied("a turn of the tool"),
        "TRANSMIT" => Code::NotApplied("TRANSMIT"),
        "TRACYL" => Code::NotApplied("TRACYL"),
        "TRAANG" => Code::NotApplied("TRAANG"),
        "TRACON" => Code::NotApplied("TRACON"),
        "TOROT" | "TOROTZ" => Code::AlongTool(true),
        "TOROTOF" => Code::AlongTool(false),
        "TOFRAME" | "TOFRAMEX" | "TOFRAMEY" | "TOFRAMEZ" | "TOROTX" | "TOROTY" => {
            Code::NotApplied("a frame along the tool")
        }
        "PAROT" => Code::NotApplied("PAROT"),
        "TCARR" | "TCOABS" | "TCOFR" | "TCOFRX" | "TCOFRY" | "TCOFRZ" => {
            Code::NotApplied("the orientable tool carrier")
        }
        "GEOAX" => Code::NotApplied("GEOAX"),
        "TANGON" => Code::NotApplied("tangential control"),
        "TRAILON" | "COUPON" | "LEADON" | "EGON" => Code::NotApplied("a coupling of axes"),
        "PTP" => Code::NotApplied("PTP motion"),
        "NORM" => Code::Contour(ContourRule::Norm),
        "KONT" => Code::Contour(ContourRule::Kont),
        "KONTC" | "KONTT" => Code::Contour(ContourRule::KontSmooth),
        "CFTCP" => Code::Contour(ContourRule::FeedAtCentre),
        "CFC" => Code::Contour(ContourRule::FeedOnContour),
        "CFIN" => Code::Contour(ContourRule::FeedOnInside),
        _ => return is_note(word).map(Code::Note),
    })
}

/// Words of no effect on the programmed path.
const NOTES: [&str; 100] = [
    "ACCLIMA",
    "ACN",
    "ADISPOSA",
    "BNAT",
    "BRAKE",
    "BRISK",
    "BRISKA",
    "BTAN",
    "CDOF",
    "CDOF2",
    "CDON",
    "CLRINT",
    "COMPCAD",
    "COMPCURV",
    "COMPOF",
    "COMPON",
    "COMPSURF",
    "COUPOF",
    "CP",
    "CPRECOF",
    "CPRECON",
    "CUT2D",
    "CUT2DF",
    "CUT3DC",
    "CUT3DCC",
    "CUT3DCCD",
    "CUT3DF",
    "CUT3DFF",
    "CUT3DFS",
    "DAC",
    "DELDTG",
    "DIAMCYCOF",
    "DISPLOF",
    "DISPLON",
    "DRIVE",
    "DRIVEA",
    "DYNFINISH",
    "DYNNORM",
    "DYNPOS",
    "DYNPREC",
    "DYNROUGH",
    "DYNSEMIFIN",
    "EAUTO",
    "ENAT",
    "ETAN",
    "FCUB",
    "FFWOF",
    "FFWON",
    "FGROUP",
    "FIFOCTRL",
    "FLIN",
    "FNORM",
    "FPRAOF",
    "FTOCOF",
    "FXS",
    "JERKLIMA",
    "LEADOF",
    "LFOF",
    "LFON",
    "METRIC",
    "ORIC",
    "ORID",
    "ORIRESET",
    "ORISOF",
    "ORISON",
    "OSC",
    "OSOF",
    "OSS",
    "OSSE",
    "PAROTOF",
    "PDELAYOF",
    "PDELAYON",
    "PON",
    "PONS",
    "RTLIOF",
    "RTLION",
    "SAVE",
    "SBLOF",
    "SBLON",
    "SETMS",
    "SOFT",
    "SOFTA",
    "SON",
    "SONS",
    "SPATH",
    "SPIF1",
    "SPIF2",
    "SPOF",
    "STARTFIFO",
    "STOPFIFO",
    "STOPRE",
    "TANGOF",
    "TCOABSOF",
    "TOWBCS",
    "TOWKCS",
    "TOWMCS",
    "TOWSTD",
    "TOWTCS",
    "UPATH",
    "WALIMOF",
];

/// More of them.
const MORE_NOTES: [&str; 15] = [
    "WALIMON", "WAITMC", "WAITM", "WAITP", "WAITS", "CHANDATA", "INCH", "SETPIECE", "RELEASE",
    "GET", "GETD", "TRAILOF", "EGOFS", "SETM", "CLEARM",
];

/// The word itself if it has no effect on the programmed path.
pub fn is_note(word: &str) -> Option<&'static str> {
    let mut all = NOTES.iter().chain(&MORE_NOTES);
    all.find(|n| **n == word).copied()
}

/// Addresses of several letters, with `=`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name {
    /// CR.
    Radius,
    /// AR.
    Opening,
    /// TURN=.
    Turn,
    /// AP.
    PolarAngle,
    /// RP.
    PolarRadius,
    /// RPL.
    PlaneAngle,
    /// NUT.
    ConeOpening,
    /// PSI.
    ConeAngle,
    /// ADIS, ADISPOS, CTOL.
    /// RND.
    Rounding,
    /// RNDM: of all corners from here on, 0 ends it.
    ModalRounding,
    /// CHR.
    ChamferLeg,
    /// CHF.
    ChamferLength,
    /// FRC.
    CornerFeed,
    /// FRCM: for all corners from here on, 0 ends it.
    ModalCornerFeed,
    /// ADIS=, ADISPOS=, CTOL=.
    Tolerance,
    /// FB.
    BlockFeed,
    /// SPOS and its relatives.
    SpindlePlace,
    /// ANG.
    Angle,
    /// `POS[X]` and its relatives.
    AxisPlace,
    /// Known, and without effect on the path.
    Noted(&'static str),
    /// Known, and its effect is not executed.
    NotApplied(&'static str),
}

/// What a word with `=` states.
pub fn parameter(word: &str) -> Option<Name> {
    Some(match word {
        "CR" => Name::Radius,
        "AR" => Name::Opening,
        "TURN" => Name::Turn,
        "AP" => Name::PolarAngle,
        "RP" => Name::PolarRadius,
        "RPL" => Name::PlaneAngle,
        "NUT" => Name::ConeOpening,
        "PSI" => Name::ConeAngle,
        "ADIS" | "ADISPOS" | "CTOL" => Name::Tolerance,
        "FB" => Name::BlockFeed,
        "SPOS" | "SPOSA" => Name::SpindlePlace,
        "ANG" => Name::Angle,
        "POS" | "POSA" => Name::AxisPlace,
        "OTOL" | "ATOL" => Name::Noted("a tolerance of the tool axis"),
        "DISC" => Name::Noted("DISC overshoot of corners"),
        "LIMS" => Name::Noted("LIMS limit of the spindle speed"),
        "FL" | "FA" | "FGREF" | "FZ" | "FPR" | "OVR" | "OVRA" | "OVRRAP" | "FMA" => {
            Name::Noted("a feed of single axes")
        }
        "ACC" | "ACCLIM" | "VELOLIM" | "JERKLIM" => Name::Noted("limits of single axes"),
        "FP" | "SD" | "PW" | "PL" | "SF" | "SCC" | "SVC" => Name::Noted("a parameter of its code"),
        "MEAS" | "MEAW" | "MEASA" => Name::NotApplied("measuring"),
        "RND" => Name::Rounding,
        "RNDM" => Name::ModalRounding,
        "CHR" => Name::ChamferLeg,
        "CHF" => Name::ChamferLength,
        "FRC" => Name::CornerFeed,
        "FRCM" => Name::ModalCornerFeed,
        "OFFN" => Name::NotApplied("OFFN"),
        "DISR" | "DISCL" | "DISRP" | "FAD" | "DAV" => Name::Noted("a parameter of soft approach"),
        "LEAD" | "TILT" => Name::NotApplied("LEAD and TILT"),
        "THETA" => Name::NotApplied("a turn of the tool"),
        "XH" | "YH" | "ZH" | "PO" => Name::NotApplied("polynomials and second points"),
        "POLF" | "LFPOS" => Name::Noted("lift fast"),
        _ => return None,
    })
}

/// Statements that fill their block and have no effect on the path here.
pub fn takes_block(word: &str) -> bool {
    const WORDS: [&str; 47] = [
        "ID",
        "IDS",
        "WHEN",
        "WHENEVER",
        "EVERY",
        "FROM",
        "DO",
        "EXECSTRING",
        "EXECTAB",
        "EXECUTE",
        "WRITE",
        "READ",
        "DELETE",
        "ISFILE",
        "SETINT",
        "ENABLE",
        "DISABLE",
        "CANCEL",
        "INIT",
        "START",
        "WAITE",
        "NEWCONF",
        "REPOSA",
        "REPOSL",
        "REPOSH",
        "REPOSQ",
        "PUTFTOC",
        "PUTFTOCF",
        "CONTPRON",
        "CONTDCON",
        "CTABDEF",
        "CTABEND",
        "CTABDEL",
        "OSCILL",
        "OSCTRL",
        "MMC",
        "FCTDEF",
        "TOOLENV",
        "DELTOOLENV",
        "SETMTH",
        "NEWT",
        "DELT",
        "DRFOF",
        "PRESETON",
        "COUPDEF",
        "MASLDEF",
        "CANCELSUB",
    ];
    WORDS.contains(&word)
}

/// Cycles that the control brings with it.
pub fn is_cycle(name: &str) -> bool {
    const BEGINNINGS: [&str; 12] = [
        "CYCLE",
        "POCKET",
        "SLOT",
        "HOLES",
        "LONGHOLE",
        "WORKPIECE",
        "E_",
        "F_",
        "GROUP_",
        "CUST_",
        "TOOLCARR",
        "ORI_",
    ];
    let upper = name.to_ascii_uppercase();
    BEGINNINGS.iter().any(|b| upper.starts_with(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_offsets_by_number() {
        assert_eq!(g_code(54), Some(Code::Offset(1)));
        assert_eq!(g_code(505), Some(Code::Offset(5)));
        assert_eq!(g_code(599), Some(Code::Offset(99)));
        assert_eq!(g_code(604), None);
    }
}
