"""A model file's tables from Python's dicts."""

from __future__ import annotations

import json
from collections.abc import Mapping


def toml(description: Mapping[str, object]) -> str:
    """The model file with these keys: tables of tables, such as ``axis`` and ``run``, under headings of their own."""
    if not isinstance(description, Mapping):
        raise TypeError(
            f"a description of type {type(description).__name__}\n  expected a model file's text, or a dict with its keys"
        )
    lines = [f"{_key(key)} = {_value(value)}" for key, value in description.items() if not isinstance(value, Mapping)]
    for key, table in description.items():
        if isinstance(table, Mapping):
            nested = bool(table) and all(isinstance(value, Mapping) for value in table.values())
            parts = {f"{_key(key)}.{_key(name)}": value for name, value in table.items()} if nested else {_key(key): table}
            for heading, part in parts.items():
                lines += ["", f"[{heading}]", *(f"{_key(name)} = {_value(value)}" for name, value in part.items())]
    return "\n".join(lines) + "\n"


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"the key {key!r} of a description is no text")
    return key if key and key.isascii() and key.replace("_", "").replace("-", "").isalnum() else _text(key)


def _value(value: object) -> str:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        # NumPy's own float is one, and shows its type.
        return repr(float(value) if isinstance(value, float) else value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(own)}" for key, own in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    raise TypeError(f"{value!r} in a description\n  expected text, a number, a list or a dict")


def _text(text: str) -> str:
    # JSON's escapes are among TOML's, but for those of characters beyond 16 bits, which stand as they are; and DEL is escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
