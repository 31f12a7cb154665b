#include "common/scene_file/map_reader.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

namespace tsg {
namespace {

/// Quoted words are texts, whatever they look like.
bool is_plain(const YAML::Node& node) { return node.IsScalar() && node.Tag() != "!"; }

template <typename T>
std::optional<T> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return {};
  return value;
}

/// NaN and infinity, YAML's spelling included, are numbers here: their range is what is wrong.
std::optional<double> number_of(const YAML::Node& node) {
  if (!is_plain(node)) return {};
  std::string text = node.Scalar();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* special : {".nan", ".inf"}) {
    if (text.ends_with(special)) return std::numeric_limits<double>::quiet_NaN();
  }
  return parsed<double>(text);
}

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// What is wrong with a number; empty where nothing is.
std::string complaint(const YAML::Node& node, Limits limits) {
  const auto number = number_of(node);
  if (!number) return "must be a number";
  if (!std::isfinite(*number)) return "must be finite, not " + node.Scalar();
  if (*number >= limits.low && *number <= limits.high) return "";
  return "must be " + text_of(limits.low) + " to " + text_of(limits.high) + ", not " +
         node.Scalar();
}

}  // namespace

std::optional<std::vector<double>> read_numbers(const ListItem& item,
                                                std::size_t count,
                                                Limits limits,
                                                SceneProblems& problems) {
  if (!item.node.IsSequence() || item.node.size() != count) {
    problems.add(item.line(), item.path, "must be a list of " + std::to_string(count) + " numbers");
    return {};
  }
  std::vector<double> numbers;
  for (const YAML::Node& element : item.node) {
    if (const std::string what = complaint(element, limits); !what.empty()) {
      problems.add(item.line(), item.path, what);
      return {};
    }
    numbers.push_back(*number_of(element));
  }
  return numbers;
}

MapReader::MapReader(const YAML::Node& node, std::string path, SceneProblems& problems)
    : path_(std::move(path)),
      problems_(&problems),
      line_(node.Mark().line + 1),
      is_map_(node.IsMap()) {
  if (is_map_) {
    load(node);
  } else {
    problems_->add(line_, path_, "must hold keys with values, e.g. {name: value}");
  }
}

void MapReader::load(const YAML::Node& node) {
  for (const auto& item : node) {
    const int line = item.first.Mark().line + 1;
    if (!item.first.IsScalar()) {
      problems_->add(line, path_, "has a key that is no word");
      continue;
    }
    Entry entry{item.first.Scalar(), item.second, line};
    if (const Entry* first = find(entry.key)) {
      problems_->add(line, path(entry.key),
                     "is given twice, first in line " + std::to_string(first->line));
      continue;
    }
    entries_.push_back(std::move(entry));
  }
}

const MapReader::Entry* MapReader::find(const std::string& key) const {
  const auto found = std::ranges::find(entries_, key, &Entry::key);
  return found == entries_.end() ? nullptr : &*found;
}

const MapReader::Entry* MapReader::take(const std::string& key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.push_back(key);
  const Entry* entry = find(key);
  if (entry != nullptr && entry->value.IsNull()) {
    add_problem(key, "has no value; give one or remove the line");
    return nullptr;
  }
  return entry;
}

bool MapReader::is_list(const std::string& key) const {
  const Entry* entry = find(key);
  return entry != nullptr && entry->value.IsSequence();
}

int MapReader::line(const std::string& key) const {
  const Entry* entry = find(key);
  return entry == nullptr ? line_ : entry->line;
}

std::string MapReader::path(const std::string& key) const {
  if (path_.empty()) return key;
  return key.empty() ? path_ : path_ + "." + key;
}

bool MapReader::require(std::initializer_list<const char*> keys) {
  bool all = is_map_;
  for (const char* key : keys) {
    if (!is_map_ || has(key)) continue;
    add_problem(key, "is missing");
    all = false;
  }
  return all;
}

