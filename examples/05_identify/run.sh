# What is the machine like? The expansion of a scale from two laser runs.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
$trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
$trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml --format json
# How does the spindle drift with temperatures, and which sensors tell? Judged on logs not seen.
$trueaxis identify thermal examples/05_identify/lathe-thermal.toml
$trueaxis identify thermal examples/05_identify/lathe-thermal.toml --format json
