"""What is free and what is taken on the floor of a rectangular room."""

import math
import random

# Half of depth (along its front, x) and width (y) of each type, metres, a little generous.
HALF_SIZE_M = {
    "armchair": (0.45, 0.45),
    "backpack": (0.2, 0.2),
    "big_plant": (0.35, 0.35),
    "bookshelf": (0.17, 0.46),
    "cabinet": (0.24, 0.46),
    "cardboard_box": (0.22, 0.27),
    "cart": (0.35, 0.5),
    "coat_rack": (0.28, 0.28),
    "coffee_table": (0.3, 0.58),
    "couch": (0.48, 1.05),
    "desk": (0.4, 0.85),
    "dining_table": (0.47, 0.85),
    "drawer_unit": (0.3, 0.22),
    "floor_lamp": (0.22, 0.22),
    "fridge": (0.34, 0.32),
    "office_chair": (0.33, 0.33),
    "potted_plant": (0.17, 0.17),
    "round_table": (0.55, 0.55),
    "sink_unit": (0.31, 0.62),
    "suitcase": (0.17, 0.25),
    "waste_bin": (0.16, 0.16),
    "water_cooler": (0.18, 0.18),
    "wooden_chair": (0.26, 0.25),
}

Rectangle = tuple[float, float, float, float]  # min x, min y, max x, max y


def turned(x: float, y: float, yaw_deg: float) -> tuple[float, float]:
    """The vector (x, y) turned counter-clockwise."""
    c, s = math.cos(math.radians(yaw_deg)), math.sin(math.radians(yaw_deg))
    return c * x - s * y, s * x + c * y


def bounds(kind: str, x: float, y: float, yaw_deg: float, margin: float = 0.0) -> Rectangle:
    """The rectangle along the walls round an object of this type."""
    half_x, half_y = HALF_SIZE_M[kind]
    c, s = abs(math.cos(math.radians(yaw_deg))), abs(math.sin(math.radians(yaw_deg)))
    wide, deep = c * half_x + s * half_y + margin, s * half_x + c * half_y + margin
    return x - wide, y - deep, x + wide, y + deep


class FloorPlan:
    """A room from (0, 0) to (width, depth), metres, and the rectangles taken in it."""

    WALL_M = 0.07

    def __init__(self, width: float, depth: float):
        self.width = width
        self.depth = depth
        self.taken: list[Rectangle] = []

    def is_inside(self, area: Rectangle) -> bool:
        x0, y0, x1, y1 = area
        wall = self.WALL_M
        return x0 >= wall and y0 >= wall and x1 <= self.width - wall and y1 <= self.depth - wall

    def is_free(self, area: Rectangle) -> bool:
        x0, y0, x1, y1 = area
        return self.is_inside(area) and not any(
            x0 < right and left < x1 and y0 < top and bottom < y1
            for left, bottom, right, top in self.taken
        )

    def take(self, area: Rectangle) -> bool:
        """Takes it if it is free; says whether it was."""
        if not self.is_free(area):
            return False
        self.taken.append(area)
        return True

    def free_point(self, chance: random.Random, clearance: float) -> tuple[float, float] | None:
        """A place with nothing within `clearance` of it, or None where none was met."""
        for _ in range(60):
            x = chance.uniform(clearance, self.width - clearance)
            y = chance.uniform(clearance, self.depth - clearance)
            if self.is_free((x - clearance, y - clearance, x + clearance, y + clearance)):
                return x, y
        return None

    def against_wall(self, chance: random.Random, off: float, along: float):
        """A pose (x, y, yaw) with its back at a wall, `off` from it, not nearer than `along` to
        the wall's ends."""
        wall = chance.randrange(4)
        length = self.width if wall in (1, 3) else self.depth
        at = chance.uniform(along, max(along, length - along))
        return {
            0: (off, at, 0.0),
            1: (at, off, 90.0),
            2: (self.width - off, at, 180.0),
            3: (at, self.depth - off, -90.0),
        }[wall]
