# The expansion coefficient of a scale from two laser runs.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
$trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml
$trueaxis identify expansion examples/05_identify/y-axis-two-temperatures.toml --format json
# Both scales of the gantry into its machine file, with the coefficients of the splines for a PLC.
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
$trueaxis identify expansion examples/05_identify/x-axis-two-temperatures.toml examples/05_identify/y-axis-two-temperatures.toml -o "$out/gantry"
$trueaxis check "$out/gantry/machine.toml"
# Error tables of two axes from laser, level and R-test, squareness from circles.
$trueaxis identify tables examples/05_identify/error-tables.toml -o "$out/tables" --report "$out/tables.html"
$trueaxis identify tables examples/05_identify/error-tables.toml --format json
$trueaxis check "$out/tables/machine.toml"
# How does the spindle drift with temperatures, and which sensors explain it? Judged on held-out logs.
$trueaxis identify thermal examples/05_identify/lathe-thermal.toml
$trueaxis identify thermal examples/05_identify/lathe-thermal.toml --format json
# A later day with a pattern of temperatures that the logs have not: worse than promised, exit status 1.
$trueaxis identify thermal examples/05_identify/lathe-thermal.toml --score examples/05_identify/lathe-new-day.csv || [ $? -eq 1 ]
# Which location errors does the machine have, and which can a probe on one ball not separate?
$trueaxis identify examples/05_identify/probe-ball.toml --report "${TMPDIR:-/tmp}/probe-ball.html" -o "${TMPDIR:-/tmp}/probe-ball-machine.toml"
$trueaxis identify examples/05_identify/probe-ball.toml --format json
# The same poses standing, at 30 and at 150 mm/min: what follows the feed is the servo.
$trueaxis identify examples/05_identify/probe-ball-two-feeds.toml --report "${TMPDIR:-/tmp}/two-feeds.html"
$trueaxis identify examples/05_identify/probe-ball-two-feeds.toml --format json
# Two cones about a ball on a table that warms up: the rest drifts with time, exit status 1.
$trueaxis identify examples/05_identify/cone-path.toml || test $? -eq 1
$trueaxis plan examples/05_identify/cone-path.toml
# A drift that is listed: its rate with U, and errors that do not suffer from it.
$trueaxis identify examples/05_identify/drift.toml -o "${TMPDIR:-/tmp}/drift-machine.toml"
# One of its random poses would make the probe touch the stem of the ball: plan says so, exit status 1.
$trueaxis plan examples/05_identify/drift.toml || test $? -eq 1
# Centres of one ball on a head-head router, errors of X, Y, Z not listed: the rest follows them, exit status 1.
$trueaxis identify examples/05_identify/head-head.toml --report "${TMPDIR:-/tmp}/head-head.html" || test $? -eq 1
$trueaxis identify examples/05_identify/head-head.toml --format json || test $? -eq 1
# All errors together as a machine file: what one ball cannot separate compensates all the same, with U of each pose.
$trueaxis identify examples/05_identify/head-head.toml --predictor "$out/predicted.toml" || test $? -eq 1
$trueaxis check "$out/predicted.toml"
$trueaxis pose "$out/predicted.toml" --at "X=850 Y=450 Z=150 B=20 C=45"
# A ring whose place, tilt and size are not known, touched at turned poses.
$trueaxis identify examples/05_identify/ring-on-table.toml
# Ball-bar, R-test and laser at once.
$trueaxis identify examples/05_identify/mixed-instruments.toml
$trueaxis identify examples/05_identify/mixed-instruments.toml --check-conventions
# Zero of the probe, its ball, linear axes, rotary axes: each stage knows what the stages before it found.
$trueaxis plan examples/05_identify/probe-ball-procedure.toml
$trueaxis identify examples/05_identify/probe-ball-procedure.toml -o "${TMPDIR:-/tmp}/procedure.toml"
$trueaxis identify examples/05_identify/probe-ball-procedure.toml --format json
# Where are the rotary centres, and what must be entered in the control? Zhang et al. 2023, steps 1 to 4.
$trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml
$trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml --format json
$trueaxis identify rtcp examples/05_identify/rtcp-engraver.toml --programs "${TMPDIR:-/tmp}/rtcp-programs" --control fanuc
# Touch probe: offset and pre-travel by direction; raw hits corrected; unknown centre; sphere with two styli.
$trueaxis identify probe examples/05_identify/ring-60.toml --report "${TMPDIR:-/tmp}/ring-60.html" --table "${TMPDIR:-/tmp}/ring-60-table.csv"
$trueaxis identify probe examples/05_identify/ring-60.toml --format json --correct examples/05_identify/ring-60-fresh.csv -o "${TMPDIR:-/tmp}/ring-60-corrected.csv"
$trueaxis identify probe examples/05_identify/ring-turned.toml
$trueaxis identify probe examples/05_identify/sphere.toml
# The same with the programs that make the hits, their logs, and programs that correct each hit inside the control.
$trueaxis identify probe examples/05_identify/ring-programs.toml --programs "${TMPDIR:-/tmp}/ring-programs" --control fanuc
$trueaxis identify probe examples/05_identify/ring-programs.toml
$trueaxis identify probe examples/05_identify/ring-programs.toml --corrections "${TMPDIR:-/tmp}/ring-corrected" --control heidenhain
# Hits of a probing program become deviations of the surface.
$trueaxis identify surface examples/05_identify/bangle-hits.toml -o "${TMPDIR:-/tmp}/bangle-deviations.csv"
# Two balls at different heights: the directions of the rotary axes beside their centres.
$trueaxis identify rtcp examples/05_identify/rtcp-angles.toml
# The log of a tool setting. Tool 3 is broken: exit status 1.
$trueaxis identify tools machines/i5-engraver/machine.toml examples/04_plan/tool-setting.setup.toml examples/05_identify/tool-setting.log || test $? -eq 1
