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

from training.furnished_room import FurnishedRoom, rounded
from training.people import make_person

PEOPLE = [0, 1, 1, 2, 2, 2, 3, 3, 4]  # how many there may be, the usual more often


def make_scene(seed: int, frames: int) -> dict:
    """What goes into the file."""
    chance = random.Random(seed)
    room = FurnishedRoom(chance)
    people = [make_person(room, f"person_{i}", frames) for i in range(chance.choice(PEOPLE))]
    if not room.targets:
        room.targets.append((room.plan.width / 2, room.plan.depth / 2, 0.8, 1.0))
    return {
        "description": "a random room to train a network with",
        "duration_s": frames,
        "seed": seed,
        "rooms": [room.room],
        "objects": room.objects,
        "people": [person for person in people if person is not None],
        "doors": room.doors,
        "windows": room.windows,
        "camera": {"waypoints": [waypoint(room, second) for second in range(frames + 1)]},
        "sensor": sensor(chance),
    }


def waypoint(room: FurnishedRoom, second: int) -> dict:
    """A place that looks at something or somebody from near or far."""
    chance = room.chance
    x, y, z, _ = chance.choices(room.targets, [target[3] for target in room.targets])[0]
    x, y, z = x + chance.gauss(0, 0.35), y + chance.gauss(0, 0.35), z + chance.gauss(0, 0.3)
    place = view_point(room, x, y)
    height = chance.choice([chance.uniform(0.35, 2.1), chance.gauss(1.3, 0.2)])
    return {
        "at_s": second,
        "position_m": rounded(*place, height),
        "look_at_m": rounded(x, y, min(z, 2.0)),
        "roll_deg": round(chance.gauss(0, 4), 1),
    }


def view_point(room: FurnishedRoom, x: float, y: float) -> tuple[float, float]:
    """A free place, not too near to what is looked at, preferably away from it."""
    places = [room.plan.free_point(room.chance, 0.3) for _ in range(8)]
    places = [place for place in places if place is not None and math.dist(place, (x, y)) > 0.9]
    if places:
        return max(places[:2], key=lambda place: math.dist(place, (x, y)))
    corner, opposite = (0.3, 0.3), (room.plan.width - 0.3, room.plan.depth - 0.3)
    return corner if math.dist(corner, (x, y)) > 0.9 else opposite


def sensor(chance: random.Random) -> dict:
    """A camera of 320 x 240 pixels, 56 to 72 degrees wide; depth is not needed, so not blurred."""
    focal = round(chance.uniform(220, 300), 1)
    return {
        "width": 320,
        "height": 240,
        "rate_hz": 1,
        "fx": focal,
        "fy": focal,
        "cx": 159.5,
        "cy": 119.5,
        "exposure_ms": round(10 ** chance.uniform(-0.7, 0.6), 2),
        "depth_noise": False,
        "depth_quantisation": False,
        "depth_holes": False,
    }


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
        scene = make_scene(seed, arguments.frames)
        text = yaml.safe_dump(scene, sort_keys=False, default_flow_style=None, width=120)
        (arguments.out / f"scene_{seed:05}.yaml").write_text(text)


if __name__ == "__main__":
    main()
