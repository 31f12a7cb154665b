"""A room with random furniture."""

import math
import random

from training.floor_plan import HALF_SIZE_M, FloorPlan, bounds, turned

FLOORS = "carpet carpet_tiles concrete laminate linoleum parquet planks tiles".split()
WALLS = "brick concrete plaster plaster plaster tiles wallpaper wallpaper wood_panels".split()
ON_DESK_BACK = "monitor monitor monitor laptop desk_lamp potted_plant book_row".split()
ON_DESK_FRONT = "keyboard laptop mouse cup book_stack newspaper bottle pen_pot".split()
ON_TABLE = "cup cup bottle book_stack vase potted_plant laptop newspaper".split()
ON_CABINET = "potted_plant book_row printer microwave vase monitor cardboard_box cup".split()
AT_WALL = (
    "bookshelf bookshelf cabinet cabinet couch fridge sink_unit drawer_unit big_plant water_cooler"
).split()
ON_FLOOR = (
    "backpack suitcase cardboard_box cart big_plant potted_plant waste_bin coat_rack floor_lamp "
    "wooden_chair wooden_chair office_chair office_chair armchair"
).split()
ON_WALL = {  # height of the bottom, metres
    "poster": (1.0, 1.6),
    "whiteboard": (0.85, 1.0),
    "wall_tv": (0.9, 1.4),
    "clock": (1.8, 2.1),
    "notice_board": (1.1, 1.3),
    "wall_shelf": (1.2, 1.6),
}
SEATS_AT_TABLE = [(0.8, -0.4), (0.8, 0.4), (-0.8, -0.4), (-0.8, 0.4), (0, 1.15), (0, -1.15)]
SEATS = ("office_chair", "wooden_chair", "armchair", "couch")


def rounded(*values: float) -> list[float]:
    return [round(value, 3) for value in values]


