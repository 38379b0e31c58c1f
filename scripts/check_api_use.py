#!/usr/bin/env python3
"""Check that every public function is used by a test or an example.

usage: check_api_use.py [ROOT]         exit 1 and print the functions that nothing uses
       check_api_use.py --exports LIB...
                                       exit 1 unless the shared libraries export the public
                                       functions and nothing else
       check_api_use.py --self-test
"""

import pathlib
import re
import subprocess
import sys

COMMENTS_AND_STRINGS = re.compile(r'/\*.*?\*/|"(?:\\.|[^"\\\n])*"|//[^\n]*', re.DOTALL)
DECLARATION = re.compile(r"\bHC_API\b[^;{]*?\b(hc_\w+)\s*\(", re.DOTALL)
LINKERS_OWN = {"__bss_start", "_edata", "_end", "_init", "_fini"}
CALL = re.compile(r"\b(hc_\w+)\s*\(")


def bare(text):
    return COMMENTS_AND_STRINGS.sub(" ", text)


def declared(texts):
    return {name for text in texts for name in DECLARATION.findall(bare(text))}


def used(texts):
    return {name for text in texts for name in CALL.findall(bare(text))}


def read(root, *patterns):
    return [path.read_text() for pattern in patterns for path in sorted(root.glob(pattern))]


def exported(library):
    lines = subprocess.run(
        ["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    return {line.split()[-1] for line in lines} - LINKERS_OWN


def check_exports(root, libraries):
    wanted = declared(read(root, "include/heightcast/*.h"))
    found = set().union(*(exported(library) for library in libraries))
    for name in sorted(found - wanted):
        print(f"{name} is exported and in no public header")
    for name in sorted(wanted - found):
        print(f"{name} is public and not exported")
    return found != wanted


def check_use(root):
    functions = declared(read(root, "include/heightcast/*.h"))
    unused = functions - used(read(root, "tests/**/*.c", "examples/*.c"))
    for name in sorted(unused):
        print(f"{name} is used by no test and no example")
    if not functions:
        print("no public function found")
    return bool(unused) or not functions


def self_test():
    header = "HC_API int hc_a(void); HC_API char *\nhc_b(int x); /* HC_API void hc_c(); */"
    source = 'int x = hc_a (); /* hc_b(1) */ const char *t = "hc_b(1)";'
    return declared([header]) != {"hc_a", "hc_b"} or used([source]) != {"hc_a"}


def main():
    root = pathlib.Path(__file__).resolve().parents[1]
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if sys.argv[1:2] == ["--exports"]:
        sys.exit(check_exports(root, sys.argv[2:]))
    sys.exit(check_use(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else root))


if __name__ == "__main__":
    main()
