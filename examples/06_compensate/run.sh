# What must the control add to its commands? A gantry in a warm hall (Zhang et al. 2019).
set -e
trueaxis=${TRUEAXIS:-target/release/trueaxis}
out=${OUT:-.}
gantry=machines/gantry-001/machine.toml
# Both ends of travel in Zhang et al. 2019: compensating the machine alone makes the part 9 and 4 times worse.
$trueaxis compensate values $gantry --at "X=3500" --temperature "scale_x=30.5 workpiece=30.5"
$trueaxis compensate values $gantry --at "Y=2300" --temperature "scale_y=31.2 workpiece=31.2"
# A table over the travel, for a control.
$trueaxis compensate values $gantry --axis X --step 350 --temperature "scale_x=30.5 workpiece=30.5"
$trueaxis compensate values $gantry --axis X --step 350 --temperature "scale_x=30.5 workpiece=30.5" --format csv -o "$out/gantry-x.csv"
# Both directions of approach, and a rotary axis in ten thousandths of a degree.
$trueaxis compensate values machines/three-axis-mill/machine.toml --axis X --step 60
$trueaxis compensate values machines/xkas2525/machine.toml --axis C --step 30 --format json
# Cutter locations become programs for this machine, read back and simulated.
$trueaxis post machines/i5-engraver/machine.toml examples/06_compensate/bangle.cls --control fanuc -o "$out/bangle.nc" --verify
$trueaxis post machines/xkas2525/machine.toml examples/06_compensate/blade.cls --control sinumerik --tcp off -o "$out/blade.mpf" --verify
$trueaxis post machines/xkas2525/machine.toml testpieces/nas979-gbt33150.toml --control sinumerik -o "$out/cone.mpf" --verify
$trueaxis post machines/three-axis-mill/machine.toml examples/06_compensate/plate.cls --control heidenhain --tcp length -o "$out/plate.h" --verify
# A blank as it was probed: the path is moved onto it, and the remaining wall (example made by oracles/bangle.py).
$trueaxis compensate adapt examples/06_compensate/bangle-adapt.toml --report "$out/bangle-adapt.html" --control fanuc -o "$out/bangle-adapt.nc" --cl "$out/bangle-adapted.cls"
# Tables of controls: files, the errors they represent, residual error of the tool and of a test piece.
$trueaxis compensate tables machines/three-axis-mill/machine.toml --target linuxcnc -o "$out/mill-linuxcnc"
$trueaxis compensate tables machines/xkas2525/machine.toml --target sinumerik -o "$out/xkas-sinumerik" --piece examples/03_predict/nas979-on-xkas2525.toml
$trueaxis compensate tables machines/xkas2525/machine.toml --target isg -o "$out/xkas-isg" --piece examples/03_predict/nas979-on-xkas2525.toml
# A program for the actual machine: the frustum of 03_predict before and after (made by oracles/frustum.py).
$trueaxis compensate program machines/xkas2525/machine.toml examples/06_compensate/frustum.mpf -o "$out/frustum-comp.mpf" --report "$out/frustum-comp.html"
root=$(pwd)
sed "s|../../frustum-comp.mpf|frustum-comp.mpf|; s|\.\./\.\.|$root|" examples/06_compensate/frustum-compensated.toml > "$out/frustum-compensated.toml"
$trueaxis predict "$out/frustum-compensated.toml" --report "$out/frustum-predicted.html"
# A program as shops write it: home, radius compensation, arcs, a drilling cycle, a subprogram.
$trueaxis compensate program machines/i5-engraver/machine.toml examples/06_compensate/everyday-fanuc.nc -o "$out/everyday-comp.nc"
