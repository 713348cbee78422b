(G31 is for one block; #5063 is where it ended; inches: 1 inch = 25.4 mm, feed 10 inch/min)
G20 G90
G0 X1.
G31 Z-1. F10.
X2.
#1=#5063
Z#1
G21
M30
