//! Pins in the shared memory of LinuxCNC. Its library is opened when a run starts: nothing of it is needed to build.
//!
//! The functions are those of `hal.h` (LinuxCNC 2.9), see `man 3hal hal_pin_new`. A component that was killed keeps its name and
//! its hold on the signals; a new one takes the next name and takes the signals from it, unless its heartbeat goes on.

use super::{Layout, Pins};
use crate::clock::{Clock, RealClock};
use libloading::{Library, Symbol};
use std::ffi::{CString, c_char, c_int, c_long, c_void};
use std::ptr::{read_volatile, write_volatile};
use std::time::Duration;

const LIBRARY: &str = "liblinuxcnchal.so.0";
const BIT: c_int = 1;
const FLOAT: c_int = 2;
const IN: c_int = 16;
const OUT: c_int = 32;
/// Runs that were killed before this one, at most.
const MOST_NAMES: usize = 9;
/// A heartbeat that does not change for so long has stopped.
const DEAD_S: f64 = 0.2;

/// Why there are no pins.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HalFault {
    /// LinuxCNC is not installed.
    #[error("{LIBRARY} cannot be opened: {0}")]
    NoLibrary(String),
    /// It is not what it should be.
    #[error("{LIBRARY} has no {0}: it is of a version that this program does not know")]
    NoFunction(String),
    /// LinuxCNC lets no component in.
    #[error("HAL lets no component in ({0}): is LinuxCNC running, and by the same user?")]
    NoComponent(i32),
    /// A pin or a signal is missing.
    #[error("HAL has no signal {signal} of the right kind ({code})")]
    NoSignal {
        /// Its name.
        signal: String,
        /// What HAL says.
        code: i32,
    },
    /// No memory.
    #[error("HAL has no memory left")]
    NoMemory,
    /// Another run writes into the same signals.
    #[error("another component has these signals, and its heartbeat goes on")]
    Held,
}

type Init = unsafe extern "C" fn(*const c_char) -> c_int;
type OfComponent = unsafe extern "C" fn(c_int) -> c_int;
type Allocate = unsafe extern "C" fn(c_long) -> *mut c_void;
type NewPin = unsafe extern "C" fn(*const c_char, c_int, c_int, *mut *mut c_void, c_int) -> c_int;
type Link = unsafe extern "C" fn(*const c_char, *const c_char) -> c_int;
type Unlink = unsafe extern "C" fn(*const c_char) -> c_int;

/// The functions that are used.
struct Functions {
    init: Init,
    ready: OfComponent,
    exit: OfComponent,
    allocate: Allocate,
    new_pin: NewPin,
    link: Link,
    unlink: Unlink,
    /// Keeps them where they are.
    _library: Library,
}

impl Functions {
    fn open() -> Result<Self, HalFault> {
        // SAFETY: the library of LinuxCNC runs no code of ours when it is opened; it maps the memory of HAL later.
        let library = unsafe { Library::new(LIBRARY) };
        let library = library.map_err(|fault| HalFault::NoLibrary(fault.to_string()))?;
        // SAFETY: the types above are those of hal.h.
        unsafe {
            Ok(Self {
                init: *function(&library, "hal_init")?,
                ready: *function(&library, "hal_ready")?,
                exit: *function(&library, "hal_exit")?,
                allocate: *function(&library, "hal_malloc")?,
                new_pin: *function(&library, "hal_pin_new")?,
                link: *function(&library, "hal_link")?,
                unlink: *function(&library, "hal_unlink")?,
                _library: library,
            })
        }
    }

    fn init(&self, name: &str) -> c_int {
        let name = text(name);
        // SAFETY: a text with its end, which HAL copies.
        unsafe { (self.init)(name.as_ptr()) }
    }

    fn unlink(&self, pin: &str) {
        let pin = text(pin);
        // SAFETY: as above; a pin that is not there is refused.
        unsafe { (self.unlink)(pin.as_ptr()) };
    }

    /// A pin on its signal; where its value is.
    fn pin(
        &self,
        component: c_int,
        (pin, signal): (&str, &str),
        (kind, direction): (c_int, c_int),
    ) -> Result<Slot, HalFault> {
        let slot_size = c_long::try_from(size_of::<*mut c_void>()).unwrap_or(8);
        // SAFETY: HAL gives memory of that size, aligned for a pointer, or none.
        let slot = unsafe { (self.allocate)(slot_size) }.cast::<*mut c_void>();
        if slot.is_null() {
            return Err(HalFault::NoMemory);
        }
        let (name, of) = (text(pin), text(signal));
        let no_signal = |code| HalFault::NoSignal { signal: signal.to_owned(), code };
        // SAFETY: `slot` is HAL memory, as hal_pin_new asks for.
        let code = unsafe { (self.new_pin)(name.as_ptr(), kind, direction, slot, component) };
        if code < 0 {
            return Err(no_signal(code));
        }
        // SAFETY: two texts with their ends.
        let code = unsafe { (self.link)(name.as_ptr(), of.as_ptr()) };
        if code < 0 { Err(no_signal(code)) } else { Ok(Slot(slot)) }
    }
}

/// # Safety
/// `F` is the type of that function.
unsafe fn function<'l, F>(library: &'l Library, name: &str) -> Result<Symbol<'l, F>, HalFault> {
    // SAFETY: the caller names the type.
    let found = unsafe { library.get(name.as_bytes()) };
    found.map_err(|_| HalFault::NoFunction(name.to_owned()))
}

/// Names are made of letters, digits and `-`.
fn text(name: &str) -> CString {
    CString::new(name).unwrap_or_default()
}

