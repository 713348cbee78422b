//! Any bytes as an NC program of any control: never a panic, every byte is kept, moves are finite.
//!
//! `scripts/fuzz nc_program 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis_nc::{Control, Library, Program, Settings, Step, interpret};

/// Every subprogram is the second half of the input.
struct Half<'a>(&'a [u8]);

impl Library for Half<'_> {
    fn text(&self, _name: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.to_vec())
    }
}

fuzz_target!(|data: &[u8]| {
    let (first, rest) = data.split_first().unwrap_or((&0, &[]));
    let controls =
        [Control::LinuxCnc, Control::Fanuc, Control::Sinumerik840d, Control::Heidenhain];
    let control = controls[usize::from(*first % 4)];
    let program = Program::new("p", rest.to_vec(), control);
    assert_eq!(program.print(), rest);
    let end = program.blocks().fold(0, |end, block| {
        assert_eq!(block.span.start, end);
        block.span.end
    });
    assert_eq!(end, rest.len());
    let settings = Settings {
        most_jumps: 100,
        deepest_call: 8,
        keep_going: first & 4 != 0,
        ..Settings::default()
    };
    if control == Control::Sinumerik840d {
        let _ = trueaxis_nc::sinumerik::read_archive("p", rest);
    }
    interpret(&program, &Half(&rest[rest.len() / 2..]), &settings, &mut |step| {
        if let Step::Move(m) = step {
            assert!(m.target.0.iter().all(|v| v.is_finite()) && m.feed.value.is_finite());
            assert!(m.direction.iter().flatten().all(|v| v.is_finite()));
        }
    });
});
