#include "common/dataset/camera_file.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

const std::set<std::string> kRequiredKeys{"fx", "fy", "cx", "cy", "width", "height", "depth_scale"};
const std::set<std::string> kOptionalKeys{"k1", "k2", "p1", "p2", "k3", "fps", "depth_registered"};

struct Value {
  double number = 0.0;
  std::string where;  ///< "FILE:LINE"
};
using Values = std::map<std::string, Value>;

tl::unexpected<Error> bad(const std::string& where, const std::string& what) {
  return make_error(ExitCode::kBadData, where + ": " + what);
}

/// OpenCV starts its files with "%YAML:1.0", which is not quite YAML; as a comment it is.
std::string without_opencv_header(std::string text) {
  if (text.starts_with("%YAML:")) text.front() = '#';
  return text;
}

Expected<YAML::Node> parse_yaml(const std::filesystem::path& path, const std::string& text) {
  try {
    YAML::Node root = YAML::Load(text);
    if (root.IsMap()) return root;
    return bad(path.string(), "is not a list of \"key: value\" lines; write one value a line");
  } catch (const YAML::Exception& error) {
    return bad(place(path, error.mark.line + 1), error.msg + "; correct the line");
  }
}

Expected<Values> read_values(const std::filesystem::path& path, const YAML::Node& root) {
  Values values;
  for (const auto& entry : root) {
    const std::string where = place(path, entry.first.Mark().line + 1);
    const auto key = entry.first.IsScalar() ? entry.first.Scalar() : std::string("?");
    if (!kRequiredKeys.contains(key) && !kOptionalKeys.contains(key)) {
      return bad(where, "unknown key \"" + key + "\"; remove or correct it");
    }
    if (values.contains(key)) return bad(where, "key \"" + key + "\" is there twice");
    if (!entry.second.IsScalar()) return bad(where, "\"" + key + "\" must be a number");
    const auto number = parse_number(entry.second.Scalar(), where + ": key \"" + key + "\"");
    if (!number) return tl::unexpected(number.error());
    values[key] = {*number, where};
  }
  for (const std::string& key : kRequiredKeys) {
    if (!values.contains(key)) return bad(path.string(), "key \"" + key + "\" is missing; add it");
  }
  return values;
}

Expected<int> read_size(const Values& values, const std::string& key) {
  const Value& value = values.at(key);
  if (value.number >= 1.0 && value.number <= 65535.0 && value.number == std::floor(value.number)) {
    return static_cast<int>(value.number);
  }
  return bad(value.where, "\"" + key + "\" must be a whole number of pixels");
}

double number_or(const Values& values, const std::string& key, double otherwise) {
  const auto found = values.find(key);
  return found == values.end() ? otherwise : found->second.number;
}

Expected<CameraModel> make_model(const std::filesystem::path& path, const Values& values) {
  const auto width = read_size(values, "width");
  if (!width) return tl::unexpected(width.error());
  const auto height = read_size(values, "height");
  if (!height) return tl::unexpected(height.error());
  CameraModel model;
  model.width = *width;
  model.height = *height;
  model.fx = values.at("fx").number;
  model.fy = values.at("fy").number;
  model.cx = values.at("cx").number;
  model.cy = values.at("cy").number;
  model.distortion = {number_or(values, "k1", 0.0), number_or(values, "k2", 0.0),
                      number_or(values, "p1", 0.0), number_or(values, "p2", 0.0),
                      number_or(values, "k3", 0.0)};
  const std::vector<std::string> problems = model.problems();
  if (!problems.empty()) return bad(path.string(), problems.front());
  return model;
}

Expected<void> check_remaining(const Values& values) {
  for (const char* key : {"fps", "depth_scale"}) {
    const auto value = values.find(key);
    if (value != values.end() && value->second.number <= 0.0) {
      return bad(value->second.where, std::string("\"") + key + "\" must be positive");
    }
  }
  const auto registered = values.find("depth_registered");
  if (registered != values.end() && registered->second.number == 0.0) {
    return bad(registered->second.where,
               "depth is not registered to colour; register it before use");
  }
  return {};
}

}  // namespace

Expected<RecordedCamera> read_camera_file(const std::filesystem::path& path) {
  const auto text = read_text_file(
      path, "write it: fx fy cx cy width height depth_scale, each as \"key: value\"");
  if (!text) return tl::unexpected(text.error());
  const auto root = parse_yaml(path, without_opencv_header(*text));
  if (!root) return tl::unexpected(root.error());
  const auto values = read_values(path, *root);
  if (!values) return tl::unexpected(values.error());
  const auto model = make_model(path, *values);
  if (!model) return tl::unexpected(model.error());
  if (const auto fine = check_remaining(*values); !fine) return tl::unexpected(fine.error());
  return RecordedCamera{*model, values->at("depth_scale").number, number_or(*values, "fps", 30.0)};
}

}  // namespace tsg