/// A place in the memory of HAL that says where the value is: that changes when a pin is linked.
#[derive(Debug, Clone, Copy)]
struct Slot(*mut *mut c_void);

impl Slot {
    fn number(self) -> f64 {
        // SAFETY: HAL keeps slot and value as long as the component is there; 8 bytes are read at once.
        unsafe { read_volatile(read_volatile(self.0).cast::<f64>()) }
    }

    fn bit(self) -> bool {
        // SAFETY: as above; a bit of HAL is one byte.
        unsafe { read_volatile(read_volatile(self.0).cast::<u8>()) != 0 }
    }

    fn set_number(self, value: f64) {
        // SAFETY: as above; the signal has this one writer.
        unsafe { write_volatile(read_volatile(self.0).cast::<f64>(), value) }
    }

    fn set_bit(self, value: bool) {
        // SAFETY: as above.
        unsafe { write_volatile(read_volatile(self.0).cast::<u8>(), u8::from(value)) }
    }
}

/// A component of HAL with its pins; they go when it is dropped.
pub struct HalPins {
    functions: Functions,
    component: c_int,
    numbers_in: Vec<Slot>,
    bits_in: Vec<Slot>,
    numbers_out: Vec<Slot>,
    bits_out: Vec<Slot>,
}

impl HalPins {
    /// Pins on their signals.
    ///
    /// # Errors
    /// LinuxCNC that is not there, or without `trueaxis.hal`.
    pub fn open(layout: &Layout) -> Result<Self, HalFault> {
        let functions = Functions::open()?;
        let mut pins = Self {
            functions,
            component: -1,
            numbers_in: Vec::new(),
            bits_in: Vec::new(),
            numbers_out: Vec::new(),
            bits_out: Vec::new(),
        };
        let mut last = 0;
        let mut name = String::new();
        for number in 1..=MOST_NAMES {
            name = if number == 1 { "trueaxis".to_owned() } else { format!("trueaxis-{number}") };
            last = pins.functions.init(&name);
            if last >= 0 {
                pins.take_signals(layout, number)?;
                break;
            }
        }
        pins.component = last;
        if last < 0 {
            return Err(HalFault::NoComponent(last));
        }
        pins.fill(layout, &name)?;
        // SAFETY: the component is ours.
        let code = unsafe { (pins.functions.ready)(pins.component) };
        if code < 0 { Err(HalFault::NoComponent(code)) } else { Ok(pins) }
    }

    /// From components of earlier runs, which were killed.
    fn take_signals(&self, layout: &Layout, number: usize) -> Result<(), HalFault> {
        if number == 1 {
            return Ok(());
        }
        self.is_dead(number)?;
        for earlier in 1..number {
            let name =
                if earlier == 1 { "trueaxis".to_owned() } else { format!("trueaxis-{earlier}") };
            let pins = layout.numbers_out.iter().chain(&layout.bits_out);
            pins.for_each(|pin| self.functions.unlink(&format!("{name}.{pin}")));
        }
        Ok(())
    }

    /// Looks at the heartbeat of the earlier ones for a while.
    fn is_dead(&self, number: usize) -> Result<(), HalFault> {
        let name = format!("trueaxis-{number}-look");
        let component = self.functions.init(&name);
        if component < 0 {
            return Err(HalFault::NoComponent(component));
        }
        let beat = self.functions.pin(
            component,
            (&format!("{name}.heartbeat"), "ta-heartbeat"),
            (BIT, IN),
        );
        let changes = beat.map(|beat| {
            let (clock, first) = (RealClock::start(), beat.bit());
            while clock.now_s() < DEAD_S && beat.bit() == first {
                std::thread::sleep(Duration::from_millis(1));
            }
            beat.bit() != first
        });
        // SAFETY: the component is ours.
        unsafe { (self.functions.exit)(component) };
        if changes? { Err(HalFault::Held) } else { Ok(()) }
    }

    fn fill(&mut self, layout: &Layout, name: &str) -> Result<(), HalFault> {
        let all = |names: &[String], kind, direction| {
            let pin = |of: &String| {
                let names = (format!("{name}.{of}"), format!("ta-{of}"));
                self.functions.pin(self.component, (&names.0, &names.1), (kind, direction))
            };
            names.iter().map(pin).collect::<Result<Vec<Slot>, HalFault>>()
        };
        let numbers_in = all(&layout.numbers_in, FLOAT, IN)?;
        let bits_in = all(&layout.bits_in, BIT, IN)?;
        let numbers_out = all(&layout.numbers_out, FLOAT, OUT)?;
        let bits_out = all(&layout.bits_out, BIT, OUT)?;
        (self.numbers_in, self.bits_in) = (numbers_in, bits_in);
        (self.numbers_out, self.bits_out) = (numbers_out, bits_out);
        Ok(())
    }
}

impl Drop for HalPins {
    fn drop(&mut self) {
        // The signal keeps this: the watchdog rests.
        self.bits_out.iter().for_each(|bit| bit.set_bit(false));
        if self.component >= 0 {
            // SAFETY: the component is ours, and no slot is used after this.
            unsafe { (self.functions.exit)(self.component) };
        }
    }
}

impl Pins for HalPins {
    fn number(&self, at: usize) -> f64 {
        self.numbers_in[at].number()
    }

    fn bit(&self, at: usize) -> bool {
        self.bits_in[at].bit()
    }

    fn set_number(&mut self, at: usize, value: f64) {
        self.numbers_out[at].set_number(value);
    }

    fn set_bit(&mut self, at: usize, value: bool) {
        self.bits_out[at].set_bit(value);
    }
}
