"""Unit tests of the training package: python3 -m unittest training.tests.test_training."""

import math
import pathlib
import random
import sys
import tempfile
import unittest

try:
    import cv2  # noqa: F401
    import numpy as np
    import onnx
    import torch
    import yaml
except ImportError as missing:
    print(f"SKIPPED: {missing}; deploy/install-deps --training installs what training needs")
    sys.exit(0)

from training import losses, metrics, scenes, targets
from training.augment import augmented, fitted
from training.classes import CLASSES
from training.dataset import Frame
from training.export import export
from training.floor_plan import FloorPlan, bounds
from training.network import GRIDS, Answer, Solov2
from training.train import Plan, Sampler, Trainer, train

FIRST_CELLS = np.cumsum([0] + [size * size for size in GRIDS])


def frame_with(ids: np.ndarray, classes: dict[int, int]) -> Frame:
    """Each instance in a grey of its own."""
    image = np.repeat((40 * ids.astype(np.uint8) + 50)[..., None], 3, 2)
    return Frame(image, ids, classes)


def ids_with(box: tuple[int, int, int, int], shape=(256, 320)) -> np.ndarray:
    """Instance 1 in a box (top, left, bottom, right)."""
    ids = np.zeros(shape, np.uint8)
    ids[box[0] : box[2], box[1] : box[3]] = 1
    return ids


class Scenes(unittest.TestCase):
    def test_are_the_same_for_the_same_seed_only(self):
        first, again, other = (scenes.make_scene(seed, 5) for seed in (7, 7, 8))
        self.assertEqual(first, again)
        self.assertNotEqual(first["objects"], other["objects"])

    def test_keep_the_camera_inside_and_give_it_a_place_for_each_frame(self):
        for seed in range(20):
            scene = scenes.make_scene(seed, 6)
            width, depth = scene["rooms"][0]["max_m"]
            waypoints = scene["camera"]["waypoints"]
            self.assertEqual([w["at_s"] for w in waypoints], list(range(7)))
            for waypoint in waypoints:
                x, y, z = waypoint["position_m"]
                self.assertTrue(0.1 < x < width - 0.1, seed)
                self.assertTrue(0.1 < y < depth - 0.1, seed)
                self.assertGreater(math.dist((x, y), waypoint["look_at_m"][:2]), 0.05)
            self.assertEqual(yaml.safe_load(yaml.safe_dump(scene)), scene)

    def test_never_seat_two_on_one_chair(self):
        for seed in range(30):
            people = scenes.make_scene(seed, 4)["people"]
            seats = [a["sit"]["on"] for p in people for a in p["actions"] if "sit" in a]
            self.assertEqual(len(seats), len(set(seats)), seed)


class Plans(unittest.TestCase):
    def test_give_no_place_twice(self):
        plan = FloorPlan(4, 3)
        self.assertTrue(plan.take(bounds("desk", 2, 1.5, 90)))
        self.assertFalse(plan.is_free(bounds("office_chair", 2.1, 1.6, 0)))
        self.assertFalse(plan.take(bounds("desk", 0.2, 1.5, 0)))  # in the wall
        chance = random.Random(1)
        for _ in range(50):
            x, y = plan.free_point(chance, 0.3)
            self.assertFalse(1.15 < x < 2.85 and 1.1 < y < 1.9, (x, y))

    def test_put_backs_to_walls(self):
        chance = random.Random(2)
        for _ in range(40):
            x, y, yaw = FloorPlan(5, 4).against_wall(chance, 0.2, 1.0)
            away = {0.0: x, 90.0: y, 180.0: 5 - x, -90.0: 4 - y}[yaw]
            self.assertAlmostEqual(away, 0.2)


