#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/scene_file/scene_problems.hpp"

namespace tsg {

/// What a number may be, both ends included.
struct Limits {
  double low = 0.0;
  double high = 0.0;
};

inline constexpr Limits kSeconds{0.0, 86'400.0};
inline constexpr Limits kMetres{-1'000.0, 1'000.0};
inline constexpr Limits kDegrees{-360.0, 360.0};
inline constexpr double kRadians = std::numbers::pi / 180.0;  ///< in a degree

/// An element of a list, with its path for messages.
struct ListItem {
  YAML::Node node;
  std::string path;
  [[nodiscard]] int line() const { return node.Mark().line + 1; }
};

/// Reads one map of a scene file and reports what does not fit:
///   MapReader reader(node, "rooms[0]", problems);
///   reader.require({"min_m", "max_m"});
///   reader.read("height_m", room.height_m, {2.0, 20.0});
///   reader.finish();  // keys that nobody read
/// A value that does not fit is left as it was.
class MapReader {
 public:
  MapReader(const YAML::Node& node, std::string path, SceneProblems& problems);

  [[nodiscard]] bool has(const std::string& key) const { return find(key) != nullptr; }
  [[nodiscard]] bool is_list(const std::string& key) const;
  /// Of the key; of the map where it is absent.
  [[nodiscard]] int line(const std::string& key) const;
  [[nodiscard]] std::string path(const std::string& key) const;
  /// Whether all of them are there; reports those that are not.
  bool require(std::initializer_list<const char*> keys);
  void add_problem(const std::string& key, const std::string& what);

  void read(const std::string& key, bool& value);
  void read(const std::string& key, std::string& value);
  /// One of `known`.
  void read(const std::string& key, std::string& value, const std::vector<std::string>& known);
  void read(const std::string& key, std::uint64_t& value);
  void read(const std::string& key, int& value, Limits limits);
  void read(const std::string& key, double& value, Limits limits);
  /// Files have other units than structs: the number times `factor`, e.g. radians per degree.
  void read_scaled(const std::string& key, double& value, Limits limits, double factor);
  /// A list of as many numbers as `value` has.
  void read(const std::string& key, Eigen::Vector2d& value, Limits limits = kMetres);
  void read(const std::string& key, Eigen::Vector3d& value, Limits limits = kMetres);

  /// The elements of a list; none where it is absent.
  [[nodiscard]] std::vector<ListItem> list(const std::string& key);
  /// The map under a key.
  [[nodiscard]] std::optional<MapReader> map(const std::string& key);
  /// The only key of this map, one of `known`, with its map; reported where it is another.
  [[nodiscard]] std::optional<std::pair<std::string, MapReader>> only_map(
      const std::vector<std::string>& known);

  /// Reports keys that nobody asked for.
  void finish();

 private:
  struct Entry {
    std::string key;
    YAML::Node value;
    int line = 0;
  };

  void load(const YAML::Node& node);
  [[nodiscard]] const Entry* find(const std::string& key) const;
  [[nodiscard]] const Entry* take(const std::string& key);

  std::string path_;
  SceneProblems* problems_;
  int line_ = 0;
  bool is_map_ = false;
  std::vector<Entry> entries_;
  std::vector<std::string> known_;
};

/// Numbers of a list; reports at `item` what is wrong. For lists within lists.
[[nodiscard]] std::optional<std::vector<double>> read_numbers(const ListItem& item,
                                                              std::size_t count,
                                                              Limits limits,
                                                              SceneProblems& problems);

}  // namespace tsg
