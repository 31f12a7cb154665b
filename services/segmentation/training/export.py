"""Writes the trained network as ONNX: python3 -m training.export CHECKPOINT FILE.onnx.

The graph ends with SOLOv2's convolutions, as docs/models.md describes raw outputs; the names of the
classes are in the metadata key `names`.
"""

import argparse
import pathlib
import warnings

import onnx
import torch

from training.classes import CLASSES
from training.network import GRIDS, Solov2
from training.train import Plan


class Raw(torch.nn.Module):
    """The network's answer as one row of tensors."""

    def __init__(self, network: Solov2):
        super().__init__()
        self.network = network

    def forward(self, image: torch.Tensor) -> tuple[torch.Tensor, ...]:
        categories, kernels, feature, _ = self.network(image)
        return (*categories, *kernels, feature)


def export(network: Solov2, path: pathlib.Path, size: tuple[int, int]) -> None:
    """For images of `size` (height, width)."""
    levels = range(len(GRIDS))
    outputs = [f"cate_{i}" for i in levels] + [f"kernel_{i}" for i in levels] + ["mask_feat"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of its own workings
        torch.onnx.export(
            Raw(network).eval(),
            torch.zeros(1, 3, *size),
            str(path),
            opset_version=13,
            input_names=["image"],
            output_names=outputs,
        )
    model = onnx.load(str(path))
    model.producer_name = "tsg-slam"
    model.doc_string = ""
    onnx.helper.set_model_props(model, {"names": str(dict(enumerate(CLASSES)))})
    onnx.checker.check_model(model)
    onnx.save(model, str(path))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkpoint", type=pathlib.Path)
    parser.add_argument("file", type=pathlib.Path)
    arguments = parser.parse_args()
    state = torch.load(arguments.checkpoint)
    network = Solov2(len(CLASSES))
    network.load_state_dict(state["average"])
    export(network, arguments.file, Plan.size)
    print(
        f"{arguments.file}: the network after {state['iteration']} of {state['plan']['iterations']} iterations"
    )


if __name__ == "__main__":
    main()
