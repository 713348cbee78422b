"""Changes of an input file: each is a function of a random source and the bytes, and says what it did."""

import re

NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
NUMBERS = (
    b"1e9 1e308 -1e308 -0 0 -1 nan inf -inf 1e-320 999999999999 1e400 0x10 1_000 1,5 4294967296 18446744073709551616 1e15"
).split() + [b"", b"1" * 400, b"0." + b"0" * 400 + b"1"]
# A unit after a number, or at the end of a heading.
UNIT = re.compile(rb"(?<=[\d_ ])(um|mm|deg|urad|mrad|rad|degC|min|s|m|K)\b(?!_)")
UNITS = {
    b"um": (b"mm", b"m", b"nm", b"urad"), b"mm": (b"um", b"m", b"in", b"deg"), b"m": (b"mm", b"um", b"km"),
    b"deg": (b"rad", b"urad", b"mm"), b"rad": (b"deg", b"urad"), b"urad": (b"rad", b"deg", b"um"), b"mrad": (b"rad", b"deg"),
    b"degC": (b"K", b"degF", b"mm"), b"K": (b"degC", b"mm"), b"s": (b"min", b"h", b"ms"), b"min": (b"s", b"h"),
}
WORD = re.compile(rb"[A-Za-z_][A-Za-z0-9_.-]*")


def _one(rng, found):
    found = list(found)
    return rng.choice(found) if found else None


def _put(data, match, new):
    return data[: match.start()] + new + data[match.end() :]


def bits(rng, data):
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8))):
        if changed:
            changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed), "bits turned"


def noise(rng, data):
    at, new = rng.randrange(len(data) + 1), rng.randbytes(rng.choice((1, 3, 64)))
    return data[:at] + new + data[at:], "random bytes put in"


def cut(rng, data):
    at = rng.randrange(len(data) + 1)
    return rng.choice((data[:at], data[at:], data[: at // 20], b"")), "cut off"


def lines(rng, data):
    rows = data.splitlines(keepends=True) or [b""]
    i, j = rng.randrange(len(rows)), rng.randrange(len(rows))
    way = rng.randrange(7)
    if way == 0:
        rows.insert(i, rows[i])
    elif way == 1:
        rows[i], rows[j] = rows[j], rows[i]
    elif way == 2:
        del rows[i]
    elif way == 3:
        del rows[min(i, j) : max(i, j)]
    elif way == 4:
        rows = rows[: i + 1] + rows[i + 1 :] * 4
    elif way == 5:
        rows = rows[:1] + rows[:0:-1]
    else:
        rows[i : i + 1] = [rows[i]] * 20_000
    return b"".join(rows), ("line doubled", "lines swapped", "line deleted", "lines deleted", "the rest four times", "order of the lines turned", "line 20,000 times")[way]


def number(rng, data):
    match = _one(rng, NUMBER.finditer(data))
    if not match:
        return noise(rng, data)
    new = rng.choice(NUMBERS)
    return _put(data, match, new), f"{match[0][:20].decode()} became {new[:20].decode()}"


def scaled(rng, data):
    match = _one(rng, NUMBER.finditer(data))
    if not match:
        return noise(rng, data)
    new = f"{float(match[0]) * rng.choice((-1, 1000, 1e-3, 25.4, 1e6)):.9g}".encode()
    return _put(data, match, new), f"{match[0][:20].decode()} became {new.decode()}"


def unit(rng, data):
    match = _one(rng, UNIT.finditer(data))
    if not match:
        return number(rng, data)
    new = rng.choice(UNITS[match[0]])
    return _put(data, match, new), f"unit {match[0].decode()} became {new.decode()}"


def word(rng, data):
    """A word of the file becomes another of its words, loses a letter, or a text, list or table."""
    words = list(WORD.finditer(data))
    if not words:
        return noise(rng, data)
    match = rng.choice(words)
    old = match[0]
    new = rng.choice((rng.choice(words)[0], old[:-1], old + old, b"true", b"[]", b"{}", b'""', b"../../../../dev/zero", old.swapcase()))
    return _put(data, match, new), f"{old[:30].decode()} became {new[:30].decode()}"


def signs(rng, data):
    old, new = rng.choice(((b",", b";"), (b".", b","), (b",", b"\t"), (b"=", b":"), (b'"', b"'"), (b"[", b"("), (b"_", b" "), (b"\n", b"\r"), (b"\n", b"\r\n"), (b" ", b"\xa0"), (b"-", b"\xe2\x88\x92")))
    return data.replace(old, new), f"every {old!r} became {new!r}"


def encoding(rng, data):
    text = data.decode("utf-8", "replace")
    ways = (
        ("UTF-16 LE", lambda: text.encode("utf-16-le")),
        ("UTF-16 with a mark", lambda: text.encode("utf-16")),
        ("UTF-16 BE with a mark", lambda: b"\xfe\xff" + text.encode("utf-16-be")),
        ("UTF-8 with a mark", lambda: b"\xef\xbb\xbf" + data),
        ("Latin-1", lambda: text.replace("e", "é", 3).encode("latin-1", "replace")),
        ("a NUL", lambda: data[: len(data) // 2] + b"\0" + data[len(data) // 2 :]),
        ("half a sign", lambda: data + b"\xc3"),
        ("other digits", lambda: text.replace("1", "１").replace("2", "²").encode()),
    )
    name, way = rng.choice(ways)
    return way(), name


def huge(rng, data):
    rows = data.splitlines(keepends=True) or [b""]
    at = rng.randrange(len(rows) + 1)
    name, new = rng.choice((
        ("a line of 1 MB", b"a" * 1_000_000 + b"\n"),
        ("a comment of 1 MB", b"#" + b"x" * 1_000_000 + b"\n"),
        ("100,000 brackets", b"x = " + b"[" * 100_000 + b"\n"),
        ("50,000 tables in each other", b"a" + b".a" * 50_000 + b" = 1\n"),
        ("100,000 empty cells", b"," * 100_000 + b"\n"),
        ("100,000 words", b"X1 " * 100_000 + b"\n"),
        ("50,000 lines of `a`", b"a\n" * 50_000),
        ("50,000 sections", b"".join(b"[s%d]\n" % i for i in range(50_000))),
        ("50,000 list tables", b"[[fixture]]\n" * 50_000),
        ("100,000 brackets of XML", b"<a>" * 100_000),
        ("a text of 1 MB", b'name = "' + b"\xc3\xa9" * 500_000 + b'"\n'),
    ))
    return b"".join(rows[:at]) + new + b"".join(rows[at:]), name


# How often each is drawn.
CHANGES = ((number, 6), (scaled, 3), (unit, 4), (word, 4), (lines, 4), (bits, 3), (signs, 2), (encoding, 2), (cut, 2), (noise, 1), (huge, 1))


def mutant(rng, data):
    """One to three changes of a file, and what they were."""
    said = []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        change = rng.choices([c for c, _ in CHANGES], [w for _, w in CHANGES])[0]
        data, what = change(rng, data)
        said.append(what)
    return data, "; ".join(said)
