//! The watchdog of the controller: what `docs/ladder-watchdog.md` asks a ladder to do, as a program.

/// What the builder of the machine has set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LadderSettings {
    /// The heartbeat must change within so much.
    pub timeout_s: f64,
    /// The largest offset, increments.
    pub limit: i32,
    /// How fast an offset that acts changes, increments per second. Unit: counts.
    pub ramp_per_s: f64,
}

/// The watchdog.
#[derive(Debug, Clone)]
pub struct Ladder {
    settings: LadderSettings,
    heartbeat: u8,
    silent_s: f64,
    /// The offsets that act, with what of an increment the ramp has gone on.
    acting: Vec<f64>,
    tripped: bool,
}

impl Ladder {
    /// Nothing acts, and until the first heartbeat nothing will.
    pub fn new(settings: LadderSettings, axes: usize) -> Self {
        Self {
            settings,
            heartbeat: 0,
            silent_s: f64::INFINITY,
            acting: vec![0.0; axes],
            tripped: true,
        }
    }

    /// One scan: `command` is what stands in the area; where the watchdog has tripped, it is overwritten by what acts.
    pub fn scan(&mut self, dt_s: f64, heartbeat: u8, command: &mut [i32]) {
        self.silent_s += dt_s;
        if heartbeat != self.heartbeat {
            (self.heartbeat, self.silent_s) = (heartbeat, 0.0);
        }
        self.tripped = self.silent_s > self.settings.timeout_s;
        let limit = f64::from(self.settings.limit);
        for (acting, command) in self.acting.iter_mut().zip(command.iter_mut()) {
            let to = if self.tripped { 0.0 } else { f64::from(*command).clamp(-limit, limit) };
            let most = self.settings.ramp_per_s * dt_s;
            *acting += (to - *acting).clamp(-most, most);
        }
        if self.tripped {
            for (command, acting) in command.iter_mut().zip(self.acting()) {
                *command = acting;
            }
        }
    }

    /// The offsets that act, increments.
    pub fn acting(&self) -> Vec<i32> {
        self.acting.iter().map(|a| crate::governor::increments_of(*a).unwrap_or(0)).collect()
    }

    /// Nothing came for too long.
    pub fn tripped(&self) -> bool {
        self.tripped
    }

    /// Power off and on: nothing acts.
    pub fn restart(&mut self) {
        *self = Self::new(self.settings, self.acting.len());
    }
}
