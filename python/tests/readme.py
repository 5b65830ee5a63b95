"""The lines of the README's Python section print what it says, in whatever Python this is."""

import contextlib
import io
import re
import sys
from pathlib import Path

README = (Path(__file__).resolve().parents[2] / "README.md").read_text()
section = README.split("\n## Python\n")[1].split("\n## ")[0]
code, expected = re.search(r"```python\n(.*?)```.*?```text\n(.*?)```", section, re.DOTALL).groups()
printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    exec(code, {})
if printed.getvalue() != expected:
    sys.exit(f"The README says\n{expected}\nwhat is printed is\n{printed.getvalue()}")
print(printed.getvalue(), end="")
