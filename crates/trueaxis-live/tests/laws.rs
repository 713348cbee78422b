//! Laws of the governor and of the frames, over random input.
//!
//! `PROPTEST_CASES` and `TRUEAXIS_GOVERNOR_STEPS` (default 60,000) make the runs longer:
//! `TRUEAXIS_GOVERNOR_STEPS=1000000 cargo test --release -p trueaxis-live --test laws law_governor -- --nocapture`.

use proptest::prelude::*;
use trueaxis_live::control::{Mode, Seen};
use trueaxis_live::focas::codec::{
    Call, Reply, Scaled, answer, answers, ask, calls, header, hello, hello_back,
};
use trueaxis_live::focas::{PmcAddress, PmcBit};
use trueaxis_live::governor::{
    AfterHold, AxisLimits, Governor, Inputs, OnDifference, Owned, Reason, Settings, State,
};

/// A generator whose stream is the same on every computer: SplitMix64 of Steele, Lea and Flood 2014.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn one_in(&mut self, n: u64) -> bool {
        self.next().is_multiple_of(n)
    }

    /// 0 to 1.
    fn part(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn limits(random: &mut Random) -> AxisLimits {
    let most = |random: &mut Random, n: u64| 1 + (random.next() % n) as i32;
    AxisLimits {
        limit: most(random, 500),
        step: most(random, 20),
        slew_per_s: 0.5 + 100.0 * random.part(),
        jump: most(random, 60),
        dead_band: 1.0 + 2.0 * random.part(),
    }
}

fn settings(random: &mut Random) -> Settings {
    Settings {
        axes: (0..1 + random.next() % 5).map(|_| limits(random)).collect(),
        window_s: 0.3,
        hold_s: 2.0,
        after_hold: if random.one_in(2) { AfterHold::Ramp } else { AfterHold::Stay },
        ramp_in_cut: random.one_in(2),
        modes: vec![Mode::Automatic],
        on_difference: if random.one_in(2) { OnDifference::Adopt } else { OnDifference::Latch },
        ladder_ramps: random.one_in(2),
    }
}

/// A control that shows what is written late, loses some of it, and that others write to.
struct Plant {
    seen: Seen,
    pending: Vec<(f64, usize, i32)>,
}

/// What the run so far has done.
#[derive(Default)]
struct Counted {
    writes: u64,
    latched: u64,
    states: std::collections::BTreeSet<String>,
}

/// Runs one governor through so many steps of faults, and checks every write.
fn run(random: &mut Random, steps: u32, counted: &mut Counted) {
    let settings = settings(random);
    let axes = settings.axes.len();
    let foreign: Vec<i32> = (0..axes).map(|_| (random.next() % 100) as i32 - 50).collect();
    let owned = random.one_in(3).then(|| Owned {
        base: foreign.clone(),
        last: foreign.clone(),
        before: foreign.clone(),
    });
    let mut governor = Governor::new(settings.clone(), owned);
    let mut plant = Plant { seen: Seen::moving(vec![0.0; 3], foreign), pending: Vec::new() };
    let (mut now_s, mut target, mut linked) = (0.0, vec![0.0; axes], true);
    let (mut sensor, mut wanted) = (true, true);
    // Of each axis: what was used of its slew and one step. It empties by the slew, so that it stays below a step exactly where
    // the movement in every time T is at most slew · T + one step.
    let mut used = vec![0.0f64; axes];
    for _ in 0..steps {
        let dt_s = match random.next() % 40 {
            0 => f64::NAN,
            1 => -1.0,
            2 => 1e9,
            _ => 0.2 * random.part(),
        };
        let real_s = if dt_s > 0.0 { dt_s.min(0.5) } else { 0.0 };
        now_s += real_s;
        for (used, limits) in used.iter_mut().zip(&settings.axes) {
            *used = (*used - limits.slew_per_s * real_s).max(0.0);
        }
        faults(random, &mut plant, (&mut linked, &mut sensor, &mut wanted));
        plant.pending.retain(|(at, axis, value)| {
            if *at <= now_s {
                plant.seen.offsets[*axis] = *value;
            }
            *at > now_s
        });
        for t in &mut target {
            *t = match random.next() % 400 {
                0 => f64::NAN,
                1 => f64::INFINITY,
                2 => 1e12,
                3 => -*t,
                _ if t.is_finite() && t.abs() < 1e4 => *t + 4.0 * (random.part() - 0.5),
                _ => 0.0,
            };
        }
        let confirmed = random.one_in(50);
        let inputs = Inputs {
            seen: if linked {
                Ok(&plant.seen)
            } else {
                Err(Reason::LinkLost { what: String::new() })
            },
            target: if sensor { Ok(&target[..]) } else { Err(Reason::NotFinite) },
            run: wanted,
            confirmed,
            journal_fails: random.one_in(100),
        };
        let journal_fails = inputs.journal_fails;
        let order = governor.step(dt_s, &inputs);
        counted.states.insert(format!("{} {}", order.state, order.reason));
        counted.latched += u64::from(order.state == State::Latched);
        let Some(write) = &order.write else { continue };
        counted.writes += 1;
        assert!(linked && !journal_fails, "written without a link or a journal");
        let seen = &plant.seen;
        assert!(!seen.emergency && seen.homed && !seen.inhibited && !seen.tripped, "{order:?}");
        assert!(settings.modes.contains(&seen.mode), "{order:?}");
        assert!(matches!(order.state, State::Run | State::RampDown), "{order:?}");
        assert!(plant.pending.is_empty(), "two writes are under way");
        let base = governor.owned().base;
        for (i, limits) in settings.axes.iter().enumerate() {
            let own = write[i] - base[i];
            assert!(own.abs() <= limits.limit, "{own} beyond {limits:?}");
            let by = (write[i] - seen.offsets[i]).abs();
            assert!(by <= limits.step, "a step of {by}: {limits:?}");
            used[i] += f64::from(by);
            let most = f64::from(limits.step) + 1e-6;
            assert!(used[i] <= most, "{} beyond slew and step: {limits:?}", used[i]);
        }
        // Visible at once, later, or never; some axes only.
        for (axis, value) in write.iter().enumerate() {
            if *value == plant.seen.offsets[axis] {
                continue;
            }
            match random.next() % 8 {
                0 => {}
                1 => plant.pending.push((now_s + 0.25 * random.part(), axis, *value)),
                _ => plant.seen.offsets[axis] = *value,
            }
        }
        if random.one_in(30) {
            governor.write_failed(random.one_in(2));
        }
    }
}

fn faults(
    random: &mut Random,
    plant: &mut Plant,
    (linked, sensor, wanted): (&mut bool, &mut bool, &mut bool),
) {
    let seen = &mut plant.seen;
    let mut flip = |flag: &mut bool, usual: bool, rare: u64| {
        *flag =
            if *flag == usual { usual ^ random.one_in(rare) } else { usual ^ !random.one_in(10) };
    };
    flip(linked, true, 150);
    flip(sensor, true, 100);
    flip(wanted, true, 300);
    flip(&mut seen.homed, true, 400);
    flip(&mut seen.emergency, false, 200);
    flip(&mut seen.inhibited, false, 200);
    flip(&mut seen.tripped, false, 300);
    flip(&mut seen.cutting, true, 50);
    if random.one_in(200) {
        seen.mode = Mode::NAMED[(random.next() % 5) as usize].1;
    } else if random.one_in(5) {
        seen.mode = Mode::Automatic;
    }
    if random.one_in(500) {
        let axis = (random.next() % seen.offsets.len() as u64) as usize;
        seen.offsets[axis] += (random.next() % 41) as i32 - 20;
        // It came last: what was on its way to this axis is gone.
        plant.pending.retain(|(_, other, _)| *other != axis);
    }
}

#[test]
#[expect(clippy::print_stdout, reason = "the named long run shows what it has tried")]
fn law_governor_limits_are_never_broken() {
    let wanted = std::env::var("TRUEAXIS_GOVERNOR_STEPS").ok().and_then(|n| n.parse().ok());
    let steps: u64 = wanted.unwrap_or(60_000);
    let (mut random, mut counted, mut done) = (Random(21), Counted::default(), 0);
    while done < steps {
        run(&mut random, 2000, &mut counted);
        done += 2000;
    }
    let Counted { writes, latched, states } = &counted;
    println!(
        "{done} steps, {writes} writes, {latched} latched, {} states with reasons",
        states.len()
    );
    // It is no law if nothing was tried.
    assert!(*writes > done / 20 && *latched > 0 && states.len() >= 15, "{states:?}");
}

/// What waits for its first sensor has written nothing, so that it ends at once; what an earlier run has left in the control waits.
#[test]
fn a_run_that_never_began_ends_at_once() {
    let left = |last: i32| Owned { base: vec![7], last: vec![last], before: vec![last] };
    for (owned, due) in
        [(None, State::Off), (Some(left(7)), State::Off), (Some(left(12)), State::Arm)]
    {
        let held = owned.as_ref().map_or(7, |owned: &Owned| owned.last[0]);
        let axes = vec![limits(&mut Random(4))];
        let mut governor = Governor::new(Settings { axes, ..settings(&mut Random(5)) }, owned);
        let seen = Seen::moving(vec![0.0; 3], vec![held]);
        let mut state = |run: bool| {
            let target = Err(Reason::Model { what: "no sample yet".to_owned() });
            let inputs =
                Inputs { seen: Ok(&seen), target, run, confirmed: false, journal_fails: false };
            let order = governor.step(0.05, &inputs);
            assert_eq!(order.write, None);
            order.state
        };
        assert_eq!(
            (state(true), state(true), state(false), state(false)),
            (State::Arm, State::Arm, due, due)
        );
    }
}

fn any_call() -> impl Strategy<Value = Call> {
    let data = prop::collection::vec(any::<u8>(), 0..40);
    (1u16..3, 1u16..3, any::<u16>(), any::<[i32; 4]>(), data).prop_map(
        |(device, path, code, arguments, data)| Call { device, path, code, arguments, data },
    )
}

proptest! {
    #[test]
    fn law_calls_are_read_back(all in prop::collection::vec(any_call(), 1..8)) {
        prop_assert_eq!(calls(&ask(&all)), Ok(all));
    }

    #[test]
    fn law_answers_are_read_back(all in prop::collection::vec((any_call(), any::<i16>()), 1..8)) {
        let asked: Vec<Call> = all.iter().map(|(call, _)| call.clone()).collect();
        let replies: Vec<Reply> =
            all.iter().map(|(call, status)| Reply::to(call, *status, call.data.clone())).collect();
        prop_assert_eq!(answers(&answer(&replies), &asked), Ok(replies));
    }

    /// No bytes make a reader panic, and nothing that differs from an answer passes for the answer to another question.
    #[test]
    fn law_mutated_frames_are_read_or_refused(
        call in any_call(), cut in 0usize..90, at in 0usize..90, byte in any::<u8>(), noise in prop::collection::vec(any::<u8>(), 0..90),
    ) {
        let asked = [call.clone()];
        let mut bytes = answer(&[Reply::to(&call, 0, call.data.clone())]);
        let whole = bytes.len();
        bytes.truncate(cut.max(1));
        prop_assert!(cut.max(1) >= whole || answers(&bytes, &asked).is_err());
        let mut changed = answer(&[Reply::to(&call, 0, call.data.clone())]);
        let place = at % whole;
        changed[place] = byte;
        // Device, path and code stand after header, number and length of the block.
        if (14..20).contains(&place) && byte != answer(&[Reply::to(&call, 0, call.data.clone())])[place] {
            prop_assert!(answers(&changed, &asked).is_err());
        }
        let _ = answers(&changed, &asked);
        for text in [&noise[..], &[&[0xa0; 4][..], &noise].concat()] {
            let _ = (header(text), answers(text, &asked), calls(text), Scaled::at(text, 0));
        }
    }

    #[test]
    fn law_scaled_numbers_are_read_back(number in any::<i32>(), exponent in 0u16..10) {
        let scaled = Scaled { number, base: 10, exponent };
        prop_assert_eq!(Scaled::at(&scaled.bytes(), 0), Some(scaled));
    }

    #[test]
    fn law_addresses_are_printed_as_they_are_read(byte in 0u16..60_000, bit in 0u8..8) {
        let address = PmcAddress { letter: 'R', byte };
        prop_assert_eq!(PmcAddress::parse(&address.to_string()), Some(address));
        prop_assert_eq!(PmcBit::parse(&format!("{address}.{bit}")), Some(PmcBit { byte: address, bit }));
    }
}

/// A client of the vendor greets so, on its first and second connection: published in huienming/nclink-c,
/// protocal/docs/01-FANUC-CNC-FOCAS.md, section 2.1; it closes with the last of these.
#[test]
fn oracle_greetings_are_those_of_a_published_capture() {
    let bytes = |text: &str| -> Vec<u8> {
        text.split(' ').map(|b| u8::from_str_radix(b, 16).unwrap()).collect()
    };
    assert_eq!(hello(1), bytes("a0 a0 a0 a0 00 01 01 01 00 02 00 01"));
    assert_eq!(hello(2), bytes("a0 a0 a0 a0 00 01 01 01 00 02 00 02"));
    assert_eq!(trueaxis_live::focas::codec::close(), bytes("a0 a0 a0 a0 00 01 02 01 00 00"));
    // A greeting is answered in 16 bytes and 8 for each record; the count stands after eight bytes (section 3.1 there).
    let back = hello_back(3);
    assert_eq!((back.len(), back[10 + 9]), (10 + 16 + 8, 1));
}

/// 197.62, as in the documentation of PyPI pyfocas 0.1.1.
#[test]
fn oracle_a_scaled_number_of_pyfocas() {
    let bytes = [0x0b, 0xc7, b'q', b' ', 0, 10, 0, 6];
    assert_eq!(Scaled::at(&bytes, 0).map(Scaled::value), Some(197.62));
    assert_eq!(Scaled::at(&[0, 0, 0, 1, 0, 10, 0xff, 0xff], 0), None);
}
