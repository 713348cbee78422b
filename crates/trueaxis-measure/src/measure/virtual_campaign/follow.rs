//! Where the axes are while the control commands: lag, backlash, sticking, repeatability, and when.
//!
//! ```text
//!     τ ṁ + m = q      s = clamp(s, m − b/2, m + b/2)      δ = s − q − d h e^{−(t − t_r)/t_s}
//!                                                                          docs/model.md eq. 116
//! ```
//!
//! q the command, m the motor, s the slide; d the direction since the last reversal at t_r.

use super::{AxisDisturb, Chance, VirtualCampaign, chance, normal};
use crate::measure::motion::{REST, length_mm};
use crate::measure::path::Path;
use crate::measure::{Campaign, Motion, Reading};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::{Approach, Command, MAX_AXES};
use trueaxis_motion::limits;
use trueaxis_motion::timing::AxisLimits;

/// The lag is exact between stations; the play of the backlash follows it in so many steps.
const STEPS: u32 = 16;

/// A station as it is passed.
#[derive(Debug, Clone, Copy)]
pub struct Stand {
    /// Which path.
    pub path: u32,
    /// Which station of it, from 0.
    pub station: u32,
    /// The station, with its time and the sides from which the axes came.
    pub reading: Reading,
    /// Where the axes are less their command, mm or rad.
    pub offset: Command,
}

/// How long an axis takes from rest to rest, s: jerk, acceleration and velocity at their limits.
///
/// *Source:* Biagiotti, Melchiorri 2008, ch. 3.4 (double S velocity profile).
pub fn move_time_s(distance: f64, velocity: f64, acceleration: f64, jerk: f64) -> f64 {
    let d = distance.abs();
    if d == 0.0 {
        return 0.0;
    }
    // How long it takes to a speed.
    let rise = |v: f64| match v * jerk >= acceleration * acceleration {
        true => v / acceleration + acceleration / jerk,
        false => 2.0 * (v / jerk).sqrt(),
    };
    if d >= velocity * rise(velocity) {
        return rise(velocity) + d / velocity;
    }
    let ramp = acceleration * acceleration / jerk;
    if d >= 2.0 * ramp * acceleration / jerk {
        let peak = 0.5 * ((ramp * ramp + 4.0 * acceleration * d).sqrt() - ramp);
        return 2.0 * (peak / acceleration + acceleration / jerk);
    }
    4.0 * (d / (2.0 * jerk)).cbrt()
}

/// All stations in order, and how long they take, s.
pub fn follow(campaign: &Campaign, real: &VirtualCampaign) -> (Vec<Stand>, f64) {
    let mut drives = Drives::new(&campaign.machine, &real.disturb.axes, real.truth.seed);
    let mut stands = Vec::new();
    for (path, of) in (0u32..).zip(&real.paths) {
        for station in 0..of.stations.len() {
            let mut reading = of.stations.row(station);
            let next = of.stations.commands.get(station + 1);
            let moving = of.feed_mm_per_s.filter(|_| station > 0);
            match moving {
                None => drives.stop_at(&reading.command, &reading.approach, of.overrun, of.dwell_s),
                Some(feed) => {
                    let instrument = &campaign.instruments[reading.instrument as usize];
                    let before = &of.stations.commands[station - 1];
                    let length = length_mm(&campaign.machine, instrument, before, &reading.command);
                    drives.go_to(&reading.command, length / feed);
                }
            }
            let passed = of.feed_mm_per_s.is_some();
            if let Some(next) = next.filter(|_| passed) {
                drives.turn_towards(next);
            }
            reading.motion = Motion::at_feed(moving.unwrap_or(0.0));
            reading.time_s = drives.time_s;
            reading.approach = drives.approach;
            let station = u32::try_from(station).unwrap_or(u32::MAX);
            stands.push(Stand { path, station, reading, offset: drives.offset() });
        }
    }
    (stands, drives.time_s)
}

/// Gives every station of paths that follow each other the time at which it would be read.
pub fn set_times(campaign: &Campaign, paths: &mut [Path]) {
    let real = VirtualCampaign::nominal(campaign, paths.to_vec());
    for stand in follow(campaign, &real).0 {
        let stations = &mut paths[stand.path as usize].stations;
        stations.times_s[stand.station as usize] = stand.reading.time_s;
    }
}

/// The drives of all axes.
struct Drives<'a> {
    machine: &'a Machine,
    axes: &'a [AxisDisturb; MAX_AXES],
    limits: AxisLimits,
    random: rand_chacha::ChaCha8Rng,
    time_s: f64,
    /// What the control commands; nothing before the first station.
    commanded: Option<Command>,
    motor: Command,
    slide: Command,
    approach: Approach,
    /// When each axis turned, and where to.
    turned_s: [Option<(f64, f64)>; MAX_AXES],
}

impl<'a> Drives<'a> {
    fn new(machine: &'a Machine, axes: &'a [AxisDisturb; MAX_AXES], seed: u64) -> Self {
        Self {
            machine,
            axes,
            limits: limits(machine),
            random: chance(seed, Chance::Repeatability),
            time_s: 0.0,
            commanded: None,
            motor: Command::default(),
            slide: Command::default(),
            approach: Approach::default(),
            turned_s: [None; MAX_AXES],
        }
    }

