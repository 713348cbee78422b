(G43.4: the tip is programmed, A B C are axes; G43.5: I J K are directions; G49 ends both)
G90 G0 X0 Y0 Z200. B0 C0
G43.4 H1 Z10.
G1 X10. B30. C90. F500.
G49
G43.5 H1
G1 X20. I0 J-0.6 K0.8
I1. J0 K0
G49
G1 X30. F600.
M30
