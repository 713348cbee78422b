(3-D G68 at 10, 0, 0 about Y by 90 deg: x axis goes to -Z, z axis to X:)
(linear 0 0 1 / 0 1 0 / -1 0 0; place 1, 2, 3 is machine 13, 2, -1)
(a second one about Z by 90 deg within it: x goes to y: columns y, -x, z of the first)
G90 G0 X13. Y2. Z-1.
G68 X10. Y0 Z0 I0 J1. K0 R90.
G91 X0
G90 X1. Y2. Z3.
G68 X0 Y0 Z0 I0 J0 K1. R90.
G91 X0
G69
M30
