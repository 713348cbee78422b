//! A file with other points reads back as what it was made to be.

use trueaxis_cl::{ClFile, ClPoint, Reading};

fn read(text: &[u8]) -> ClFile {
    let (file, problems) = ClFile::read("a.cls", text.to_vec(), &Reading::default());
    let found: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert!(!problems.has_errors(), "{found:?}");
    file
}

#[test]
fn law_moved_points_are_read_back() {
    for (text, table) in [
        (
            "UNITS/MM\r\nMULTAX/ON\r\nFEDRAT/100\r\nGOTO/1,2,3,0,0,1\r\nRAPID\r\nGOTO/4,5,6,0,0.6,0.8\r\nFINI\r\n",
            false,
        ),
        (
            "UNITS/INCHES\nFEDRAT/10,IPM\nGOTO / 1.5, 2, -3, $\n 0.6, 0, 0.8 $$ a remark\n$$ END\nGOTO/1,1,1,0,0,1\nFINI",
            false,
        ),
        ("PARTNO GOTO 1\nFEDRAT/5\nGOTO/1,2,3\nGODLTA/1,0,0\nFINI\n", false),
        ("# a table\n1 2 3 0 0 1\n4;5;6;0;0.6;0.8\n", true),
    ] {
        let file = read(text.as_bytes());
        assert_eq!(file.is_table(), table, "{text}");
        let moved = |(k, (_, p)): (usize, (u32, &ClPoint))| ClPoint {
            tip_mm: p.tip_mm.map(|v| v + 0.123_456_789 * (k as f64 + 1.0)),
            ..*p
        };
        let points: Vec<ClPoint> = file.points().enumerate().map(moved).collect();
        let written = file.with_points(&points).rewritten();
        let again = read(&written);
        let shown = String::from_utf8_lossy(&written);
        assert_eq!(again.points().count(), points.len(), "{shown}");
        for ((_, found), wanted) in again.points().zip(&points) {
            for k in 0..3 {
                assert!((found.tip_mm[k] - wanted.tip_mm[k]).abs() < 3e-8, "{shown}");
                assert!((found.axis[k] - wanted.axis[k]).abs() < 1e-11, "{shown}");
            }
            assert_eq!((found.rapid, found.feed), (wanted.rapid, wanted.feed), "{shown}");
        }
        assert_eq!(again.records().len(), file.records().len(), "{shown}");
    }
}
