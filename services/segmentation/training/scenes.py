"""Writes random scenes for `tsgctl simulate`: python3 -m training.scenes --out DIR --count N --seed S.

Each is one furnished room with people in it. Time runs in steps of a second, one for each frame; the
camera jumps to another place from one to the next, so that all frames of a scene differ. The same
arguments give the same files.
"""

import argparse
import math
import pathlib
import random

import yaml

from training.floor_plan import HALF_SIZE_M, FloorPlan, bounds, turned

FLOORS = [
    "carpet",
    "carpet_tiles",
    "concrete",
    "laminate",
    "linoleum",
    "parquet",
    "planks",
    "tiles",
]
WALLS = [
    "brick",
    "concrete",
    "plaster",
    "plaster",
    "plaster",
    "tiles",
    "wallpaper",
    "wallpaper",
    "wood_panels",
]
GESTURES = ["talk", "wave", "point", "phone", "idle"]
ON_DESK_BACK = ["monitor", "monitor", "monitor", "laptop", "desk_lamp", "potted_plant", "book_row"]
ON_DESK_FRONT = [
    "keyboard",
    "laptop",
    "mouse",
    "cup",
    "book_stack",
    "newspaper",
    "bottle",
    "pen_pot",
]
ON_TABLE = ["cup", "cup", "bottle", "book_stack", "vase", "potted_plant", "laptop", "newspaper"]
ON_CABINET = [
    "potted_plant",
    "book_row",
    "printer",
    "microwave",
    "vase",
    "monitor",
    "cardboard_box",
    "cup",
]
AT_WALL = [
    "bookshelf",
    "bookshelf",
    "cabinet",
    "cabinet",
    "couch",
    "fridge",
    "sink_unit",
    "drawer_unit",
    "big_plant",
    "water_cooler",
]
ON_WALL = {  # height of the bottom, metres
    "poster": (1.0, 1.6),
    "whiteboard": (0.85, 1.0),
    "wall_tv": (0.9, 1.4),
    "clock": (1.8, 2.1),
    "notice_board": (1.1, 1.3),
    "wall_shelf": (1.2, 1.6),
}
ON_FLOOR = [
    "backpack",
    "suitcase",
    "cardboard_box",
    "cart",
    "big_plant",
    "potted_plant",
    "waste_bin",
    "coat_rack",
    "floor_lamp",
    "wooden_chair",
    "wooden_chair",
    "office_chair",
    "office_chair",
    "armchair",
]
TOP_M = {
    "desk": 0.74,
    "dining_table": 0.75,
    "round_table": 0.74,
    "coffee_table": 0.43,
    "cabinet": 0.9,
}


def rounded(*values: float) -> list[float]:
    return [round(value, 3) for value in values]