class Targets(unittest.TestCase):
    def cells_of(self, found: targets.Targets, grid: int) -> set[tuple[int, int]]:
        size = GRIDS[grid]
        own = [
            int(c - FIRST_CELLS[grid])
            for c in found.cells
            if FIRST_CELLS[grid] <= c < FIRST_CELLS[grid + 1]
        ]
        return {divmod(cell, size) for cell in own}

    def test_put_an_instance_into_the_grid_of_its_size_at_its_centre(self):
        small = targets.make_targets(ids_with((120, 150, 140, 170)), {1: 3})  # 20 x 20 of 256 x 320
        self.assertEqual(self.cells_of(small, 0), {(16, 15), (16, 16)})
        self.assertEqual(self.cells_of(small, 4), set())
        large = targets.make_targets(ids_with((0, 0, 256, 320)), {1: 3})
        self.assertEqual(self.cells_of(large, 0), set())
        self.assertEqual(self.cells_of(large, 4), {(r, c) for r in (3, 4) for c in (3, 4)})
        self.assertTrue((large.categories[4][[27, 28, 35, 36]] == 3).all())
        self.assertEqual((large.categories[4] >= 0).sum(), 4)

    def test_leave_out_what_has_no_class_or_is_tiny(self):
        for ids, classes in (
            (ids_with((0, 0, 90, 90)), {2: 0}),
            (ids_with((8, 8, 12, 12)), {1: 0}),
        ):
            found = targets.make_targets(ids, classes)
            self.assertEqual(len(found.cells), 0)
            self.assertEqual(found.masks.shape, (0, 64, 80))

    def test_have_masks_with_the_share_of_each_sample(self):
        found = targets.make_targets(ids_with((100, 101, 140, 160)), {1: 0})
        self.assertEqual(found.masks.shape, (1, 64, 80))
        self.assertAlmostEqual(float(found.masks.sum()) * 16, 40 * 59, places=3)
        self.assertAlmostEqual(float(found.masks[0, 30, 25]), 0.75)  # columns 101, 102, 103 of four

    def test_tell_the_class_of_every_eighth_pixel(self):
        semantic = targets.make_targets(ids_with((64, 80, 128, 160)), {1: 3, 9: 4}).semantic
        self.assertEqual(semantic.shape, (32, 40))
        self.assertTrue((semantic[8:16, 10:20] == 3).all())
        self.assertEqual((semantic == -1).sum(), 32 * 40 - 8 * 10)

    def test_give_a_cell_that_two_claim_to_the_smaller(self):
        ids = ids_with((60, 80, 200, 240))
        ids[110:150, 140:180] = 2
        found = targets.make_targets(ids, {1: 0, 2: 5})
        both = [g for g in range(len(GRIDS)) if {0, 5} <= set(found.categories[g])]
        areas = found.masks.sum((1, 2))
        for grid in both:
            centre = (GRIDS[grid] // 2) * GRIDS[grid] + GRIDS[grid] // 2
            self.assertEqual(found.categories[grid][centre], 5)
        self.assertGreater(areas[0], areas[1])


class Losses(unittest.TestCase):
    def test_focal_loss_is_that_of_its_formula(self):
        logits = torch.tensor([[0.4, -1.2], [2.0, 0.1]])
        classes = torch.tensor([1, -1])
        p = [1 / (1 + math.exp(-x)) for x in (0.4, -1.2, 2.0, 0.1)]
        wanted = -0.25 * (1 - p[1]) ** 2 * math.log(p[1])
        wanted += sum(-0.75 * q**2 * math.log(1 - q) for q in (p[0], p[2], p[3]))
        self.assertAlmostEqual(
            float(losses.focal_loss(logits, classes, alpha=0.25)), wanted, places=5
        )

    def test_dice_loss_goes_from_one_to_zero(self):
        masks = torch.zeros(1, 8, 8)
        masks[:, 2:5, 2:6] = 1
        right = losses.dice_loss(40 * (masks - 0.5), masks)
        wrong = losses.dice_loss(40 * (0.5 - masks), masks)
        self.assertAlmostEqual(float(right), 0, places=4)
        self.assertAlmostEqual(float(wrong), 1, places=4)

    def test_pair_the_kernel_of_a_cell_with_the_mask_of_its_instance(self):
        """With kernels and feature made to fit one instance, the mask's loss is nearly 0; for
        another cell's kernel it is not."""
        wanted = targets.make_targets(ids_with((64, 80, 128, 160)), {1: 2})
        feature = torch.from_numpy(40 * (wanted.masks - 0.5))[None]  # [1, 1, 64, 80]
        cells = torch.zeros(1, 1, int(FIRST_CELLS[-1]))
        cells[0, 0, wanted.cells] = 1.0
        for factor, low, high in ((1.0, 0.0, 0.01), (-1.0, 2.9, 3.0)):
            kernels = [
                k.view(1, 1, s, s)
                for k, s in zip((factor * cells).split([s * s for s in GRIDS], 2), GRIDS)
            ]
            categories = [torch.full((1, 3, s, s), -9.0) for s in GRIDS]
            answer = Answer(categories, kernels, feature, torch.zeros(1, 4, 32, 40))
            mask_loss = losses.solov2_losses(answer, [wanted], 0.25).mask
            self.assertTrue(low <= float(mask_loss) <= high, float(mask_loss))

    def test_are_finite_without_any_instance(self):
        network = Solov2(4)
        nothing = targets.make_targets(np.zeros((64, 96), np.uint8), {})
        found = losses.solov2_losses(network(torch.zeros(1, 3, 64, 96)), [nothing], 0.25)
        self.assertTrue(all(torch.isfinite(loss) for loss in found))


class Network(unittest.TestCase):
    def test_answers_with_the_shapes_that_the_decoder_expects(self):
        categories, kernels, feature, semantic = Solov2(7, kernel_length=32).eval()(
            torch.zeros(2, 3, 128, 160)
        )
        self.assertEqual([tuple(c.shape) for c in categories], [(2, 7, s, s) for s in GRIDS])
        self.assertEqual([tuple(k.shape) for k in kernels], [(2, 32, s, s) for s in GRIDS])
        self.assertEqual(tuple(feature.shape), (2, 32, 32, 40))
        self.assertEqual(tuple(semantic.shape), (2, 8, 16, 20))

    def test_is_exported_with_names_of_outputs_and_classes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "net.onnx"
            export(Solov2(len(CLASSES)), path, (64, 96))
            model = onnx.load(str(path))
        names = [output.name for output in model.graph.output]
        self.assertEqual(
            names,
            [*(f"cate_{i}" for i in range(5)), *(f"kernel_{i}" for i in range(5)), "mask_feat"],
        )
        metadata = {p.key: p.value for p in model.metadata_props}
        self.assertTrue(metadata["names"].startswith("{0: 'person', 1: 'chair'"))
        operators = {node.op_type for node in model.graph.node}
        self.assertFalse(operators & {"NonZero", "TopK", "Loop", "If"})

    def test_learns_one_image_by_heart(self):
        frame = frame_with(ids_with((16, 24, 48, 72), (64, 96)), {1: 0})
        image, ids = fitted(frame, 64, 96)
        with tempfile.TemporaryDirectory() as folder:
            trainer = Trainer(Plan(iterations=40, warm_up=5, masks_first=0), pathlib.Path(folder))
            tensor = torch.from_numpy(image).permute(2, 0, 1)[None].repeat(2, 1, 1, 1)
            goal = [targets.make_targets(ids, frame.classes)] * 2
            first, *_, last = (trainer.step(tensor, goal) for _ in range(40))
        self.assertGreater(first.mask, 1.0)
        self.assertLess(last.mask, 0.5)
        self.assertLess(last.category, 0.5 * first.category)
        self.assertLess(last.semantic, 0.5 * first.semantic)


class Training(unittest.TestCase):
    PLAN = Plan(iterations=4, batch=2, warm_up=1, small_size=(64, 96), size=(64, 96))

    def frames(self) -> list[Frame]:
        return [
            frame_with(ids_with((8 * i, 16, 8 * i + 30, 60), (64, 96)), {1: i % 3})
            for i in range(3)
        ]

    def run_to(self, iterations: int, out: pathlib.Path) -> Trainer:
        plan = (
            self.PLAN
            if iterations == self.PLAN.iterations
            else Plan(**{**self.PLAN.__dict__, "iterations": iterations})
        )
        train(plan, self.frames(), self.frames()[:1], out)
        trainer = Trainer(plan, out)
        trainer.resume()
        return trainer

    def test_writes_a_checkpoint_and_goes_on_from_it(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            self.assertEqual(self.run_to(2, out).iteration, 2)
            lines = (out / "log.jsonl").read_text().splitlines()
            self.assertEqual(self.run_to(4, out).iteration, 4)
            self.assertGreater(len((out / "log.jsonl").read_text().splitlines()), len(lines))

    def test_gives_the_same_network_again(self):
        with tempfile.TemporaryDirectory() as a, tempfile.TemporaryDirectory() as b:
            states = [self.run_to(4, pathlib.Path(each)).average.state_dict() for each in (a, b)]
        self.assertTrue(
            all(torch.equal(x, y) for x, y in zip(states[0].values(), states[1].values()))
        )

    def test_shows_all_frames_before_any_again(self):
        sampler = Sampler(6, Plan(batch=2))
        seen = [i for iteration in range(6) for i in sampler.batch(iteration)]
        self.assertEqual(sorted(seen[:6]), list(range(6)))
        self.assertEqual(sorted(seen[6:]), list(range(6)))
        self.assertNotEqual(seen[:6], seen[6:])

    def test_rate_rises_then_falls(self):
        plan = Plan(iterations=1000, warm_up=100)
        self.assertLess(plan.rate(0), 0.02 * plan.peak_rate)
        self.assertAlmostEqual(plan.rate(100), plan.peak_rate)
        self.assertLess(plan.rate(999), 0.02 * plan.peak_rate)


class Augmentation(unittest.TestCase):
    def test_keeps_pixels_and_ids_together(self):
        """An instance much brighter than all else stays so wherever it goes."""
        ids = ids_with((60, 80, 180, 240), (240, 320))
        image = np.where(ids[..., None] == 1, 200, 60).astype(np.uint8).repeat(3, 2)
        for seed in range(20):
            shown, moved = augmented(
                Frame(image, ids, {1: 0}), 256, 320, np.random.default_rng(seed)
            )
            self.assertEqual(shown.shape, (256, 320, 3))
            inside, outside = shown[moved == 1], shown[(moved == 0) & (shown != 0).any(2)]
            self.assertGreater(np.median(inside), np.percentile(outside, 90), seed)

    def test_fits_a_frame_as_at_run_time(self):
        image, ids = fitted(frame_with(np.ones((240, 320), np.uint8), {1: 0}), 256, 320)
        self.assertTrue((ids[:240] == 1).all() and (ids[240:] == 0).all())
        self.assertTrue((image[240:] == 0).all() and (image[:240] != 0).all())


class Metrics(unittest.TestCase):
    def instances(self, *boxes, scores=None) -> metrics.Instances:
        masks = np.zeros((len(boxes), 40, 40), bool)
        for mask, (top, left, bottom, right) in zip(masks, boxes):
            mask[top:bottom, left:right] = True
        return metrics.Instances(
            masks, np.zeros(len(boxes), int), np.array(scores or [1.0] * len(boxes))
        )

    def test_average_precision_is_one_for_the_truth_and_zero_for_nothing(self):
        truth = self.instances((0, 0, 10, 10), (20, 20, 40, 40))
        self.assertAlmostEqual(
            metrics.average_precision([metrics.match(truth, truth, 1)]).mean(), 1.0
        )
        none = self.instances()
        self.assertAlmostEqual(
            metrics.average_precision([metrics.match(none, truth, 1)]).mean(), 0.0
        )
        self.assertTrue(np.isnan(metrics.average_precision([metrics.match(truth, none, 1)])).all())

    def test_average_precision_of_a_case_reckoned_by_hand(self):
        """Two to be found; by score: right, wrong, right (IoU 0.6, so for three of ten thresholds)."""
        truth = self.instances((0, 0, 10, 10), (20, 20, 30, 30))
        found = self.instances(
            (0, 0, 10, 10), (0, 30, 5, 35), (20, 20, 26, 30), scores=[0.9, 0.8, 0.7]
        )
        precision = metrics.average_precision([metrics.match(found, truth, 1)])
        half = 51 / 101  # recalls up to 0.5
        for threshold, value in zip(metrics.THRESHOLDS, precision):
            second = (1 - half) * 2 / 3 if threshold < 0.601 else 0.0
            self.assertAlmostEqual(value, half + second, places=6)

    def test_of_two_for_one_the_second_is_wrong(self):
        truth = self.instances((0, 0, 10, 10))
        found = self.instances((0, 0, 10, 10), (0, 0, 10, 9), scores=[0.5, 0.9])
        matched = metrics.match(found, truth, 1)
        self.assertEqual(matched.right[0].tolist(), [True, False])
        self.assertEqual(matched.right[-1].tolist(), [False, True])  # 0.9 is not 0.95

    def test_leaves_what_is_small_out_of_account(self):
        truth = self.instances((0, 0, 3, 3), (20, 20, 30, 30))
        found = self.instances(
            (0, 0, 3, 3), (20, 20, 30, 30), (36, 36, 38, 38), scores=[0.9, 0.8, 0.7]
        )
        matched = metrics.match(found, truth, 20)
        self.assertEqual(matched.wanted, 1)
        self.assertEqual(matched.ignored[0].tolist(), [True, False, True])
        self.assertAlmostEqual(metrics.average_precision([matched]).mean(), 1.0)

    def test_best_overlap_is_zero_where_nothing_is_found(self):
        truth = self.instances((0, 0, 10, 10), (20, 20, 30, 30), (0, 39, 1, 40))
        found = self.instances((0, 0, 10, 5))
        self.assertEqual(metrics.best_overlaps(found, truth, 10).tolist(), [0.5, 0.0])
        self.assertEqual(metrics.best_overlaps(self.instances(), truth, 10).tolist(), [0.0, 0.0])


if __name__ == "__main__":
    unittest.main()
