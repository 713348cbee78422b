"""Where the tool really is: a plain rigid-body chain with the errors of the example machines, written from docs/conventions only.

    linear axis  P . L . J(q) . E(q)        rotary axis  P . L . E(q) . J(q)        L, E = Trans(x y z) . Rz(c) Ry(b) Rx(a)
    workpiece_from_tip = inverse(bed_from_workpiece) . bed_from_tool . tip

Shares no code with trueaxis; it reads what the example files use and refuses the rest.
"""
import math
import re
import tomllib

UNITS = {"um": 1e-3, "mm": 1.0, "urad": 1e-6, "um/K": 1e-3}


def value(text):
    number, unit = re.fullmatch(r"(\S+) (\S+)", text).groups()
    return float(number) * UNITS[unit]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def shift(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turn(axis, angle):
    s, c = math.sin(angle), math.cos(angle)
    i, j = {"A": (1, 2), "B": (2, 0), "C": (0, 1)}[axis]
    m = shift(0, 0, 0)
    m[i][i] = m[j][j] = c
    m[i][j], m[j][i] = -s, s
    return m


def six(e):
    m = shift(*e[:3])
    for axis, angle in (("C", e[5]), ("B", e[4]), ("A", e[3])):
        if angle:
            m = product(m, turn(axis, angle))
    return m


def inverse(m):
    r = [[m[j][i] for j in range(3)] for i in range(3)]
    t = [-sum(r[i][k] * m[k][3] for k in range(3)) for i in range(3)]
    return [r[i] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]


def curve(stated):
    if set(stated) == {"polynomial", "scale"}:
        scale, terms = value(stated["scale"]), [value(t) for t in stated["polynomial"]]
        return lambda q: sum(t * (q / scale) ** k for k, t in enumerate(terms))
    if set(stated) == {"fourier"}:
        mean = value(stated["fourier"]["mean"])
        terms = [(k, value(a), value(b)) for k, a, b in stated["fourier"]["terms"]]
        return lambda q: mean + sum(a * math.cos(k * q) + b * math.sin(k * q) for k, a, b in terms)
    raise ValueError(f"unknown curve {stated}")


class Machine:
    """`exact` leaves all errors out; `celsius` of the spindle."""

    def __init__(self, path, celsius=20.0, exact=False):
        file = tomllib.load(open(path, "rb"))
        assert set(file) <= {"machine", "axis", "tool", "location", "motion", "heat"}, set(file)
        names = file["machine"]["chain"].split()
        bed = names.index("b")
        self.work = [n.rstrip("'") for n in names[1:bed]][::-1]
        self.tools = names[bed + 1:-1]
        self.length = value(file["tool"]["length"])
        self.place, self.location, self.motion = {}, {}, {}
        for name in self.work + self.tools:
            place = file["axis"].get(name, {}).get("placement", "0 0 0 mm").split()
            self.place[name] = shift(*map(float, place[:3]))
            assert file["axis"][name].get("sense", 1) == 1 and (name in self.tools or "sense" in file["axis"][name])
        tool = [0.0] * 6
        six_of = {n: [0.0] * 6 for n in self.work + self.tools} | {"t": tool}
        for name, stated in file.get("location", {}).items() if not exact else ():
            six_of[name[3]]["XYZABC".index(name[1])] += value(stated)
        for name, terms in file.get("heat", {}).items() if not exact else ():
            for stated in terms.values():
                six_of[name[3]]["XYZABC".index(name[1])] += value(stated) * (celsius - 20.0)
        self.location = {n: six(e) for n, e in six_of.items()}
        for axis, errors in file.get("motion", {}).items() if not exact else ():
            self.motion[axis] = [("XYZABC".index(n[1]), curve(c)) for n, c in errors.items()]

    def link(self, name, q):
        errors = [0.0] * 6
        for i, f in self.motion.get(name, ()):
            errors[i] = f(q)
        m = product(self.place[name], self.location[name])
        if name in "XYZ":
            move = shift(*(q if n == name else 0.0 for n in "XYZ"))
            return product(product(m, move), six(errors))
        return product(product(m, six(errors)), turn(name, q))

    def tool(self, at):
        """Tip (mm) and axis of the tool in the workpiece; `at`: mm and rad by letter."""
        bed_from_work = bed_from_tool = shift(0, 0, 0)
        for name in self.work:
            bed_from_work = product(bed_from_work, self.link(name, at[name]))
        for name in self.tools:
            bed_from_tool = product(bed_from_tool, self.link(name, at[name]))
        m = product(inverse(bed_from_work), product(bed_from_tool, self.location["t"]))
        tip = [m[i][3] - self.length * m[i][2] for i in range(3)]
        return tip, [m[i][2] for i in range(3)]
