"""One part of every family on a sheet: figure.py FIGURE.webp [--seed N]."""

import os
import sys

import generate
from families import FAMILIES, HARD

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "resources", "sweep"))
from picture import EYES, cad_scene, pyplot  # noqa: E402

COLUMNS = 8


def main():
    seed = int(sys.argv[3]) if sys.argv[2:3] == ["--seed"] else 1
    names = [*FAMILIES, *HARD]
    figure, axes = pyplot.subplots(-(-len(names) // COLUMNS), COLUMNS, figsize=(COLUMNS * 1.9, -(-len(names) // COLUMNS) * 2.05))
    for place in axes.flat:
        place.axis("off")
    for place, name in zip(axes.flat, names):
        cad_scene(generate.make(name, 0, seed)[1]).draw(place, EYES[0])
        place.set_title(name + (" *" if name in HARD else ""), fontsize=9)
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.96, 0.02, 0.12)
    figure.savefig(sys.argv[1], dpi=80, pil_kwargs={"quality": 80})
    return 0


if __name__ == "__main__":
    sys.exit(main())
