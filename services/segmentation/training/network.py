"""A small SOLOv2 (Wang et al., "SOLOv2: Dynamic and Fast Instance Segmentation", 2020).

What differs from the paper's: a narrow ResNet-18, 64 channels in pyramid and heads, two convolutions
in a head instead of four, coarser grids, and a mask feature that is summed from the pyramid's levels
without a stack of convolutions of its own for each.

Shapes: B images, C classes, E numbers of a kernel, S cells along a side of a grid.
"""

from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor, nn
from torch.nn import functional

GRIDS = [32, 24, 16, 12, 8]
MASK_STRIDE = 4


def conv_bn(inputs: int, outputs: int, stride: int = 1, kernel: int = 3) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, bias=False), nn.BatchNorm2d(outputs)
    )


class FloatGroupNorm(nn.GroupNorm):
    """PyTorch 1.13 has none for bfloat16, in which the rest may be reckoned."""

    def forward(self, x: Tensor) -> Tensor:
        return super().forward(x.float())


def conv_gn(inputs: int, outputs: int) -> nn.Sequential:
    """For heads that all levels share: their statistics differ, so none are kept."""
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, 3, padding=1, bias=False),
        FloatGroupNorm(16, outputs),
        nn.ReLU(True),
    )


class BasicBlock(nn.Module):
    """ResNet's: two convolutions and a short cut."""

    def __init__(self, inputs: int, outputs: int, stride: int):
        super().__init__()
        self.first = conv_bn(inputs, outputs, stride)
        self.second = conv_bn(outputs, outputs)
        is_same = stride == 1 and inputs == outputs
        self.short_cut = nn.Identity() if is_same else conv_bn(inputs, outputs, stride, 1)

    def forward(self, x: Tensor) -> Tensor:
        return torch.relu(self.second(torch.relu(self.first(x))) + self.short_cut(x))


class Backbone(nn.Module):
    """[B, 3, H, W] to four maps of strides 4, 8, 16 and 32 with `widths` channels."""

    def __init__(self, widths: tuple[int, ...], blocks: tuple[int, ...]):
        super().__init__()
        half = widths[0] // 2
        self.stem = nn.Sequential(
            conv_bn(3, half, 2), nn.ReLU(True), conv_bn(half, widths[0], 2), nn.ReLU(True)
        )
        stages = []
        inputs = widths[0]
        for index, (width, count) in enumerate(zip(widths, blocks)):
            strides = [1 if index == 0 else 2] + [1] * (count - 1)
            stages.append(
                nn.Sequential(
                    *(
                        BasicBlock(inputs if i == 0 else width, width, s)
                        for i, s in enumerate(strides)
                    )
                )
            )
            inputs = width
        self.stages = nn.ModuleList(stages)

    def forward(self, image: Tensor) -> list[Tensor]:
        x = self.stem(image)
        maps = []
        for stage in self.stages:
            x = stage(x)
            maps.append(x)
        return maps


class Pyramid(nn.Module):
    """Feature pyramid (Lin et al., 2017): the same strides, each `channels` wide. The finest is
    only mixed, since the mask feature convolves it anyway."""

    def __init__(self, widths: tuple[int, ...], channels: int):
        super().__init__()
        self.laterals = nn.ModuleList(nn.Conv2d(width, channels, 1) for width in widths)
        self.smooth = nn.ModuleList(conv_bn(channels, channels) for _ in widths[1:])

    def forward(self, maps: list[Tensor]) -> list[Tensor]:
        levels = [lateral(x) for lateral, x in zip(self.laterals, maps)]
        for i in range(len(levels) - 1, 0, -1):
            levels[i - 1] = levels[i - 1] + functional.interpolate(
                levels[i], scale_factor=2.0, mode="nearest"
            )
        return [levels[0]] + [torch.relu(smooth(x)) for smooth, x in zip(self.smooth, levels[1:])]


def with_coordinates(x: Tensor) -> Tensor:
    """[B, N, h, w] to [B, N + 2, h, w]: each place's x and y, -1 to 1 (CoordConv)."""
    batch, _, height, width = x.shape
    across, down = np.meshgrid(
        *(np.linspace(-1.0, 1.0, n, dtype=np.float32) for n in (width, height))
    )
    coordinates = torch.from_numpy(np.stack([across, down])).expand(batch, 2, height, width)
    return torch.cat([x, coordinates], 1)


