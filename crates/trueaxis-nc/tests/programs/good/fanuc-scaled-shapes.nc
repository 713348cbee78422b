(twice in X alone makes an ellipse of a circle; twice along Z scales the pecks: both are said)
G17 G90 G0 Z10.
G51 X0 Y0 Z0 I2. J1. K2.
G2 X0 Y0 I1. J0 F100.
G99 G81 X1. Y0 R2. Z-1.
G80 G50
M30
