#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace tsg {

inline constexpr int kEdgeCells = 3;  ///< masks are cut up to 10 pixels short

struct DepthRange {
  double nearest = 0.0;   ///< metres
  double farthest = 0.0;  ///< metres
};

/// Without the twentieth that is nearest and that which is farthest. Reorders `depths`, which must
/// not be empty.
[[nodiscard]] DepthRange usual_range(std::vector<double>& depths);

/// Grows the marked cells (CV_8UC1, 255) of a moving thing as long as most of what lies beside them
/// is the same surface: a mask that was cut short. A whole thing touches others, as feet do the
/// floor, but only here and there. Stays within `range`, give or take `tolerance_m`.
void complete_body(const cv::Mat& depth,
                   const DepthRange& range,
                   double tolerance_m,
                   cv::Mat& marked);

/// The thing that `seeds` were seen to move on, as far as it is `known` or hangs together with them
/// nearby: neither what lies behind nor what it stands beside. All CV_8UC1 of cells, 255.
[[nodiscard]] cv::Mat body_around(const cv::Mat& seeds, const cv::Mat& known, const cv::Mat& depth);

}  // namespace tsg
