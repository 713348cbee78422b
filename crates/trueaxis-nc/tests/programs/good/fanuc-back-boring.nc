(G87: beside by Q3 along X, down to R-20, over the hole, up to Z-5 with feed, wait 0.5 s, out)
G90 G0 Z10. M3 S500
G98 G87 X10. Y0 Z-5. R-20. Q3. P500 F80.
G80
M30
