//! The Markdown reports of others: raw readings and printed figures.

use std::path::Path;

/// Their name of a figure and ours.
pub const FIGURES: [(&str, &str); 12] = [
    ("A", "A"),
    ("A_fwd", "A_up"),
    ("A_bwd", "A_down"),
    ("R", "R"),
    ("R_fwd", "R_up"),
    ("R_bwd", "R_down"),
    ("E", "E"),
    ("E_fwd", "E_up"),
    ("E_bwd", "E_down"),
    ("M", "M"),
    ("B", "B"),
    ("B_avg", "B_mean"),
];

pub struct Report {
    pub path: std::path::PathBuf,
    pub name: String,
    /// The readings as a table that the product reads.
    pub table: String,
    text: String,
}

impl Report {
    /// The printed figure: `**A_fwd = 0.02008 [mm]**`.
    pub fn figure_um(&self, name: &str) -> Option<f64> {
        let start = format!("{name} = ");
        let mut lines = self.text.lines().map(|l| l.trim_start_matches('*'));
        let words = lines.find_map(|l| {
            let value = l.strip_prefix(&start)?;
            value.split_whitespace().next()?.parse::<f64>().ok()
        });
        words.map(|mm| mm * 1e3)
    }
}

pub fn read_all(folder: &Path) -> Vec<Report> {
    let mut reports = Vec::new();
    for owner in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        for file in std::fs::read_dir(owner.path()).into_iter().flatten().flatten() {
            let path = file.path();
            let text = match path.extension() {
                Some(e) if e == "md" => std::fs::read_to_string(&path).unwrap_or_default(),
                _ => continue,
            };
            if text.contains("### Data forward direction") {
                let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let table = table(&text);
                reports.push(Report { path, name, table, text });
            }
        }
    }
    reports.sort_by(|a, b| a.name.cmp(&b.name));
    reports
}

fn table(text: &str) -> String {
    let mut table = "target_mm,run,direction,actual_mm\n".to_owned();
    let mut direction = None;
    for line in text.lines() {
        if line.starts_with("##") {
            direction = match line {
                "### Data forward direction" => Some("up"),
                "### Data backward direction" => Some("down"),
                _ => None,
            };
        }
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let index = cells[0].parse::<usize>();
        if let (Some(direction), Ok(_)) = (direction, index) {
            for (run, actual) in cells[2..].iter().enumerate() {
                table += &format!("{},{},{direction},{actual}\n", cells[1], run + 1);
            }
        }
    }
    table
}
