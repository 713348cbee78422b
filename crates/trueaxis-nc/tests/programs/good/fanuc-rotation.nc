(G68 about 10, 20 by 90 deg: x' = 10 - [y - 20] = 30 - y, y' = 20 + [x - 10] = 10 + x)
(so linear 0 -1 / 1 0 and shift 30, 10)
(the machine stands at 0, 0 when it is set: x = -10, y = 30 in the turned frame)
(G69: machine of 5, 0 is 30, 15: X 1 alone keeps Y 15)
G90 G0 X0 Y0
G68 X10. Y20. R90.
G91 X0.
G90 X5. Y0.
G2 X15. Y0. I5. J0. F200.
G0 X5. Y0.
G69
X1.
M30