    fn count(&self) -> usize {
        self.machine.axes().len()
    }

    /// Goes there at the limits of the axes and stands still; a path may state the side from
    /// which an axis comes, if need be by going too far first.
    fn stop_at(&mut self, target: &Command, stated: &Approach, overrun: f64, dwell_s: f64) {
        let from = self.commanded.unwrap_or(*target);
        let mut longest: f64 = 0.0;
        for i in 0..self.count() {
            let l = &self.limits;
            let way = target[i] - from[i];
            let time = |way| move_time_s(way, l.velocity[i], l.acceleration[i], l.jerk[i]);
            let moves = way.abs() > REST;
            let came = if moves { way.signum() } else { self.approach[i] };
            let turned = stated[i] != 0.0 && stated[i] != came;
            // Beyond the target and back.
            let detour = if turned && self.commanded.is_some() { overrun } else { 0.0 };
            longest = longest.max(time(way.abs() + detour) + time(detour));
            // Always drawn, so that the numbers of one axis do not depend on another.
            let missed = self.axes[i].repeatability * normal(&mut self.random);
            self.motor[i] = target[i];
            self.approach[i] = if turned { stated[i] } else { came };
            let half = 0.5 * self.axes[i].backlash;
            let slide = match self.commanded {
                _ if turned => target[i] - stated[i] * half,
                // Before its first move an axis stands in the middle of its play.
                None => target[i],
                Some(_) if !moves => continue,
                Some(_) => self.slide[i].clamp(target[i] - half, target[i] + half),
            };
            self.slide[i] = slide + missed;
        }
        self.turned_s = [None; MAX_AXES];
        self.commanded = Some(*target);
        self.time_s += longest + dwell_s;
    }

    /// Goes on along the path, straight in the axes, in that time or what the fastest axis needs.
    fn go_to(&mut self, target: &Command, time_s: f64) {
        let from = self.commanded.unwrap_or(*target);
        let mut time = time_s;
        for i in 0..self.count() {
            time = time.max((target[i] - from[i]).abs() / self.limits.velocity[i]);
        }
        if time > 0.0 && time.is_finite() {
            let step = time / f64::from(STEPS);
            for i in 0..self.count() {
                let speed = (target[i] - from[i]) / time;
                if (target[i] - from[i]).abs() > REST {
                    self.approach[i] = speed.signum();
                }
                for k in 1..=STEPS {
                    let q = from[i] + speed * step * f64::from(k);
                    self.follow_ramp(i, q, speed, step);
                }
            }
            self.time_s += time;
        }
        self.commanded = Some(*target);
    }

    /// The exact answer of a first-order lag to a ramp, then the play.
    fn follow_ramp(&mut self, i: usize, q: f64, speed: f64, step_s: f64) {
        let AxisDisturb { lag_s, backlash, .. } = self.axes[i];
        self.motor[i] = match lag_s > 0.0 {
            true => {
                let steady = q - lag_s * speed;
                let left = self.motor[i] - (q - speed * step_s - lag_s * speed);
                steady + left * (-step_s / lag_s).exp()
            }
            false => q,
        };
        let half = 0.5 * backlash;
        self.slide[i] = self.slide[i].clamp(self.motor[i] - half, self.motor[i] + half);
    }

    /// An axis that turns here sticks from here on.
    fn turn_towards(&mut self, next: &Command) {
        let Some(here) = self.commanded else { return };
        for i in 0..self.count() {
            let way = next[i] - here[i];
            if way.abs() > REST && way * self.approach[i] < 0.0 {
                self.turned_s[i] = Some((self.time_s, way.signum()));
            }
        }
    }

    fn offset(&self) -> Command {
        let mut offset = Command::default();
        let Some(commanded) = self.commanded else { return offset };
        for i in 0..self.count() {
            offset[i] = self.slide[i] - commanded[i];
            let AxisDisturb { spike, spike_time_s, .. } = self.axes[i];
            if let Some((since, towards)) = self.turned_s[i].filter(|_| spike > 0.0) {
                let age = self.time_s - since;
                let left = if age > 0.0 { (-age / spike_time_s).exp() } else { 1.0 };
                offset[i] -= towards * spike * left;
            }
        }
        offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_move_takes_its_way_and_its_ramps() {
        // v/a + a/j + d/v = 0.1 + 0.05 + 1 s
        let time = move_time_s(1000.0, 1000.0, 10_000.0, 200_000.0);
        assert!((time - 1.15).abs() < 1e-12);
        assert_eq!(move_time_s(0.0, 1.0, 1.0, 1.0), 0.0);
    }

    #[test]
    fn times_grow_without_a_step_from_one_profile_to_the_next() {
        let time = |d: f64| move_time_s(d, 100.0, 1000.0, 20_000.0);
        // 2a³/j² = 5 mm, v(v/a + a/j) = 15 mm
        for edge in [5.0, 15.0] {
            assert!((time(edge + 1e-9) - time(edge - 1e-9)).abs() < 1e-8);
        }
    }
}