class RoomWriter:
    """Fills one scene, step by step; `scene` is what goes into the file."""

    def __init__(self, seed: int, frames: int):
        self.chance = random.Random(seed)
        self.frames = frames
        width, depth = (self.chance.uniform(3.4, 6.6) for _ in range(2))
        self.plan = FloorPlan(width, depth)
        self.seats: list[str] = []
        self.targets: list[tuple[float, float, float, float]] = []  # x, y, z and weight
        self.scene = {
            "description": "a random room to train a network with",
            "duration_s": frames,
            "seed": seed,
            "rooms": [self.room(width, depth)],
            "objects": [],
            "people": [],
        }

    def room(self, width: float, depth: float) -> dict:
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
        name = f"{kind}_{len(self.scene['objects'])}"
        self.scene["objects"].append({"type": kind, "name": name, **keys})
        return name

    def stand(
        self, kind: str, x: float, y: float, yaw: float, height_of_interest: float = 0.6
    ) -> str | None:
        """Puts it on the floor if there is room; its name."""
        if not self.plan.take(bounds(kind, x, y, yaw)):
            return None
        scale = round(self.chance.uniform(0.92, 1.08), 3)
        name = self.add(kind, at_m=rounded(x, y), yaw_deg=round(yaw % 360, 1), scale=scale)
        if kind in ("office_chair", "wooden_chair", "armchair", "couch"):
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
        self.scene["doors"] = [{"at_m": at, "open_deg": chance.choice([0, 0, 30, 80])}]
        self.scene["windows"] = [
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
        for side_x, side_y in [
            (0.8, -0.4),
            (0.8, 0.4),
            (-0.8, -0.4),
            (-0.8, 0.4),
            (0, 1.15),
            (0, -1.15),
        ]:
            if chance.random() < 0.6:
                dx, dy = turned(side_x + chance.gauss(0, 0.06), side_y, yaw)
                facing = (
                    math.degrees(math.atan2(-dy, -dx))
                    if side_x == 0
                    else yaw + (180 if side_x > 0 else 0)
                )
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
            kind = chance.choice(AT_WALL)
            x, y, yaw = self.plan.against_wall(
                chance, HALF_SIZE_M[kind][0] + 0.08, HALF_SIZE_M[kind][1] + 0.1
            )
            name = self.stand(kind, x, y, yaw, 0.9)
            if name is not None and kind == "cabinet":
                self.fill_top(name, kind, ON_CABINET, chance.randint(0, 2), (-0.3, 0.3))
        for _ in range(chance.randint(2, 6)):
            kind = chance.choice(ON_FLOOR)
            place = self.plan.free_point(chance, max(HALF_SIZE_M[kind]))
            if place is not None:
                self.stand(kind, *place, chance.uniform(-180, 180))
        for _ in range(chance.randint(1, 6)):
            kind = chance.choice(sorted(ON_WALL) + ["poster", "wall_tv"])
            x, y, yaw = self.plan.against_wall(chance, 0.07, 0.7)
            self.add(
                kind,
                at_m=rounded(x, y),
                yaw_deg=yaw,
                height_m=round(chance.uniform(*ON_WALL[kind]), 2),
            )

    def person(self, index: int) -> None:
        """Somebody who sits, stands or walks, for the whole time."""
        chance = self.chance
        place = self.plan.free_point(chance, 0.3)
        if place is None:
            return
        person = {
            "name": f"person_{index}",
            "height_m": round(chance.uniform(1.5, 1.95), 2),
            "look": chance.randint(1, 10**6),
            "start": {"at_m": rounded(*place), "yaw_deg": round(chance.uniform(-180, 180), 1)},
            "repeat": True,
        }
        manner = chance.random()
        if manner < 0.35 and self.seats:
            self.sit(person)
        elif manner < 0.7:
            person["actions"] = [self.standing() for _ in range(4)]
            self.targets.append((*place, 1.1, 5.0))
        else:
            self.walk(person)
            self.targets.append((*place, 1.1, 4.0))
        self.scene["people"].append(person)

    def standing(self) -> dict:
        chance = self.chance
        yaw = round(chance.uniform(-180, 180), 1)
        return {
            "stand": {
                "for_s": chance.randint(2, 6),
                "gesture": chance.choice(GESTURES),
                "yaw_deg": yaw,
            }
        }

    def sit(self, person: dict) -> None:
        """On a seat of which it is the only one, from the beginning on."""
        seat = self.seats.pop(self.chance.randrange(len(self.seats)))
        x, y = next(o["at_m"] for o in self.scene["objects"] if o["name"] == seat)
        person["start"]["at_m"] = self.nearest_free(x, y)
        gestures = [*GESTURES, "type"]
        person["actions"] = [
            {"sit": {"on": seat, "for_s": self.frames, "gesture": self.chance.choice(gestures)}}
        ]
        self.targets.append((x, y, 0.9, 5.0))

    def nearest_free(self, x: float, y: float) -> list[float]:
        """Of some free places the nearest to (x, y)."""
        places = [self.plan.free_point(self.chance, 0.25) for _ in range(20)]
        places = [place for place in places if place is not None]
        return rounded(*min(places, key=lambda place: math.dist(place, (x, y)), default=(x, y)))

    def walk(self, person: dict) -> None:
        chance = self.chance
        corners = [self.plan.free_point(chance, 0.3) for _ in range(chance.randint(2, 4))]
        path = [rounded(*corner) for corner in corners if corner is not None]
        speed = round(chance.uniform(0.3, 1.3), 2)
        person["actions"] = (
            [{"walk": {"path_m": path, "speed_mps": speed}}] if path else [self.standing()]
        )
        person["actions"].append(self.standing())
        for corner in path:
            self.targets.append((*corner, 1.1, 1.5))

    def camera(self) -> None:
        """A place for each second, looking at something or somebody from near or far."""
        chance = self.chance
        waypoints = []
        for second in range(self.frames + 1):
            x, y, z, _ = chance.choices(self.targets, [target[3] for target in self.targets])[0]
            x, y, z = x + chance.gauss(0, 0.35), y + chance.gauss(0, 0.35), z + chance.gauss(0, 0.3)
            place = self.view_point(x, y)
            height = chance.choice([chance.uniform(0.35, 2.1), chance.gauss(1.3, 0.2)])
            waypoints.append(
                {
                    "at_s": second,
                    "position_m": rounded(*place, height),
                    "look_at_m": rounded(x, y, min(z, 2.0)),
                    "roll_deg": round(chance.gauss(0, 4), 1),
                }
            )
        self.scene["camera"] = {"waypoints": waypoints}

    def view_point(self, x: float, y: float) -> tuple[float, float]:
        """A free place, not too near to what is looked at, preferably away from it."""
        chance = self.chance
        places = [self.plan.free_point(chance, 0.3) for _ in range(8)]
        places = [place for place in places if place is not None and math.dist(place, (x, y)) > 0.9]
        if not places:
            return (
                (0.3, 0.3)
                if math.dist((0.3, 0.3), (x, y)) > 0.9
                else (self.plan.width - 0.3, self.plan.depth - 0.3)
            )
        return max(places[:2], key=lambda place: math.dist(place, (x, y)))

    def sensor(self) -> None:
        """A camera of 320 x 240 pixels, 56 to 72 degrees wide; depth is not needed, so not blurred."""
        chance = self.chance
        focal = round(chance.uniform(220, 300), 1)
        depth_parts = ["depth_noise", "depth_quantisation", "depth_holes"]
        self.scene["sensor"] = {
            "width": 320,
            "height": 240,
            "rate_hz": 1,
            "fx": focal,
            "fy": focal,
            "cx": 159.5,
            "cy": 119.5,
            "exposure_ms": round(10 ** chance.uniform(-0.7, 0.6), 2),
            **{part: False for part in depth_parts},
        }

    def write(self, path: pathlib.Path) -> None:
        path.write_text(
            yaml.safe_dump(self.scene, sort_keys=False, default_flow_style=None, width=120)
        )


def make_scene(seed: int, frames: int) -> RoomWriter:
    writer = RoomWriter(seed, frames)
    writer.openings()
    writer.furniture()
    for index in range(writer.chance.choice([0, 1, 1, 2, 2, 2, 3, 3, 4])):
        writer.person(index)
    if not writer.targets:
        writer.targets.append((writer.plan.width / 2, writer.plan.depth / 2, 0.8, 1.0))
    writer.camera()
    writer.sensor()
    return writer


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--out", type=pathlib.Path, required=True, help="new folder for scene_SEED.yaml files"
    )
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--seed", type=int, required=True, help="of the first; the others follow")
    parser.add_argument("--frames", type=int, default=24, help="of each scene")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        make_scene(seed, arguments.frames).write(arguments.out / f"scene_{seed:05}.yaml")


if __name__ == "__main__":
    main()
