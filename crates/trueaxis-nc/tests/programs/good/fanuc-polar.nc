(G16: X is a radius, Y an angle. 100 at 30 deg: 100 cos 30 = 86.602540, 100 sin 30 = 50)
(+120 with G91: 100 at 150 deg: -86.602540, 50. +120 again: 100 at 270 deg: 0, -100)
(G91 with a radius: from the place itself: 20 at 270 + 90 = 0 deg: 20, -100)
G90 G17 G16
G0 X100. Y30.
G91 Y120.
Y120.
X20. Y90.
G15
G90 X5. Y6.
M30
