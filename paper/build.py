#!/usr/bin/env python3
"""Builds paper/paper.pdf; with --pages DIR also every page as PNG. Fails on any warning of Typst but one: a font that this
machine lacks, where the next of its list takes its place. The last of every list comes with Typst.

Once: pip install -r paper/requirements.txt
"""

import argparse
import pathlib
import sys

try:
    import typst
except ImportError:
    sys.exit("typst is missing: pip install -r paper/requirements.txt")

here = pathlib.Path(__file__).resolve().parent
arguments = argparse.ArgumentParser(description=__doc__)
arguments.add_argument("--pages", metavar="DIR", help="folder for the pages as PNG")
arguments.add_argument("--out", metavar="PDF", default=here / "paper.pdf", help="where the paper goes")
arguments = arguments.parse_args()

pdf, warnings = typst.compile_with_warnings(here / "paper.typ", root=here)
pathlib.Path(arguments.out).write_bytes(pdf)
if arguments.pages:
    pages = pathlib.Path(arguments.pages)
    pages.mkdir(parents=True, exist_ok=True)
    images = typst.compile(here / "paper.typ", root=here, format="png", ppi=110)
    for number, image in enumerate(images if isinstance(images, list) else [images], 1):
        (pages / f"page-{number}.png").write_bytes(image)
for warning in warnings:
    print(f"warning: {warning.message}", *getattr(warning, "hints", []), sep="\n  ", file=sys.stderr)
print(f"{arguments.out}: {len(pdf)} bytes")
sys.exit(any(not warning.message.startswith("unknown font family") for warning in warnings))
