(the three points lie on one line)
G68.2 P2 Q1 X0 Y0 Z0
G68.2 P2 Q2 X1. Y0 Z0
G68.2 P2 Q3 X2. Y0 Z0
M30
