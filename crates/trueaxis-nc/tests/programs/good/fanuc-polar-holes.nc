(bolt circle: radius 50, angles 0, 90, 180 by two repetitions of +90; R2 Z-10)
G90 G0 Z20.
G16
G81 X50. Y0. R2. Z-10. F100.
G91 Y90. K2
G15 G80
G90 M30
