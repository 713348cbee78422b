(P2 without Q)
G68.2 P2 X0 Y0 Z0
M30
