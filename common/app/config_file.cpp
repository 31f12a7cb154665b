#include "common/app/config_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "common/core/error.hpp"

namespace tsg {
namespace {

constexpr const char* kCommandLine = "--set";

/// A value and where it was written, for messages.
struct Entry {
  YAML::Node value;
  std::string origin;
};

[[noreturn]] void fail(const std::string& message) { throw FatalError(ExitCode::kConfig, message); }

std::string origin_of(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

std::string join(const std::string& section, std::string_view key) {
  return section.empty() ? std::string(key) : section + "." + std::string(key);
}

}  // namespace

/// Every leaf of the file by its dotted name, e.g. "slam.features.count".
struct ConfigFile::Impl {
  std::map<std::string, Entry> entries;

  void flatten(const YAML::Node& node, const std::string& name, const std::string& file) {
    if (!node.IsMap()) {
      set(name, {node, origin_of(file, node.Mark())});
      return;
    }
    for (const auto& item : node) {
      const std::string child = join(name, item.first.as<std::string>());
      if (item.second.IsNull()) continue;  // an empty section: all defaults
      flatten(item.second, child, file);
    }
  }

  /// Not by assignment: to a YAML node it would change whatever shares the old value.
  void set(const std::string& name, const Entry& entry) {
    entries.erase(name);
    entries.emplace(name, entry);
  }

  void apply_override(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (equals == std::string::npos || name.find('.') == std::string::npos) {
      throw FatalError(ExitCode::kUsage,
                       "--set " + text + ": write section.key=value, e.g. slam.lockstep=true");
    }
    const std::string value = text.substr(equals + 1);
    try {
      // Nothing behind the sign means an empty text; YAML would take it for null.
      set(name, {value.empty() ? YAML::Node("") : YAML::Load(value), kCommandLine});
    } catch (const YAML::Exception& error) {
      throw FatalError(ExitCode::kUsage, "--set " + text + ": " + error.what());
    }
  }
};

ConfigFile::ConfigFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ConfigFile::~ConfigFile() = default;
ConfigFile::ConfigFile(ConfigFile&&) noexcept = default;
ConfigFile& ConfigFile::operator=(ConfigFile&&) noexcept = default;

ConfigFile ConfigFile::load(const std::filesystem::path& path,
                            const std::vector<std::string>& overrides) {
  if (!std::filesystem::is_regular_file(path)) {
    throw FatalError(ExitCode::kMissingInput,
                     path.string() + ": no such configuration file; give one with --config");
  }
  auto impl = std::make_unique<Impl>();
  try {
    const YAML::Node root = YAML::LoadFile(path.string());
    if (!root.IsMap() && !root.IsNull()) fail(path.string() + ": must hold sections, e.g. 'slam:'");
    if (root.IsMap()) impl->flatten(root, "", path.string());
  } catch (const YAML::Exception& error) {
    fail(origin_of(path.string(), error.mark) + ": not valid YAML: " + error.msg);
  }
  for (const std::string& text : overrides) impl->apply_override(text);
  return ConfigFile(std::move(impl));
}

ConfigFile ConfigFile::from_overrides(const std::vector<std::string>& overrides) {
  auto impl = std::make_unique<Impl>();
  for (const std::string& text : overrides) impl->apply_override(text);
  return ConfigFile(std::move(impl));
}

std::vector<std::string> ConfigFile::unknown_sections(
    const std::vector<std::string>& known_sections) const {
  std::vector<std::string> unknown;
  for (const auto& [name, entry] : impl_->entries) {
    const std::string section = name.substr(0, name.find('.'));
    if (std::ranges::find(known_sections, section) == known_sections.end()) {
      unknown.push_back(entry.origin + ": unknown section '" + section + "'");
    }
  }
  return unknown;
}

ConfigReader::ConfigReader(const ConfigFile& file, std::string section)
    : file_(&file), section_(std::move(section)) {}

template <typename T>
void ConfigReader::read_as(std::string_view key, T& value, const char* type_name) {
  const std::string name = join(section_, key);
  known_keys_.push_back(name);
  const auto found = file_->impl_->entries.find(name);
  if (found == file_->impl_->entries.end()) return;
  try {
    value = found->second.value.as<T>();
  } catch (const YAML::Exception&) {
    problems_.push_back(found->second.origin + ": " + name + " must be " + type_name);
  }
}

void ConfigReader::read(std::string_view key, bool& value) { read_as(key, value, "true or false"); }
void ConfigReader::read(std::string_view key, int& value) { read_as(key, value, "a whole number"); }
void ConfigReader::read(std::string_view key, double& value) { read_as(key, value, "a number"); }
void ConfigReader::read(std::string_view key, std::string& value) { read_as(key, value, "a text"); }
void ConfigReader::read(std::string_view key, std::vector<std::string>& value) {
  read_as(key, value, "a list of texts");
}
void ConfigReader::read(std::string_view key, std::vector<double>& value) {
  read_as(key, value, "a list of numbers");
}

void ConfigReader::finish(const std::vector<std::string>& more_problems) {
  const std::string prefix = section_ + ".";
  for (const auto& [name, entry] : file_->impl_->entries) {
    if (!name.starts_with(prefix) && name != section_) continue;
    if (std::ranges::find(known_keys_, name) != known_keys_.end()) continue;
    problems_.push_back(entry.origin + ": unknown key " + name);
  }
  for (const std::string& problem : more_problems) {
    problems_.push_back(join(section_, problem));
  }
  if (problems_.empty()) return;
  std::ostringstream message;
  message << "the configuration has " << problems_.size()
          << (problems_.size() == 1 ? " problem:" : " problems:");
  for (const std::string& problem : problems_) message << "\n  " << problem;
  fail(message.str());
}

}  // namespace tsg
