(Q121 is no order of X Y Z)
G68.2 P1 Q121 X0 Y0 Z0 I10. J0 K0
M30
