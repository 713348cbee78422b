# What can a measurement determine, and what not? Writes its programs into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis plan examples/04_plan/probe-ball.toml -o "$out/probe-ball" --report "$out/probe-ball.html"
$trueaxis plan examples/04_plan/ball-bar-10791-6.toml -o "$out/ball-bar"
$trueaxis plan examples/04_plan/laser-gantry.toml -o "$out/laser" --control fanuc
$trueaxis measure examples/04_plan/laser-gantry.toml -o "$out/laser-readings"
$trueaxis plan examples/04_plan/touch-probe-5-minutes.toml -o "$out/five-minutes" --control fanuc
$trueaxis plan examples/04_plan/touch-probe-5-minutes.toml --format json
# The chosen poses measured on the virtual machine, and what is identified of it.
$trueaxis measure "$out/five-minutes/campaign.toml" -o "$out/five-minutes/readings"
$trueaxis identify "$out/five-minutes/campaign.toml"
# Touches on a whole free-form bangle, along its normals; the hits become deviations, which `compensate adapt` reads.
$trueaxis plan probe-surface examples/04_plan/probe-surface.toml -o "$out/probe-surface" --control fanuc
$trueaxis identify surface "$out/probe-surface/hits.toml" -o "$out/measured.csv"
# Length and diameter of the tools at a tool setter, with alarms for broken tools.
for control in fanuc haas sinumerik linuxcnc heidenhain; do
    $trueaxis plan tool-setting machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml -o "$out/tool-setting-$control" --control $control
done
