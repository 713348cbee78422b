(G52 X10: the machine at 0 reads -10. G92 X5 there: shift 10 - 15 = -5: 0 - [-5] = 5)
(G92.1 X0 takes it back: machine 0 reads 0)
G90 G0 X0
G52 X10.
G91 X0
G92 X5.
X0
G92.1 X0
X0
G52 X0
M30
