#include "common/scene_file/scene_names.hpp"

#include <algorithm>

namespace tsg {

void SceneNames::declare(const std::string& name, int line, SceneProblems& problems) {
  const auto [first, is_new] = lines_.emplace(name, line);
  if (is_new) return;
  problems.add(line, "name",
               "\"" + name + "\" is taken in line " + std::to_string(first->second) +
                   "; objects and people need names of their own");
}

void SceneNames::declare_object(const std::string& name, int line, SceneProblems& problems) {
  declare(name, line, problems);
  objects_.push_back(name);
}

void SceneNames::declare_person(const std::string& name, int line, SceneProblems& problems) {
  declare(name, line, problems);
}

std::string SceneNames::make_object_name(const std::string& type) const {
  for (int counter = 1;; ++counter) {
    std::string name = type + "_" + std::to_string(counter);
    if (!lines_.contains(name)) return name;
  }
}

void SceneNames::use_object(const std::string& name, int line, const std::string& key) {
  uses_.push_back({name, line, key});
}

void SceneNames::stack(const std::string& upper,
                       const std::string& lower,
                       int line,
                       const std::string& key) {
  use_object(lower, line, key);
  stands_on_[upper] = {lower, line, key};
}

bool SceneNames::is_cyclic(const std::string& object) const {
  std::string lower = object;
  for (std::size_t steps = 0; steps < stands_on_.size(); ++steps) {
    const auto next = stands_on_.find(lower);
    if (next == stands_on_.end()) return false;
    lower = next->second.name;
    if (lower == object) return true;
  }
  return false;
}

void SceneNames::check(SceneProblems& problems) const {
  for (const Use& use : uses_) {
    if (std::ranges::find(objects_, use.name) != objects_.end()) continue;
    problems.add(use.line, use.key,
                 "there is no object \"" + use.name + "\"; " + suggestion(use.name, objects_));
  }
  for (const auto& [upper, use] : stands_on_) {
    if (!is_cyclic(upper)) continue;
    problems.add(use.line, use.key,
                 "\"" + upper + "\" stands on itself in the end; break the circle");
  }
}

}  // namespace tsg
