#pragma once

#include <filesystem>
#include <vector>

#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// The folder that a run writes into.
class OutputFolder {
 public:
  /// Makes the folder and removes what an earlier run has left there, so that nothing old passes
  /// for a result; other files stay. Throws FatalError (kCannotWrite) where the folder cannot be
  /// written or has too little room for a run.
  explicit OutputFolder(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path logs() const { return path_ / "logs"; }
  /// Those of a run's files that are there.
  [[nodiscard]] std::vector<OutputFile> files() const;

 private:
  std::filesystem::path path_;
};

}  // namespace tsg
