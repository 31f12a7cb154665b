#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/slam/lib/dynamic/frame_verdicts.hpp"
#include "services/tsgctl/dynamic/frame_truth.hpp"

namespace tsg {

/// An instance is visible, and a frame has a recall or a precision of its own, from so many
/// features on: shares of fewer say nothing.
inline constexpr std::uint64_t kMinFeatures = 5;
/// An instance counts as removed, or as kept, from this share of its features on.
inline constexpr double kMostFeatures = 0.8;

/// How many features were judged which way.
struct Judged {
  std::uint64_t removed = 0;
  std::uint64_t kept = 0;

  [[nodiscard]] std::uint64_t total() const { return removed + kept; }
  Judged& operator+=(const Judged& other);
  bool operator==(const Judged&) const = default;
};

/// Verdicts on features by what is true of them.
struct VerdictCounts {
  std::array<Judged, 4> by_state;  ///< index: TrueState

  [[nodiscard]] Judged& of(TrueState state) { return by_state[static_cast<std::size_t>(state)]; }
  [[nodiscard]] const Judged& of(TrueState state) const {
    return by_state[static_cast<std::size_t>(state)];
  }
  /// Share of the features on moving things that was removed; nothing where there were none.
  [[nodiscard]] std::optional<double> recall() const;
  /// Of the removed features on moving and still things, the share on moving ones.
  [[nodiscard]] std::optional<double> precision() const;
  VerdictCounts& operator+=(const VerdictCounts& other);
  bool operator==(const VerdictCounts&) const = default;
};

/// Kinds of features as the paper's Table 1 counts them, its last column split by motion.
enum class FeatureKind : std::uint8_t {
  kStaticThings,        ///< that never move by themselves, and do not now
  kDynamicClasses,      ///< people and the like, moving or not
  kPotentiallyMoving,   ///< on a thing of a potentially dynamic class that moves
  kPotentiallyStill,    ///< ... that does not
  kUnexpectedlyMoving,  ///< on a thing that moves though its class says nothing of it
};
inline constexpr std::size_t kFeatureKinds = 5;
using KindCounts = std::array<Judged, kFeatureKinds>;  ///< index: FeatureKind

/// An instance that may move, or does, in one frame.
struct InstanceScore {
  int id = 0;
  std::string class_name;
  std::string name;
  bool is_moving = false;
  Judged features;  ///< away from edges
};

/// How the verdicts of one frame compare with the truth.
struct FrameScore {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;  ///< as recorded
  bool is_tracked = false;
  std::map<std::string, VerdictCounts> by_class = {};  ///< of the true thing; away from edges
  VerdictCounts at_edge = {};
  KindCounts kinds = {};                      ///< with those at edges
  std::vector<InstanceScore> instances = {};  ///< not of dynamic classes; that may move, or do

  [[nodiscard]] VerdictCounts away_from_edges() const;
};

/// The name under which by_class has what lies on no instance.
inline constexpr const char* kBackground = "background";

/// Counts what is in `verdicts`; seq, stamp_ns and is_tracked are the caller's to fill in.
[[nodiscard]] FrameScore score_frame(const FrameVerdicts& verdicts, const FrameTruth& truth);

/// A figure over the frames that have one.
struct FrameSpread {
  std::size_t frames = 0;
  double median = 0.0;
  double worst = 0.0;
};

/// An instance over all frames in which it is visible.
struct InstanceTally {
  int id = 0;
  std::string class_name;
  std::string name;
  std::size_t frames_moving = 0;
  std::size_t frames_removed = 0;  ///< of these: most of its features were removed
  std::size_t frames_still = 0;
  std::size_t frames_kept = 0;  ///< of these: most of its features were kept

  [[nodiscard]] std::optional<double> removed_share() const;
  [[nodiscard]] std::optional<double> kept_share() const;
};

/// How the verdicts of a whole sequence compare with the truth.
struct VerdictSummary {
  std::size_t frames = 0;
  VerdictCounts total = {};  ///< away from edges
  VerdictCounts at_edge = {};
  FrameSpread recall = {};  ///< away from edges
  FrameSpread precision = {};
  std::map<std::string, VerdictCounts> by_class = {};
  std::vector<InstanceTally> instances = {};  ///< by id
  KindCounts kinds{};

  [[nodiscard]] VerdictCounts with_edges() const;
};

[[nodiscard]] VerdictSummary summarise(const std::vector<FrameScore>& scores);

}  // namespace tsg
