(G10 L2 P2: G55 at 100, 0; G54.1 P3 and G54 P3 at 0, 20; external P0 at 0, 0, 5)
(the machine at 10: in G55 -90; in P3 10, -20; the external shift makes Z -5)
G90 G10 L2 P2 X100.
G10 L20 P3 Y20.
G0 X10.
G55
G91 X0
G54 P3
X0
G10 L2 P0 Z5.
G90 X1.
#5221=7.
#7041=#5221+#5241
G54
X#7041
M30
