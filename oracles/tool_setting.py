"""The log of a tool setting, made for this project: what a machine with these tools and this drift writes.

    python3 oracles/tool_setting.py > examples/05_identify/tool-setting.log

Truth: spindle and setter have drifted by 7.3 um; tool 1 is worn by 12.4 um, its diameter is 2.9864 mm; tool 2 is as it
should be (-1.1 um, 2.9993 mm); tool 3 is broken: 0.4 mm too short. The noise of a trigger is 0.5 um. The equations are those of
the crate written down a second time: Z = Z_face + L + drift, X = X_setter +- (D + D_setter)/2 (+ run-out of none).
"""
import random

random.seed(20261124)
FACE, X0, Y0, SETTER, DRIFT, NOISE, DEPTH = -110.0, -150.0, 85.0, 10.0, 0.0073, 0.0005, 1.5
# number, nominal length at the setter, true length, true diameter
TOOLS = [
    (12, 100.0021, 100.0021, None),
    (1, 90.0, 90.0 - 0.0124, 2.9864),
    (2, 90.5, 90.5 - 0.0011, 2.9993),
    (3, 85.0, 85.0 - 0.4, None),
]
print("TRUEAXIS HITS MM MACHINE")
hit = 0
for number, nominal, length, diameter in TOOLS:
    places = [(X0, FACE + length + DRIFT + random.gauss(0, NOISE))]
    if diameter:
        z = FACE + nominal - DEPTH
        for side in (1, -1):
            places.append((X0 + side * 0.5 * (diameter + SETTER) + random.gauss(0, NOISE), z))
    for x, z in places:
        hit += 1
        print(f"H{hit} K{number} T{number} X{x:.4f} Y{Y0:.4f} Z{z:.4f} A0.00000 C0.00000")
print(f"END {hit}")
