O0001
(G66 calls O20 after each move: Z down by A and up again; not after S alone; G67 ends it)
G90 G0 Z0
G66 P20 A3.
X1.
S100
X2.
G67
X3.
M30
O0020
G91 G0 Z-#1
Z#1
G90
M99
