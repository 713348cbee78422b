(P2: origin 10 0 0, x towards 10 5 0: y axis; a point on the y side at 10 0 7: z axis)
(x = 0 1 0, y = 0 0 1, z = x cross y = 1 0 0: rows 0 0 1 / 1 0 0 / 0 1 0)
(Q0 shifts by 2 along its x: origin 10 2 0, and turns by 90 about z: x becomes y, y becomes -x)
G68.2 P2 Q1 X10. Y0 Z0
G68.2 P2 Q2 X10. Y5. Z0
G68.2 P2 Q3 X10. Y0 Z7.
G69
G68.2 P2 Q0 X2. Y0 Z0 R90.
G68.2 P2 Q1 X10. Y0 Z0
G68.2 P2 Q2 X10. Y5. Z0
G68.2 P2 Q3 X10. Y0 Z7.
G69
(P3: x along 0 0 2, z along 3 0 0 at 1 2 3: y = z cross x = 1 0 0 cross 0 0 1 = 0 -1 0)
G68.2 P3 Q1 X1. Y2. Z3. I0 J0 K2.
G68.2 P3 Q2 I3. J0 K0
G69
M30
