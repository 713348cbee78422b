//! The machine, the poses and the clock that the batch benches share.

use std::time::Instant;
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;

/// Poses of a round.
pub const POSES: usize = 1_000_000;
const KNOTS: usize = 50;
const ROUNDS: usize = 15;

/// Tables in memory: `X.csv` and so on.
struct Memory;

impl Tables for Memory {
    fn text(&self, name: &str) -> Result<String, String> {
        let letter = name.chars().next().ok_or("no name")?;
        Ok(table(letter))
    }
}

/// Fifty positions with six smooth errors each, µm and µrad.
fn table(letter: char) -> String {
    let (unit, from, to) = match letter {
        'X' | 'Y' | 'Z' => ("mm", -500.0, 500.0),
        _ => ("deg", -180.0, 180.0),
    };
    let heads = ["EX", "EY", "EZ", "EA", "EB", "EC"];
    let units = ["um", "um", "um", "urad", "urad", "urad"];
    let columns: Vec<_> =
        heads.iter().zip(units).map(|(h, u)| format!("{h}{letter}_{u}")).collect();
    let mut text = format!("position_{unit},{}\n", columns.join(","));
    for i in 0..KNOTS {
        let t = i as f64 / (KNOTS - 1) as f64;
        let phase = f64::from(letter as u32);
        let value =
            |k: usize| 12.0 * (7.0 * t + phase + 1.3 * k as f64).sin() + 3.0 * (31.0 * t).cos();
        let row: Vec<_> = (0..6).map(|k| format!("{:.4}", value(k))).collect();
        text += &format!("{},{}\n", from + (to - from) * t, row.join(","));
    }
    text
}

/// Head-head, all thirty error motions, all location errors of the axes.
pub fn machine() -> Machine {
    let mut text = String::from(
        "[machine]\nname = \"bench\"\nchain = \"w b X Y Z C A t\"\nsource = \"invented\"\n\
         [tool]\nplacement = \"0 0 -200 mm\"\nlength = \"100 mm\"\n[location]\n",
    );
    for (i, axis) in "XYZCA".chars().enumerate() {
        for (k, direction) in "XYZ".chars().enumerate() {
            text += &format!("E{direction}0{axis} = \"{} um\"\n", 3 + 2 * i + k);
        }
        for (k, direction) in "ABC".chars().enumerate() {
            text += &format!("E{direction}0{axis} = \"{} urad\"\n", 11 - 3 * i as i32 + k as i32);
        }
    }
    for axis in "XYZCA".chars() {
        text += &format!("[motion.{axis}]\ntable = \"{axis}.csv\"\n");
    }
    let (machine, problems) = Machine::check("bench.toml", &text, &Memory);
    let list: Vec<String> = problems.iter().map(ToString::to_string).collect();
    machine.unwrap_or_else(|| panic!("{}", list.join("\n")))
}

/// Random positions within the tables (splitmix64).
#[allow(dead_code, reason = "not every bench draws poses")]
pub fn commands() -> Vec<Vec<f64>> {
    let mut state = 1_u64;
    let mut unit = move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let half = [500.0, 500.0, 500.0, std::f64::consts::PI, std::f64::consts::PI];
    half.map(|half| (0..POSES).map(|_| half * (2.0 * unit() - 1.0)).collect()).to_vec()
}

/// One way to compute the batch.
pub struct Candidate<'a> {
    name: String,
    /// How many poses a round computes.
    poses: usize,
    work: Box<dyn FnMut() + 'a>,
    /// By the clock, and by what all threads used of the cores; of every round.
    ns_per_pose: [Vec<f64>; 2],
}

impl<'a> Candidate<'a> {
    /// A way with its work for one round.
    pub fn new(name: impl Into<String>, poses: usize, work: impl FnMut() + 'a) -> Self {
        Self { name: name.into(), poses, work: Box::new(work), ns_per_pose: Default::default() }
    }

    fn round(&mut self) {
        let start = (Instant::now(), cpu_seconds());
        (self.work)();
        let seconds = [start.0.elapsed().as_secs_f64(), cpu_seconds() - start.1];
        for (all, seconds) in self.ns_per_pose.iter_mut().zip(seconds) {
            all.push(seconds * 1e9 / self.poses as f64);
        }
    }

    /// Median and least, by the clock and by the core.
    fn summary(&self) -> [[f64; 2]; 2] {
        self.ns_per_pose.each_ref().map(|all| {
            // The first round warms up.
            let mut all = all[1..].to_vec();
            all.sort_by(f64::total_cmp);
            [all[all.len() / 2], all[0]]
        })
    }
}

/// What all threads have used of the cores; 0 where the system does not say (not Linux).
fn cpu_seconds() -> f64 {
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let ns = |thread: std::fs::DirEntry| {
        let text = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        text.split(' ').next()?.parse::<f64>().ok()
    };
    threads.filter_map(ns).sum::<f64>() * 1e-9
}

/// So many threads.
#[allow(dead_code, reason = "not every bench has threads")]
pub fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads")
}

/// All candidates in turns.
pub fn run(candidates: &mut [Candidate<'_>]) {
    // `cargo test --benches` only wants to see it run.
    let rounds = if std::env::args().any(|a| a == "--bench") { ROUNDS } else { 1 };
    for _ in 0..=rounds {
        candidates.iter_mut().for_each(Candidate::round);
    }
}

/// The table of the medians.
pub fn print(candidates: &[Candidate<'_>]) {
    println!("ns per pose: median of the rounds (least); ratio of the medians to the first row");
    println!(
        "{:<36}{:>20}{:>8}{:>22}{:>8}{:>12}",
        "", "clock", "ratio", "core", "ratio", "M poses/s"
    );
    let plain = candidates[0].summary();
    for candidate in candidates {
        let [clock, core] = candidate.summary();
        print!("{:<36}{:>10.1} ({:>7.1})", candidate.name, clock[0], clock[1]);
        print!("{:>8.2}", plain[0][0] / clock[0]);
        print!("{:>12.1} ({:>7.1}){:>8.2}", core[0], core[1], plain[1][0] / core[0]);
        println!("{:>12.1}", 1e3 / core[0]);
    }
}