void MapReader::add_problem(const std::string& key, const std::string& what) {
  problems_->add(line(key), path(key), what);
}

void MapReader::read(const std::string& key, bool& value) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  if (!is_plain(entry->value) || !YAML::convert<bool>::decode(entry->value, value)) {
    add_problem(key, "must be true or false");
  }
}

void MapReader::read(const std::string& key, std::string& value) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  if (entry->value.IsScalar() && !entry->value.Scalar().empty()) {
    value = entry->value.Scalar();
  } else {
    add_problem(key, "must be a text");
  }
}

void MapReader::read(const std::string& key,
                     std::string& value,
                     const std::vector<std::string>& known) {
  std::string word;
  read(key, word);
  if (word.empty()) return;
  if (std::ranges::find(known, word) == known.end()) {
    add_problem(key, "there is no \"" + word + "\"; " + suggestion(word, known));
  } else {
    value = word;
  }
}

void MapReader::read(const std::string& key, std::uint64_t& value) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  const auto number =
      is_plain(entry->value) ? parsed<std::uint64_t>(entry->value.Scalar()) : std::nullopt;
  if (number) {
    value = *number;
  } else {
    add_problem(key, "must be a whole number, 0 or more");
  }
}

void MapReader::read(const std::string& key, int& value, Limits limits) {
  double number = value;
  read(key, number, limits);
  if (number == std::floor(number)) {
    value = static_cast<int>(number);
  } else {
    add_problem(key, "must be a whole number");
  }
}

void MapReader::read(const std::string& key, double& value, Limits limits) {
  read_scaled(key, value, limits, 1.0);
}

void MapReader::read_scaled(const std::string& key, double& value, Limits limits, double factor) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  if (const std::string what = complaint(entry->value, limits); what.empty()) {
    value = *number_of(entry->value) * factor;
  } else {
    add_problem(key, what);
  }
}

void MapReader::read(const std::string& key, Eigen::Vector2d& value, Limits limits) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  const auto numbers = read_numbers({entry->value, path(key)}, 2, limits, *problems_);
  if (numbers) value = {numbers->at(0), numbers->at(1)};
}

void MapReader::read(const std::string& key, Eigen::Vector3d& value, Limits limits) {
  const Entry* entry = take(key);
  if (entry == nullptr) return;
  const auto numbers = read_numbers({entry->value, path(key)}, 3, limits, *problems_);
  if (numbers) value = {numbers->at(0), numbers->at(1), numbers->at(2)};
}

std::vector<ListItem> MapReader::list(const std::string& key) {
  const Entry* entry = take(key);
  std::vector<ListItem> items;
  if (entry == nullptr) return items;
  if (!entry->value.IsSequence()) {
    add_problem(key, "must be a list");
    return items;
  }
  for (std::size_t i = 0; i < entry->value.size(); ++i) {
    items.push_back({entry->value[i], path(key) + "[" + std::to_string(i) + "]"});
  }
  return items;
}

std::optional<MapReader> MapReader::map(const std::string& key) {
  const Entry* entry = take(key);
  if (entry == nullptr) return {};
  return MapReader(entry->value, path(key), *problems_);
}

std::optional<std::pair<std::string, MapReader>> MapReader::only_map(
    const std::vector<std::string>& known) {
  if (!is_map_) return {};
  if (entries_.size() != 1) {
    add_problem("", "must hold one key; " + suggestion("", known));
    return {};
  }
  const std::string key = entries_.front().key;
  if (std::ranges::find(known, key) == known.end()) {
    add_problem(key, "unknown key; " + suggestion(key, known));
    return {};
  }
  auto reader = map(key);
  if (!reader) return {};
  return std::pair(key, std::move(*reader));
}

void MapReader::finish() {
  for (const Entry& entry : entries_) {
    if (std::ranges::find(known_, entry.key) != known_.end()) continue;
    problems_->add(entry.line, path(entry.key), "unknown key; " + suggestion(entry.key, known_));
  }
}

}  // namespace tsg
