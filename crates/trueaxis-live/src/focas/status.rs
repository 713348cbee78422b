//! What the control means by a status that is not 0.

/// Status, name of the vendor, what to do.
const STATUSES: [(i16, &str, &str); 17] = [
    (1, "EW_FUNC", "the control has no such function"),
    (2, "EW_LENGTH", "the length of the data is not that of this control"),
    (3, "EW_NUMBER", "there is no such number"),
    (4, "EW_ATTRIB", "there is no such axis or kind"),
    (5, "EW_DATA", "the value is not accepted"),
    (6, "EW_NOOPT", "the option is not installed"),
    (
        7,
        "EW_PROT",
        "the memory is protected: switch the protection key, or the write permission of FOCAS, on",
    ),
    (8, "EW_OVRFLOW", "the memory is full"),
    (9, "EW_PARAM", "a parameter of the control forbids it"),
    (10, "EW_BUFFER", "the buffer is empty or full: slower"),
    (11, "EW_PATH", "there is no such path"),
    (12, "EW_MODE", "not in this mode of operation"),
    (13, "EW_REJECT", "the control rejects it now"),
    (14, "EW_DTSRVR", "the data server fails"),
    (15, "EW_ALARM", "the control has an alarm"),
    (16, "EW_STOP", "the control is not running"),
    (17, "EW_PASSWD", "the data are protected by a password"),
];

/// A refusal in words.
///
/// ```
/// use trueaxis_live::focas::refusal;
/// assert!(refusal(7).starts_with("EW_PROT (7): the memory is protected"));
/// assert_eq!(refusal(99), "status 99");
/// ```
pub fn refusal(status: i16) -> String {
    let known = STATUSES.iter().find(|(number, ..)| *number == status);
    known.map_or_else(
        || format!("status {status}"),
        |(number, name, cure)| format!("{name} ({number}): {cure}"),
    )
}
