//! Days of the calendar.

use std::fmt;

/// A day.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date {
    year: i32,
    month: u32,
    day: u32,
}

impl Date {
    /// Reads `2026-03-14` (also with a time after it), `2026/03/14` or `14.03.2026`; no other order of day and month.
    ///
    /// ```
    /// use trueaxis_input::Date;
    /// assert_eq!(Date::parse("14.03.2026"), Date::parse("2026-03-14T10:00:00"));
    /// assert!(["foo", "", "2026-02-30", "03/04/2026", "2026-03"].iter().all(|text| Date::parse(text).is_none()));
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let day = text.trim().split(['T', ' ', 't']).next()?;
        let numbers = |sign: char| -> Option<[i32; 3]> {
            let all: Option<Vec<i32>> = day.split(sign).map(|n| n.parse().ok()).collect();
            all?.try_into().ok()
        };
        let [year, month, day] = match (numbers('-').or_else(|| numbers('/')), numbers('.')) {
            (Some(ymd), _) => ymd,
            (None, Some([day, month, year])) => [year, month, day],
            _ => return None,
        };
        let date = Self { year, month: u32::try_from(month).ok()?, day: u32::try_from(day).ok()? };
        let sound = (1900..=2200).contains(&year) && (1..=12).contains(&month);
        (sound && (1..=date.days_of_month()).contains(&date.day)).then_some(date)
    }

    fn is_leap(self) -> bool {
        self.year % 4 == 0 && (self.year % 100 != 0 || self.year % 400 == 0)
    }

    fn days_of_month(self) -> u32 {
        match self.month {
            2 if self.is_leap() => 29,
            2 => 28,
            4 | 6 | 9 | 11 => 30,
            _ => 31,
        }
    }

    /// Days since 1900-01-01.
    pub fn number(self) -> i32 {
        let before = |year: i32| {
            let y = year - 1;
            365 * (year - 1900) + (y / 4 - y / 100 + y / 400) - 460
        };
        let months = (1..self.month).map(|month| Self { month, ..self }.days_of_month());
        before(self.year) + months.sum::<u32>() as i32 + self.day as i32 - 1
    }

    /// The day of a number; the last one known where it lies beyond.
    pub fn of_number(number: i32) -> Self {
        let mut date = Self { year: 1900 + (number / 366).clamp(0, 300), month: 1, day: 1 };
        while (Self { year: date.year + 1, ..date }).number() <= number && date.year < 2200 {
            date.year += 1;
        }
        while date.month < 12 && (Self { month: date.month + 1, ..date }).number() <= number {
            date.month += 1;
        }
        let day = (number - date.number()).clamp(0, 30).unsigned_abs() + 1;
        Self { day: day.min(date.days_of_month()), ..date }
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_follow_each_other() {
        let first = Date::parse("1900-01-01").map(Date::number);
        assert_eq!(first, Some(0));
        // 1 January 2000 is day 36524 after 1 January 1900.
        assert_eq!(Date::parse("2000-01-01").map(Date::number), Some(36_524));
        for number in (0..100_000).step_by(7) {
            let date = Date::of_number(number);
            assert_eq!(date.number(), number, "{date}");
            assert_eq!(Date::parse(&date.to_string()), Some(date));
        }
    }
}
