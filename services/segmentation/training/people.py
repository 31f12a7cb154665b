"""Random people in a room: what scene files say of them."""

import math
import random

from training.furnished_room import FurnishedRoom, rounded

GESTURES = ["talk", "wave", "point", "phone", "idle"]


def make_person(room: FurnishedRoom, name: str, seconds: int) -> dict | None:
    """Somebody who sits, stands or walks, for the whole time; None where there is no place left."""
    chance = room.chance
    place = room.plan.free_point(chance, 0.3)
    if place is None:
        return None
    person = {
        "name": name,
        "height_m": round(chance.uniform(1.5, 1.95), 2),
        "look": chance.randint(1, 10**6),
        "start": {"at_m": rounded(*place), "yaw_deg": round(chance.uniform(-180, 180), 1)},
        "repeat": True,
    }
    manner = chance.random()
    if manner < 0.35 and room.seats:
        person["start"]["at_m"], person["actions"] = sit(room, seconds)
    elif manner < 0.7:
        person["actions"] = [standing(chance) for _ in range(4)]
        room.targets.append((*place, 1.1, 5.0))
    else:
        person["actions"] = walk(room)
        room.targets.append((*place, 1.1, 4.0))
    return person


def standing(chance: random.Random) -> dict:
    yaw = round(chance.uniform(-180, 180), 1)
    seconds = chance.randint(2, 6)
    return {"stand": {"for_s": seconds, "gesture": chance.choice(GESTURES), "yaw_deg": yaw}}


def sit(room: FurnishedRoom, seconds: int) -> tuple[list[float], list[dict]]:
    """Where to come from, and sitting on a seat that nobody else has."""
    seat = room.seats.pop(room.chance.randrange(len(room.seats)))
    x, y = next(each["at_m"] for each in room.objects if each["name"] == seat)
    start = nearest_free(room, x, y)
    gesture = room.chance.choice([*GESTURES, "type"])
    room.targets.append((x, y, 0.9, 5.0))
    return start, [{"sit": {"on": seat, "for_s": seconds, "gesture": gesture}}]


def nearest_free(room: FurnishedRoom, x: float, y: float) -> list[float]:
    """Of some free places the nearest to (x, y)."""
    places = [room.plan.free_point(room.chance, 0.25) for _ in range(20)]
    places = [place for place in places if place is not None]
    return rounded(*min(places, key=lambda place: math.dist(place, (x, y)), default=(x, y)))


def walk(room: FurnishedRoom) -> list[dict]:
    """Through some free places, then standing for a while."""
    chance = room.chance
    corners = [room.plan.free_point(chance, 0.3) for _ in range(chance.randint(2, 4))]
    path = [rounded(*corner) for corner in corners if corner is not None]
    speed = round(chance.uniform(0.3, 1.3), 2)
    room.targets.extend((*corner, 1.1, 1.5) for corner in path)
    way = [{"walk": {"path_m": path, "speed_mps": speed}}] if path else [standing(chance)]
    return [*way, standing(chance)]
