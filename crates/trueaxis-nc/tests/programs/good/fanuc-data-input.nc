(G10 L50: what comes up to G11 are parameters of the control)
G90 G0 X1.
G10 L50
N5400 R0
N1020 P1 R88
G11
X2.
G5.1 Q1
G8 P1
G22 X100. Y100. Z100. I0 J0 K0
G64
M30
