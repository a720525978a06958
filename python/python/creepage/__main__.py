"""The command `creepage`, as `pip install creepage` brings it."""

import sys

from ._creepage import main as _main


def main() -> int:
    """Carries out the command; the exit code."""
    return _main(["creepage", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
