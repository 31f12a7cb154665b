"""SOLOv2 after its convolutions, written down plainly: solov2.py FOLDER (see tensors.py).

Tensors: either, for each level, class scores [1, C, S, S] (before the sigmoid) and kernels
[1, E, S, S], the finest level first, and then the feature [1, E, H/4, W/4]; or merged class scores
[3872, C], kernels [3872, E] and the feature.
"""

import numpy as np

from tensors import main, resized, sigmoid

STRIDES = [8, 8, 16, 32, 32]
MERGED_GRIDS = [40, 36, 24, 16, 12]
SIGMA = 2.0


def points_nms(scores):
    """scores [C, S, S]: those stay that are the largest of the 2 x 2 that end with them."""
    padded = np.pad(scores, ((0, 0), (1, 1), (1, 1)), constant_values=-np.inf)
    pooled = np.maximum.reduce(
        [padded[:, :-1, :-1], padded[:, 1:, :-1], padded[:, :-1, 1:], padded[:, 1:, 1:]]
    )[:, :-1, :-1]
    return np.where(pooled == scores, scores, 0.0)


def cells_of(request):
    """Scores [N, C], kernels [N, E] and stride of each cell; the feature [E, h, w]."""
    *grids, feature = request.tensors
    feature = feature.reshape(feature.shape[-3:])
    if len(grids) == 2:
        scores, kernels = (grid.reshape(grid.shape[-2:]) for grid in grids)
        sizes = MERGED_GRIDS
    else:
        categories, kernels = grids[0::2], grids[1::2]
        sizes = [grid.shape[-1] for grid in categories]
        scores = np.concatenate(
            [points_nms(sigmoid(c[0])).reshape(c.shape[1], -1).T for c in categories]
        )
        kernels = np.concatenate([k[0].reshape(k.shape[1], -1).T for k in kernels])
    strides = np.concatenate([np.full(s * s, stride) for s, stride in zip(sizes, STRIDES)])
    return scores, kernels, strides, feature


def matrix_nms(masks, classes, scores):
    """The scores, each shrunk for better masks of its class that it overlaps."""
    flat = masks.reshape(len(masks), -1).astype(np.float64)
    shared = flat @ flat.T
    area = flat.sum(1)
    iou = np.triu(shared / (area[:, None] + area[None, :] - shared), 1)
    iou *= np.triu(classes[:, None] == classes[None, :], 1)
    compensation = iou.max(0)[:, None]
    decay = (np.exp(-SIGMA * iou**2) / np.exp(-SIGMA * compensation**2)).min(0)
    return scores * decay


def best(scores, count):
    return np.argsort(-scores, kind="stable")[:count]


def decode(request):
    scores, kernels, strides, feature = cells_of(request)
    cell, classes = np.nonzero(scores > 0.1)
    scores = scores[cell, classes]
    if len(cell) == 0:
        return []
    channels, height, width = feature.shape
    logits = kernels[cell].astype(np.float64) @ feature.reshape(channels, -1).astype(np.float64)
    masks = sigmoid(logits).reshape(-1, height, width)
    inside = masks > 0.5
    area = inside.sum((1, 2))
    keep = area > strides[cell]
    masks, inside, classes, area = masks[keep], inside[keep], classes[keep], area[keep]
    if len(masks) == 0:
        return []
    scores = scores[keep] * (masks * inside).sum((1, 2)) / area

    order = best(scores, 500)
    masks, inside, classes, scores = masks[order], inside[order], classes[order], scores[order]
    scores = matrix_nms(inside, classes, scores)
    order = [i for i in best(scores, 100) if scores[i] >= 0.05]
    order = [i for i in order if scores[i] > request.score_threshold]

    image_height, image_width = request.image_size()
    found = []
    for i in order:
        mask = resized(masks[i], 4 * height, 4 * width)[:image_height, :image_width]
        mask = resized(mask, request.frame_height, request.frame_width)
        found.append((classes[i], scores[i], mask > 0.5))
    return found


if __name__ == "__main__":
    main(decode)
