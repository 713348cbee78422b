#!/usr/bin/env python3
"""The size of every unit that a file may use, by another library.

    python3 oracles/units.py > crates/trueaxis-input/tests/data/units.csv

pint 0.25.3 reads the spelling where it can; the others are written as pint wants them. The inner units are mm,
rad, s, K and their quotients; W and J stay.
"""
import pint

ureg = pint.UnitRegistry()
INNER = {
    "Length": ("mm", "mm um µm nm cm m in"),
    "Angle": ("rad", "rad mrad mm/m urad µrad um/m µm/m deg ° arcmin ′ arcsec ″"),
    "Time": ("s", "s ms min h"),
    "Velocity": ("mm/s", "mm/s mm/min m/min m/s um/s mm/h um/h"),
    "Acceleration": ("mm/s^2", "mm/s^2 mm/s² m/s^2 m/s²"),
    "Jerk": ("mm/s^3", "mm/s^3 mm/s³ m/s^3 m/s³"),
    "AngularVelocity": ("rad/s", "rad/s deg/s °/s deg/min °/min rpm 1/min urad/h"),
    "AngularAcceleration": ("rad/s^2", "rad/s^2 deg/s^2 deg/s² °/s^2 °/s²"),
    "AngularJerk": ("rad/s^3", "rad/s^3 deg/s^3 deg/s³ °/s^3 °/s³"),
    "Expansion": ("1/K", "1/K um/(m·K) µm/(m·K) um/(m_K) um/m/K ppm/K"),
    "LengthPerKelvin": ("mm/K", "mm/K um/K µm/K"),
    "AnglePerKelvin": ("rad/K", "rad/K urad/K µrad/K arcsec/K"),
    "Diffusivity": ("mm^2/s", "mm^2/s mm²/s m^2/s m²/s"),
    "FilmCoefficient": ("W/m^2/K", "W/(m^2_K) W/(m²·K) W/m^2/K"),
    "HeatCapacity": ("J/m^3/K", "J/(m^3_K) J/(m³·K) MJ/(m^3_K) MJ/(m³·K)"),
    "Power": ("W", "W kW"),
    "Ratio": ("", "%"),
}
AS_PINT = {"°": "deg", "′": "arcmin", "″": "arcsec", "²": "^2", "³": "^3", "·": "*", "_": "*", "1/min": "rpm",
           "in": "inch", "%": "percent", "ppm/K": "1e-6/K"}


def size(name, inner):
    if name == "1/min":
        name = "rpm"
    elif name == "in":
        name = "inch"
    for ours, theirs in AS_PINT.items():
        if ours not in ("in", "1/min"):
            name = name.replace(ours, theirs)
    return ureg.Quantity(1, ureg.parse_expression(name).units).m_as(inner) * ureg.parse_expression(name).magnitude


print(f"# pint {pint.__version__}, oracles/units.py: one of the unit in mm, rad, s, K, W, J")
print("dimension,unit,inner")
for dimension, (inner, names) in INNER.items():
    for name in names.split():
        print(f"{dimension},{name.replace('_', ' ')},{size(name, inner or 'dimensionless'):.17g}")
