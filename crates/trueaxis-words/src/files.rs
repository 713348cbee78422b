//! The dictionaries: one file for each room of the program, in every language.

/// Name and content of every dictionary of a language.
macro_rules! dictionaries {
    ($language:literal: $($room:literal)*) => {
        &[$((
            concat!($language, "/", $room, ".toml"),
            include_str!(concat!($language, "/", $room, ".toml")),
        )),*]
    };
    ($language:literal) => {
        dictionaries!($language: "layout" "machine" "motion" "predict" "study" "measure" "calibrate" "correct" "live" "condition" "standards")
    };
}

pub(crate) const GERMAN_FILES: &[(&str, &str)] = dictionaries!("de");
pub(crate) const CHINESE_FILES: &[(&str, &str)] = dictionaries!("zh");
