(G91: R counts from where the cycles began: 10 - 8 = 2; Z from R: 2 - 7 = -5; twice by K)
G90 G0 Z10.
G91 G99 G81 X5. R-8. Z-7. K2 F60.
X5. R-8.
G80 G90
M30
