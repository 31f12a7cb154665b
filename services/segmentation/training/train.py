"""Trains the network: python3 -m training.train --data DIR --held-out DIR --out DIR.

Writes DIR/checkpoint.pt, from which it goes on when started again, and DIR/log.jsonl. The same
arguments give the same network on the same machine, but for a stop in between: what images follow is
decided by the number of the iteration, not by what happened before.
"""

import argparse
import copy
import dataclasses
import json
import math
import pathlib
import time

import numpy as np
import torch

from training.augment import augmented, fitted
from training.classes import CLASSES
from training.dataset import Frame, load_sequences
from training.losses import Losses, solov2_losses
from training.network import Solov2
from training.targets import Targets, make_targets


@dataclasses.dataclass(frozen=True)
class Plan:
    """How long and how fast to learn."""

    iterations: int = 4000
    batch: int = 8
    peak_rate: float = 1.5e-3
    warm_up: int = 200
    weight_decay: float = 0.05
    small_share: float = 0.65  # so long on small images, which are cheaper
    small_size: tuple[int, int] = (192, 256)  # height, width
    size: tuple[int, int] = (256, 320)
    max_gradient: float = 5.0
    average: float = 0.998  # weight of what was, in the average of the network over time
    masks_first: int = 1750  # so long mostly masks are learnt, which come sooner than classes
    half_precision: bool = True  # bfloat16: half the time, where lscpu tells avx512_bf16
    seed: int = 1

    def weights(self, iteration: int) -> Losses:
        """How much each loss counts."""
        return Losses(1.0, 1.0, 0.0) if iteration < self.masks_first else Losses(2.0, 1.0, 1.0)

    def alpha(self, iteration: int) -> float:
        """Of the focal loss: 0.25, as published, teaches to be right; 0.5 to be sure as well."""
        return 0.25 if iteration < self.masks_first else 0.5

    def rate(self, iteration: int) -> float:
        """Rises evenly, then falls along half a cosine."""
        if iteration < self.warm_up:
            return self.peak_rate * (iteration + 1) / self.warm_up
        share = (iteration - self.warm_up) / max(1, self.iterations - self.warm_up)
        return self.peak_rate * (0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * share)))

    def size_at(self, iteration: int) -> tuple[int, int]:
        return self.small_size if iteration < self.small_share * self.iterations else self.size


class Sampler:
    """Which frames are in which batch: all once, in another order each round."""

    def __init__(self, frames: int, plan: Plan):
        self.frames = frames
        self.plan = plan
        self.round = -1
        self.order = np.zeros(0, np.int64)

    def batch(self, iteration: int) -> list[int]:
        return [self._at(iteration * self.plan.batch + i) for i in range(self.plan.batch)]

    def _at(self, position: int) -> int:
        number = position // self.frames
        if number != self.round:
            self.order = np.random.default_rng([self.plan.seed, number]).permutation(self.frames)
            self.round = number
        return int(self.order[position % self.frames])


def to_tensor(images: list[np.ndarray]) -> torch.Tensor:
    """[H, W, 3] each to [B, 3, H, W]."""
    batch = torch.from_numpy(np.stack(images)).permute(0, 3, 1, 2)
    return batch.contiguous(memory_format=torch.channels_last)


def training_batch(
    frames: list[Frame], plan: Plan, iteration: int, chosen: list[int]
) -> tuple[torch.Tensor, list[Targets]]:
    chance = np.random.default_rng([plan.seed, 1, iteration])
    shown = [(frames[i], *augmented(frames[i], *plan.size_at(iteration), chance)) for i in chosen]
    return to_tensor([image for _, image, _ in shown]), [
        make_targets(ids, frame.classes) for frame, _, ids in shown
    ]


@torch.no_grad()
def held_out_losses(network: Solov2, frames: list[Frame], plan: Plan, alpha: float) -> Losses:
    """Mean losses on frames as they are at run time."""
    network.eval()
    sums = np.zeros(len(Losses._fields))
    for start in range(0, len(frames), plan.batch):
        part = frames[start : start + plan.batch]
        shown = [(frame, *fitted(frame, *plan.size)) for frame in part]
        goals = [make_targets(ids, frame.classes) for frame, _, ids in shown]
        losses = solov2_losses(network(to_tensor([s[1] for s in shown])), goals, alpha)
        sums += [float(loss) * len(part) for loss in losses]
    return Losses(*(sums / len(frames)))


