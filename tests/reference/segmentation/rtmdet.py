"""RTMDet-Ins after its NMS, written down plainly: rtmdet.py FOLDER (see tensors.py).

Tensors: dets [1, N, 5], labels [1, N], masks [1, N, H, W].
"""

import numpy as np

from tensors import main, resized, sigmoid


def decode(request):
    boxes, classes, masks = (tensor[0] for tensor in request.tensors)
    if masks.size and (masks.min() < 0 or masks.max() > 1):
        masks = sigmoid(masks)
    image_height, image_width = request.image_size()
    found = []
    for i in np.argsort(-boxes[:, 4], kind="stable"):
        if not boxes[i, 4] > request.score_threshold:
            continue
        mask = masks[i, :image_height, :image_width].astype(np.float64)
        mask = resized(mask, request.frame_height, request.frame_width)
        found.append((classes[i], boxes[i, 4], mask > 0.5))
    return found


if __name__ == "__main__":
    main(decode)
