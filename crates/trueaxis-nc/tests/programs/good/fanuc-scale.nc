(P2000 is twice about 10, 0: x' = 10 + 2 [x - 10] = 2 x - 10; y' = 2 y; z' = 2 z about Z 0)
(I0.5 J-1. K1. about 0: half in X, mirrored in Y)
(machine of 10, 5 with twice: 10, 10, 0; without: the same numbers; in the second: 20, -10)
G90 G0 X0 Y0
G51 X10. Y0 Z0 P2000
X10. Y5.
G50
G91 X0
G90 G51 X0 Y0 Z0 I0.5 J-1. K1.
G91 X0
G50
G90 X1.
M30
