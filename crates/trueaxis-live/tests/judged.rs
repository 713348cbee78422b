//! Samples that come late, and logs that are older than the run.

use std::sync::Arc;
use trueaxis::input::Diagnostics;
use trueaxis::machine::heat::TemperatureLog;
use trueaxis_live::sensor::{LogSensor, Sample, Sensor, SensorFault, SensorSettings, Sent, Watch};

fn watch(stale_s: f64) -> Watch {
    Watch::new(vec![SensorSettings {
        name: "hall".to_owned(),
        input: "hall".to_owned(),
        range: [10.0, 45.0],
        rate_k_per_s: 2.0 / 60.0,
        stale_s,
        stuck_s: 600.0,
        is_workpiece: false,
        instead: None,
    }])
}

fn sample(text: &str, taken_s: f64) -> Sample {
    Sample { sensor: 0, sent: Sent::Text(text.to_owned()), taken_s: Some(taken_s) }
}

/// A sample that is older than the last one changes nothing, whatever it says: a broker that hands on late does not stop the run.
#[test]
fn law_an_older_sample_that_comes_late_changes_nothing() {
    for late in ["20.0", "12.0", "44.0", "900", "warm", "nan"] {
        let mut watch = watch(30.0);
        watch.take(&sample("20.5", 100.0), 100.0);
        let before = watch.judged(101.0);
        assert_eq!(before[0].celsius, Ok(20.5));
        watch.take(&sample(late, 90.0), 101.0);
        assert_eq!(watch.judged(101.0), before, "{late}");
        // One that is newer is judged as ever.
        watch.take(&sample("900", 102.0), 102.0);
        assert_eq!(watch.judged(102.0)[0].celsius, Err(SensorFault::OutOfRange(900.0)));
    }
}

/// The row before the start is as old as it is, on the clock of the run; after the last row there is none.
#[test]
fn law_a_row_before_the_start_is_as_old_as_it_is() {
    let text = "time_s,hall_degC\n0,20\n600,21\n1200,22\n";
    let log = TemperatureLog::parse("day.csv", text, &mut Diagnostics::new()).expect("a log");
    let log = Arc::new(log);
    for (start_s, speed, celsius, age_s) in [
        (600.0, 1.0, 21.0, 0.0),
        (900.0, 1.0, 21.0, 300.0),
        (900.0, 10.0, 21.0, 30.0),
        (7200.0, 1.0, 22.0, 6000.0),
    ] {
        let mut sensor = LogSensor::new(Arc::clone(&log), "hall", 0, start_s).at_speed(speed);
        let mut watch = watch(60.0);
        let samples = sensor.poll(0.0);
        samples.iter().for_each(|sample| watch.take(sample, 0.0));
        let judged = watch.judged(0.0);
        assert_eq!(judged[0].age_s, Some(age_s), "start {start_s} s");
        let due = if age_s > 60.0 { Err(SensorFault::Stale(60.0)) } else { Ok(celsius) };
        assert_eq!(judged[0].celsius, due, "start {start_s} s");
    }
}
