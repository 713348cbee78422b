(N9 belongs to O2, not to O1)
O0001
GOTO 9
M30
O0002
N9 M99
