# Programs that fit this machine. Writes them into $OUT.
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
$trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --dialect fanuc -o "$out/bangle.nc" --verify
$trueaxis post machines/xkas2525/machine.toml examples/06_compensate/blade.cls --dialect sinumerik --tcp off -o "$out/blade.mpf" --verify
