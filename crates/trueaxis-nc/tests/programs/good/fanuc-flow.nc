O0001
(computed GOTO; N5 stands twice: the next one counts; two loops within each other: 2 x 2 moves)
G91 G0
#1=10
GOTO[#1+10]
X99.
N20 X1.
#2=0
WHILE [#2 LT 2] DO1
#3=0
WHILE [#3 LT 2] DO2
Y1.
#3=#3+1
END2
#2=#2+1
END1
GOTO 5
X99.
N5 Z1.
/X2.
M98 P0003
M30
N5 X99.
O0003
(its own N5)
GOTO 5
X99.
N5 Z2.
#2=77
M99

