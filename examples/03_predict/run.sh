# Will the part be within tolerance? Writes its reports into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis predict examples/03_predict/nas979-on-xkas2525.toml --report "$out/nas979.html"
$trueaxis predict examples/03_predict/nas979-at-feeds.toml --report "$out/feeds.html"
$trueaxis predict examples/03_predict/cone-on-i5.toml --report "$out/cone.html"
$trueaxis predict examples/03_predict/torque-arm.toml --report "$out/torque-arm.html"
$trueaxis predict examples/03_predict/torque-arm-over-a-shift.toml --report "$out/shift.html"
# This one fails: exit status 1 is the verdict.
status=0
$trueaxis predict examples/03_predict/nas979-head-out-of-square.toml --report "$out/fail.html" || status=$?
test "$status" = 1
