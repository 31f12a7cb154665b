#pragma once

#include <cstddef>
#include <opencv2/core/utility.hpp>

namespace tsg::render {

/// Calls work(i) for all i below `count`, spread over all cores, in any order.
template <typename Work>
void for_each_index(std::size_t count, const Work& work) {
  cv::parallel_for_(cv::Range(0, static_cast<int>(count)), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) work(static_cast<std::size_t>(i));
  });
}

}  // namespace tsg::render
