(G53.1 needs a tilted plane)
G90 G53.1
M30
