//! The stock after a program: what was removed, by which blocks, and how long the tools cut air.

use super::simulation::{Simulation, clock};
use crate::{BlockUse, Machined};
use serde::Serialize;
use trueaxis_nc::moves::Origin;
use trueaxis_report::JsonSchema;
use trueaxis_report::{Section, Table};

/// Blocks in the table, those that remove most.
const MOST_BLOCKS: usize = 10;
/// Blocks in JSON.
const MOST_LISTED: usize = 1000;

/// What became of the stock.
#[derive(Debug, Serialize, JsonSchema)]
pub struct StockEntry {
    /// Distance of the lines that the stock is kept on, mm.
    pub resolution_mm: f64,
    /// Volume before the first cut, mm³.
    pub before_mm3: f64,
    /// Volume that remains, mm³.
    pub left_mm3: f64,
    /// How far the volumes by lines along X, Y and Z differ from their mean, mm³.
    pub spread_mm3: f64,
    /// Volume that was removed, mm³.
    pub removed_mm3: f64,
    /// With feed in material, s.
    pub cutting_s: f64,
    /// With feed in the air, s.
    pub air_s: f64,
    /// Volume that was cut from the part of the set-up, mm³; null without a part.
    pub gouged_mm3: Option<f64>,
    /// Volume that remains beside the part, mm³; null without a part.
    pub excess_mm3: Option<f64>,
    /// The first 1000 blocks that move a tool, in the order of programs and lines.
    pub blocks: Vec<BlockEntry>,
    /// How many more there are.
    pub blocks_left_out: usize,
}

/// What a block took, all its runs together.
#[derive(Debug, Serialize, JsonSchema)]
pub struct BlockEntry {
    /// The program, an index into `programs`.
    pub program: u32,
    /// The line.
    pub line: u32,
    /// Volume that it removed, mm³.
    pub removed_mm3: f64,
    /// With feed in material, s.
    pub cutting_s: f64,
    /// With feed in the air, s.
    pub air_s: f64,
}

impl From<&Machined> for StockEntry {
    fn from(machined: &Machined) -> Self {
        let total = machined.total();
        let block = |(origin, block): &(Origin, BlockUse)| BlockEntry {
            program: origin.program,
            line: origin.line,
            removed_mm3: block.removed_mm3,
            cutting_s: block.cutting_s,
            air_s: block.air_s,
        };
        Self {
            resolution_mm: machined.stock.resolution_mm(),
            before_mm3: machined.before_mm3,
            left_mm3: machined.stock.volume_mm3(),
            spread_mm3: machined.spread_mm3(),
            removed_mm3: total.removed_mm3,
            cutting_s: total.cutting_s,
            air_s: total.air_s,
            gouged_mm3: machined.gouged_mm3,
            excess_mm3: machined.excess_mm3,
            blocks: machined.blocks.iter().take(MOST_LISTED).map(block).collect(),
            blocks_left_out: machined.blocks.len().saturating_sub(MOST_LISTED),
        }
    }
}

/// cm³ with three digits after the point.
fn cm3(mm3: f64) -> String {
    format!("{:.3}", mm3 / 1e3 + 0.0)
}

pub(super) fn stock_section(s: &Simulation<'_>, machined: &Machined) -> Section<'static> {
    let total = machined.total();
    let with_feed_s = total.cutting_s + total.air_s;
    let share = if with_feed_s > 0.0 { 100.0 * total.air_s / with_feed_s } else { 0.0 };
    let mut table = Table::new(["stock", "value", "unit"])
        .row(["before".to_owned(), cm3(machined.before_mm3), "cm³".to_owned()])
        .row(["removed".to_owned(), cm3(total.removed_mm3), "cm³".to_owned()])
        .row([
            "remains".to_owned(),
            format!("{} ± {}", cm3(machined.stock.volume_mm3()), cm3(machined.spread_mm3())),
            "cm³".to_owned(),
        ])
        .row(["with feed in material".to_owned(), clock(total.cutting_s), String::new()])
        .row([
            "with feed in the air".to_owned(),
            format!("{} ({share:.0} %)", clock(total.air_s)),
            String::new(),
        ]);
    if let (Some(gouged), Some(excess)) = (machined.gouged_mm3, machined.excess_mm3) {
        table = table.row(["cut from the part".to_owned(), cm3(gouged), "cm³".to_owned()]).row([
            "remains beside the part".to_owned(),
            cm3(excess),
            "cm³".to_owned(),
        ]);
    }
    let note = format!(
        "Kept on lines {} mm apart along X, Y and Z; ± is how far their three volumes differ. Nominal machine.",
        machined.stock.resolution_mm()
    );
    let mut order: Vec<&(Origin, BlockUse)> =
        machined.blocks.iter().filter(|(_, b)| b.removed_mm3 > 0.0).collect();
    order.sort_by(|(_, a), (_, b)| b.removed_mm3.total_cmp(&a.removed_mm3));
    let rows = order.into_iter().take(MOST_BLOCKS).map(|(origin, block)| {
        [
            s.block(*origin),
            cm3(block.removed_mm3),
            format!("{:.2}", block.cutting_s),
            format!("{:.2}", block.air_s),
        ]
    });
    let blocks = Table::new(["blocks that remove most", "cm³", "in material, s", "in the air, s"]);
    Section::new("Stock").table(table.note(note)).table(blocks.rows(rows))
}
