#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/decoders/class_names.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// One level of SOLOv2's grids of cells.
struct Solov2Grid {
  int size = 0;                ///< cells along each side
  int stride = 0;              ///< smallest area of a mask, in its samples, is above it
  std::size_t first_cell = 0;  ///< in merged outputs
  std::size_t categories = 0;  ///< index of the output with class scores
  std::size_t kernels = 0;     ///< index of the output with mask kernels
};

/// A SOLOv2 network (Wang et al., "SOLOv2: Dynamic and Fast Instance Segmentation", 2020), cut
/// where its convolutions end. C classes, kernels of E numbers, five grids of S x S cells. Either
/// raw:
///   5 x     [1, C, S, S]        class scores, before the sigmoid
///   5 x     [1, E, S, S]        mask kernels
///   feature [1, E, H/4, W/4]
/// in any order, or merged, the cells of the grids 40, 36, 24, 16, 12 one after another:
///   scores  [3872, C]           0..1, after points-NMS
///   kernels [3872, E]
///   feature [1, E, H/4, W/4]
/// in any order. The leading 1 may be absent, or stand before scores and kernels as well.
struct Solov2Layout {
  cv::Size input_size;
  cv::Size mask_size;
  int kernel_length = 0;
  bool is_merged = false;
  std::size_t feature = 0;            ///< index of that output
  std::array<Solov2Grid, 5> grids{};  ///< the finest first
  std::vector<std::string> class_names;

  [[nodiscard]] int classes() const { return static_cast<int>(class_names.size()); }
};

/// The layout of `model`; kUnsupportedModel, saying what differs, where it is not one of SOLOv2's,
/// and the error of check_class_count().
[[nodiscard]] Expected<Solov2Layout> solov2_layout(const ModelDescription& model,
                                                   const ClassNames& names);

}  // namespace tsg
