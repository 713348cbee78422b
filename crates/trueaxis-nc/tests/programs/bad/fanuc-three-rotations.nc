(two within each other are the most)
G68 X0 Y0 Z0 I0 J0 K1. R0
G68 X0 Y0 Z0 I0 J0 K1. R0
G68 X0 Y0 Z0 I0 J0 K1. R0
M30
