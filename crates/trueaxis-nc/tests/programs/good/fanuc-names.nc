O<MAIN>
(programs by name, in this text and in a file; L2 calls twice)
G91 G0 X1.
M98 <STEP> L2
G65 <SIDE> A5.
M98 P78 L2
M30
O<STEP>
Y1.
M99
