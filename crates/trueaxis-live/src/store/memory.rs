//! A store in memory, for tests and forecasts.

use super::{Event, Store};
use crate::cycle::CycleInput;
use crate::datum::Datum;
use crate::governor::{Order, Owned};
use crate::setups::SetupDatum;
use std::cell::RefCell;
use std::rc::Rc;

/// What was kept.
#[derive(Debug, Clone, Default)]
pub struct Noted {
    /// What was owned last.
    pub owned: Option<Owned>,
    /// The events.
    pub events: Vec<Event>,
    /// The record.
    pub cycles: Vec<(CycleInput, Order)>,
    /// Nothing can be kept.
    pub fails: bool,
    /// The zeros of all setups.
    pub datums: Vec<SetupDatum>,
    /// The part that is made.
    pub part: Option<String>,
    /// The lines of all records.
    pub part_lines: Vec<String>,
    /// Whether cycles are recorded.
    pub records: bool,
}

/// Keeps everything in memory; all clones keep in the same place.
#[derive(Debug, Clone, Default)]
pub struct MemoryStore(pub Rc<RefCell<Noted>>);

impl Noted {
    /// The zero that was touched last.
    pub fn datum(&self) -> Option<Datum> {
        self.datums.last()?.datum.clone()
    }
}

impl MemoryStore {
    fn unless_failing(&self) -> Result<(), String> {
        if self.0.borrow().fails { Err("no space left on device".to_owned()) } else { Ok(()) }
    }
}

impl Store for MemoryStore {
    fn own(&mut self, owned: &Owned) -> Result<(), String> {
        self.unless_failing()?;
        self.0.borrow_mut().owned = Some(owned.clone());
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), String> {
        self.unless_failing()?;
        self.0.borrow_mut().events.push(event.clone());
        Ok(())
    }

    fn state(&mut self, _: &serde_json::Value) -> Result<(), String> {
        self.unless_failing()
    }

    fn datums(&mut self, all: &[SetupDatum]) -> Result<(), String> {
        self.unless_failing()?;
        self.0.borrow_mut().datums = all.to_vec();
        Ok(())
    }

    fn part(&mut self) -> Option<String> {
        self.0.borrow().part.clone()
    }

    fn part_line(&mut self, line: String) -> Result<(), String> {
        self.unless_failing()?;
        self.0.borrow_mut().part_lines.push(line);
        Ok(())
    }

    fn record(&mut self, input: &CycleInput, order: &Order) -> Result<(), String> {
        if self.0.borrow().records {
            self.0.borrow_mut().cycles.push((input.clone(), order.clone()));
        }
        Ok(())
    }
}
