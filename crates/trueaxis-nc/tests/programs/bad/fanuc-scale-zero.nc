(a scale of 0 squeezes the part flat)
G51 X0 Y0 Z0 P0
M30
