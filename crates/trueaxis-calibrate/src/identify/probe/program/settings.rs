//! `[program]` of a study of a probe: where the ring stands and how carefully it is touched.

use crate::identify::probe::Gauge;
use trueaxis_input::{Dimension, Item, Section, parse_quantity};

/// Directions around the ring unless the file says otherwise, as in Zhang et al. 2023, 3.1.
const DIRECTIONS: usize = 60;
/// More directions are a slip.
const MOST_DIRECTIONS: usize = 720;
/// Touches of a face.
const FACE_HITS: usize = 3;

/// The centre of the ball stays outside of the surface: this part of its radius at most.
const MOST_BEYOND: f64 = 0.9;

/// How the hits of a study are made.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramSettings {
    /// The number of the probe in the tool table of the control.
    pub tool: u32,
    /// The spindle when the ball is in the ring at the height where it touches, machine coordinate, mm.
    pub z_mm: f64,
    /// The spindle when the probe is clear of everything, mm.
    pub clear_z_mm: f64,
    /// How far the spindle is turned, rad.
    pub orientation_rad: f64,
    /// Touches around the ring.
    pub directions: usize,
    /// Ball to surface before a touch, mm.
    pub stand_off_mm: f64,
    /// Back from the fast touch before the slow one, mm.
    pub back_off_mm: f64,
    /// How far a touch goes on beyond the nominal surface, mm; `None`: as far as the ball allows, 1 mm at most.
    pub beyond_mm: Option<f64>,
    /// Of the fast touch, mm/min.
    pub fast_mm_per_min: f64,
    /// Of the touch that counts, mm/min.
    pub touch_mm_per_min: f64,
    /// Between touches, mm/min.
    pub feed_mm_per_min: f64,
    /// A plane face for the Z datum.
    pub face: Option<Face>,
}

impl ProgramSettings {
    /// How far a touch goes on beyond the nominal surface, mm.
    pub fn beyond_of(&self, ball_radius_mm: f64) -> f64 {
        self.beyond_mm.unwrap_or_else(|| most_beyond_mm(ball_radius_mm).min(1.0))
    }
}

/// With this ball the stylus is not crushed where nothing triggers, mm.
fn most_beyond_mm(ball_radius_mm: f64) -> f64 {
    MOST_BEYOND * ball_radius_mm
}

/// A plane face, touched from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Where the spindle stands, mm.
    pub place_mm: [f64; 2],
    /// From the spindle to the lowest point of the ball, about, mm.
    pub length_mm: f64,
    /// How often it is touched.
    pub hits: usize,
}

pub(in crate::identify::probe) fn read_program(section: &Section<'_>) -> Option<ProgramSettings> {
    let tool = section.get("tool").map_or(Some(1), |i| i.count());
    let hint =
        "z = \"-210 mm\": the spindle when the ball is in the ring at the height where it touches";
    let z_mm = section.require("z", hint).and_then(|i| i.quantity(Dimension::Length));
    let hint = "clear_z = \"-100 mm\": the spindle when the probe is clear of everything";
    let clear = section.require("clear_z", hint).and_then(|i| i.quantity(Dimension::Length));
    let orientation =
        section.get("orientation").map_or(Some(0.0), |i| i.quantity(Dimension::Angle));
    let directions = section.get("directions").map_or(Some(DIRECTIONS), |i| i.count());
    let length = |key: &str, usual| positive(section, key, Dimension::Length, usual, 1.0);
    let [stand_off, back_off] = [length("stand_off", 2.0), length("back_off", 0.5)];
    let beyond = section.get("beyond").map(|_| length("beyond", 1.0));
    let feed = |key: &str, usual| positive(section, key, Dimension::Velocity, usual, 60.0);
    let [fast, touch, between] =
        [feed("fast_feed", 300.0), feed("touch_feed", 100.0), feed("feed", 1500.0)];
    let face = section.get("face").map(|item| read_face(section, &item));
    let settings = ProgramSettings {
        tool: u32::try_from(tool?).unwrap_or(u32::MAX),
        z_mm: z_mm?,
        clear_z_mm: clear?,
        orientation_rad: orientation?,
        directions: directions?,
        stand_off_mm: stand_off?,
        back_off_mm: back_off?,
        beyond_mm: match beyond {
            Some(stated) => Some(stated?),
            None => None,
        },
        fast_mm_per_min: fast?,
        touch_mm_per_min: touch?,
        feed_mm_per_min: between?,
        face: match face {
            Some(stated) => Some(stated?),
            None => None,
        },
    };
    check(section, &settings).then_some(settings)
}

