# How many machines of a series hold the part, on how many days? Writes its reports into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
# So few machines do not decide it: exit status 1. With the 10 000 of the file it is a PASS.
status=0
$trueaxis study examples/09_study/fleet.toml --machines 100 --report "$out/fleet.html" --table "$out/fleet.csv" || status=$?
test "$status" = 1
$trueaxis study examples/09_study/guideways.toml --machines 50 --report "$out/guideways.html"
# Compensating the machine alone makes bad parts on most days: exit status 1 is the verdict.
status=0
$trueaxis study examples/09_study/summer.toml --machines 40 --report "$out/summer.html" || status=$?
test "$status" = 1
