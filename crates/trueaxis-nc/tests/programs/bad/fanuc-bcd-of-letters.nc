(hexadecimal A is no digit of a BCD number: 10 = 16#0A)
#1=BIN[10]
M30