fn check(section: &Section<'_>, s: &ProgramSettings) -> bool {
    let wrong = if !(4..=MOST_DIRECTIONS).contains(&s.directions) {
        Some(("bad-count", "directions", format!("{} directions", s.directions), "4 to 720"))
    } else if s.clear_z_mm <= s.z_mm {
        let message = format!("clear_z ({} mm) is not above z ({} mm)", s.clear_z_mm, s.z_mm);
        Some(("bad-size", "clear_z", message, "positions of the spindle, higher is clear"))
    } else if s.back_off_mm >= s.stand_off_mm {
        let message = format!("back_off ({} mm) is not less than stand_off", s.back_off_mm);
        Some(("bad-size", "back_off", message, "back_off = \"0.5 mm\", stand_off = \"2 mm\""))
    } else if s.touch_mm_per_min > s.fast_mm_per_min {
        let message = "the touch that counts is faster than the fast one".to_owned();
        Some(("bad-size", "touch_feed", message, "the second touch is the slow one"))
    } else {
        None
    };
    let Some((code, key, message, hint)) = wrong else { return true };
    match section.get(key) {
        Some(item) => item.error(code, message, hint),
        None => section.error(code, message, hint),
    }
    false
}

/// Whether the way of a touch fits into the gauge and does not crush the probe.
pub(in crate::identify::probe) fn fits(
    settings: &ProgramSettings,
    gauge: &Gauge,
    ball_radius_mm: f64,
) -> Result<(), String> {
    let contact = gauge.contact_mm(ball_radius_mm);
    if settings.stand_off_mm >= contact {
        return Err(format!(
            "the stand-off of {} mm does not fit: the ball stands {contact} mm from the centre when it touches",
            settings.stand_off_mm
        ));
    }
    let most = most_beyond_mm(ball_radius_mm);
    match settings.beyond_mm.filter(|b| *b > most) {
        Some(beyond) => Err(format!(
            "`beyond` of {beyond} mm lets the stylus be crushed where nothing triggers; with this ball at most {most} mm"
        )),
        None => Ok(()),
    }
}

fn positive(
    section: &Section<'_>,
    key: &str,
    dimension: Dimension,
    usual: f64,
    scale: f64,
) -> Option<f64> {
    let Some(item) = section.get(key) else { return Some(usual) };
    let value = item.quantity(dimension)? * scale;
    if value <= 0.0 {
        item.error("not-positive", format!("`{key}` must be more than 0"), "leave it out");
        return None;
    }
    Some(value)
}

fn read_face(section: &Section<'_>, item: &Item<'_>) -> Option<Face> {
    let hint = "face = \"157 80 mm\": where the spindle stands over the plane face";
    let text = item.text()?;
    let mut words: Vec<&str> = text.split_whitespace().collect();
    let unit = words.pop().unwrap_or_default();
    let read = |w: &&str| parse_quantity(&format!("{w} {unit}"), Dimension::Length).ok();
    let values: Option<Vec<f64>> = words.iter().map(read).collect();
    let place_mm = values.and_then(|v| <[f64; 2]>::try_from(v).ok());
    if place_mm.is_none() {
        item.error("bad-vector", format!("`{text}` is not two lengths"), hint);
    }
    let length =
        section.require("length", "length = \"90 mm\": about, spindle to the end of the ball");
    let length_mm = length.and_then(|i| i.quantity(Dimension::Length));
    let hits = section.get("face_hits").map_or(Some(FACE_HITS), |i| i.count());
    let (place_mm, length_mm, hits) = (place_mm?, length_mm?, hits?);
    if length_mm <= 0.0 || !(1..=100).contains(&hits) {
        let message = format!("a length of {length_mm} mm, {hits} touches of the face");
        item.error("bad-size", message, "length = \"90 mm\", face_hits = 3");
        return None;
    }
    Some(Face { place_mm, length_mm, hits })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::probe::{GaugeKind, Side};

    /// Ring, ball and way of a touch ten times as large fit as they did: lengths only count against lengths.
    #[test]
    fn law_whether_a_touch_fits_does_not_depend_on_the_size() {
        let verdict = |size: f64, stand_off: f64, beyond: f64| {
            let gauge = Gauge {
                kind: GaugeKind::Ring,
                side: Side::Inside,
                radius_mm: 25.0 * size,
                u_radius_mm: 0.0,
                centre_mm: None,
                u_centre_mm: 0.0,
            };
            let settings = ProgramSettings {
                tool: 1,
                z_mm: 0.0,
                clear_z_mm: 0.0,
                orientation_rad: 0.0,
                directions: 60,
                stand_off_mm: stand_off * size,
                back_off_mm: 0.5,
                beyond_mm: Some(beyond * size),
                fast_mm_per_min: 500.0,
                touch_mm_per_min: 50.0,
                feed_mm_per_min: 2000.0,
                face: None,
            };
            fits(&settings, &gauge, 3.0 * size).is_ok()
        };
        for size in [0.2, 1.0, 7.0] {
            // A ball of 3 mm in a ring of 25 mm touches 22 mm from the centre; 0.9 of its radius is 2.7 mm.
            assert!(verdict(size, 21.9, 2.69), "{size}");
            assert!(!verdict(size, 22.1, 2.69), "{size}");
            assert!(!verdict(size, 21.9, 2.71), "{size}");
        }
    }
}
