%
O0001(subprograms in files)
G90 G0 X1.
M98 P0077 L2
M30
%