class FurnishedRoom:
    """What scene files say of a room, its doors, windows and objects."""

    def __init__(self, chance: random.Random):
        self.chance = chance
        width, depth = (chance.uniform(3.4, 6.6) for _ in range(2))
        self.plan = FloorPlan(width, depth)
        self.seats: list[str] = []  # names of those that nobody sits on
        self.targets: list[tuple[float, float, float, float]] = []  # to look at: x, y, z, weight
        self.room = self.surfaces(width, depth)
        self.doors: list[dict] = []
        self.windows: list[dict] = []
        self.objects: list[dict] = []
        self.openings()
        self.furniture()

    def surfaces(self, width: float, depth: float) -> dict:
        chance = self.chance
        room = {
            "name": "room",
            "min_m": [0, 0],
            "max_m": rounded(width, depth),
            "height_m": round(chance.uniform(2.4, 3.2), 2),
            "floor": chance.choice(FLOORS),
            "walls": chance.choice(WALLS),
            "lamps": chance.randint(2, 6),
            "brightness": round(chance.uniform(0.5, 1.6), 2),
        }
        if chance.random() < 0.6:
            grey = chance.uniform(0.35, 0.95)
            room["wall_colour_rgb"] = rounded(
                *(min(1.0, max(0.1, grey + chance.gauss(0, 0.08))) for _ in range(3))
            )
        return room

    def add(self, kind: str, **keys) -> str:
        """Adds an object; its name."""
        name = f"{kind}_{len(self.objects)}"
        self.objects.append({"type": kind, "name": name, **keys})
        return name

    def stand(
        self, kind: str, x: float, y: float, yaw: float, height_of_interest: float = 0.6
    ) -> str | None:
        """Puts it on the floor if there is room; its name."""
        if not self.plan.take(bounds(kind, x, y, yaw)):
            return None
        scale = round(self.chance.uniform(0.92, 1.08), 3)
        name = self.add(kind, at_m=rounded(x, y), yaw_deg=round(yaw % 360, 1), scale=scale)
        if kind in SEATS:
            self.seats.append(name)
        self.targets.append((x, y, height_of_interest, 1.0))
        return name

    def openings(self) -> None:
        chance, width, depth = self.chance, self.plan.width, self.plan.depth
        walls = {
            "left": lambda s: (0, s * depth),
            "right": lambda s: (width, s * depth),
            "near": lambda s: (s * width, 0),
            "far": lambda s: (s * width, depth),
        }
        sides = chance.sample(sorted(walls), 4)
        at = rounded(*walls[sides[0]](chance.uniform(0.3, 0.7)))
        self.doors = [{"at_m": at, "open_deg": chance.choice([0, 0, 30, 80])}]
        self.windows = [
            {
                "at_m": rounded(*walls[side](chance.uniform(0.35, 0.65))),
                "width_m": round(chance.uniform(1.0, 1.8), 2),
            }
            for side in sides[1 : 1 + chance.choice([0, 1, 1, 2])]
        ]

    def fill_top(
        self, table: str, kind: str, things: list[str], count: int, depth_share=(-0.65, 0.65)
    ) -> None:
        """Puts things on a table, next to each other along it, each turned at will."""
        chance = self.chance
        half_x, half_y = (0.8 * half for half in HALF_SIZE_M[kind])
        for i in range(count):
            along = half_y * (2 * (i + chance.uniform(0.2, 0.8)) / count - 1)
            across = half_x * chance.uniform(*depth_share)
            self.add(
                chance.choice(things),
                on=table,
                at_m=rounded(across, along),
                yaw_deg=round(chance.gauss(0, 25), 1),
            )

    def desk(self) -> None:
        chance = self.chance
        place = self.plan.free_point(chance, 0.6)
        if place is None:
            return
        yaw = chance.choice([0, 90, 180, 270]) + chance.gauss(0, 4)
        x, y = place
        desk = self.stand("desk", x, y, yaw, 0.85)
        if desk is None:
            return
        self.fill_top(desk, "desk", ON_DESK_BACK, chance.randint(1, 3), (-0.6, -0.3))
        self.fill_top(desk, "desk", ON_DESK_FRONT, chance.randint(1, 4), (0.3, 0.75))
        side_x, side_y = turned(chance.uniform(0.75, 1.0), chance.gauss(0, 0.15), yaw)
        self.stand(
            chance.choice(["office_chair", "office_chair", "wooden_chair"]),
            x + side_x,
            y + side_y,
            yaw + 180 + chance.gauss(0, 35),
        )

    def dining(self) -> None:
        chance = self.chance
        kind = chance.choice(["dining_table", "round_table"])
        place = self.plan.free_point(chance, 0.7)
        if place is None:
            return
        x, y = place
        yaw = chance.choice([0, 90]) + chance.gauss(0, 5)
        table = self.stand(kind, x, y, yaw, 0.75)
        if table is None:
            return
        self.fill_top(table, kind, ON_TABLE, chance.randint(1, 4))
        chair = chance.choice(["wooden_chair", "wooden_chair", "office_chair"])
        for side_x, side_y in SEATS_AT_TABLE:
            if chance.random() < 0.6:
                dx, dy = turned(side_x + chance.gauss(0, 0.06), side_y, yaw)
                at_end = math.degrees(math.atan2(-dy, -dx))
                at_side = yaw + (180 if side_x > 0 else 0)
                facing = at_end if side_x == 0 else at_side
                self.stand(chair, x + dx, y + dy, facing + chance.gauss(0, 12))

    def lounge(self) -> None:
        chance = self.chance
        x, y, yaw = self.plan.against_wall(chance, 0.58, 1.1)
        if self.stand("couch", x, y, yaw, 0.5) is None:
            return
        dx, dy = turned(1.05, 0, yaw)
        table = self.stand("coffee_table", x + dx, y + dy, yaw, 0.5)
        if table is not None:
            self.fill_top(table, "coffee_table", ON_TABLE, chance.randint(1, 3))
        dx, dy = turned(1.9, chance.choice([-0.5, 0.5]), yaw)
        self.stand("armchair", x + dx, y + dy, yaw + 180 + chance.gauss(0, 25))

    def furniture(self) -> None:
        chance = self.chance
        for _ in range(chance.randint(2, 4)):
            chance.choice([self.desk, self.desk, self.dining, self.lounge])()
        for _ in range(chance.randint(1, 4)):
            self.at_wall(chance.choice(AT_WALL))
        for _ in range(chance.randint(2, 6)):
            kind = chance.choice(ON_FLOOR)
            place = self.plan.free_point(chance, max(HALF_SIZE_M[kind]))
            if place is not None:
                self.stand(kind, *place, chance.uniform(-180, 180))
        for _ in range(chance.randint(1, 6)):
            kind = chance.choice(sorted(ON_WALL) + ["poster", "wall_tv"])
            x, y, yaw = self.plan.against_wall(chance, 0.07, 0.7)
            height = round(chance.uniform(*ON_WALL[kind]), 2)
            self.add(kind, at_m=rounded(x, y), yaw_deg=yaw, height_m=height)

    def at_wall(self, kind: str) -> None:
        half_x, half_y = HALF_SIZE_M[kind]
        x, y, yaw = self.plan.against_wall(self.chance, half_x + 0.08, half_y + 0.1)
        name = self.stand(kind, x, y, yaw, 0.9)
        if name is not None and kind == "cabinet":
            self.fill_top(name, kind, ON_CABINET, self.chance.randint(0, 2), (-0.3, 0.3))
