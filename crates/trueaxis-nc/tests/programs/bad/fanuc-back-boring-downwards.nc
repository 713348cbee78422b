(G87 bores upwards: R lies below Z)
G0 Z10.
G87 X1. Z-20. R-5. Q1. F100.
M30
