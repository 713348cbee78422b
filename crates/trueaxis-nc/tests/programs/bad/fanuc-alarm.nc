(#3000 stops for good, also where one goes on behind errors)
G0 X1.
#3000=7 (PART MISSING)
X2.
M30
