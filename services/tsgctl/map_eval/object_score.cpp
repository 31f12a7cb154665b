#include "services/tsgctl/map_eval/object_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tsg {
namespace {

constexpr float kAroundBoxM = 0.3F;

struct Pair {
  const Tag* tag;
  const ExpectedObject* object;
  float distance_m;
};

/// Whether a point lies within the box or `kAroundBoxM` around it.
bool is_at(const TrueBox& box, const Eigen::Vector3f& point) {
  const Eigen::AngleAxisf R_box_world(-box.yaw_rad, Eigen::Vector3f::UnitZ());
  const Eigen::Vector3f from_centre = R_box_world * Eigen::Vector3f(point - box.centre_m);
  return (from_centre.cwiseAbs().array() <= 0.5F * box.size_m.array() + kAroundBoxM).all();
}

/// Which of its two level axes is x is of no meaning.
Eigen::Vector3f with_longest_first(const Eigen::Vector3f& size) {
  return {std::max(size.x(), size.y()), std::min(size.x(), size.y()), size.z()};
}

double size_error(const Tag& tag, const TrueBox& box) {
  const Eigen::Vector3f difference =
      with_longest_first(tag.oriented_box.size) - with_longest_first(box.size_m);
  return difference.norm() / std::max(box.size_m.norm(), 1e-3F);
}

std::vector<Pair> candidates(std::span<const Tag> tags,
                             const std::vector<ExpectedObject>& objects) {
  std::vector<Pair> pairs;
  for (const Tag& tag : tags) {
    for (const ExpectedObject& object : objects) {
      if (tag.state == TagState::kGone || tag.class_name != object.class_name) continue;
      if (!is_at(object.box, tag.centre)) continue;
      pairs.push_back({&tag, &object, (tag.centre - object.box.centre_m).norm()});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::distance_m);
  return pairs;
}

}  // namespace

std::size_t ObjectScore::count_error() const {
  std::size_t sum = 0;
  for (const ClassScore& of_class : classes) sum += of_class.count_error();
  return sum;
}

ObjectScore score_objects(std::span<const Tag> tags, const std::vector<ExpectedObject>& objects) {
  ObjectScore score;
  std::set<const Tag*> used_tags;
  std::set<const ExpectedObject*> found;
  for (const Pair& pair : candidates(tags, objects)) {
    if (used_tags.contains(pair.tag) || found.contains(pair.object)) continue;
    used_tags.insert(pair.tag);
    found.insert(pair.object);
    score.matches.push_back({.object_id = pair.object->id,
                             .name = pair.object->name,
                             .class_name = pair.object->class_name,
                             .tag_id = pair.tag->id,
                             .is_well_seen = pair.object->is_well_seen,
                             .centre_error_m = pair.distance_m,
                             .size_error = size_error(*pair.tag, pair.object->box)});
  }
  std::map<std::string, ClassScore> classes;
  for (const ExpectedObject& object : objects) {
    if (!object.is_well_seen) continue;
    ClassScore& of_class = classes[object.class_name];
    ++of_class.objects;
    of_class.missing += found.contains(&object) ? 0 : 1;
  }
  for (const Tag& tag : tags) {
    if (tag.state == TagState::kGone) continue;
    ClassScore& of_class = classes[tag.class_name];
    ++of_class.tags;
    of_class.surplus += used_tags.contains(&tag) ? 0 : 1;
  }
  for (auto& [name, of_class] : classes) {
    of_class.class_name = name;
    score.classes.push_back(of_class);
  }
  return score;
}

}  // namespace tsg
