//! Any bytes as a campaign file beside a small machine: never a panic; what is measured is finite.
//!
//! `scripts/fuzz campaign_file 600`

#![no_main]

use libfuzzer_sys::fuzz_target;
use trueaxis::files::disk;
use trueaxis::measure::read_campaign;
use trueaxis::measure::virtual_campaign::{measure, read_virtual};

const MACHINE: &str = "[machine]\nname = \"m\"\nchain = \"w C' A' b X Y Z t\"\n\
                       [tool]\nlength = \"100 mm\"\n[location]\nEX0C = \"12 ± 1 um\"\n";
const POSES: &str = "X,Y,Z,A,C\n0,0,0,0,0\n10,20,-30,15,40\n";

fuzz_target!(|data: &[u8]| {
    let folder = std::env::temp_dir().join(format!("trueaxis-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("machine.toml"), MACHINE).expect("written");
    std::fs::write(folder.join("poses.csv"), POSES).expect("written");
    let path = folder.join("campaign.toml");
    std::fs::write(&path, data).expect("written");
    let (read, problems) =
        read_campaign(&disk(), &path, |root, campaign| read_virtual(root, campaign, None));
    let Some((campaign, real)) = read else {
        assert!(problems.has_errors());
        return;
    };
    if real.paths.iter().map(|p| p.stations.len()).sum::<usize>() > 1000 {
        return;
    }
    if let Ok(found) = measure(&campaign, &real) {
        let values = found.readings.values.iter().flatten();
        assert!(values.chain(&found.readings.times_s).all(|v| v.is_finite()));
    }
});
