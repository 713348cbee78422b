# What is this machine, where is its tool, and how does it get there?
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
$trueaxis check machines/xkas2525/machine.toml
$trueaxis pose machines/xkas2525/machine.toml --at "X=3000 Y=1200 Z=-700 C=-90 A=15"
$trueaxis pose machines/three-axis-mill/machine.toml --at "X=200 Y=100 Z=-50" --approach "X=+ Y=-"
$trueaxis pose machines/xkas2525/machine.toml --at-file examples/01_describe/positions.csv
$trueaxis solve machines/i5-engraver/machine.toml --tip "10 20 30" --axis "0.3 -0.2 0.93"
$trueaxis solve machines/nutating-head/machine.toml --tip "0 0 50" --axis "0.2 0 1" --from "C=90"
$trueaxis solve machines/i5-engraver/machine.toml --path examples/01_describe/path.csv
