(G28 by way of 5, 6 to machine 0; G29 by way of 5, 6 to 20; G27 at the reference point; G60)
G90 G0 X10. Y10.
G28 X5. Y6.
G29 X20. Y0
G27 X0 Y0
G60 X3.
X4.
G30 X0
M30
