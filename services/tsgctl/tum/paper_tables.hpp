#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/core/error.hpp"

namespace tsg {

/// Errors as the paper's tables give them, metres.
struct PaperErrors {
  double mean = 0.0;
  double median = 0.0;
  double rmse = 0.0;
  double std_dev = 0.0;
};

/// What the paper prints for one system on one sequence.
struct PaperResult {
  PaperErrors ate;  ///< eq. 10
  PaperErrors rpe;  ///< eq. 11, of translation; over which time the paper does not say
};

/// One sequence of the paper's Tables 2 to 4.
struct PaperSequence {
  std::string_view name;  ///< "fr1/desk"
  int table = 0;
  PaperResult orb_slam3;
  PaperResult tsg_slam;
};

/// Improvement of ATE over ORB-SLAM3, percent.
struct PaperRates {
  std::optional<double> rmse;  ///< none where the other paper has none
  std::optional<double> std_dev;
};

/// One sequence of the paper's Table 5, by system: kComparedSystems.
struct PaperComparison {
  std::string_view name;
  std::array<PaperRates, 5> rates;
};
inline constexpr std::array<std::string_view, 5> kComparedSystems{
    "DS-SLAM", "DynaSLAM", "MISD-SLAM", "RDS-SLAM", "TSG-SLAM"};

/// In the order of the tables.
[[nodiscard]] std::span<const PaperSequence> paper_sequences();
[[nodiscard]] std::span<const PaperComparison> paper_comparisons();

/// Null where the paper has no such sequence.
[[nodiscard]] const PaperSequence* find_paper_sequence(std::string_view name);

/// "fr3/walking_xyz" for this and for "rgbd_dataset_freiburg3_walking_xyz"; kUsage for what is no
/// name of the benchmark.
[[nodiscard]] Expected<std::string> tum_short_name(const std::string& name);
/// "rgbd_dataset_freiburg3_walking_xyz" for "fr3/walking_xyz".
[[nodiscard]] std::string tum_folder_name(const std::string& short_name);

}  // namespace tsg
