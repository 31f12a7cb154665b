#pragma once

#include <cstddef>
#include <filesystem>

#include "common/dataset/tum_folder.hpp"
#include "services/camera/lib/frame_source.hpp"

namespace tsg {

struct ReplayConfig {
  std::string folder;  ///< a sequence in TUM layout; must be given
  bool loop = false;   ///< starts anew after the last frame, with stamps that go on
};

/// Frames of a recorded sequence.
class ReplaySource : public FrameSource {
 public:
  /// Errors are those of open_tum_folder(), and kConfig where no folder is given.
  [[nodiscard]] static Expected<std::unique_ptr<ReplaySource>> open(const ReplayConfig& config);

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] Expected<std::unique_ptr<PendingFrame>> next() override;

 private:
  ReplaySource(TumFolder folder, bool loop);

  TumFolder folder_;
  bool loop_;
  SourceInfo info_;
  std::size_t next_ = 0;
  std::int64_t shift_ns_ = 0;  // what laps so far add to stamps
};

}  // namespace tsg
