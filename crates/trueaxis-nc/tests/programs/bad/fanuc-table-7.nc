(six of G54 to G59)
G10 L2 P7 X1.
M30
