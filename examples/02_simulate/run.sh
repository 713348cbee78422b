# What does the actual machine do while this program runs?
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis simulate machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --report "$out/impeller.html"
$trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --report "$out/ring.html" --path "$out/ring.csv"
$trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/ring-fanuc.nc --stock --report "$out/ring-stock.html"
$trueaxis trace machines/wyxzcat-gantry/machine.toml examples/02_simulate/impeller-840d.mpf --block 120
# The nodes of the same gantry with errors: nominal and actual pose of each at every point of the path.
$trueaxis check machines/wyxzcat-gantry/with-errors.toml --frames
$trueaxis simulate machines/wyxzcat-gantry/with-errors.toml examples/02_simulate/impeller-840d.mpf --report "$out/impeller.html" --bodies "$out/nodes.csv"
# Increments count from where the tool is, after a swivel and under M128, too.
$trueaxis simulate machines/head-table/machine.toml examples/02_simulate/incremental.h --report "$out/incremental.html"
# The same time for every chord.
for chord in 0.05 0.005 0.0002; do
    $trueaxis simulate machines/three-axis-mill/machine.toml examples/02_simulate/circle-times.ngc --chord $chord --report "$out/circle-times.html"
done
# G41: the path is that of the centre of the tool.
$trueaxis simulate machines/three-axis-mill/machine.toml examples/02_simulate/square-g41.nc --report "$out/square.html" --path "$out/square.csv"
# The holder collides with the table: exit status 1, and both bodies are named.
! $trueaxis simulate machines/i5-engraver/machine.toml examples/02_simulate/collision-fanuc.nc --report "$out/collision.html"
