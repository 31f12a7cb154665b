#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/scene_file/scene_problems.hpp"

namespace tsg {

/// The names that a scene gives to objects and people, and where they are used. Names may be used
/// before they are given: check() comes last.
class SceneNames {
 public:
  /// Reports a name that is taken.
  void declare_object(const std::string& name, int line, SceneProblems& problems);
  void declare_person(const std::string& name, int line, SceneProblems& problems);
  /// A name made of `type` and a counter.
  [[nodiscard]] std::string make_object_name(const std::string& type) const;

  /// `key` refers to object `name`.
  void use_object(const std::string& name, int line, const std::string& key);
  /// Object `upper` stands on `lower`.
  void stack(const std::string& upper, const std::string& lower, int line, const std::string& key);

  /// Reports unknown names, and things that stand on themselves in the end.
  void check(SceneProblems& problems) const;

 private:
  struct Use {
    std::string name;
    int line = 0;
    std::string key;
  };

  void declare(const std::string& name, int line, SceneProblems& problems);
  [[nodiscard]] bool is_cyclic(const std::string& object) const;

  std::map<std::string, int> lines_;  ///< of all names
  std::vector<std::string> objects_;
  std::vector<Use> uses_;
  std::map<std::string, Use> stands_on_;
};

}  // namespace tsg
