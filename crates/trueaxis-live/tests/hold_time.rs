//! How long a Hold lasts before the offset is ramped down.

use trueaxis_live::control::{Mode, Seen};
use trueaxis_live::governor::{
    AfterHold, AxisLimits, Governor, Inputs, OnDifference, Reason, Settings, State,
};

fn settings(hold_s: f64) -> Settings {
    let axis = AxisLimits { limit: 500, step: 20, slew_per_s: 100.0, jump: 60, dead_band: 1.0 };
    Settings {
        axes: vec![axis],
        window_s: 0.3,
        hold_s,
        after_hold: AfterHold::Ramp,
        ramp_in_cut: true,
        modes: vec![Mode::Automatic],
        on_difference: OnDifference::Latch,
        ladder_ramps: false,
    }
}

/// A target that is missing for longer than the hold time is ramped down in the first cycle after that time, whatever the period.
#[test]
fn law_a_hold_ends_in_the_first_cycle_after_its_time() {
    let hold_s = 2.05;
    for period_s in [0.02, 0.1, 0.3] {
        let mut governor = Governor::new(settings(hold_s), None);
        let seen = Seen::moving(vec![0.0; 3], vec![0]);
        let mut step = |target: Result<&[f64], Reason>| {
            let seen = Ok(&seen);
            let inputs = Inputs { seen, target, run: true, confirmed: false, journal_fails: false };
            governor.step(period_s, &inputs).state
        };
        let zero = [0.0; 1];
        for _ in 0..5 {
            step(Ok(&zero[..]));
        }
        assert_eq!(step(Ok(&zero[..])), State::Run);
        let mut missing = || step(Err(Reason::NotFinite));
        assert_eq!(missing(), State::Hold);
        let mut held_s = period_s;
        while missing() == State::Hold {
            held_s += period_s;
            assert!(held_s < 2.0 * hold_s, "it holds for ever");
        }
        let late = held_s - hold_s;
        assert!((0.0..period_s).contains(&late), "{period_s} s: ramped down after {held_s} s");
    }
}
