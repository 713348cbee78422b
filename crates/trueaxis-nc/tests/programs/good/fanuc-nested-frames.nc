(G54 at 100, 0, shifted by G52 to 100, 10, within it a quarter turn: R p = -y, x)
(machine 0, 0 is -100, -10 from there: -y = -100, x = -10: reads -10, 100)
(G92 X0: the place moves by -10 along x, that is by 0, -10 outside: the shift 0, 10 becomes 0, 0)
G90 G10 L2 P1 X100.
G52 Y10.
G68 X0 Y0 R90.
G91 G0 X0
G92 X0 Y100.
X0
G69
X0
M30
