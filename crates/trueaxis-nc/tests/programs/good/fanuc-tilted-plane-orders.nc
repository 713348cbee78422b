(P1 Q321: about fixed Z by 90, then about fixed Y by 90, then X by 0: x to y to y; y to -x to z;)
(z to z to x: columns y, z, x: rows 0 0 1 / 1 0 0 / 0 1 0)
(Q123 of the same turns: X 0, Y 90: x to -z, y to y, z to x; then Z 90: x: -z, y: -x, z: y:)
(rows 0 -1 0 / 0 0 1 / -1 0 0)
G68.2 P1 Q321 X0 Y0 Z0 I0 J90. K90.
G69
G68.2 P1 Q123 X0 Y0 Z0 I0 J90. K90.
(G68.4 in that plane: shift by 1 along its x: -z; no turn: the origin is 0, 0, -1)
G68.4 X1. Y0 Z0 I0 J0 K0
G53.6 P2
G69
M30
