"""The classes: those that the simulator renders and COCO knows, by COCO's names."""

CLASSES = [
    "person", "chair", "couch", "dining table", "tv", "laptop", "keyboard", "mouse", "book",
    "potted plant", "cup", "bottle", "vase", "backpack", "suitcase", "refrigerator", "microwave",
    "sink", "clock",
]  # fmt: skip
