#!/usr/bin/env python3
"""Check the arrows of docs/architecture.md: who may include whom.

usage: check_layers.py [ROOT]          check the tree; exit 1 and print file:line for each violation
       check_layers.py --self-test     plant violations in a made tree and see that they are found
"""

import pathlib
import re
import sys
import tempfile

# part -> the parts it may include, besides itself
ARROWS = {
    "base": [],
    "field": ["base"],
    "maps": ["base", "field"],
    "reference": ["base", "field"],
    "bake": ["base", "field", "maps"],
    "trace": ["base", "field", "maps"],
    "gl": ["base", "field", "maps"],
    "gpu": ["base", "field", "maps", "bake", "gl"],
    "render": ["base", "field", "maps", "trace", "gl"],
    "io": ["base", "field", "maps"],
}

# public header -> its part; the umbrella header belongs to the users
PUBLIC = {
    "version.h": "base",
    "result.h": "base",
    "mesh.h": "base",
    "field.h": "field",
    "ray.h": "field",
    "maps.h": "maps",
    "bake.h": "bake",
    "trace.h": "trace",
    "render.h": "render",
    "gpu.h": "gpu",
    "terrain.h": "render",
    "io.h": "io",
}
UMBRELLA = "heightcast.h"

# folders of users: the public headers and themselves, nothing of src/
USERS = ["tools", "examples", "bench"]

# what the parts of libheightcast may include from outside: libc, POSIX threads, vector intrinsics
CORE = ["base", "field", "maps", "bake", "trace", "reference"]
LIBC = set(
    """assert.h ctype.h errno.h fenv.h float.h inttypes.h limits.h math.h stdalign.h stdarg.h
    stdatomic.h stdbool.h stddef.h stdint.h stdio.h stdlib.h string.h time.h pthread.h sched.h
    sys/mman.h unistd.h immintrin.h""".split()
)

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(path):
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == "<", match.group(2)


def target_of(root, path, angled, name):
    """The file inside the tree that an include means, relative to `root`, or None if outside."""
    folders = [root / "include", root / "src", root / "tests", root]
    if not angled:
        folders.insert(0, path.parent)
    for folder in folders:
        candidate = (folder / name).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root)
    return None


def part_of(relative):
    """("src", "bake"), ("include", "maps"), ("tools", "cli"), ("tests", "unit"), ..."""
    top = relative.parts[0]
    if top == "include":
        return top, UMBRELLA if relative.name == UMBRELLA else PUBLIC.get(relative.name, "?")
    return top, relative.parts[1] if len(relative.parts) > 2 else ""


def violation(root, relative, angled, name):
    """Why `relative` may not include `name`, or None."""
    target = target_of(root, root / relative, angled, name)
    here_top, here = part_of(relative)
    in_library = here_top in ("src", "include")
    if in_library and here not in ARROWS and here != UMBRELLA:
        return f"'{here}' is no part that scripts/check_layers.py knows"
    if target is None:
        if name.startswith("heightcast/") or not angled:
            return f"'{name}' is not in the tree"
        if in_library and here in CORE and name not in LIBC:
            return f"{here} may not know <{name}>: libc, libm and threads only"
        return None
    there_top, there = part_of(target)
    if there_top == "include" and not angled:
        return "public headers are included as <heightcast/...>"
    if here == UMBRELLA:
        return None if there_top == "include" and there != "io" else "the umbrella is the core only"
    if in_library:
        if there_top not in ("src", "include"):
            return f"the library may not know {there_top}/"
        if here_top == "include" and there_top == "src":
            return "public headers may not include private ones"
        if there == here or there in ARROWS[here]:
            return None
        return f"{here} may not know {there}"
    if there_top == "include" or (here_top == there_top and here == there):
        return None
    if here_top == "tests" and there_top in ("src", "tests"):
        return None
    if here_top == "tools" and there_top == "bench":
        return None  # the command line shows what bench/ measures
    return f"{here_top}/{here} may use <heightcast/...> and its own folder only".replace("/ ", " ")


def check(root):
    root = root.resolve()
    found = []
    for top in ["include", "src", "tests", *USERS]:
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in (".c", ".h", ".cpp"):
                continue
            relative = path.relative_to(root)
            for number, angled, name in includes(path):
                reason = violation(root, relative, angled, name)
                if reason:
                    found.append(f"{relative}:{number}: includes {name}: {reason}")
    return found


PLANTED = {
    # file: (line, what it includes, is it a violation?)
    "src/base/a.c": ('"field/b.h"', True),
    "src/base/ok.c": ("<stdlib.h>", False),
    "src/field/b.h": ("<heightcast/result.h>", False),
    "src/field/c.c": ("<tiffio.h>", True),
    "src/maps/d.c": ("<heightcast/bake.h>", True),
    "src/bake/e.c": ('"../field/b.h"', False),
    "src/bake/f.c": ("<heightcast/trace.h>", True),
    "src/trace/g.c": ("<heightcast/maps.h>", False),
    "src/trace/h.c": ('"bake/i.h"', True),
    "src/bake/i.h": ('"missing.h"', True),
    "src/reference/j.c": ("<heightcast/maps.h>", True),
    "src/reference/k.c": ("<heightcast/field.h>", False),
    "src/io/l.c": ("<tiffio.h>", False),
    "src/io/m.c": ("<heightcast/bake.h>", True),
    "src/novel/n.c": ("<stdio.h>", True),
    "src/maps/o.c": ("<heightcast/heightcast.h>", True),
    "include/heightcast/result.h": ("<stdbool.h>", False),
    "include/heightcast/field.h": ("<heightcast/result.h>", False),
    "include/heightcast/maps.h": ("<heightcast/field.h>", False),
    "include/heightcast/bake.h": ('"field/b.h"', True),
    "include/heightcast/trace.h": ("<heightcast/bake.h>", True),
    "include/heightcast/heightcast.h": ("<heightcast/bake.h>", False),
    "tools/cli/p.c": ('"field/b.h"', True),
    "tools/cli/q.c": ('"r.h"', False),
    "tools/cli/r.h": ("<heightcast/heightcast.h>", False),
    "tools/show/s.c": ('"../cli/r.h"', True),
    "bench/t.h": ("<heightcast/heightcast.h>", False),
    "bench/v.c": ('"tools/cli/r.h"', True),
    "tools/cli/w.c": ('"bench/t.h"', False),
    "examples/t.c": ("<heightcast/bake.h>", False),
    "bench/u.c": ('"../src/bake/i.h"', True),
    "tests/unit/v.c": ('"bake/i.h"', False),
}


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (included, _) in PLANTED.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(f"/* planted */\n#include {included}\n")
        found = {line.split(":")[0]: line for line in check(root)}
    wrong = [name for name, (_, bad) in PLANTED.items() if bad != (name in found)]
    for name in wrong:
        print(f"self-test: {name}: {found.get(name, 'violation not found')}")
    if any(":2: " not in line for line in found.values()):
        wrong.append("line numbers")
        print("self-test: a line number is wrong")
    return wrong


def main():
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(1 if self_test() else 0)
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1])
    found = check(root)
    for line in found:
        print(line)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
