# How good is the machine by the standards? Writes its reports into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
verify=examples/07_verify
# Geometric tests: a surface plate of 1955, a guideway by level and by straightedge, a square, both reversed.
$trueaxis evaluate iso230-1 $verify/moody-1955.csv --report "$out/plate.html"
$trueaxis evaluate iso230-1 $verify/moody-1955.csv --format json
$trueaxis evaluate iso230-1 $verify/straightness-x-level.csv
$trueaxis evaluate iso230-1 $verify/straightness-x-reversal.csv
$trueaxis evaluate iso230-1 $verify/squareness-xy.csv --report "$out/square.html"
# How well does a touch probe repeat, and how much does its pre-travel vary with the direction?
$trueaxis evaluate iso230-10 $verify/probe-performance.csv --report "$out/probe.html"
$trueaxis evaluate iso230-10 $verify/probe-performance.csv --format json
$trueaxis evaluate iso230-2 $verify/x-axis-laser.csv --report "$out/x.html"
$trueaxis evaluate iso230-2 $verify/x-axis-laser.csv --format json
# The same with a heading, to be filed and signed; named x.pdf it is a PDF where the program has that (the package does).
$trueaxis evaluate iso230-2 $verify/x-axis-laser.csv --report "$out/signed.html" --heading $verify/report-heading.toml
$trueaxis evaluate iso230-2 $verify/c-axis-polygon.csv --report "$out/c.html"
$trueaxis evaluate iso230-2 $verify/y-axis-long.csv
$trueaxis evaluate vdi3441 $verify/x-axis-laser.csv
$trueaxis evaluate iso230-4 $verify/circle-xy.csv --report "$out/circle.html"
# A ball-bar in the words of another program, as errors of the machine file; tolerances; five calibrations: one has jumped.
$trueaxis evaluate iso230-4 $verify/ball-bar-export.csv --machine machines/three-axis-mill/machine.toml \
    -o "$out/ball-bar-machine.toml" --report "$out/ball-bar.html"
$trueaxis evaluate iso230-2 $verify/x-axis-laser.csv --tolerance "A=16 um" --tolerance "R=8 um"
$trueaxis verify --history $verify/history --limit "EC0X=40 urad" --report "$out/history.html" || [ $? -eq 1 ]
$trueaxis evaluate iso230-6 $verify/body-diagonals.csv --report "$out/diagonals.html"
$trueaxis evaluate iso230-3 $verify/spindle-drift.csv --window "30 min" --report "$out/drift.html"
$trueaxis evaluate iso230-7 $verify/spindle-motion.csv --report "$out/spindle.html"
# Form from points: roundness of a section, filtered; cylindricity; straightness.
$trueaxis evaluate form $verify/cone-section.csv --element circle
$trueaxis evaluate form $verify/cone-section.csv --element circle --filter "gauss 15 upr" --u "0.3 um" \
    --tolerance "0.02 mm" --report "$out/section.html"
$trueaxis evaluate form $verify/cylinder-points.csv --element cylinder --u "0.3 um" --report "$out/cylinder.html"
$trueaxis evaluate form $verify/edge-profile.csv --element line --u "0.1 um" --filter "gauss 0.8 mm"
# Does the machine file predict the readings of a probe-ball? The same readings again from their random seed.
$trueaxis verify $verify/probe-ball.toml --report "$out/probe-ball.html"
$trueaxis measure $verify/probe-ball-campaign.toml -o "$out/readings" --truth "$out/truth.toml"
# A laser on the gantry of Zhang et al. 2019 before and after compensation: the machine alone, and with the workpiece.
$trueaxis verify --before-after $verify/laser-before-after-x.toml -o "$out/laser-x" --report "$out/laser-x.html"
$trueaxis verify --before-after $verify/laser-before-after-y.toml --report "$out/laser-y.html"
$trueaxis evaluate iso230-2 "$out/laser-x/02-X-workpiece-comprehensive.csv"
# What has changed since the calibration of the machine? Four errors: exit status 1.
$trueaxis verify --diff machines/xkas2525/machine.toml $verify/xkas2525-after-a-year.toml \
    --report "$out/after-a-year.html" || [ $? -eq 1 ]
# Residual error after compensation at poses that the identification has not used: tables, and programs.
$trueaxis verify --certificate $verify/certificate.toml --report "$out/certificate.html"
$trueaxis verify --certificate $verify/certificate-program.toml --report "$out/certificate-program.html"
# Four measured frusta against their prediction (Wu et al. 2022, Fig 20): one angularity is not proved, exit status 1.
$trueaxis verify --part $verify/nas979-measured.toml || [ $? -eq 1 ]
# One frustum point by point: made again, and verified.
$trueaxis measure --part examples/03_predict/nas979-on-xkas2525.toml --draw --seed 979 --point-u "0.7 um" \
    -o "$out/nas979-points.csv"
$trueaxis verify --part $verify/nas979-points.toml --report "$out/nas979-part.html"
# The measured error motion as a table for the machine file.
mkdir -p "$out/mill"
cp machines/three-axis-mill/machine.toml "$out/mill/machine.toml"
$trueaxis evaluate iso230-2 $verify/x-axis-laser.csv --write-back "$out/mill/machine.toml" X
