"""What the reference decoders share: reading a request, interpolation, writing the answer.

A request is a folder with request.json and one file of raw numbers for each tensor:
  {"frame": [width, height], "input": [width, height], "score_threshold": 0.25, "nms_iou": 0.6,
   "classes": 80, "tensors": [{"file": "0.raw", "type": "float32", "shape": [1, 80, 40, 40]}, ...]}
The answer: instances.json, [{"class": 3, "score": 0.9}, ...] by falling score, and masks.raw, one
byte for each pixel of each instance's mask.
"""

import json
import pathlib
import sys

import numpy as np


class Request:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        content = json.loads((self.folder / "request.json").read_text())
        self.frame_width, self.frame_height = content["frame"]
        self.input_width, self.input_height = content["input"]
        self.score_threshold = content["score_threshold"]
        self.nms_iou = content["nms_iou"]
        self.classes = content["classes"]
        self.tensors = [
            np.fromfile(self.folder / tensor["file"], tensor["type"]).reshape(tensor["shape"])
            for tensor in content["tensors"]
        ]

    def image_size(self):
        """Height and width of the frame in the network's input, its aspect ratio kept."""
        scale = min(self.input_width / self.frame_width, self.input_height / self.frame_height)
        return int(self.frame_height * scale + 0.5), int(self.frame_width * scale + 0.5)

    def answer(self, instances):
        """instances: (class, score, mask) by falling score."""
        masks = np.zeros((len(instances), self.frame_height, self.frame_width), np.uint8)
        for index, (_, _, mask) in enumerate(instances):
            masks[index] = mask
        masks.tofile(self.folder / "masks.raw")
        found = [{"class": int(c), "score": float(score)} for c, score, _ in instances]
        (self.folder / "instances.json").write_text(json.dumps(found))


def sigmoid(values):
    return 1.0 / (1.0 + np.exp(-values.astype(np.float64)))


def _axis(length, new_length):
    position = (np.arange(new_length) + 0.5) * length / new_length - 0.5
    position = np.clip(position, 0, length - 1)
    first = np.floor(position).astype(int)
    return first, np.minimum(first + 1, length - 1), position - first


def resized(image, height, width):
    """Bilinear, half-pixel centres, edges going on (align_corners=False)."""
    first, second, weight = _axis(image.shape[0], height)
    image = image[first] * (1 - weight)[:, None] + image[second] * weight[:, None]
    first, second, weight = _axis(image.shape[1], width)
    return image[:, first] * (1 - weight) + image[:, second] * weight


def main(decode):
    request = Request(sys.argv[1])
    request.answer(decode(request))
