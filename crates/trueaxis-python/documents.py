"""Writes python/trueaxis/documents.py: the documents of answers as types, from docs/schemas; a test compares.

    python crates/trueaxis-python/documents.py
"""

import json
import keyword
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCHEMAS = HERE.parents[1] / "docs/schemas"
PLACE = HERE / "python/trueaxis/documents.py"

#: The schemas of answers of functions of the package.
NAMES = """before-after certificate compensate compensate-adapt compensate-program compensate-tables diff evaluate
evaluate-form history identify-errors identify-expansion identify-expansions identify-probe identify-probe-programs identify-rtcp
identify-rtcp-programs identify-surface identify-tables identify-thermal identify-tools measure measure-part part plan
plan-probe-surface plan-tool-setting pose pose-rows post predict predict-holes predict-part simulate solve solve-path study trace
verify verify-part""".split()

HEAD = '''"""The documents of answers as types: what `Answer.document` is.

Made by crates/trueaxis-python/documents.py from docs/schemas. An entry is there as an attribute and as an item; one whose
name Python has taken (`from`) only as an item. Entries that are marked so may be absent.
"""

from __future__ import annotations

from typing import Any, List, Literal, Mapping, Optional

from ._answers import Record
'''


def named(schema, owner):
    """The Python type of a schema; `owner` is the document, its name and its definitions."""
    document, definitions = owner
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        target = definitions[name]
        if "properties" in target:
            return f"{document}.{name}"
        return "Any" if "anyOf" in target or "oneOf" in target else named(target, owner)
    if "const" in schema:
        return f"Literal[{json.dumps(schema['const'])}]"
    for word in ("anyOf", "oneOf"):
        if word in schema:
            kinds = sorted({named(one, owner) for one in schema[word]})
            rest = [kind for kind in kinds if kind != "None"]
            united = rest[0] if len(rest) == 1 else f"Union[{', '.join(rest)}]"
            return f"Optional[{united}]" if len(rest) < len(kinds) else united
    kind = schema.get("type")
    if isinstance(kind, list):
        return named({"anyOf": [{**schema, "type": one} for one in kind]}, owner)
    if kind == "array":
        return f"List[{named(schema.get('items', {}), owner)}]"
    if kind == "object":
        more = schema.get("additionalProperties")
        return f"Mapping[str, {named(more, owner)}]" if isinstance(more, dict) else "Mapping[str, Any]"
    return {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "null": "None"}.get(kind, "Any")


def entries(schema, owner):
    required = set(schema.get("required", []))
    for name, entry in schema.get("properties", {}).items():
        said = " ".join(entry.get("description", "").split())
        absent = "" if name in required else " May be absent."
        if name.isidentifier() and not keyword.iskeyword(name):
            yield f"#: {said}{absent}".rstrip()
            yield f"{name}: {named(entry, owner)}"
        else:
            yield f"# [{json.dumps(name)}]: {said}{absent}".rstrip()


def described(name, schema, owner, inner=()):
    said = " ".join(schema.get("description", "A part of the document.").split()).replace("\\", "\\\\")
    body = [f'"""{said}"""', *entries(schema, owner)]
    for title, definition in inner:
        body += ["", *described(title, definition, owner)]
    return [f"class {name}(Record):", *("    " + line if line else "" for line in body)]


def written():
    """The text of the module."""
    lines = [HEAD]
    for name in NAMES:
        schema = json.loads((SCHEMAS / f"{name}.json").read_text(encoding="utf-8"))
        title = "".join(word.capitalize() for word in name.split("-")) + "Document"
        definitions = schema.get("$defs", {})
        inner = [(key, definition) for key, definition in definitions.items() if "properties" in definition]
        lines += ["", *described(title, schema, (title, definitions), inner), ""]
    return "\n".join(lines)


if __name__ == "__main__":
    PLACE.write_text(written(), encoding="utf-8")
