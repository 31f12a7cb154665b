"""How good instances are, against the truth.

Mask AP as COCO's (Lin et al., 2014; pycocotools): for each class, predictions over all images by
falling score each take the unmatched instance of the truth with which their IoU is best, if it is at
least a threshold; precision, made monotone, is averaged over 101 recalls, and the outcome over
thresholds 0.50, 0.55 .. 0.95. What is too small in the truth is left out of account, as are
predictions that take it, and unmatched predictions that are as small.
"""

import dataclasses

import numpy as np

THRESHOLDS = np.linspace(0.5, 0.95, 10)
RECALLS = np.linspace(0, 1, 101)


@dataclasses.dataclass
class Instances:
    """Of one image; masks are bool [N, H, W]."""

    masks: np.ndarray
    classes: np.ndarray  # int [N]
    scores: np.ndarray  # float [N]; of the truth: unused

    def of_class(self, wanted: int) -> "Instances":
        chosen = self.classes == wanted
        return Instances(self.masks[chosen], self.classes[chosen], self.scores[chosen])


def overlaps(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """IoU of each of N masks with each of M: [N, M]."""
    pixels = found.shape[1] * found.shape[2]  # not -1, which no mask at all would leave open
    a, b = (masks.reshape(len(masks), pixels).astype(np.float32) for masks in (found, truth))
    shared = a @ b.T
    union = a.sum(1)[:, None] + b.sum(1)[None, :] - shared
    return shared / np.maximum(union, 1)


@dataclasses.dataclass
class Matches:
    """Of one class in one image: for each prediction its score and what became of it."""

    scores: np.ndarray  # [N]
    right: np.ndarray  # bool [thresholds, N]
    ignored: np.ndarray  # bool [thresholds, N]
    wanted: int  # how many there are to be found


def match(found: Instances, truth: Instances, min_area: int) -> Matches:
    """`found` and `truth` of one class."""
    order = np.argsort(-found.scores, kind="stable")
    iou = overlaps(found.masks[order], truth.masks)
    is_small = truth.masks.sum((1, 2)) < min_area
    right = np.zeros((len(THRESHOLDS), len(order)), bool)
    ignored = np.zeros_like(right)
    for t, threshold in enumerate(THRESHOLDS):
        free = np.ones(len(is_small), bool)
        for i in range(len(order)):
            # What counts first: only where none of these fits is it one of the small.
            for candidates in (free & ~is_small, free & is_small):
                fits = np.where(candidates, iou[i], 0.0)
                if len(fits) and fits.max() >= threshold:
                    best = int(fits.argmax())
                    free[best] = False
                    right[t, i] = not is_small[best]
                    ignored[t, i] = is_small[best]
                    break
    unmatched_small = (found.masks[order].sum((1, 2)) < min_area)[None, :] & ~right
    return Matches(found.scores[order], right, ignored | unmatched_small, int((~is_small).sum()))


def average_precision(matches: list[Matches]) -> np.ndarray:
    """Of one class over all images, by threshold; NaN where there was nothing to be found."""
    wanted = sum(each.wanted for each in matches)
    if wanted == 0:
        return np.full(len(THRESHOLDS), np.nan)
    scores = np.concatenate([each.scores for each in matches])
    order = np.argsort(-scores, kind="stable")
    right = np.concatenate([each.right for each in matches], 1)[:, order]
    ignored = np.concatenate([each.ignored for each in matches], 1)[:, order]
    return np.array([_precision(r[~i], wanted) for r, i in zip(right, ignored)])


def _precision(right: np.ndarray, wanted: int) -> float:
    """Mean precision over RECALLS, for predictions by falling score."""
    hits = np.cumsum(right)
    recall = hits / wanted
    precision = hits / np.arange(1, len(right) + 1)
    precision = np.maximum.accumulate(precision[::-1])[::-1]
    places = np.searchsorted(recall, RECALLS, side="left")
    return float(np.append(precision, 0.0)[np.minimum(places, len(precision))].mean())


def best_overlaps(found: Instances, truth: Instances, min_area: int) -> np.ndarray:
    """For each instance of the truth that is large enough, the best IoU that a prediction of its
    class has with it, 0 where there is none. `found` and `truth` of one class."""
    large = truth.masks[truth.masks.sum((1, 2)) >= min_area]
    if len(found.masks) == 0:
        return np.zeros(len(large))
    return overlaps(found.masks, large).max(0, initial=0.0)
