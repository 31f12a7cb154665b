"""What the network ought to answer for an image: SOLOv2's assignment of instances to cells.

An instance goes to the grids whose range its size is in, there to the cells round its centre of mass.
"""

import dataclasses

import numpy as np

from training.network import GRIDS, MASK_STRIDE

# Smallest and largest sqrt(width * height) for each grid, as shares of the image's sqrt(H * W).
SIZE_RANGES = [(0.0, 0.12), (0.07, 0.22), (0.14, 0.42), (0.28, 0.75), (0.55, 10.0)]
CENTRE_SHARE = 0.2  # of width and height, round the centre: cells in it are positive
MIN_AREA = 32  # pixels; what is smaller is not to be found


@dataclasses.dataclass
class Targets:
    """Of one image; P positive cells over all grids."""

    categories: list[np.ndarray]  # for each grid int64 [S * S]: the class, -1: none
    cells: np.ndarray  # int64 [P]: counted over all grids, the finest first
    mask_of_cell: np.ndarray  # int64 [P]: which of the masks
    masks: np.ndarray  # float32 [M, H / 4, W / 4]: share of each sample that is the instance's
    semantic: np.ndarray  # int64 [H / 8, W / 8]: class of each place, -1: none


def coarse_mask(mask: np.ndarray) -> np.ndarray:
    """bool [H, W] to float32 [H / 4, W / 4]."""
    height, width = mask.shape
    blocks = mask.reshape(height // MASK_STRIDE, MASK_STRIDE, width // MASK_STRIDE, MASK_STRIDE)
    return blocks.mean((1, 3), dtype=np.float32)


def semantic_target(ids: np.ndarray, classes: dict[int, int]) -> np.ndarray:
    """ids [H, W] to the classes of every eighth pixel, from the fourth on; -1: none."""
    places = ids[4::8, 4::8].astype(np.int64)
    table = np.full(max([int(ids.max()), *classes]) + 1, -1, np.int64)
    table[list(classes)] = list(classes.values())
    return table[places]


def cells_of(low: float, high: float, centre: float, size: int) -> range:
    """Along one axis, where lengths are shares of the image's: the cells from `low` to `high`, yet
    none that is not next to that of the centre."""
    middle = min(int(centre * size), size - 1)
    first = max(0, int(low * size), middle - 1)
    last = min(size - 1, int(high * size), middle + 1)
    return range(min(first, middle), max(last, middle) + 1)


def make_targets(ids: np.ndarray, classes: dict[int, int]) -> Targets:
    """ids [H, W]: which instance each pixel shows; only those with a class count."""
    height, width = ids.shape
    categories = [np.full(size * size, -1, np.int64) for size in GRIDS]
    first_cells = np.cumsum([0] + [size * size for size in GRIDS])
    masks: list[np.ndarray] = []
    owners: dict[int, int] = {}
    # From large to small, so that where two claim a cell the smaller has it.
    areas = {
        i: int(n)
        for i, n in zip(*np.unique(ids, return_counts=True))
        if i in classes and n >= MIN_AREA
    }
    for instance in sorted(areas, key=lambda i: (-areas[i], i)):
        mask = ids == instance
        rows, columns = np.nonzero(mask)
        y, x = (rows.mean() + 0.5) / height, (columns.mean() + 0.5) / width
        tall = (rows.max() - rows.min() + 1) / height
        wide = (columns.max() - columns.min() + 1) / width
        masks.append(coarse_mask(mask))
        for grid, (size, (low, high)) in enumerate(zip(GRIDS, SIZE_RANGES)):
            if not low <= np.sqrt(tall * wide) < high:
                continue
            half_y, half_x = 0.5 * CENTRE_SHARE * tall, 0.5 * CENTRE_SHARE * wide
            for row in cells_of(y - half_y, y + half_y, y, size):
                for column in cells_of(x - half_x, x + half_x, x, size):
                    cell = row * size + column
                    categories[grid][cell] = classes[instance]
                    owners[int(first_cells[grid]) + cell] = len(masks) - 1
    coarse = (
        np.stack(masks)
        if masks
        else np.zeros((0, height // MASK_STRIDE, width // MASK_STRIDE), np.float32)
    )
    cells = sorted(owners)
    return Targets(
        categories,
        np.array(cells, np.int64),
        np.array([owners[cell] for cell in cells], np.int64),
        coarse,
        semantic_target(ids, classes),
    )
