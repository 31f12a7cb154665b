"""SOLOv2 for simulated rooms: scenes, training, export and evaluation. README.md tells how to run it."""
