//! One axis of the governor: whole increments, limits, slew, dead band.

/// The limits of one axis, in least increments of the control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisLimits {
    /// The largest correction.
    pub limit: i32,
    /// The largest change by one write.
    pub step: i32,
    /// How fast the correction changes, increments per second. Unit: counts.
    pub slew_per_s: f64,
    /// The largest change of the target between two cycles.
    pub jump: i32,
    /// The target is followed only where it is away by so much; at least 1, so that rounding does not dither. Unit: counts.
    pub dead_band: f64,
}

/// A value in increments, rounded half away from zero; none beyond 32 bits, or of what is no number.
///
/// ```text
///     n = round(value / increment),  −2³¹ ≤ n < 2³¹
/// ```
///
/// ```
/// use trueaxis_live::governor::increments_of;
/// assert_eq!(increments_of(-2.5), Some(-3));
/// assert_eq!(increments_of(3e9), None);
/// assert_eq!(increments_of(f64::NAN), None);
/// ```
#[expect(clippy::cast_possible_truncation, reason = "checked: within 32 bits")]
pub fn increments_of(value: f64) -> Option<i32> {
    let rounded = value.round();
    (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&rounded).then_some(rounded as i32)
}

/// What is known of one axis.
#[derive(Debug, Clone)]
pub(super) struct AxisMemory {
    limits: AxisLimits,
    /// What stands there and is not ours.
    pub base: i32,
    /// What is ours.
    pub own: i32,
    /// What the control held before the last write, base included.
    pub before: i32,
    /// The last target that was one.
    target: Option<f64>,
    /// What the slew allows now, at most a step.
    allowance: f64,
    /// The target is beyond the limit.
    pub is_limited: bool,
    /// Slew or step did not let it come to where it shall go.
    pub is_behind: bool,
}

impl AxisMemory {
    pub fn new(limits: &AxisLimits) -> Self {
        let limits = *limits;
        Self {
            limits,
            base: 0,
            own: 0,
            before: 0,
            target: None,
            allowance: 0.0,
            is_limited: false,
            is_behind: false,
        }
    }

    /// The whole offset.
    pub fn whole(&self) -> i32 {
        self.base.saturating_add(self.own)
    }

    pub fn pass(&mut self, dt_s: f64) {
        let most = f64::from(self.limits.step);
        self.allowance = (self.allowance + self.limits.slew_per_s * dt_s).min(most);
    }

    /// Takes over what the control holds as base and own part.
    pub fn adopt(&mut self, held: i32, base: i32) {
        (self.base, self.before) = (base, held);
        self.own = held.saturating_sub(base);
        self.target = None;
    }

    /// Whether the own part would be within the limit, and all sums within 32 bits.
    pub fn can_adopt(&self, held: i32, base: i32) -> bool {
        let own = held.checked_sub(base);
        own.is_some_and(|own| own.unsigned_abs() <= self.limits.limit.unsigned_abs())
            && base.unsigned_abs() < 1 << 30
    }

    /// Takes what the control holds; the base stays.
    pub fn take(&mut self, held: i32) {
        self.own = held.saturating_sub(self.base);
        self.before = held;
    }

    /// The control has gone to `held` by itself; where it goes from there is no jump.
    pub fn release(&mut self, held: i32) {
        self.take(held);
        self.target = None;
    }

    /// Whether a value lies between the base and what was written: where a ladder has ramped to.
    pub fn is_between(&self, held: i32) -> bool {
        let ends = [self.base, self.whole(), self.before];
        let (low, high) = (ends.iter().min(), ends.iter().max());
        low.zip(high).is_some_and(|(low, high)| (low..=high).contains(&&held))
    }

    /// Whether a target is too far from the last one. While there was none it may have moved by the slew.
    pub fn jumps(&self, target: f64, missing_s: f64) -> bool {
        let Some(last) = self.target else { return false };
        let allowed = f64::from(self.limits.jump) + self.limits.slew_per_s * missing_s;
        (target - last).abs() > allowed
    }

    pub fn forget_target(&mut self) {
        self.target = None;
    }

    pub fn wish(&mut self, target: f64) {
        self.target = Some(target);
        self.is_limited = target.abs() >= f64::from(self.limits.limit) + 0.5;
    }

    /// Where the axis shall go; none within the dead band.
    pub fn wanted(&self, target: f64) -> Option<i32> {
        let most = f64::from(self.limits.limit);
        let target = target.clamp(-most, most);
        let away = (target - f64::from(self.own)).abs() >= self.limits.dead_band.max(1.0);
        increments_of(target).filter(|_| away)
    }

    /// Goes there as far as step and slew allow; `true` if it moved. Within the dead band there is nowhere to go.
    pub fn go(&mut self, to: Option<i32>) -> bool {
        let moved = to.is_some_and(|to| self.go_to(to));
        self.is_behind = to.is_some_and(|to| self.own != to);
        moved
    }

    fn go_to(&mut self, to: i32) -> bool {
        let Some(most) = increments_of(self.allowance.floor()).filter(|most| *most > 0) else {
            return false;
        };
        let by = to.saturating_sub(self.own).clamp(-most, most);
        if by == 0 {
            return false;
        }
        self.own += by;
        self.allowance -= f64::from(by.abs());
        true
    }

    /// Four fifths of the limit are used.
    pub fn is_near_limit(&self) -> bool {
        i64::from(self.own).abs() * 5 >= i64::from(self.limits.limit) * 4
    }
}
