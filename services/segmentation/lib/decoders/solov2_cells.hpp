#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "services/segmentation/lib/decoders/solov2_layout.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// One grid's numbers in the outputs of a run, whichever way these are laid out.
struct Solov2Level {
  const float* categories = nullptr;  ///< of cell 0, class 0
  const float* kernels = nullptr;     ///< of cell 0, number 0
  int size = 0;
  int stride = 0;
  std::ptrdiff_t between_cells_of_categories = 0;
  std::ptrdiff_t between_classes = 0;
  std::ptrdiff_t between_cells_of_kernels = 0;
  std::ptrdiff_t between_numbers = 0;  ///< of a kernel

  [[nodiscard]] float category(int cell, int class_id) const {
    return categories[cell * between_cells_of_categories + class_id * between_classes];
  }
};

/// The grids of a run, the finest first; views of `outputs`.
[[nodiscard]] std::vector<Solov2Level> solov2_levels(const Solov2Layout& layout,
                                                     std::span<const TensorView> outputs);

/// A class that a cell may show.
struct Solov2Candidate {
  int level = 0;
  int cell = 0;
  int class_id = 0;
  float score = 0.0F;
};

/// All that score above 0.1, by level, cell and class. Where the outputs are raw, the sigmoid is
/// taken and points-NMS done: of 2 x 2 cells that overlap, the best stays for each class.
[[nodiscard]] std::vector<Solov2Candidate> find_candidates(const Solov2Layout& layout,
                                                           std::span<const Solov2Level> levels);

}  // namespace tsg
