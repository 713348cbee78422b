(1000 jumps are allowed here)
WHILE [1 EQ 1] DO1
END1
M30
