(tool 1 is 100 long, tool 2 50. G43 H1 Z10: machine 110; H2 alone: machine 110 reads 60, then Z5)
(G44 H2: length -50: machine 55 reads 105. G10 L10 P2 R70, L11 P2 R-1: 69)
G90 G0 G43 Z10. H1
H2
G91 X0
G90 Z5.
G44 H2
G91 X0
G90 G10 L10 P2 R70.
G10 L11 P2 R-1.
#1=#2202+#2002
G43 H2 Z#1
G49
M30
