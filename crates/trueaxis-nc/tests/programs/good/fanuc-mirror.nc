(G51.1 X50: x' = 100 - x. The machine at 0 reads 100. G50.1 X0 ends it; G68 outside of it:)
(x' = R x about 0: mirror first: [100 - x, y], turned by 90 deg: [-y, 100 - x])
G90 G0 X0 Y0
G51.1 X50.
G91 X0
G90 X10. Y0
G50.1 X0
G91 X0
G90 X0
G51.1 X50.
G68 X0 Y0 R90.
G90 X10. Y3.
G69
G50.1 X0
G91 X0
M30
