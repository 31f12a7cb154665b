"""Draws how a training went: python3 -m training.curves LOG.jsonl FILE.png."""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")  # no display
from matplotlib import pyplot  # noqa: E402


def draw(log: pathlib.Path, path: pathlib.Path) -> None:
    lines = [json.loads(line) for line in log.read_text().splitlines()]
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3), constrained_layout=True)
    for axis, key, title in zip(
        axes, ("category", "mask"), ("class loss (focal)", "mask loss (3 x Dice)")
    ):
        for prefix, label in (
            ("", "training, augmented"),
            ("held_out_", "held out, averaged network"),
        ):
            points = [
                (line["iteration"], line[prefix + key]) for line in lines if prefix + key in line
            ]
            axis.plot(*zip(*points), label=label, linewidth=1)
        axis.set(title=title, xlabel="iteration", ylim=(0, None))
        axis.grid(alpha=0.3)
    axes[0].legend()
    figure.savefig(path, dpi=90)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("log", type=pathlib.Path)
    parser.add_argument("file", type=pathlib.Path)
    arguments = parser.parse_args()
    draw(arguments.log, arguments.file)


if __name__ == "__main__":
    main()
