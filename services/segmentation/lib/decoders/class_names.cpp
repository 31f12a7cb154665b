#include "services/segmentation/lib/decoders/class_names.hpp"

#include <cctype>
#include <charconv>
#include <cstddef>
#include <sstream>
#include <utility>

#include "common/dataset/text_file.hpp"

namespace tsg {

namespace {

constexpr std::size_t kMaxNameBytes = 31;  // what a message has room for
constexpr const char* kHowToName =
    "; give the names in a text file, one on each line, with segmentation.model.labels "
    "(tsgctl model check: --labels)";

std::string too_long(const std::string& name) {
  return "the class name '" + name.substr(0, 60) + "' has more than " +
         std::to_string(kMaxNameBytes) + " bytes";
}

/// Reads a Python dictionary literal of integer keys and string values from its beginning on.
class DictionaryReader {
 public:
  explicit DictionaryReader(std::string_view text) : text_(text) {}

  bool skip(char expected) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }

  bool read_key(int& key) {
    skip_blanks();
    const char* end = text_.data() + text_.size();
    const auto [next, failure] = std::from_chars(text_.data() + at_, end, key);
    if (failure != std::errc{}) return false;
    at_ = static_cast<std::size_t>(next - text_.data());
    return true;
  }

  bool read_string(std::string& value) {
    value.clear();
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') return false;
    while (++at_ < text_.size()) {
      if (text_[at_] == quote) {
        ++at_;
        return true;
      }
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      value += text_[at_];
    }
    return false;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

Expected<std::vector<std::string>> parse_class_names(std::string_view dictionary) {
  const auto wrong = [&] {
    return make_error(ExitCode::kUnsupportedModel,
                      "the metadata key `names` should read {0: 'person', 1: ...}, not \"" +
                          std::string(dictionary.substr(0, 60)) + "\"" + kHowToName);
  };
  DictionaryReader reader(dictionary);
  if (!reader.skip('{')) return wrong();
  std::vector<std::string> names;
  do {
    int key = -1;
    std::string name;
    if (!reader.read_key(key) || key != static_cast<int>(names.size())) return wrong();
    if (!reader.skip(':') || !reader.read_string(name) || name.empty()) return wrong();
    if (name.size() > kMaxNameBytes) {
      return make_error(ExitCode::kUnsupportedModel, too_long(name) + kHowToName);
    }
    names.push_back(std::move(name));
  } while (reader.skip(','));
  if (!reader.skip('}')) return wrong();
  return names;
}

Expected<ClassNames> class_names_of(const ModelDescription& model) {
  const auto found = model.metadata.find("names");
  if (found == model.metadata.end()) {
    return make_error(
        ExitCode::kUnsupportedModel,
        std::string("the model does not name its classes (no metadata key `names`)") + kHowToName);
  }
  auto names = parse_class_names(found->second);
  if (!names) return tl::unexpected(names.error());
  return ClassNames{std::move(*names), "the metadata key `names`", ExitCode::kUnsupportedModel};
}

Expected<ClassNames> read_labels_file(const std::filesystem::path& path) {
  const auto text = read_text_file(path, "correct segmentation.model.labels or --labels");
  if (!text) return tl::unexpected(text.error());
  ClassNames read{{}, "the labels file " + path.string(), ExitCode::kBadData};
  std::istringstream lines(*text);
  for (std::string name; std::getline(lines, name);) {
    if (!name.empty() && name.back() == '\r') name.pop_back();
    const std::string where = place(path, static_cast<int>(read.names.size()) + 1);
    if (name.find_first_not_of(" \t") == std::string::npos) {
      return make_error(ExitCode::kBadData,
                        where +
                            ": a line without a name: write one class on each line, background "
                            "not counted");
    }
    if (name.size() > kMaxNameBytes) {
      return make_error(ExitCode::kBadData, where + ": " + too_long(name) + ": shorten it");
    }
    read.names.push_back(std::move(name));
  }
  if (!read.names.empty()) return read;
  return make_error(
      ExitCode::kEmptyInput,
      read.source + " is empty: write one class on each line, background not counted");
}

Expected<void> check_class_count(const ClassNames& names, std::int64_t classes) {
  const auto named = static_cast<std::int64_t>(names.names.size());
  if (named == classes) return {};
  return make_error(names.fault,
                    "the network has " + std::to_string(classes) + " classes, but " + names.source +
                        " names " + std::to_string(named) +
                        "; give the names that it was trained with, background not counted");
}

}  // namespace tsg
