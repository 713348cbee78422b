(with the tip programmed G53 and G28 are places of the machine: only the named axes move)
G43.4 H1
G90 G0 X5. Y6. Z7.
G53 Z0
G49
M30
