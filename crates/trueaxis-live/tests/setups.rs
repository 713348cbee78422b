//! Pallets, work offsets, clampings: each number of the control has a zero of its own.

mod rig;

use rig::{Rig, standing};
use trueaxis_live::cycle::Correction;
use trueaxis_live::datum::{Datum, DatumOrder};
use trueaxis_live::focas::PmcAddress;
use trueaxis_live::governor::State;
use trueaxis_live::setups::{SetupDatum, Setups};

const INHIBIT: &str = "inhibit = \"R1044.0\"";

fn rig() -> Rig {
    Rig::new(standing(&[(INHIBIT, "inhibit = \"R1044.0\"\nsetup = \"R1046\"")]))
}

fn clamp(rig: &Rig, number: u8) {
    let at = PmcAddress::parse("R1046").expect("an address");
    rig.mock.borrow_mut().set_byte(at, number);
}

/// The hall is warmer when the second pallet is touched: each part keeps the zero of its own touch, however often they change
/// places. Nothing is written while a zero is missing, and no write is larger than the step.
#[test]
fn law_each_pallet_has_the_zero_of_its_touch() {
    let mut rig = rig();
    clamp(&rig, 1);
    rig.pass(20.0);
    let first = rig.acting();
    assert_eq!(rig.state(), State::Run, "{}", rig.story());
    clamp(&rig, 2);
    rig.pass(1.0);
    let writes = rig.writes();
    assert!(rig.state() == State::Hold && rig.shown().contains("setup 2"), "{}", rig.shown());
    // 0.5 K more at the scales while nothing is corrected: it is missing when the second part is touched.
    for celsius in [30.7, 30.9, 31.0] {
        rig.sensors.borrow_mut().celsius[0] = celsius;
        rig.pass(10.0);
    }
    assert_eq!((rig.state(), rig.writes(), rig.acting()), (State::Hold, writes, first.clone()));
    rig.run.ask_datum(DatumOrder::Take);
    rig.pass(10.0);
    // Nothing moves at the touch.
    assert_eq!((rig.state(), rig.acting()), (State::Run, first.clone()), "{}", rig.story());
    let missing = rig.store.0.borrow().datum().expect("kept").missing[0];
    // 10.8 µm/(m·K) · 3.5 m · 0.5 K by hand.
    assert!((missing.abs() - 0.0189).abs() < 1.5e-3, "{missing}");
    for (number, due) in [(1, 1.0), (2, 0.0), (1, 1.0), (2, 0.0)] {
        clamp(&rig, number);
        rig.pass(10.0);
        assert_eq!(rig.state(), State::Run, "{}", rig.story());
        let by_mm = f64::from(rig.acting()[0] - first[0]) * 1e-3 * rig.plan.axes[0].sign;
        assert!((by_mm - due * missing).abs() < 1.6e-3, "setup {number}: {by_mm} of {missing}");
    }
    assert_eq!(rig.store.0.borrow().datums.len(), 2);
}

/// A restart knows both; on a third one it takes over what stands in the control, holds, and can be touched.
#[test]
fn a_restart_goes_on_from_the_zeros_of_all_setups() {
    let of = |setup: i32, mm: f64| SetupDatum {
        setup: Some(setup),
        datum: Some(Datum { missing: vec![mm, 0.0] }),
    };
    let kept = vec![of(1, 0.0), of(2, 0.03)];
    let mut acting = Vec::new();
    for number in [1, 2] {
        let mut rig = rig();
        clamp(&rig, number);
        rig.run.ask_datum(DatumOrder::Kept(kept.clone()));
        rig.pass(20.0);
        assert_eq!(rig.state(), State::Run, "{}", rig.story());
        acting.push(rig.acting()[0]);
    }
    assert!((acting[0] - acting[1] - 30).abs() <= 1, "{acting:?}");
    for clears in [true, false] {
        let mut rig = rig();
        clamp(&rig, 3);
        rig.run.ask_datum(DatumOrder::Kept(kept.clone()));
        rig.pass(5.0);
        assert!(rig.state() == State::Hold && rig.writes() == 0, "{}", rig.story());
        rig.run.ask_datum(if clears { DatumOrder::Clear } else { DatumOrder::Take });
        rig.pass(20.0);
        assert_eq!(rig.state(), State::Run, "{}", rig.story());
        let due = if clears { acting[0] } else { 0 };
        assert!((rig.acting()[0] - due).abs() <= 1, "{:?} {acting:?}", rig.acting());
        assert_eq!(rig.store.0.borrow().datums.len(), 3);
    }
}

/// A record in which setups change gives the same orders again.
#[test]
fn law_a_record_with_setups_gives_the_same_orders() {
    let mut rig = rig();
    rig.store.0.borrow_mut().records = true;
    clamp(&rig, 1);
    rig.pass(10.0);
    clamp(&rig, 2);
    rig.pass(3.0);
    rig.run.ask_datum(DatumOrder::Take);
    rig.pass(3.0);
    clamp(&rig, 1);
    rig.pass(5.0);
    let mut correction = Correction::new(&rig.plan, None);
    for (input, order) in &rig.store.0.borrow().cycles {
        let text = serde_json::to_string(input).expect("JSON");
        let again = serde_json::from_str(&text).expect("the same");
        assert_eq!(&correction.step(&again).order, order);
    }
}

/// Without a number nothing changes; the first one takes the zero that was there.
#[test]
fn the_first_number_has_the_zero_of_the_run_before() {
    let datum = Some(Datum { missing: vec![0.01] });
    let mut setups = Setups::new(None, vec![SetupDatum { setup: None, datum: datum.clone() }]);
    assert!(!setups.show(None) && setups.datum() == datum.as_ref());
    assert!(setups.show(Some(7)) && setups.datum() == datum.as_ref());
    assert!(setups.show(Some(8)) && setups.fault().is_some() && setups.datum().is_none());
    assert!(setups.show(Some(7)) && setups.datum() == datum.as_ref() && setups.fault().is_none());
    setups.clear();
    assert_eq!((setups.datum(), setups.known().len()), (None, 1));
}

/// To commission an axis is no run with a part: the zeros of the folder stay, whatever the control shows.
#[test]
fn commissioning_replaces_no_zero() {
    let rig = rig();
    let mut rig = Rig { run: rig.run.with_target(vec![10.0, 0.0]), ..rig };
    clamp(&rig, 1);
    rig.pass(5.0);
    assert_eq!((rig.state(), rig.acting()), (State::Run, vec![10, 0]), "{}", rig.story());
    assert!(rig.store.0.borrow().datums.is_empty());
}
