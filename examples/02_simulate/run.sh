# What does the actual machine do while this program runs?
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis simulate machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --report "$out/impeller.html"
$trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --report "$out/ring.html" --path "$out/ring.csv"
$trueaxis trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120
# The holder collides with the table: exit status 1, and both bodies are named.
! $trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/collision-fanuc.nc --report "$out/collision.html"
