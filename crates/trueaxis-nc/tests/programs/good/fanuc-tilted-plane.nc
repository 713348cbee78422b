(G68.2 Euler: about Z by 90: x to Y; about the new X by 30; about the new Z by 0)
(R = Rz 90 times Rx 30: columns: x: 0 1 0; y: -cos 30 0 sin 30; z: sin 30 0 cos 30)
(rows 0 -0.866025 0.5 / 1 0 0 / 0 0.5 0.866025)
(the machine at 100, 0, 50 minus the origin is 0: place 0, 0, 0)
G90 G54 G0 X100. Y0. Z50.
G68.2 X100. Y0 Z50. I90. J30. K0
G53.1
G91 X0
G90 X10. Y5. Z2.
G43 H1 Z20.
G49
G69
M30
