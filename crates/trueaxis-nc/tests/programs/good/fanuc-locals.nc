O0001
(M98 shares #1 with its caller, G65 does not; M98 P20005 calls twice; M99 P60 goes elsewhere)
G90 G0
#1=1
M98 P20005
X#1
G65 P5
X#1
M98 P6
X99.
N60 X7.
M30
O0005
#1=#1+1
M99
O0006
M99 P60