class Trainer:
    """The network, its average over time, and how far it has come."""

    def __init__(self, plan: Plan, out: pathlib.Path):
        torch.manual_seed(plan.seed)
        self.plan = plan
        self.out = out
        self.network = Solov2(len(CLASSES)).to(memory_format=torch.channels_last).train()
        self.average = copy.deepcopy(self.network).eval()
        decayed = [p for p in self.network.parameters() if p.dim() > 1]
        others = [p for p in self.network.parameters() if p.dim() <= 1]
        self.optimiser = torch.optim.AdamW(
            [
                {"params": decayed, "weight_decay": plan.weight_decay},
                {"params": others, "weight_decay": 0.0},
            ]
        )
        self.iteration = 0

    def step(self, images: torch.Tensor, targets: list[Targets]) -> Losses:
        """Learns from a batch; the losses before that, each by itself."""
        for group in self.optimiser.param_groups:
            group["lr"] = self.plan.rate(self.iteration)
        with torch.autocast("cpu", torch.bfloat16, enabled=self.plan.half_precision):
            answer = self.network(images)
        losses = solov2_losses(answer.float(), targets, self.plan.alpha(self.iteration))
        weights = self.plan.weights(self.iteration)
        self.optimiser.zero_grad(set_to_none=True)
        sum(weight * loss for weight, loss in zip(weights, losses) if weight > 0).backward()
        torch.nn.utils.clip_grad_norm_(self.network.parameters(), self.plan.max_gradient)
        self.optimiser.step()
        self._update_average()
        self.iteration += 1
        return Losses(*(float(loss.detach()) for loss in losses))

    @torch.no_grad()
    def _update_average(self) -> None:
        keep = min(self.plan.average, (1 + self.iteration) / (10 + self.iteration))
        for mean, now in zip(
            self.average.state_dict().values(), self.network.state_dict().values()
        ):
            if mean.is_floating_point():
                mean.lerp_(now, 1 - keep)
            else:
                mean.copy_(now)

    def save(self) -> None:
        """Another file in place of the last at once: a stop in between costs nothing."""
        state = {
            "iteration": self.iteration,
            "plan": dataclasses.asdict(self.plan),
            "network": self.network.state_dict(),
            "average": self.average.state_dict(),
            "optimiser": self.optimiser.state_dict(),
        }
        torch.save(state, self.out / "checkpoint.tmp")
        (self.out / "checkpoint.tmp").replace(self.out / "checkpoint.pt")

    def resume(self) -> None:
        path = self.out / "checkpoint.pt"
        if not path.exists():
            return
        state = torch.load(path)
        self.iteration = state["iteration"]
        self.network.load_state_dict(state["network"])
        self.average.load_state_dict(state["average"])
        self.optimiser.load_state_dict(state["optimiser"])

    def log(self, **values) -> None:
        with (self.out / "log.jsonl").open("a") as file:
            file.write(json.dumps(values) + "\n")


def train(plan: Plan, frames: list[Frame], held_out: list[Frame], out: pathlib.Path) -> None:
    trainer = Trainer(plan, out)
    trainer.resume()
    sampler = Sampler(len(frames), plan)
    recent: list[Losses] = []
    start = time.process_time()
    while trainer.iteration < plan.iterations:
        chosen = sampler.batch(trainer.iteration)
        recent.append(trainer.step(*training_batch(frames, plan, trainer.iteration, chosen)))
        done = trainer.iteration
        if done % 50 == 0:
            mean = Losses(*np.mean(recent, 0))
            recent.clear()
            trainer.log(iteration=done, cpu_s=time.process_time() - start, **mean._asdict())
        if done % 250 == 0 or done == plan.iterations:
            alpha = plan.alpha(done - 1)
            losses = held_out_losses(trainer.average, held_out, plan, alpha)._asdict()
            trainer.log(iteration=done, **{f"held_out_{key}": losses[key] for key in losses})
            trainer.save()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--data", type=pathlib.Path, required=True, help="folder of rendered sequences"
    )
    parser.add_argument(
        "--held-out", type=pathlib.Path, required=True, help="others, not to be learnt from"
    )
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--iterations", type=int, default=Plan.iterations)
    parser.add_argument("--threads", type=int, default=1)
    arguments = parser.parse_args()
    torch.set_num_threads(arguments.threads)
    arguments.out.mkdir(parents=True, exist_ok=True)
    held_out = load_sequences(arguments.held_out)[::8]
    train(
        Plan(iterations=arguments.iterations),
        load_sequences(arguments.data),
        held_out,
        arguments.out,
    )


if __name__ == "__main__":
    main()
