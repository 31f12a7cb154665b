#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// Collects all that is wrong with a scene file, so that it is told at once.
class SceneProblems {
 public:
  explicit SceneProblems(std::filesystem::path file);

  /// `key` is the path to it, for example "objects[2].at_m"; empty: the whole file.
  void add(int line, const std::string& key, const std::string& what);

  [[nodiscard]] bool empty() const { return lines_.empty(); }
  /// kConfig; a line each, in the order of the file.
  [[nodiscard]] Error to_error() const;

 private:
  std::filesystem::path file_;
  std::vector<std::pair<int, std::string>> lines_;
};

/// How to go on after a word that is not among `known`: the nearest of them, or all.
[[nodiscard]] std::string suggestion(const std::string& word,
                                     const std::vector<std::string>& known);

}  // namespace tsg
