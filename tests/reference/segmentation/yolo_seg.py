"""YOLOv8/11-seg after its convolutions, written down plainly: yolo_seg.py FOLDER (see tensors.py).

Tensors: output0 [1, 4 + C + M, A], output1 [1, M, H/4, W/4].
"""

import numpy as np

from tensors import main, sigmoid


def overlap(box, boxes):
    """Intersection over union of one box with each of many; (left, top, right, bottom)."""
    width = np.minimum(box[2], boxes[:, 2]) - np.maximum(box[0], boxes[:, 0])
    height = np.minimum(box[3], boxes[:, 3]) - np.maximum(box[1], boxes[:, 1])
    shared = np.clip(width, 0, None) * np.clip(height, 0, None)
    area = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    return shared / ((box[2] - box[0]) * (box[3] - box[1]) + area - shared)


def without_duplicates(boxes, classes, max_iou):
    """Indices of those that no better one of their class covers; by falling score."""
    kept = []
    for i in range(len(boxes)):
        better = [k for k in kept if classes[k] == classes[i]]
        if not better or overlap(boxes[i], boxes[better]).max() <= max_iou:
            kept.append(i)
    return kept


def sampled(image, rows, columns):
    """The image between its samples, bilinear, edges going on."""
    def weights(position, length):
        position = np.clip(position, 0, length - 1)
        first = np.floor(position).astype(int)
        return first, np.minimum(first + 1, length - 1), position - first

    first, second, weight = weights(rows, image.shape[0])
    image = image[first] * (1 - weight)[:, None] + image[second] * weight[:, None]
    first, second, weight = weights(columns, image.shape[1])
    return image[:, first] * (1 - weight) + image[:, second] * weight


def decode(request):
    anchors, prototypes = (tensor[0].astype(np.float64) for tensor in request.tensors)
    anchors = anchors.T
    scores = anchors[:, 4 : 4 + request.classes]
    classes, scores = scores.argmax(1), scores.max(1)
    x, y, width, height = anchors[:, :4].T
    keep = (scores > request.score_threshold) & (width > 0) & (height > 0)
    keep = np.nonzero(keep)[0]
    keep = keep[np.argsort(-scores[keep], kind="stable")]
    boxes = np.stack([x - width / 2, y - height / 2, x + width / 2, y + height / 2], 1)
    keep = keep[without_duplicates(boxes[keep], classes[keep], request.nms_iou)]

    image_height, image_width = request.image_size()
    left = (request.input_width - image_width) // 2
    top = (request.input_height - image_height) // 2
    scale_x = image_width / request.frame_width
    scale_y = image_height / request.frame_height
    columns = np.arange(request.frame_width)
    rows = np.arange(request.frame_height)
    found = []
    for i in keep:
        logits = np.tensordot(anchors[i, 4 + request.classes :], prototypes, 1)
        mask = sampled(
            sigmoid(logits),
            ((rows + 0.5) * scale_y + top) / 4 - 0.5,
            ((columns + 0.5) * scale_x + left) / 4 - 0.5,
        )
        box = np.array([boxes[i, 0] - left, boxes[i, 1] - top, boxes[i, 2] - left, boxes[i, 3] - top])
        box /= [scale_x, scale_y, scale_x, scale_y]
        box[0::2] = np.clip(box[0::2], 0, request.frame_width)
        box[1::2] = np.clip(box[1::2], 0, request.frame_height)
        # Whole pixels, both ends included; a box beside the frame has none.
        inside = (
            (columns >= np.floor(box[0])) & (columns <= np.floor(box[2])) & (box[2] > box[0])
        ) & ((rows >= np.floor(box[1])) & (rows <= np.floor(box[3])) & (box[3] > box[1]))[:, None]
        found.append((classes[i], scores[i], (mask > 0.5) & inside))
    return found


if __name__ == "__main__":
    main(decode)
