(the caller has no N70)
O0001
M98 P2
M30
O0002
M99 P70
