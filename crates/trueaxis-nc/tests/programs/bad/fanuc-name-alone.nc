(a name that nothing calls)
G0 X1. <STEP>
M30
