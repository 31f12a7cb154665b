#include "services/tsgctl/dynamic/run_variants.hpp"

#include <array>

namespace tsg {
namespace {

/// Another one is another line.
const std::array<RunVariant, 10> kVariants{{
    {"late1", "1 frame late", {.faults = {.late_frames = 1}}},
    {"late3", "3 frames late", {.faults = {.late_frames = 3}}},
    {"late6", "6 frames late", {.faults = {.late_frames = 6}}},
    {"late10", "10 frames late", {.faults = {.late_frames = 10}}},
    {"every10", "of every 10th frame only", {.faults = {.every_frames = 10}}},
    {"flicker", "of which every 3rd lacks an instance", {.faults = {.drop_instance_every = 3}}},
    {"merged", "with two instances in one", {.faults = {.merge_two = true}}},
    {"shrunk", "10 px too small at each edge", {.faults = {.shrink_px = 10}}},
    {"swapped", "of which every 3rd has a wrong class", {.faults = {.swap_class_every = 3}}},
    {"nomasks", "none at all", {.use = false}},
}};

}  // namespace

std::span<const RunVariant> run_variants() { return kVariants; }

Expected<const RunVariant*> find_variant(std::string_view name) {
  std::string names;
  for (const RunVariant& variant : kVariants) {
    if (variant.name == name) return &variant;
    names += " " + std::string(variant.name);
  }
  return make_error(ExitCode::kUsage,
                    "there is no variant " + std::string(name) + "; choose among" + names);
}

}  // namespace tsg
