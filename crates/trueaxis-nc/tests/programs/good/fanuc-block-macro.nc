O0001
(G66.1 calls O20 instead of each block: X is #24, Y is #25)
G90 G0 X0
G66.1 P20
X1. Y2.
X3.
G67
X4.
M30
O0020
G0 X[#24*10] Y[#25*10]
M99
