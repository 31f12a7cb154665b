"""How good a network is: python3 -m training.evaluate MODEL.onnx --data DIR --tsgctl FILE --out DIR.

The network is run by `tsgctl model run`, which is the code of the segmentation service, on rendered
sequences; what is found is compared with the true masks. DIR gets report.json and report.md. With
    AP            mask AP over IoU 0.50..0.95 (metrics.py), all that scores 0.05 and more
    AP50          the same at IoU 0.50
    instance IoU  mean over true instances of the best IoU with something found of that class; 0 where
                  nothing is
    semantic IoU  of all pixels of a class in all images: those found and true, by found or true
IoUs are of what scores 0.25 and more, as the service has it. Instances of the truth below --min-area
count in no AP and in no instance IoU.
"""

import argparse
import dataclasses
import json
import pathlib
import subprocess

import cv2
import numpy as np

from training.classes import CLASSES
from training.dataset import Frame, load_sequence
from training.metrics import Instances, Matches, average_precision, best_overlaps, match

LOWEST_SCORE = 0.05
SERVICE_SCORE = 0.25


@dataclasses.dataclass
class ClassTally:
    """Of one class, over the images so far."""

    matches: list[Matches] = dataclasses.field(default_factory=list)
    best: list[np.ndarray] = dataclasses.field(default_factory=list)
    shared_pixels: int = 0
    joined_pixels: int = 0

    def add(self, found: Instances, truth: Instances, min_area: int) -> None:
        """Both of this class."""
        self.matches.append(match(found, truth, min_area))
        sure = found.scores >= SERVICE_SCORE
        found = Instances(found.masks[sure], found.classes[sure], found.scores[sure])
        self.best.append(best_overlaps(found, truth, min_area))
        a, b = found.masks.any(0), truth.masks.any(0)
        self.shared_pixels += int((a & b).sum())
        self.joined_pixels += int((a | b).sum())

    def report(self) -> dict:
        precision = average_precision(self.matches)
        best = np.concatenate(self.best)
        return {
            "instances": len(best),
            "ap": float(precision.mean()),
            "ap50": float(precision[0]),
            "instance_iou": float(best.mean()) if len(best) else float("nan"),
            "semantic_iou": self.shared_pixels / self.joined_pixels
            if self.joined_pixels
            else float("nan"),
        }


def true_instances(frame: Frame) -> Instances:
    ids = [i for i in np.unique(frame.ids) if int(i) in frame.classes]
    masks = (
        np.stack([frame.ids == i for i in ids]) if ids else np.zeros((0, *frame.ids.shape), bool)
    )
    return Instances(masks, np.array([frame.classes[int(i)] for i in ids], int), np.ones(len(ids)))


def found_instances(labels: np.ndarray, found: list[dict]) -> Instances:
    """Of a label image as the service publishes it: no pixel belongs to two, and an instance may be
    wholly covered."""
    known = [
        i for i, each in enumerate(found) if each["class"] in CLASSES and (labels == i + 1).any()
    ]
    masks = (
        np.stack([labels == i + 1 for i in known]) if known else np.zeros((0, *labels.shape), bool)
    )
    classes = [CLASSES.index(found[i]["class"]) for i in known]
    return Instances(masks, np.array(classes, int), np.array([found[i]["score"] for i in known]))


def run_network(
    tsgctl: str, model: pathlib.Path, sequence: pathlib.Path, out: pathlib.Path
) -> list[Instances]:
    """What it finds in each image of a sequence."""
    command = [tsgctl, "model", "run", model, "--input", sequence, "--out", out, "--threads", "1"]
    subprocess.run([*command, "--score", str(LOWEST_SCORE)], check=True, capture_output=True)
    images = json.loads((out / "found.json").read_text())["images"]
    return [
        found_instances(
            cv2.imread(
                str(out / "mask" / f"{pathlib.Path(each['image']).stem}.png"), cv2.IMREAD_UNCHANGED
            ),
            each["instances"],
        )
        for each in images
    ]


def evaluate(
    tsgctl: str, model: pathlib.Path, data: pathlib.Path, out: pathlib.Path, min_area: int
) -> dict:
    tallies = {name: ClassTally() for name in CLASSES}
    sequences = sorted(path.parent for path in data.glob("*/rgb.txt"))
    if not sequences:
        raise SystemExit(
            f"{data}: no rendered sequence in it; render some: training/reproduce does it"
        )
    images = 0
    for sequence in sequences:
        frames = load_sequence(sequence)
        for frame, found in zip(frames, run_network(tsgctl, model, sequence, out / sequence.name)):
            truth = true_instances(frame)
            for index, name in enumerate(CLASSES):
                tallies[name].add(found.of_class(index), truth.of_class(index), min_area)
        images += len(frames)
    return summary(tallies, images, len(sequences), min_area)


def summary(tallies: dict[str, ClassTally], images: int, sequences: int, min_area: int) -> dict:
    classes = {
        name: tally.report()
        for name, tally in tallies.items()
        if sum(m.wanted for m in tally.matches)
    }
    means = {
        key: float(np.mean([each[key] for each in classes.values()]))
        for key in ("ap", "ap50", "instance_iou", "semantic_iou")
    }
    return {
        "images": images,
        "sequences": sequences,
        "min_area_px": min_area,
        "mean": means,
        "classes": classes,
    }


def to_markdown(report: dict) -> str:
    def row(name: str, instances, each: dict) -> str:
        numbers = (f"{each[key]:.3f}" for key in ("ap", "ap50", "instance_iou", "semantic_iou"))
        return f"| {name} | {instances} | " + " | ".join(numbers) + " |"

    lines = [
        "| class | instances | AP | AP50 | instance IoU | semantic IoU |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    lines += [row(name, each["instances"], each) for name, each in report["classes"].items()]
    lines.append(
        row(
            "mean of classes",
            sum(each["instances"] for each in report["classes"].values()),
            report["mean"],
        )
    )
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument(
        "--data", type=pathlib.Path, required=True, help="folder of rendered sequences"
    )
    parser.add_argument("--tsgctl", required=True, help="the program")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--min-area", type=int, default=100, help="pixels (%(default)s)")
    arguments = parser.parse_args()
    report = evaluate(
        arguments.tsgctl, arguments.model, arguments.data, arguments.out, arguments.min_area
    )
    (arguments.out / "report.json").write_text(json.dumps(report, indent=1) + "\n")
    (arguments.out / "report.md").write_text(to_markdown(report))
    print(to_markdown(report), end="")


if __name__ == "__main__":
    main()
