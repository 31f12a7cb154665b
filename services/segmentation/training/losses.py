"""SOLOv2's losses, focal for classes and Dice for masks, and one to learn faster: the class of each
place, as in semantic segmentation."""

from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from training.network import Answer
from training.targets import Targets

MASK_WEIGHT = 3.0  # of the paper


class Losses(NamedTuple):
    """Of a batch."""

    category: Tensor
    mask: Tensor
    semantic: Tensor


def focal_loss(logits: Tensor, classes: Tensor, alpha: float, gamma: float = 2.0) -> Tensor:
    """Sum over cells and classes (Lin et al., 2017). logits [N, C]; classes [N], -1: none."""
    wanted = torch.zeros_like(logits)
    positive = classes >= 0
    wanted[positive, classes[positive]] = 1.0
    chance = torch.sigmoid(logits)
    missed = torch.where(wanted > 0, 1 - chance, chance)
    weight = torch.where(wanted > 0, alpha, 1 - alpha) * missed**gamma
    return (
        weight * functional.binary_cross_entropy_with_logits(logits, wanted, reduction="none")
    ).sum()


def dice_loss(logits: Tensor, masks: Tensor) -> Tensor:
    """1 - Dice coefficient of each pair (Milletari et al., 2016). Both [P, h, w]; the answer [P]."""
    chance = torch.sigmoid(logits).flatten(1)
    masks = masks.flatten(1)
    shared = (chance * masks).sum(1)
    return 1 - 2 * shared / ((chance**2).sum(1) + (masks**2).sum(1) + 1e-4)


def mask_logits(kernels: Tensor, feature: Tensor) -> Tensor:
    """kernels [P, E], feature [E, h, w]: the masks before the sigmoid, [P, h, w]."""
    return (kernels @ feature.flatten(1)).view(-1, *feature.shape[1:])


def solov2_losses(found: Answer, targets: list[Targets], alpha: float) -> Losses:
    """Of the network's answer to a batch; `alpha` weighs cells that show something."""
    categories, kernels, feature, semantic = found
    logits = torch.cat([c.flatten(2) for c in categories], 2).transpose(1, 2)  # [B, cells, C]
    kernels_by_cell = torch.cat([k.flatten(2) for k in kernels], 2).transpose(1, 2)  # [B, cells, E]
    classes = torch.stack([torch.from_numpy(np.concatenate(each.categories)) for each in targets])
    positives = sum(len(each.cells) for each in targets)
    category_loss = focal_loss(logits.flatten(0, 1), classes.flatten(), alpha) / (positives + 1)

    dice = [
        dice_loss(
            mask_logits(kernels_by_cell[i, torch.from_numpy(each.cells)], feature[i]),
            torch.from_numpy(each.masks[each.mask_of_cell]),
        )
        for i, each in enumerate(targets)
        if len(each.cells) > 0
    ]
    mask_loss = torch.cat(dice).mean() if dice else feature.sum() * 0.0
    places = torch.from_numpy(np.stack([each.semantic for each in targets]))
    nothing = semantic.shape[1] - 1
    semantic_loss = functional.cross_entropy(semantic, torch.where(places < 0, nothing, places))
    return Losses(category_loss, MASK_WEIGHT * mask_loss, semantic_loss)
