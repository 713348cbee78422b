# The correction in the control while it cuts, on a mock. Keeps its journal in $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
export XDG_STATE_HOME="$out/state"
$trueaxis live expect examples/08_live/gantry-mock.toml \
    --temperature-log examples/03_predict/torque-arm-hall.csv --report "$out/expect.html"
$trueaxis live status examples/08_live/gantry-mock.toml
$trueaxis live examples/08_live/gantry-mock.toml --for 3s --record "$out/day.jsonl"
$trueaxis live status examples/08_live/gantry-mock.toml --format json > "$out/status.json"
$trueaxis live replay examples/08_live/gantry-mock.toml "$out/day.jsonl"
