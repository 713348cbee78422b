(G88: feed, wait, stop, out. G86 and G85, G89. G73 breaks the chip every Q4 from R1: -3, then -5,)
(back by 0.254 mm between. G99: out to R only)
G90 G0 Z10.
G99 G88 X1. Z-5. R1. P100 F60.
G85 X2.
G89 X3. P200
G73 X4. Q4.
G80 X5.
M30
