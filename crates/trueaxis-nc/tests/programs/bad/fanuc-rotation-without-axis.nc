(an axis of no length)
G68 X0 Y0 Z0 I0 J0 K0 R90.
M30
