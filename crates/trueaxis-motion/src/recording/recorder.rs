//! Keeps the nodes of a simulation while they come, in bounded memory.

use super::super::clock::limits;
use super::super::{Batch, Observer, Options, SetUp};
use super::blocks::Blocks;
use super::columns::{Columns, RAPID, Row, WAITS, length};
use super::detail::details;
use super::pyramid::{BUCKET, Pyramid};
use super::{Recording, Stretch};
use trueaxis_geometry::Vec3;
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::heat::WarmingMachine;

/// Nodes that are kept; with 180 bytes each they take 0.8 GB.
const MOST_NODES: usize = 1 << 22;

/// Keeps what a [`Recording`] shows.
#[derive(Debug)]
pub struct Recorder {
    machine: Machine,
    warming: Option<WarmingMachine>,
    columns: Columns,
    pyramid: Pyramid,
    stretches: Vec<Stretch>,
    most: usize,
    /// Of so many consecutive nodes one is kept.
    stride: usize,
    seen: usize,
    /// The last two nodes that came.
    recent: Columns,
    last: Option<Row>,
}

impl Recorder {
    /// Empty; machine, set-up and options are those of the simulation.
    pub fn of(machine: &Machine, setup: &SetUp, options: &Options) -> Self {
        let machine = setup.mounted(machine);
        // The simulation reports what is wrong with the log.
        let problems = &mut Diagnostics::new();
        let run = options.temperatures.as_ref();
        let columns = Columns::of(&machine);
        Self {
            warming: run.and_then(|run| WarmingMachine::new(&machine, run, problems)),
            pyramid: Pyramid::of(columns.quantities().count()),
            recent: columns.clone(),
            columns,
            machine,
            stretches: Vec::new(),
            most: MOST_NODES,
            stride: 1,
            seen: 0,
            last: None,
        }
    }

    /// Keeps at most so many nodes (16 at least, 4 million without this); where there are more, they
    /// are thinned, and [`Recording::is_thinned`] states it.
    #[must_use]
    pub fn at_most(mut self, nodes: usize) -> Self {
        // So that halves are whole buckets.
        self.most = nodes.max(16) / (2 * BUCKET) * (2 * BUCKET);
        self
    }

    /// The whole simulation.
    pub fn finish(mut self) -> Recording {
        if let Some(last) =
            self.last.filter(|last| self.columns.time_s.last() != Some(&last.time_s))
        {
            let bucket = self.columns.len() / BUCKET;
            self.columns.push(&last);
            self.see_extents(bucket);
        }
        self.pyramid.finish();
        Recording {
            velocities: limits(&self.machine).velocity,
            blocks: Blocks::of(&self.columns),
            detail: details(&self.columns),
            machine: self.machine,
            warming: self.warming,
            columns: self.columns,
            pyramid: self.pyramid,
            stretches: self.stretches,
            seen: self.seen,
        }
    }

    fn see(&mut self, row: &Row) {
        if self.seen / self.stride >= self.most {
            self.thin();
        }
        let index = self.seen / self.stride;
        self.seen += 1;
        if index == self.columns.len() {
            self.columns.push(row);
        } else if index > 0 && length(row.off_um) > self.columns.off(index) {
            // Where the program begins stays in any case.
            self.columns.pop();
            self.columns.push(row);
        }
        let before = self.last.replace(*row);
        self.recent.keep(&[]);
        before.iter().chain([row]).for_each(|row| self.recent.push(row));
        self.see_extents(index / BUCKET);
    }

    /// The extents of the last node.
    fn see_extents(&mut self, bucket: usize) {
        let (recent, last) = (&self.recent, self.recent.len() - 1);
        self.pyramid.see(bucket, recent.quantities().map(|of| recent.value(of, last)));
    }

    /// Of every two nodes that with the greater deviation stays.
    fn thin(&mut self) {
        let columns = &self.columns;
        let greater = |first: usize| match first {
            0 => 0,
            i if columns.off(i + 1) > columns.off(i) => i + 1,
            i => i,
        };
        let kept: Vec<usize> = (0..columns.len()).step_by(2).map(greater).collect();
        self.columns.keep(&kept);
        self.pyramid.halve();
        self.stride *= 2;
    }

    fn begin(&mut self, batch: &Batch<'_>) {
        let stretch = Stretch {
            after_s: self.last.map_or(f64::NEG_INFINITY, |last| last.time_s),
            tool: batch.tool,
            tip_mm: batch.machine.tip_mm(),
            since_s: batch.since_s,
        };
        let same = |last: &Stretch| Stretch { after_s: last.after_s, ..stretch } == *last;
        if !self.stretches.last().is_some_and(same) {
            self.stretches.push(stretch);
        }
    }
}

fn thousandfold(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(|x| (x * 1e3) as f32)
}

impl Observer for Recorder {
    fn path(&mut self, batch: &Batch<'_>) {
        self.begin(batch);
        for (i, (node, stamp)) in batch.nodes.iter().zip(batch.stamps).enumerate() {
            let deviation = batch.deviation(i);
            let rapid = if node.is_rapid() { RAPID } else { 0 };
            let waits = if node.dwell_s > 0.0 { WAITS } else { 0 };
            self.see(&Row {
                time_s: stamp.time_s,
                command: node.command,
                tip_mm: deviation.nominal_tip.vector().into(),
                off_um: thousandfold(deviation.tip_mm),
                along_um: thousandfold(batch.along_path_mm[i]),
                axis_urad: (deviation.axis.norm() * 1e6) as f32,
                speed: stamp.speed as f32,
                program: node.origin.program,
                line: node.origin.line,
                flags: rapid | waits,
                approach: batch.approach(i).map(|side| side as i8),
            });
        }
    }
}
