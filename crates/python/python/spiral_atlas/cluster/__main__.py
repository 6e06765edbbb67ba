"""`python -m spiral_atlas.cluster`: the same as `spiral-atlas-cluster`."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
