# Will the part be within tolerance? Writes its reports into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis predict examples/03_predict/nas979-on-xkas2525.toml --report "$out/nas979.html"
$trueaxis predict examples/03_predict/nas979-at-feeds.toml --report "$out/feeds.html"
# The programs of the set-up with an empty file of readings; the prediction with a filled one.
$trueaxis post machines/xkas2525/machine.toml testpieces/nas979-gbt33150.toml --control sinumerik \
    -o "$out/nas979.mpf" --verify --set-up "$out/nas979-set-up"
$trueaxis predict examples/03_predict/nas979-set-up.toml --report "$out/set-up.html"
$trueaxis predict examples/03_predict/cone-on-i5.toml --report "$out/cone.html"
$trueaxis predict examples/03_predict/torque-arm.toml --report "$out/torque-arm.html"
$trueaxis predict examples/03_predict/torque-arm-over-a-shift.toml --report "$out/shift.html"
# This one fails: exit status 1 is the verdict.
status=0
$trueaxis predict examples/03_predict/nas979-head-out-of-square.toml --report "$out/fail.html" || status=$?
test "$status" = 1
# A bore of this one is nearer to its limit than its uncertainty: no verdict, exit status 1.
status=0
$trueaxis predict examples/03_predict/housing.toml --report "$out/housing.html" || status=$?
test "$status" = 1
$trueaxis predict examples/03_predict/blade.toml --report "$out/blade.html"
$trueaxis predict examples/03_predict/s-shape.toml --report "$out/s-shape.html"
