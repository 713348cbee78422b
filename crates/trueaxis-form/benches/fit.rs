//! The four reference circles of one section of 72 points. Target: all four in 10 µs.

use trueaxis_form::circle::Fitter;

fn main() {
    divan::main();
}

/// A section of radius 118 mm with lobes of 30 µm and scatter of 2 µm, as the frustum has.
fn section(lobes: f64, roughness: f64, seed: u64) -> Vec<[f64; 2]> {
    let mut state = seed;
    let mut scatter = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    (0..72)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 72.0;
            let r = 118.0 + 0.03 * (lobes * angle + 0.4).cos() + roughness * scatter();
            [r * angle.cos() + 0.02, r * angle.sin() - 0.01]
        })
        .collect()
}

fn sections(lobes: f64) -> Vec<Vec<[f64; 2]>> {
    (0..64).map(|seed| section(lobes, 0.004, seed)).collect()
}

#[divan::bench(args = [1.0, 2.0, 3.0, 5.0])]
fn all_four(bencher: divan::Bencher<'_, '_>, lobes: f64) {
    let sections = sections(lobes);
    let mut fitter = Fitter::default();
    bencher.counter(divan::counter::ItemsCount::new(sections.len())).bench_local(|| {
        sections.iter().filter_map(|s| fitter.all(s).ok()).map(|c| c.mzc.width_mm()).sum::<f64>()
    });
}

/// A smooth oval: the inscribed circle has a ridge, the hardest case of a machined section.
#[divan::bench]
fn all_four_smooth_oval(bencher: divan::Bencher<'_, '_>) {
    let sections: Vec<_> = (0..64).map(|seed| section(2.0, 1e-6, seed)).collect();
    let mut fitter = Fitter::default();
    bencher.counter(divan::counter::ItemsCount::new(sections.len())).bench_local(|| {
        sections.iter().filter_map(|s| fitter.all(s).ok()).map(|c| c.mzc.width_mm()).sum::<f64>()
    });
}

/// Nothing but a shift of the cut: a circle to second order, nearly every contact a tie.
#[divan::bench]
fn all_four_pure_shift(bencher: divan::Bencher<'_, '_>) {
    let point = |i: u32, e: f64| {
        let angle = f64::from(i) * std::f64::consts::TAU / 72.0;
        let r = 118.0 + e * (angle - 10.0 * e).cos();
        [r * angle.cos(), r * angle.sin()]
    };
    let sections: Vec<Vec<_>> =
        (1..65).map(|k| (0..72).map(|i| point(i, 0.002 * f64::from(k))).collect()).collect();
    let mut fitter = Fitter::default();
    bencher.counter(divan::counter::ItemsCount::new(sections.len())).bench_local(|| {
        sections.iter().filter_map(|s| fitter.all(s).ok()).map(|c| c.mzc.width_mm()).sum::<f64>()
    });
}

#[divan::bench]
fn minimum_zone(bencher: divan::Bencher<'_, '_>) {
    let sections = sections(3.0);
    let mut fitter = Fitter::default();
    bencher.counter(divan::counter::ItemsCount::new(sections.len())).bench_local(|| {
        sections.iter().filter_map(|s| fitter.minimum_zone(s).ok()).map(|z| z.inner_mm).sum::<f64>()
    });
}
