"""Rendered sequences in memory."""

import dataclasses
import json
import pathlib

import cv2
import numpy as np

from training.classes import CLASSES


@dataclasses.dataclass
class Frame:
    """An image with its truth."""

    image: np.ndarray  # uint8 [H, W, 3], RGB
    ids: np.ndarray  # uint8 or uint16 [H, W]: which instance; 0: none
    classes: dict[int, int]  # of instances that have one of CLASSES, by id


def load_sequence(folder: pathlib.Path) -> list[Frame]:
    """All frames of a folder that `tsgctl simulate` wrote."""
    instances = json.loads((folder / "instances.json").read_text())["instances"]
    classes = {
        int(key): CLASSES.index(each["cls"])
        for key, each in instances.items()
        if each["cls"] in CLASSES
    }
    frames = []
    for path in sorted((folder / "rgb").glob("*.png")):
        image = cv2.cvtColor(cv2.imread(str(path)), cv2.COLOR_BGR2RGB)
        ids = cv2.imread(str(folder / "mask" / path.name), cv2.IMREAD_UNCHANGED)
        frames.append(Frame(image, ids, classes))
    return frames


def load_sequences(folder: pathlib.Path) -> list[Frame]:
    """The frames of all sequences in a folder, by name."""
    finished = sorted(path.parent for path in folder.glob("*/rgb.txt"))
    frames = [frame for sequence in finished for frame in load_sequence(sequence)]
    if not frames:
        raise SystemExit(
            f"{folder}: no rendered sequence in it; render some: training/reproduce does it"
        )
    return frames
