//! A whole day in little time: constant memory, and no error that grows.

mod rig;

use rig::{Rig, plan_with};
use trueaxis_live::clock::Clock;
use trueaxis_live::governor::State;

/// Resident memory of this process, MiB; none where the system does not say.
fn resident_mib() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = text.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4096.0 / f64::from(1 << 20))
}

/// A hall that warms up by 6 K until the afternoon, scales and workpiece after it, each with the noise of its sensor.
fn celsius(time_s: f64) -> Vec<f64> {
    let hall =
        |late_s: f64| 24.0 - 6.0 * (std::f64::consts::TAU * (time_s - late_s) / 86_400.0).cos();
    let noise = |k: f64| 0.01 * (time_s * k).sin();
    vec![hall(1800.0) + noise(1.3), hall(2400.0) + noise(1.7), hall(5400.0) + noise(2.3)]
}

/// Of X at the end of its travel: 10.8 · 3.5 µm/K of the scale, 13.2 · 3.5 µm/K of the workpiece, which differ by some µm of one
/// minute to the next at most: what is off is the increment, the dead band, and the age of the sample.
#[test]
fn law_a_day_needs_no_more_memory_than_an_hour() {
    // A whole day with TRUEAXIS_LONG (scripts/long-laws).
    let hours = if std::env::var_os("TRUEAXIS_LONG").is_some() { 24 } else { 2 };
    let mut rig = Rig::new(plan_with(&[]).expect("the example"));
    let (mut first, mut worst) = (None, Vec::new());
    for hour in 0..hours {
        let end_s = f64::from(hour + 1) * 3600.0;
        let mut most = 0.0_f64;
        while rig.clock.now_s() < end_s {
            rig.sensors.borrow_mut().celsius = celsius(rig.clock.now_s());
            rig.cycle();
            let output = &rig.last.as_ref().expect("a cycle").output;
            let target = output.target.as_ref().filter(|_| rig.clock.now_s() > 60.0);
            for (target, acts) in target.into_iter().flat_map(|t| &t.offsets).zip(rig.acting()) {
                most = most.max((target - f64::from(acts)).abs());
            }
        }
        assert_eq!(rig.state(), State::Run, "{:?}", rig.seen);
        worst.push(most);
        // What this test itself keeps.
        rig.seen.truncate(8);
        let now = resident_mib();
        match (first, now) {
            (None, _) => first = now,
            // The mock keeps its last 100,000 writes.
            (Some(first), Some(now)) => {
                assert!(now - first < 24.0, "{first} to {now} MiB in {hour} h");
            }
            _ => {}
        }
    }
    // µm: of the way from one stop to the next at 10 m/min, two periods late.
    assert!(worst.iter().all(|most| *most < 4.0), "{worst:?}");
    let (events, writes) = (rig.store.0.borrow().events.len(), rig.run.counts().writes);
    assert!(events < 20 && writes > 1000, "{events} events, {writes} writes");
}
