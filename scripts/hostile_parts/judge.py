"""What is wrong with what a run printed. Exit status 0, 1 or 2 with one JSON document that fits its schema is right."""

import json
import re

LONGEST_MESSAGE = 2500  # characters; messages and hints are cut at 2,000
LONGEST_OUTPUT = 64 << 10  # bytes on standard error
# Larger figures of these names are absurd: a metre as an error, a radian as an angle error.
ABSURD = (("_um", 1e6), ("_urad", 1e6), ("_um_per_m_k", 1e4))
# The same for lengths in mm that are errors and not places.
ABSURD_MM = re.compile(r"(deviation|error|residual|rms|worst|expanded|^u_|noise|drift).*_mm$")


class Schemas:
    def __init__(self, folder):
        self.all = {p.stem: json.loads(p.read_text()) for p in folder.glob("*.json")}

    def faults(self, name, document):
        schema = self.all.get(name)
        return [f"no schema {name}"] if schema is None else list(_faults(schema, schema, document, ""))[:3]


def _types(value):
    if value is None:
        return {"null"}
    if isinstance(value, bool):
        return {"boolean"}
    if isinstance(value, (int, float)):
        return {"number", "integer"} if isinstance(value, int) or value.is_integer() else {"number"}
    return {"string"} if isinstance(value, str) else {"array"} if isinstance(value, list) else {"object"}


def _faults(root, schema, value, place):
    """The part of JSON Schema that says what may stand where: types, keys, constants, alternatives."""
    if schema is True or schema == {}:
        return
    if "$ref" in schema:
        yield from _faults(root, root["$defs"][schema["$ref"].rsplit("/", 1)[1]], value, place)
    for key in ("anyOf", "oneOf"):
        if key in schema and all(any(True for _ in _faults(root, s, value, place)) for s in schema[key]):
            yield f"{place}: {json.dumps(value)[:60]} is none of what is promised"
    for one in schema.get("allOf", ()):
        yield from _faults(root, one, value, place)
    kind = schema.get("type")
    if kind and not _types(value) & {*([kind] if isinstance(kind, str) else kind)}:
        yield f"{place}: {json.dumps(value)[:60]} where {kind} is promised"
        return
    if "const" in schema and value != schema["const"] or "enum" in schema and value not in schema["enum"]:
        yield f"{place}: {json.dumps(value)[:60]} is no word of the schema"
    if isinstance(value, dict):
        known = schema.get("properties", {})
        for key in schema.get("required", ()):
            if key not in value:
                yield f"{place}/{key} is missing"
        for key, entry in value.items():
            yield from _faults(root, known.get(key, schema.get("additionalProperties", True)) or {}, entry, f"{place}/{key}")
    if isinstance(value, list) and "items" in schema:
        for i, entry in enumerate(value):
            yield from _faults(root, schema["items"], entry, f"{place}/{i}")


def _numbers(value, key, place):
    if isinstance(value, bool):
        return
    if isinstance(value, (int, float)):
        yield key, place, value
    elif isinstance(value, dict):
        for name, entry in value.items():
            yield from _numbers(entry, name, f"{place}/{name}")
    elif isinstance(value, list):
        for i, entry in enumerate(value):
            yield from _numbers(entry, key, f"{place}/{i}")


def _absurd(document):
    for key, place, value in _numbers(document, "", ""):
        limits = [most for ending, most in ABSURD if key.endswith(ending)]
        if ABSURD_MM.search(key):
            limits.append(1e3)
        if limits and abs(value) > min(limits):
            yield f"absurd without a warning: {place} = {value:g}"


def judge(schemas, status, out, err):
    """The faults of a run, none if it is right; the codes of its problems."""
    faults, codes = [], set()
    if b"panicked at" in err or status == 101:
        return [f"panic: {err[:300].decode(errors='replace')}"], codes
    if status not in (0, 1, 2):
        return [f"exit status {status}: {err[-200:].decode(errors='replace')}"], codes
    if len(err) > LONGEST_OUTPUT:
        faults.append(f"{len(err)} bytes on standard error")

    def no_number(word):
        raise ValueError(f"{word} in the document")

    try:
        document = json.loads(out.decode("utf-8"), parse_constant=no_number)
    except ValueError as error:
        return [*faults, f"status {status}, no document: {error}: {out[:80]!r} {err[:200]!r}"], codes
    name = document.get("schema", "").split("/")[1:2]
    variants = [n for n in schemas.all if name and (n == name[0] or n.startswith(name[0] + "-"))]
    found = [schemas.faults(n, document) for n in variants]
    if not found or all(found):
        faults += min(found, key=len, default=[f"no schema of {document.get('schema')}"])
    problems = document.get("diagnostics", [])
    errors = [p for p in problems if p["severity"] == "error"]
    codes |= {p["code"] for p in problems}
    for problem in problems:
        for key in ("message", "hint", "file"):
            if len(problem[key]) > LONGEST_MESSAGE:
                faults.append(f"{key} of {problem['code']} has {len(problem[key])} characters")
    if status == 2 and not errors:
        faults.append("refused without an error")
    if any(not p["file"] or not p["message"] for p in errors):
        faults.append("an error without a place or without words")
    if status < 2 and not any(p["severity"] in ("error", "warning") for p in problems):
        faults += list(_absurd(document))[:2]
    return faults, codes
