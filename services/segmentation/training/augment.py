"""Makes each frame look different each time it is shown."""

import cv2
import numpy as np

from training.dataset import Frame

MEAN = np.array([123.675, 116.28, 103.53], np.float32)  # RGB, what SOLOv2's decoder subtracts
DEVIATION = np.array([58.395, 57.12, 57.375], np.float32)


def normalised(image: np.ndarray) -> np.ndarray:
    """uint8 [H, W, 3] to what the network is shown, float32 [H, W, 3]."""
    return (image.astype(np.float32) - MEAN) / DEVIATION


def fitted(frame: Frame, height: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Image and ids as at run time: scaled into the size at the top left, 0 beside it."""
    scale = min(height / frame.ids.shape[0], width / frame.ids.shape[1])
    return window(frame, scale, (0, 0), (height, width), normalised)


def augmented(
    frame: Frame, height: int, width: int, chance: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Normalised image [H, W, 3] and ids [H, W]: bigger or smaller, a part of it, mirrored, in other
    colours."""
    fit = min(height / frame.ids.shape[0], width / frame.ids.shape[1])
    scale = fit * chance.choice(
        [chance.uniform(0.75, 1.0), 1.0, chance.uniform(1.0, 1.6)], p=[0.35, 0.2, 0.45]
    )
    room = np.maximum(0, np.array(frame.ids.shape) * scale - (height, width))
    corner = tuple((chance.random(2) * room).astype(int))
    if chance.random() < 0.5:
        frame = Frame(frame.image[:, ::-1], frame.ids[:, ::-1], frame.classes)
    return window(
        frame, scale, corner, (height, width), lambda pixels: normalised(recoloured(pixels, chance))
    )


def window(frame: Frame, scale: float, corner, size, finish) -> tuple[np.ndarray, np.ndarray]:
    """Of the scaled frame what begins at `corner` (row, column); what is beyond the frame is 0.
    `finish` makes float32 pixels of uint8 ones."""
    shape = (round(frame.ids.shape[1] * scale), round(frame.ids.shape[0] * scale))
    rows, columns = slice(corner[0], corner[0] + size[0]), slice(corner[1], corner[1] + size[1])
    kind = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    scaled = cv2.resize(np.ascontiguousarray(frame.image), shape, interpolation=kind)
    pixels = finish(np.ascontiguousarray(scaled[rows, columns]))
    inside = cv2.resize(np.ascontiguousarray(frame.ids), shape, interpolation=cv2.INTER_NEAREST)[
        rows, columns
    ]
    image = np.zeros((*size, 3), np.float32)
    ids = np.zeros(size, frame.ids.dtype)
    image[: pixels.shape[0], : pixels.shape[1]] = pixels
    ids[: inside.shape[0], : inside.shape[1]] = inside
    return image, ids


def recoloured(image: np.ndarray, chance: np.random.Generator) -> np.ndarray:
    """Other exposure, contrast, white balance, saturation and hue; now and then blurred, grainy or
    grey. uint8 [H, W, 3] in and out."""
    pixels = image
    if chance.random() < 0.5:
        hsv = cv2.cvtColor(pixels, cv2.COLOR_RGB2HSV).astype(np.int16)
        hsv[..., 0] = (hsv[..., 0] + round(chance.uniform(-9, 9))) % 180
        hsv[..., 1] = np.clip(hsv[..., 1] * chance.uniform(0.4, 1.4), 0, 255)
        pixels = cv2.cvtColor(hsv.astype(np.uint8), cv2.COLOR_HSV2RGB)
    if chance.random() < 0.05:
        pixels = cv2.cvtColor(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY), cv2.COLOR_GRAY2RGB)
    gamma = np.exp(chance.normal(0, 0.25))
    gain = np.exp(chance.normal(0, 0.2)) * np.exp(chance.normal(0, 0.06, 3))
    offset = chance.normal(0, 12)
    codes = np.arange(256, dtype=np.float32)[:, None] / 255
    table = np.clip(255 * codes**gamma * gain + offset, 0, 255).astype(np.uint8)
    pixels = cv2.LUT(pixels, table[:, None, :])
    if chance.random() < 0.2:
        pixels = cv2.GaussianBlur(pixels, (0, 0), chance.uniform(0.4, 1.2))
    if chance.random() < 0.2:
        noise = chance.normal(0, chance.uniform(2, 10), pixels.shape)
        pixels = np.clip(pixels + noise, 0, 255).astype(np.uint8)
    return pixels
