//! `[spindle]` and `[magazine]` of a machine file.

use crate::equipment::Equipment;
use trueaxis_input::{Dimension, Section};

/// Reads both sections.
pub fn read_equipment(root: &Section<'_>) -> Equipment {
    let mut equipment = root.section("spindle", read_spindle).unwrap_or_default();
    equipment.magazine_places = root.section("magazine", read_places).flatten();
    equipment
}

fn read_spindle(section: &Section<'_>) -> Equipment {
    let max = positive(section, "max_speed", Dimension::AngularVelocity);
    let min = positive(section, "min_speed", Dimension::AngularVelocity);
    if let (Some(min), Some(max), Some(item)) = (min, max, section.get("min_speed"))
        && min >= max
    {
        let message = "min_speed must be below max_speed".to_owned();
        item.error("bad-value", message, "for instance min_speed = \"500 rpm\"");
    }
    Equipment {
        max_spindle_rad_per_s: max,
        min_spindle_rad_per_s: min,
        spindle_power_w: positive(section, "power", Dimension::Power),
        magazine_places: None,
    }
}

fn positive(section: &Section<'_>, key: &str, dimension: Dimension) -> Option<f64> {
    let item = section.get(key)?;
    let value = item.quantity(dimension)?;
    if value > 0.0 {
        return Some(value);
    }
    item.error("not-positive", format!("`{key}` must be positive"), "remove it if it is not known");
    None
}

fn read_places(section: &Section<'_>) -> Option<u32> {
    let item = section.require("places", "the number of tools that the magazine holds")?;
    let places = item.count()?;
    let fits = u32::try_from(places).ok().filter(|n| (1..=10_000).contains(n));
    if fits.is_none() {
        let message = format!("a magazine has 1 to 10,000 places, not {places}");
        item.error("bad-count", message, "the number of tools that it holds");
    }
    fits
}

#[cfg(test)]
mod tests {
    use crate::Machine;
    use crate::file::NoTables;

    fn said(sections: &str) -> Vec<&'static str> {
        let text = format!("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n{sections}");
        Machine::check("m.toml", &text, &NoTables).1.iter().map(|d| d.code).collect()
    }

    #[test]
    fn spindle_and_magazine_are_read() {
        let text = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[spindle]\nmax_speed = \"40000 rpm\"\n\
                    min_speed = \"500 rpm\"\npower = \"2.5 kW\"\n[magazine]\nplaces = 12\n";
        let machine = Machine::check("m.toml", text, &NoTables).0.unwrap();
        let equipment = machine.equipment();
        assert_eq!(
            (equipment.magazine_places, equipment.spindle_power_w),
            (Some(12), Some(2500.0))
        );
        let beyond = |per_minute| equipment.speed_limit_passed(per_minute).map(f64::round);
        assert_eq!(beyond(40_000.0), None);
        assert_eq!(beyond(-40_001.0), Some(40_000.0));
        assert_eq!((beyond(500.0), beyond(499.0), beyond(0.0)), (None, Some(500.0), None));
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!(said("[spindle]\nmax_speed = \"0 rpm\"\n"), ["not-positive"]);
        assert_eq!(said("[spindle]\nmax_speed = \"40000\"\n"), ["missing-unit"]);
        assert_eq!(said("[spindle]\npower = \"2.5 rpm\"\n"), ["wrong-unit"]);
        assert_eq!(
            said("[spindle]\nmax_speed = \"5 rpm\"\nmin_speed = \"6 rpm\"\n"),
            ["bad-value"]
        );
        assert_eq!(said("[spindle]\nspeed = \"5 rpm\"\n"), ["unknown-key"]);
        assert_eq!(said("[magazine]\nplaces = 0\n"), ["bad-count"]);
        assert_eq!(said("[magazine]\n"), ["missing-key"]);
    }
}
