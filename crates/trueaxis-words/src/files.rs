//! The dictionaries: one file for each room of the program.

pub(crate) const GERMAN_FILES: &[(&str, &str)] = &[
    ("de/layout.toml", include_str!("de/layout.toml")),
    ("de/machine.toml", include_str!("de/machine.toml")),
    ("de/motion.toml", include_str!("de/motion.toml")),
    ("de/predict.toml", include_str!("de/predict.toml")),
    ("de/study.toml", include_str!("de/study.toml")),
    ("de/measure.toml", include_str!("de/measure.toml")),
    ("de/calibrate.toml", include_str!("de/calibrate.toml")),
    ("de/correct.toml", include_str!("de/correct.toml")),
    ("de/live.toml", include_str!("de/live.toml")),
    ("de/condition.toml", include_str!("de/condition.toml")),
    ("de/standards.toml", include_str!("de/standards.toml")),
];
pub(crate) const CHINESE_FILES: &[(&str, &str)] = &[
    ("zh/layout.toml", include_str!("zh/layout.toml")),
    ("zh/machine.toml", include_str!("zh/machine.toml")),
    ("zh/motion.toml", include_str!("zh/motion.toml")),
    ("zh/predict.toml", include_str!("zh/predict.toml")),
    ("zh/study.toml", include_str!("zh/study.toml")),
    ("zh/measure.toml", include_str!("zh/measure.toml")),
    ("zh/calibrate.toml", include_str!("zh/calibrate.toml")),
    ("zh/correct.toml", include_str!("zh/correct.toml")),
    ("zh/live.toml", include_str!("zh/live.toml")),
    ("zh/condition.toml", include_str!("zh/condition.toml")),
    ("zh/standards.toml", include_str!("zh/standards.toml")),
];