class MaskFeature(nn.Module):
    """The pyramid to what kernels are multiplied with: [B, E, H / 4, W / 4]."""

    def __init__(self, channels: int, kernel_length: int):
        super().__init__()
        self.merge = nn.ModuleList(nn.Conv2d(channels, channels, 1) for _ in range(3))
        self.mix = conv_bn(channels + 2, channels)
        self.out = nn.Sequential(conv_bn(channels, kernel_length, kernel=1), nn.ReLU(True))

    def forward(self, levels: list[Tensor]) -> Tensor:
        finest = levels[0]
        for level, merge, factor in zip(levels[1:], self.merge, (2.0, 4.0, 8.0)):
            finest = finest + functional.interpolate(
                merge(level), scale_factor=factor, mode="bilinear", align_corners=False
            )
        return self.out(torch.relu(self.mix(with_coordinates(torch.relu(finest)))))


class Head(nn.Module):
    """What each cell of a grid shows, and with which kernel to find its mask."""

    def __init__(self, channels: int, classes: int, kernel_length: int):
        super().__init__()
        self.category = nn.Sequential(conv_gn(channels, channels), conv_gn(channels, channels))
        self.kernel = nn.Sequential(conv_gn(channels + 2, channels), conv_gn(channels, channels))
        self.category_out = nn.Conv2d(channels, classes, 3, padding=1)
        self.kernel_out = nn.Conv2d(channels, kernel_length, 3, padding=1)
        nn.init.normal_(self.category_out.weight, std=0.01)
        nn.init.constant_(self.category_out.bias, -4.6)  # sigmoid: 0.01; few cells show anything
        nn.init.normal_(self.kernel_out.weight, std=0.01)
        nn.init.zeros_(self.kernel_out.bias)

    def forward(self, level: Tensor, size: int) -> tuple[Tensor, Tensor]:
        """Class scores before the sigmoid [B, C, S, S] and kernels [B, E, S, S]."""
        x = functional.interpolate(level, size=(size, size), mode="bilinear", align_corners=False)
        category = self.category_out(self.category(x))
        return category, self.kernel_out(self.kernel(with_coordinates(x)))


class Answer(NamedTuple):
    """What the network says of a batch."""

    categories: list[Tensor]  # class scores before the sigmoid, the finest grid first [B, C, S, S]
    kernels: list[Tensor]  # of the same grids [B, E, S, S]
    feature: Tensor  # [B, E, H / 4, W / 4]
    semantic: Tensor  # class of each place before the softmax, the last: none [B, C + 1, H / 8, W / 8]

    def float(self) -> "Answer":
        """The same as float32."""
        categories = [each.float() for each in self.categories]
        kernels = [each.float() for each in self.kernels]
        return Answer(categories, kernels, self.feature.float(), self.semantic.float())


class Solov2(nn.Module):
    """Images, RGB and normalised [B, 3, H, W], H and W multiples of 32, to what SOLOv2's
    convolutions end with."""

    def __init__(
        self,
        classes: int,
        widths: tuple[int, ...] = (32, 64, 128, 192),
        blocks: tuple[int, ...] = (2, 2, 2, 2),
        channels: int = 64,
        kernel_length: int = 64,
    ):
        super().__init__()
        self.backbone = Backbone(widths, blocks)
        self.pyramid = Pyramid(widths, channels)
        self.mask_feature = MaskFeature(channels, kernel_length)
        self.head = Head(channels, classes, kernel_length)
        self.semantic = nn.Conv2d(channels, classes + 1, 1)  # to learn with only: not exported

    def forward(self, image: Tensor) -> Answer:
        levels = self.pyramid(self.backbone(image))
        seen = [levels[1], levels[1], levels[2], levels[3], levels[3]]  # by each grid
        found = [self.head(level, size) for level, size in zip(seen, GRIDS)]
        return Answer(
            [category for category, _ in found],
            [kernel for _, kernel in found],
            self.mask_feature(levels),
            self.semantic(levels[1]),
        )
