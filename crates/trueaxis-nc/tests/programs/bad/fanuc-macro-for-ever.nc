(O2 calls itself: 64 calls within each other are allowed)
O0001
G65 P2
M30
O0002
G65 P2
M99
