#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// Names of a network's classes, in the order of its numbers; background has none.
struct ClassNames {
  std::vector<std::string> names;
  std::string source;                            ///< "the labels file coco.txt", for messages
  ExitCode fault = ExitCode::kUnsupportedModel;  ///< of an error in them: of the file that is wrong
};

/// Reads class names as exporters write them, a Python dictionary: {0: 'person', 1: "tv"}, with
/// the keys 0, 1, 2 ... in this order. kUnsupportedModel where it is not.
[[nodiscard]] Expected<std::vector<std::string>> parse_class_names(std::string_view dictionary);

/// From the metadata key `names`. kUnsupportedModel, with the fix, where there is none or a bad
/// one.
[[nodiscard]] Expected<ClassNames> class_names_of(const ModelDescription& model);

/// From a text file with one name on each line. kMissingInput where it is not there, kEmptyInput
/// where it has no line, kBadData where a line is empty or too long for a message.
[[nodiscard]] Expected<ClassNames> read_labels_file(const std::filesystem::path& path);

/// An error that names both numbers where a network has not as many classes as there are names.
[[nodiscard]] Expected<void> check_class_count(const ClassNames& names, std::int64_t classes);

}  // namespace tsg
