#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tsg {

/// A YAML configuration: one section per service, each read by that service only.
class ConfigFile {
 public:
  /// Throws FatalError (kConfig / kMissingInput) naming file and line where it cannot be parsed.
  /// `overrides` are "section.key=value" and win over the file.
  static ConfigFile load(const std::filesystem::path& path,
                         const std::vector<std::string>& overrides = {});
  /// Nothing but overrides.
  static ConfigFile from_overrides(const std::vector<std::string>& overrides);

  /// A sentence, with file and line, for each entry outside the named top-level sections.
  [[nodiscard]] std::vector<std::string> unknown_sections(
      const std::vector<std::string>& known_sections) const;

  ~ConfigFile();
  ConfigFile(ConfigFile&& other) noexcept;
  ConfigFile& operator=(ConfigFile&& other) noexcept;
  ConfigFile(const ConfigFile& other) = delete;
  ConfigFile& operator=(const ConfigFile& other) = delete;

 private:
  friend class ConfigReader;
  struct Impl;
  explicit ConfigFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads one section into a struct and finds everything that is wrong with it:
///   ConfigReader reader(file, "slam");
///   reader.read("max_features", config.features.max_features);
///   reader.finish(config.problems());
class ConfigReader {
 public:
  /// A section that is absent leaves all defaults. Sections may be dotted: "slam.features".
  ConfigReader(const ConfigFile& file, std::string section);

  /// Overwrites `value` where the key is there; a value of the wrong type is a problem.
  void read(std::string_view key, bool& value);
  void read(std::string_view key, int& value);
  void read(std::string_view key, double& value);
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, std::vector<std::string>& value);
  void read(std::string_view key, std::vector<double>& value);

  /// Throws FatalError (kConfig) listing every value of a wrong type and every key that nobody
  /// read, with file and line, and `more_problems` (each starting with the name of its key).
  void finish(const std::vector<std::string>& more_problems = {});

 private:
  template <typename T>
  void read_as(std::string_view key, T& value, const char* type_name);

  const ConfigFile* file_;
  std::string section_;
  std::vector<std::string> known_keys_;
  std::vector<std::string> problems_;
};

}  // namespace tsg
